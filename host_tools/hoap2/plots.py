"""The report's figures, in the manner of Fig. 7.10: one function each, from a run's log.

Text, axes and references are drawn in INK, which `svg` turns into the page's own text
colour, so that a figure reads on a light and on a dark page.
"""

from __future__ import annotations

import io
import math
import re

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib.figure import Figure  # noqa: E402
from matplotlib.patches import Polygon  # noqa: E402

from hoap2 import metrics, parameters, walk_plan  # noqa: E402
from hoap2.scenario import Scenario  # noqa: E402
from hoap2.signal_log import SignalLog  # noqa: E402

INK = "#123456"
RIGHT, LEFT, THIRD = "#d55e00", "#0a84d0", "#009e73"  # told apart with any colour vision
WIDTH_IN = 9.0
STYLE = {
    "svg.fonttype": "none", "font.size": 9, "font.family": "sans-serif", "axes.edgecolor": INK, "axes.labelcolor": INK,
    "text.color": INK, "xtick.color": INK, "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": INK, "grid.alpha": 0.12, "grid.linewidth": 0.6, "lines.linewidth": 1.1,
    "legend.frameon": False, "legend.fontsize": 8, "axes.titlesize": 9, "axes.titlelocation": "left",
}  # fmt: skip
DEG = 180.0 / math.pi


def svg(figure: Figure, salt: str) -> str:
    """The figure as inline SVG; `salt` keeps the ids of several figures on a page apart."""
    with matplotlib.rc_context({"svg.hashsalt": salt, "svg.fonttype": "none"}):
        buffer = io.StringIO()
        figure.savefig(buffer, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    text = buffer.getvalue()
    text = text[text.index("<svg") :].replace(INK, "currentColor")
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1", text, count=1)
    text = re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1)
    return re.sub(r'(id="|href="#|url\(#)', rf"\g<1>{salt}-", text)


def thin(t: np.ndarray, y: np.ndarray, bins: int = 700) -> tuple[np.ndarray, np.ndarray]:
    """Few points that still show every peak: the least and the largest of each bin, in order."""
    size = len(y) // bins
    if size < 3:
        return t, y
    whole = len(y) // size * size
    blocks = y[:whole].reshape(-1, size)
    ends = np.sort(np.stack([np.nanargmin(blocks, axis=1), np.nanargmax(blocks, axis=1)]), axis=0)
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

    def line(self, axes, y: np.ndarray | None, label: str, **style) -> None:
        if y is not None and np.isfinite(y).any():
            axes.plot(*thin(self.t, y), label=label, **style)

    def marks(self, axes) -> None:
        """A hair line at each step, a strong one at the fall."""
        for tick in self.step_ticks:
            axes.axvline(self.t[tick], color=INK, alpha=0.18, linewidth=0.5, zorder=0)
        if self.fall_s is not None:
            axes.axvline(self.fall_s, color="#d00000", linewidth=1.4)
            axes.annotate("fell", (self.fall_s, 1.0), xycoords=("data", "axes fraction"), color="#d00000",
                          xytext=(3, -10), textcoords="offset points", fontsize=8)  # fmt: skip


def stack(rows: int, height_in: float, columns: int = 1, share_y: bool = False):
    """Axes below each other with one time axis, in the report's style."""
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(WIDTH_IN, height_in), layout="constrained")
        axes = figure.subplots(rows, columns, sharex=True, sharey=share_y, squeeze=False)
    return figure, axes


def legend(axes) -> None:
    """Above the axes at the right, where it covers no curve."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.97), ncols=6, frameon=False, fontsize=8, borderaxespad=0.2,
                labelcolor=INK)  # fmt: skip


def _finish(run: Run, axes_list, bottom) -> None:
    for axes in axes_list:
        run.marks(axes)
        axes.margins(x=0.0)
        if axes.get_legend_handles_labels()[0]:
            legend(axes)
    for axes in bottom:
        axes.set_xlabel("time (s)")


REF = {"color": INK, "linestyle": "--", "linewidth": 0.9, "alpha": 0.8}


def attitude(run: Run) -> Figure:
    """Roll and pitch of the chest over time with step marks, as Fig. 7.10 B."""
    figure, axes = stack(2, 4.2)
    rpy = run.log.block("p.true_chest_rpy_rad")
    for row, (name, color) in enumerate((("roll", RIGHT), ("pitch", LEFT))):
        run.line(axes[row, 0], rpy[:, row] * DEG, "truth", color=color)
        run.line(axes[row, 0], run.column(f"c.{name}_est_rad", DEG), "as the robot senses it", **REF)
        axes[row, 0].set_ylabel(f"{name} (deg)")
    _finish(run, axes[:, 0], axes[-1])
    return figure


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
    last = run.log.count - 1 if run.fall_s is None else int(np.searchsorted(run.t, run.fall_s))
    prints: list[tuple[int, float, float, float]] = []
    for tick in [0, *[t - 1 for t in run.step_ticks if t <= last], last]:
        for foot in (0, 1):
            x, y = 1e3 * metrics.to_start_frame(pos[tick, 3 * foot : 3 * foot + 2], run.scenario)
            before = [p for p in prints if p[0] == foot]
            if not before or math.hypot(x - before[-1][1], y - before[-1][2]) > 2.0:
                prints.append((foot, x, y, yaw[tick, foot] - start_yaw))
    return prints


def plane(run: Run) -> Figure:
    """CoM, CoP and footprints seen from above, as Fig. 7.10 C."""
    figure, grid = stack(1, 4.0)
    axes = grid[0, 0]
    plan = walk_plan.footprints(run.scenario.values["controller"], run.scenario.steps_planned)
    for p in plan:
        corners = _sole(1e3 * p.x_m, 1e3 * p.y_m, p.yaw_rad)
        axes.add_patch(Polygon(corners, fill=False, ec=INK, ls=":", lw=0.6, alpha=0.5))
    axes.plot([], [], color=INK, ls=":", lw=0.8, label="footprints, planned")
    axes.plot([], [], color=RIGHT, lw=5, alpha=0.4, label="right, taken")
    axes.plot([], [], color=LEFT, lw=5, alpha=0.4, label="left, taken")
    for foot, x, y, yaw in _taken_footprints(run):
        color = LEFT if foot else RIGHT
        axes.add_patch(Polygon(_sole(x, y, yaw), fc=color, ec=color, alpha=0.16, lw=0.6))
        axes.plot(x, y, "+", color=color, markersize=4)
    until = slice(0, run.log.count if run.fall_s is None else int(np.searchsorted(run.t, run.fall_s)))
    for name, label, style in (
        ("p.true_cop_W_m", "CoP, truth", {"color": THIRD, "linestyle": "", "marker": ".", "markersize": 1.2}),
        ("c.com_plan_W_m", "CoM, plan (7.13)", REF),
        ("p.true_com_W_m", "CoM, truth", {"color": INK, "linewidth": 1.2}),
    ):
        track = run.start_mm(name)
        if track is not None:
            axes.plot(*track[until][::5].T, label=label, **style)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x, forward (mm)")
    axes.set_ylabel("y, left (mm)")
    legend(axes)
    return figure


def _plane_signals(run: Run, rows: list[tuple[str, str, dict]], height_in: float = 4.4) -> Figure:
    figure, axes = stack(2, height_in)
    for row, axis in enumerate(("x, forward", "y, left")):
        for name, label, style in rows:
            track = run.start_mm(name)
            run.line(axes[row, 0], None if track is None else track[:, row], label, **style)
        axes[row, 0].set_ylabel(f"{axis} (mm)")
    _finish(run, axes[:, 0], axes[-1])
    return figure


def com_cop(run: Run) -> Figure:
    """CoM and CoP over time against their references."""
    return _plane_signals(run, [
        ("p.true_cop_W_m", "CoP, truth", {"color": THIRD, "linewidth": 0.6, "alpha": 0.8}),
        ("c.cop_ref_W_m", "CoP, reference", {"color": RIGHT, "linewidth": 0.9}),
        ("c.com_plan_W_m", "CoM, plan", REF),
        ("p.true_com_W_m", "CoM, truth", {"color": LEFT, "linewidth": 1.3}),
    ])  # fmt: skip


def capture_point(run: Run) -> Figure:
    """The capture point: desired (7.10) and as the robot senses it (7.1)."""
    return _plane_signals(run, [
        ("c.cp_est_W_m", "measured", {"color": LEFT}),
        ("c.cp_ref_W_m", "desired", REF),
        ("c.cp_eos_W_m", "end of step", {"color": RIGHT, "linewidth": 0.8}),
    ])  # fmt: skip


def forces(run: Run) -> Figure:
    """Vertical force on each foot: truth and the sum of the cells."""
    figure, axes = stack(2, 4.0, share_y=True)
    for row, (foot, key, color) in enumerate((("right", "r", RIGHT), ("left", "l", LEFT))):
        run.line(axes[row, 0], run.column(f"p.true_foot_force_W_N.{key}.z"), "truth", color=color)
        run.line(axes[row, 0], run.column(f"c.foot_force_est_N.{key}"), "force cells", **REF | {"linewidth": 0.6})
        axes[row, 0].set_ylabel(f"{foot} foot (N)")
    _finish(run, axes[:, 0], axes[-1])
    return figure


LEG = ("hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll")


def joints(run: Run) -> Figure:
    """The legs' joint references and true angles."""
    figure, axes = stack(len(LEG), 8.4, columns=2)
    for column, (side, color) in enumerate((("r", RIGHT), ("l", LEFT))):
        for row, joint in enumerate(LEG):
            name = f"{side}_{joint}"
            true, ref = run.column(f"p.{name}.true_q_rad", DEG), run.column(f"c.{name}.q_ref_rad", DEG)
            if true is not None:
                axes[row, column].plot(*thin(run.t, true, 350), color=color, linewidth=0.9, label="truth")
            if ref is not None:
                axes[row, column].plot(*thin(run.t, ref, 350), label="reference", **REF | {"linewidth": 0.6})
            axes[row, column].set_title(f"{name.replace('_', ' ')} (deg)", loc="left", fontsize=9, color=INK)
            axes[row, column].margins(x=0.0)
    legend(axes[0, 0])
    for a in axes[-1]:
        a.set_xlabel("time (s)")
    return figure


def torques(run: Run) -> Figure:
    """Each joint's torque as a part of its peak: rms and largest, up to a fall."""
    table = parameters.table().robot["joints"]
    tau = np.abs(run.log.block("p.true_tau_Nm"))
    tau = tau if run.fall_s is None else tau[: max(1, int(np.searchsorted(run.t, run.fall_s)))]
    peak = np.array([j["torque_peak_Nm"] for j in table])
    steady = np.array([j["torque_continuous_Nm"] for j in table]) / peak * 100
    largest, rms = tau.max(axis=0) / peak * 100, np.sqrt((tau**2).mean(axis=0)) / peak * 100
    figure, grid = stack(1, 3.4)
    axes, place = grid[0, 0], np.arange(len(table))
    axes.bar(place, largest, color=LEFT, alpha=0.45, label="largest")
    axes.bar(place, rms, color=LEFT, width=0.45, label="rms")
    axes.plot(place, steady, "_", color=RIGHT, markersize=12, label="continuous rating")
    axes.axhline(100.0, color=INK, linewidth=0.8)
    axes.set_xticks(place, [j["name"].replace("_", " ") for j in table], rotation=60, ha="right", fontsize=8)
    axes.set_ylabel("of peak torque (%)")
    axes.margins(x=0.01)
    legend(axes)
    return figure


def sensing(run: Run) -> Figure:
    """What the robot senses less the truth: attitude, CoP and CoM."""
    figure, axes = stack(3, 5.6)
    rpy = run.log.block("p.true_chest_rpy_rad")
    for index, (name, color) in enumerate((("roll", RIGHT), ("pitch", LEFT))):
        est = run.column(f"c.{name}_est_rad")
        run.line(axes[0, 0], None if est is None else (est - rpy[:, index]) * DEG, name, color=color)
    axes[0, 0].set_ylabel("attitude (deg)")
    for row, (name, label) in enumerate((("cop", "CoP"), ("com", "CoM")), 1):
        a, b = run.start_mm(f"c.{name}_est_W_m"), run.start_mm(f"p.true_{name}_W_m")
        for index, (axis, color) in enumerate((("x", RIGHT), ("y", LEFT))):
            run.line(axes[row, 0], None if a is None else (a - b)[:, index], axis, color=color, linewidth=0.8)
        axes[row, 0].set_ylabel(f"{label} (mm)")
    _finish(run, axes[:, 0], axes[-1])
    return figure
