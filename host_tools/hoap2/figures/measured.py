"""What a walk shows in numbers, for the text beside the book's figures."""

from __future__ import annotations

import numpy as np

from hoap2 import metrics, parameters, walk_metrics
from hoap2.figures.walk_data import Walk

PITCH_GROWN_DEG = 2.0


def rows_of_steps(walk: Walk, first: int, last: int) -> slice | None:
    """The rows from the start of step `first` to the end of step `last`; None when the walk did not get there."""
    ticks = walk.step_ticks
    if first not in ticks or last + 1 not in ticks or ticks[last + 1] > walk.last:
        return None
    return slice(ticks[first], ticks[last + 1])


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def roll_rms_deg(walk: Walk, first: int, last: int) -> float | None:
    rows = rows_of_steps(walk, first, last)
    return None if rows is None else _rms(walk.chest_deg[rows, 0])


def sway_mm(walk: Walk, first: int, last: int) -> float | None:
    """Half the lateral way of the CoM over these steps."""
    rows, com = rows_of_steps(walk, first, last), walk.mm("p.true_com_W_m")
    return None if rows is None or com is None else 0.5 * float(np.ptp(com[rows, 1]))


def pitch_at_step_deg(walk: Walk, step: int) -> float | None:
    """Mean pitch over a step."""
    rows = rows_of_steps(walk, step, step)
    return None if rows is None else float(walk.chest_deg[rows, 1].mean())


def pitch_grown(walk: Walk, limit_deg: float = PITCH_GROWN_DEG) -> tuple[int, float] | None:
    """Step and time (s) from which the backward pitch stays beyond the limit up to the fall or the end."""
    pitch = walk.chest_deg[walk.until_fall, 1]
    within = np.flatnonzero(pitch > -limit_deg)
    tick = int(within[-1]) + 1 if within.size else 0
    if tick >= len(pitch) or not walk.step_ticks:
        return None
    return int(walk.log.column("c.step_index")[tick]), float(walk.t_s[tick])


def walk_begins_s(walk: Walk) -> float:
    return float(walk.t_s[min(walk.step_ticks.values())])


def outcome(walk: Walk) -> str:
    """`all 36 steps, stands at the end` or `fell backward, step 18, 7.2 s into the walk`."""
    done, planned = walk.summary.get("steps_taken"), walk.scenario.steps_planned
    if walk.fall_tick is not None:
        step = walk_fall_step(walk)
        where = metrics.fall_direction(walk.log, walk.fall_tick)
        return f"fell {where}, step {step}, {walk.fall_s - walk_begins_s(walk):.1f} s into the walk"
    end = "stands at the end" if walk.summary.get("stands_at_end") else "does not stand still at the end"
    return f"{'all ' if done == planned else ''}{done} of {planned} steps, {end}"


def walk_fall_step(walk: Walk) -> int | None:
    """The step whose lift-off was the last before the fall."""
    single = parameters.table().enums["phase"].index("single_support")
    lifted = np.flatnonzero(walk.log.column("c.phase")[walk.until_fall] == single)
    return int(walk.log.column("c.step_index")[lifted[-1]]) if lifted.size else None


def sinkage_mm(walk: Walk) -> float | None:
    found = walk_metrics.sinkage_mid_stance_m(walk.log, walk.last)
    return None if found is None else 1e3 * found


def cop_margin_mm(walk: Walk) -> float | None:
    """Least distance of the reference CoP in single support from the edge of the planned stance sole; inside > 0."""
    cop, supports = walk.mm("c.cop_ref_W_m"), walk_metrics.single_supports(walk.log, walk.last)
    if cop is None or not supports:
        return None
    feet = parameters.table().robot["feet"]
    margins = []
    for step, _, first, end in supports:
        stance = walk.nominal[step] if step != 1 else walk.nominal[1 - walk.nominal[2].foot]
        c, s = np.cos(stance.yaw_rad), np.sin(stance.yaw_rad)
        local = (cop[first : end + 1] - [1e3 * stance.x_m, 1e3 * stance.y_m]) @ np.array([[c, -s], [s, c]]) * 1e-3
        margins.append(min((feet["ankle_to_toe_m"] - local[:, 0]).min(), (local[:, 0] + feet["ankle_to_heel_m"]).min(),
                           (feet["half_width_m"] - np.abs(local[:, 1])).min()))  # fmt: skip
    return 1e3 * float(min(margins))
