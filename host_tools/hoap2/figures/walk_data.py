"""A finished walk as the figures and comparisons see it: signals in the start frame, steps, the fall."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from hoap2 import metrics, parameters, scenario, signal_log, walk_metrics, walk_plan
from hoap2.errors import UserError
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog
from hoap2.walk_plan import Footprint

DEG = 180.0 / math.pi
FILES = ("run.toml", "summary.json", "signals.parquet")


@dataclass
class Walk:
    """Signals, scenario and summary of one run. Positions are in the start frame, mm; angles in deg."""

    folder: Path
    log: SignalLog
    scenario: Scenario
    summary: dict

    @cached_property
    def t_s(self) -> np.ndarray:
        return self.log.t_s

    @cached_property
    def fall_tick(self) -> int | None:
        return metrics.fall_tick(self.log)

    @property
    def fall_s(self) -> float | None:
        return None if self.fall_tick is None else float(self.t_s[self.fall_tick])

    @property
    def until_fall(self) -> slice:
        """The rows up to the fall, all without one."""
        return slice(0, self.log.count if self.fall_tick is None else self.fall_tick + 1)

    @property
    def last(self) -> int:
        """The last row before the fall."""
        return self.until_fall.stop - 1

    @cached_property
    def chest_deg(self) -> np.ndarray:
        """Roll and pitch of the chest, truth, (ticks, 2)."""
        return self.log.block("p.true_chest_rpy_rad")[:, :2] * DEG

    def mm(self, name: str) -> np.ndarray | None:
        """A horizontal position, (ticks, 2); None when the run does not have it."""
        block = self.log.block(name)
        return None if block is None else 1e3 * metrics.to_start_frame(block, self.scenario)

    def turned_mm(self, name: str) -> np.ndarray | None:
        """A horizontal difference of positions, (ticks, 2)."""
        block = self.log.block(name)
        if block is None:
            return None
        yaw = self.scenario.values["plant"]["start_yaw_W_rad"][0]
        c, s = math.cos(yaw), math.sin(yaw)
        return 1e3 * block[:, :2] @ np.array([[c, -s], [s, c]])

    @cached_property
    def step_ticks(self) -> dict[int, int]:
        """Step -> its first tick."""
        if "c.step_index" not in self.log:
            return {}
        index = self.log.column("c.step_index")
        first = np.flatnonzero(np.diff(index) > 0) + 1
        return {int(index[tick]): int(tick) for tick in first}

    @cached_property
    def nominal(self) -> list[Footprint]:
        """The footprints that the parameters ask for: both at the start, then one a step."""
        return walk_plan.footprints(self.scenario.values["controller"], self.scenario.steps_planned)

    @cached_property
    def landed(self) -> list[tuple[int, int, float, float, float]]:
        """(step, foot, x mm, y mm, yaw rad) of where each step's foot stood as the step ended, up to the fall."""
        pos, yaw = self.log.block("p.true_foot_pos_W_m"), self.log.block("p.true_foot_yaw_W_rad")
        start_yaw = self.scenario.values["plant"]["start_yaw_W_rad"][0]
        found = []
        for step, end in walk_metrics.step_ends(self.log, self.last):
            foot = self.nominal[step + 1].foot if step + 1 < len(self.nominal) else None
            if foot is not None and (end < self.last or self.fall_tick is None):
                x, y = 1e3 * metrics.to_start_frame(pos[end, 3 * foot : 3 * foot + 2], self.scenario)
                found.append((step, foot, float(x), float(y), float(yaw[end, foot] - start_yaw)))
        return found

    @cached_property
    def shifts_mm(self) -> tuple[np.ndarray, np.ndarray]:
        """Steps and the shift (7.14) that each ended with, (steps, 2) along and across the start's heading."""
        ends = walk_metrics.step_ends(self.log, self.last)
        shift = self.turned_mm("c.landing_shift_W_m")
        if shift is None or not ends:
            return np.zeros(0), np.zeros((0, 2))
        return np.array([step for step, _ in ends]), shift[[end for _, end in ends]]

    @property
    def on_soil(self) -> bool:
        ground = parameters.table().enums["ground"]
        return ground[int(self.scenario.values["plant"]["ground"][0])] == "soil"

    @property
    def controls_landing(self) -> bool:
        return bool(self.scenario.values["controller"]["landing_control"][0])


def load(folder: Path) -> Walk:
    """A run folder; a clear error for anything else."""
    if not folder.is_dir():
        raise UserError(f"there is no run folder {folder}", "make one: ./hoap2 run sand-walk")
    missing = [name for name in FILES if not (folder / name).is_file()]
    if missing:
        what = "a study" if (folder / "study.json").is_file() else "no complete run folder"
        hint = "give the folder of one run: it holds " + ", ".join(FILES)
        raise UserError(f"{folder} is {what}: {missing[0]} is missing", hint)
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UserError(f"cannot read {folder / 'summary.json'}: {error}") from None
    log = signal_log.read(folder / "signals.parquet")
    if log.count < 2 or "p.true_chest_rpy_rad.x" not in log or log.block("p.true_com_W_m") is None:
        raise UserError(f"{folder} holds no motion of the robot", "was the run made by another version?")
    return Walk(folder, log, scenario.load(str(folder / "run.toml")), summary)


def sole_mm(x_mm: float, y_mm: float, yaw_rad: float) -> np.ndarray:
    """Corners of a sole about the point under its ankle, (4, 2)."""
    feet = parameters.table().robot["feet"]
    toe, heel, half = (1e3 * feet[k] for k in ("ankle_to_toe_m", "ankle_to_heel_m", "half_width_m"))
    corners = np.array([[toe, half], [toe, -half], [-heel, -half], [-heel, half]])
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return corners @ np.array([[c, s], [-s, c]]) + [x_mm, y_mm]
