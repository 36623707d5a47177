"""The report's figures, in the manner of Fig. 7.10: one function each, from a run's log."""

from __future__ import annotations

import math

import numpy as np

from hoap2 import metrics, parameters, walk_plan
from hoap2.axes import INK, Axes, Patch, Stroke
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog
from hoap2.svg import Figure

RIGHT, LEFT, THIRD, ALARM = "#d55e00", "#0a84d0", "#009e73", "#d00000"  # told apart with any colour vision
REF = Stroke(INK, 0.9, "3.3 1.4", 0.8)
STEP, FALL = Stroke(INK, 0.5, "", 0.18), Stroke(ALARM, 1.4)
UNIT_IN = 72.0  # units of a figure an inch of its height
DEG = 180.0 / math.pi


def thin(t: np.ndarray, y: np.ndarray, bins: int = 700) -> tuple[np.ndarray, np.ndarray]:
    """Few points that still show every peak: the least and the largest of each bin, in order."""
    size = len(y) // bins
    if size < 3:
        return t, y
    whole = len(y) // size * size
    blocks = y[:whole].reshape(-1, size)
    gaps = np.isnan(blocks)
    least, largest = (np.where(gaps, end, blocks) for end in (np.inf, -np.inf)) if gaps.any() else (blocks, blocks)
    ends = np.sort(np.stack([least.argmin(axis=1), largest.argmax(axis=1)]), axis=0)
    picks = np.unique((ends + np.arange(len(blocks)) * size).T.ravel())
    picks = np.concatenate([picks, np.arange(whole, len(y))])
    return t[picks], y[picks]


class Run:
    """A run as the figures see it: log, scenario, step and fall times, positions in the start frame."""

    def __init__(self, log: SignalLog, scenario: Scenario) -> None:
        self.log, self.scenario, self.t = log, scenario, log.t_s
        tick = metrics.fall_tick(log)
        self.fall_s = None if tick is None else float(self.t[tick])
        index = log.column("c.step_index") if "c.step_index" in log else np.zeros(log.count, np.int32)
        self.step_ticks = np.flatnonzero(np.diff(index)) + 1

    def column(self, name: str, scale: float = 1.0) -> np.ndarray | None:
        return self.log.column(name) * scale if name in self.log else None

    def start_mm(self, name: str) -> np.ndarray | None:
        """A horizontal position in the start frame, mm."""
        block = self.log.block(name)
        return None if block is None else 1e3 * metrics.to_start_frame(block, self.scenario)

    def line(self, axes: Axes, y: np.ndarray | None, label: str, stroke: Stroke, bins: int = 700) -> None:
        if y is not None and np.isfinite(y).any():
            axes.line(*thin(self.t, y, bins), stroke, label)

    def marks(self, axes: Axes) -> None:
        """A hair line at each step, a strong one at the fall."""
        axes.marks += [(float(self.t[tick]), STEP) for tick in self.step_ticks]
        if self.fall_s is not None:
            axes.marks.append((self.fall_s, FALL))
            axes.notes.append((self.fall_s, "fell", ALARM))

    def until_fall(self) -> int:
        """The number of rows before the fall, all rows without one."""
        return self.log.count if self.fall_s is None else int(np.searchsorted(self.t, self.fall_s))


def _over_time(run: Run, rows: list[Axes], height_in: float) -> Figure:
    """Axes below each other with one time axis."""
    for axes in rows:
        run.marks(axes)
        axes.x_numbers = axes is rows[-1]
    rows[-1].x_label = "time (s)"
    return Figure([[axes] for axes in rows], height_in * UNIT_IN)


def attitude(run: Run) -> Figure:
    """Roll and pitch of the chest over time with step marks, as Fig. 7.10 B."""
    rpy, rows = run.log.block("p.true_chest_rpy_rad"), []
    for row, (name, color) in enumerate((("roll", RIGHT), ("pitch", LEFT))):
        rows.append(Axes(y_label=f"{name} (deg)"))
        run.line(rows[-1], rpy[:, row] * DEG, "truth", Stroke(color))
        run.line(rows[-1], run.column(f"c.{name}_est_rad", DEG), "as the robot senses it", REF)
    return _over_time(run, rows, 4.2)


def _sole(x_mm: float, y_mm: float, yaw_rad: float) -> np.ndarray:
    feet = parameters.table().robot["feet"]
    toe, heel, half = (1e3 * feet[k] for k in ("ankle_to_toe_m", "ankle_to_heel_m", "half_width_m"))
    corners = np.array([[toe, half], [toe, -half], [-heel, -half], [-heel, half]])
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return corners @ np.array([[c, s], [-s, c]]) + [x_mm, y_mm]


def _taken_footprints(run: Run) -> list[tuple[int, float, float, float]]:
    """(foot, x mm, y mm, yaw) of both feet at the start and at each end of a step, where a foot has moved."""
    pos, yaw = run.log.block("p.true_foot_pos_W_m"), run.log.block("p.true_foot_yaw_W_rad")
    start_yaw = run.scenario.values["plant"]["start_yaw_W_rad"][0]
    last = min(run.log.count - 1, run.until_fall())
    prints: list[tuple[int, float, float, float]] = []
    for tick in [0, *[t - 1 for t in run.step_ticks if t <= last], last]:
        for foot in (0, 1):
            x, y = 1e3 * metrics.to_start_frame(pos[tick, 3 * foot : 3 * foot + 2], run.scenario)
            before = [p for p in prints if p[0] == foot]
            if not before or math.hypot(x - before[-1][1], y - before[-1][2]) > 2.0:
                prints.append((foot, x, y, yaw[tick, foot] - start_yaw))
    return prints


PLANNED = Stroke(INK, 0.6, "0.8 1.2", 0.6)


def _footprints(run: Run, axes: Axes) -> None:
    for p in walk_plan.footprints(run.scenario.values["controller"], run.scenario.steps_planned):
        axes.patches.append(Patch(_sole(1e3 * p.x_m, 1e3 * p.y_m, p.yaw_rad), edge=PLANNED))
    taken = _taken_footprints(run)
    for number, color in enumerate((RIGHT, LEFT)):
        places = np.array([(x, y) for foot, x, y, _ in taken if foot == number]).reshape(-1, 2)
        for x, y in places:  # the ankle's place as a cross of 3 mm
            axes.line(np.array([x - 1.5, x + 1.5, np.nan, x, x]), np.array([y, y, np.nan, y - 1.5, y + 1.5]),
                      Stroke(color, 0.8))  # fmt: skip
    for foot, x, y, yaw in taken:
        color = LEFT if foot else RIGHT
        axes.patches.append(Patch(_sole(x, y, yaw), color, 0.16, Stroke(color, 0.6, "", 0.3)))
    axes.entries += [
        ("footprints, planned", PLANNED.but(width=0.8)),
        ("right, taken", Patch(np.zeros((0, 2)), RIGHT, 0.4)),
        ("left, taken", Patch(np.zeros((0, 2)), LEFT, 0.4)),
    ]


def plane(run: Run) -> Figure:
    """CoM, CoP and footprints seen from above, as Fig. 7.10 C."""
    axes = Axes(x_label="x, forward (mm)", y_label="y, left (mm)", margins=(0.05, 0.05), equal=True)
    _footprints(run, axes)
    for name, label, stroke in (
        ("p.true_cop_W_m", "CoP, truth", Stroke(THIRD, 1.5, dots=True)),
        ("c.com_plan_W_m", "CoM, plan (7.13)", REF),
        ("p.true_com_W_m", "CoM, truth", Stroke(INK, 1.2)),
    ):
        track = run.start_mm(name)
        if track is not None:
            axes.line(*track[: run.until_fall()][::5].T, stroke, label)
    return Figure([[axes]], 4.0 * UNIT_IN)


def _plane_signals(run: Run, signals: list[tuple[str, str, Stroke]], height_in: float = 4.4) -> Figure:
    rows = [Axes(y_label=f"{axis} (mm)") for axis in ("x, forward", "y, left")]
    for row, axes in enumerate(rows):
        for name, label, stroke in signals:
            track = run.start_mm(name)
            run.line(axes, None if track is None else track[:, row], label, stroke)
    return _over_time(run, rows, height_in)


def com_cop(run: Run) -> Figure:
    """CoM and CoP over time against their references."""
    return _plane_signals(run, [
        ("p.true_cop_W_m", "CoP, truth", Stroke(THIRD, 0.6, "", 0.8)),
        ("c.cop_ref_W_m", "CoP, reference", Stroke(RIGHT, 0.9)),
        ("c.com_plan_W_m", "CoM, plan", REF),
        ("p.true_com_W_m", "CoM, truth", Stroke(LEFT, 1.3)),
    ])  # fmt: skip


def capture_point(run: Run) -> Figure:
    """The capture point: desired (7.10) and as the robot senses it (7.1)."""
    return _plane_signals(run, [
        ("c.cp_est_W_m", "measured", Stroke(LEFT)),
        ("c.cp_ref_W_m", "desired", REF),
        ("c.cp_eos_W_m", "end of step", Stroke(RIGHT, 0.8)),
    ])  # fmt: skip


THIN_REF = REF.but(width=0.6, dash="2.2 1")


def forces(run: Run) -> Figure:
    """Vertical force on each foot: truth and the sum of the cells."""
    rows = []
    for foot, key, color in (("right", "r", RIGHT), ("left", "l", LEFT)):
        rows.append(Axes(y_label=f"{foot} foot (N)"))
        run.line(rows[-1], run.column(f"p.true_foot_force_W_N.{key}.z"), "truth", Stroke(color))
        run.line(rows[-1], run.column(f"c.foot_force_est_N.{key}"), "force cells", THIN_REF)
    rows[0].share_y, rows[1].share_y = rows[1], rows[0]
    return _over_time(run, rows, 4.0)


LEG = ("hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll")


def joints(run: Run) -> Figure:
    """The legs' joint references and true angles."""
    rows = []
    for joint in LEG:
        rows.append([])
        for side, color in (("r", RIGHT), ("l", LEFT)):
            name = f"{side}_{joint}"
            axes = Axes(title=f"{name.replace('_', ' ')} (deg)", legend=joint == LEG[0] and side == "r")
            axes.x_numbers, axes.x_label = joint == LEG[-1], "time (s)" if joint == LEG[-1] else ""
            run.line(axes, run.column(f"p.{name}.true_q_rad", DEG), "truth", Stroke(color, 0.9), 350)
            run.line(axes, run.column(f"c.{name}.q_ref_rad", DEG), "reference", THIN_REF, 350)
            rows[-1].append(axes)
    return Figure(rows, 8.4 * UNIT_IN)


def torques(run: Run) -> Figure:
    """Each joint's torque as a part of its peak: rms and largest, up to a fall."""
    table = parameters.table().robot["joints"]
    tau = np.abs(run.log.block("p.true_tau_Nm"))[: max(1, run.until_fall())]
    peak = np.array([j["torque_peak_Nm"] for j in table])
    steady = np.array([j["torque_continuous_Nm"] for j in table]) / peak * 100
    axes = Axes(y_label="of peak torque (%)", margins=(0.01, 0.05), names=[j["name"].replace("_", " ") for j in table],
                y_floor=0.0, levels=[(100.0, Stroke(INK, 0.8))])  # fmt: skip
    for i, level in enumerate(steady):
        axes.line(np.array([i - 0.35, i + 0.35]), np.array([level, level]), Stroke(RIGHT, 1.0))
    axes.entries.append(("continuous rating", Stroke(RIGHT, 1.0)))
    axes.bars(tau.max(axis=0) / peak * 100, 0.8, LEFT, 0.45, "largest")
    axes.bars(np.sqrt((tau**2).mean(axis=0)) / peak * 100, 0.45, LEFT, 1.0, "rms")
    return Figure([[axes]], 3.5 * UNIT_IN, foot=72.0)


def sensing(run: Run) -> Figure:
    """What the robot senses less the truth: attitude, CoP and CoM."""
    rows = [Axes(y_label=f"{label}") for label in ("attitude (deg)", "CoP (mm)", "CoM (mm)")]
    rpy = run.log.block("p.true_chest_rpy_rad")
    for index, (name, color) in enumerate((("roll", RIGHT), ("pitch", LEFT))):
        est = run.column(f"c.{name}_est_rad")
        run.line(rows[0], None if est is None else (est - rpy[:, index]) * DEG, name, Stroke(color))
    for axes, name in zip(rows[1:], ("cop", "com")):
        a, b = run.start_mm(f"c.{name}_est_W_m"), run.start_mm(f"p.true_{name}_W_m")
        for index, (axis, color) in enumerate((("x", RIGHT), ("y", LEFT))):
            run.line(axes, None if a is None else (a - b)[:, index], axis, Stroke(color, 0.8))
    return _over_time(run, rows, 5.6)
