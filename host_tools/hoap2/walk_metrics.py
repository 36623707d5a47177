"""What a walk did step by step, from its log alone: sinkage, shifts of the landing, whether it was survived."""

from __future__ import annotations

import math

import numpy as np

from hoap2 import parameters
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog

SURVIVED_SHARE = 350.0 / 420.0  # of the planned way: a walk that only marks time is not survived


def single_supports(log: SignalLog, last: int) -> list[tuple[int, int, int, int]]:
    """(step, stance foot, first tick, last tick) of each step's single support, up to the row `last`.

    A single support that the row `last` cuts short is left out: it has no middle.
    """
    if any(f"c.{name}" not in log for name in ("phase", "step_index", "stance_foot")):
        return []
    single = log.column("c.phase") == parameters.table().enums["phase"].index("single_support")
    step = np.where(single, log.column("c.step_index"), 0)[: last + 1]
    borders = np.flatnonzero(np.diff(step)) + 1
    found = []
    for first, end in zip(np.r_[0, borders], np.r_[borders, len(step)]):
        foot = int(log.column("c.stance_foot")[first])
        if step[first] > 0 and foot in (0, 1) and (end <= last or last == log.count - 1):
            found.append((int(step[first]), foot, int(first), int(end) - 1))
    return found


def sinkage_mid_stance_m(log: SignalLog, last: int) -> float | None:
    """Mean sinkage of the stance sole (mean over the sole) at mid single support, averaged over the steps."""
    depth = log.block("p.true_sinkage_m")
    supports = single_supports(log, last)
    if depth is None or not supports:
        return None
    return float(np.mean([depth[(first + end) // 2, foot] for _, foot, first, end in supports]))


def step_ends(log: SignalLog, last: int) -> list[tuple[int, int]]:
    """(step, last tick) of each step up to the row `last`."""
    if "c.step_index" not in log:
        return []
    index = log.column("c.step_index")[: last + 1]
    ends = np.r_[np.flatnonzero(np.diff(index)), len(index) - 1]
    return [(int(index[end]), int(end)) for end in ends if index[end] > 0]


def landing_shifts_m(log: SignalLog, last: int) -> np.ndarray:
    """(steps, 2): the shift (7.14) that each step ended with, world axes, m; no rows without the signal."""
    shift = log.block("c.landing_shift_W_m")
    ends = step_ends(log, last)
    return np.zeros((0, 2)) if shift is None or not ends else shift[[end for _, end in ends]]


def survived(numbers: dict, scenario: Scenario) -> bool | None:
    """All planned steps, five sixths of the planned way (350 of 420 mm), standing at the end, never fallen.

    numbers: what metrics.compute has found. None without steps to survive.
    """
    if not scenario.steps_planned:
        return None
    plan = np.array([numbers["plan_x_m"], numbers["plan_y_m"]])
    length = math.hypot(*plan)
    way = float(np.dot([numbers["progress_x_m"], numbers["progress_y_m"]], plan) / length) if length > 1e-6 else 0.0
    arrived = way >= SURVIVED_SHARE * length
    done = numbers["steps_taken"] == scenario.steps_planned
    return bool(done and arrived and numbers["stands_at_end"] and not numbers["fell"])
