"""Panels of the book's figures seen from above, and the design of the references over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hoap2.figures import style
from hoap2.figures.measured import walk_begins_s
from hoap2.figures.panels import LABEL_PLACE, new_axes, steps_above, time_limits
from hoap2.figures.walk_data import Walk, sole_mm

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


SHIFT_SHOWN_MM = 0.5  # landings that are shifted by less are not marked


def plan(figure: Figure, walk: Walk, bottom: float, height: float) -> None:
    """C: CoM from above; landings: nominal, shifted by (7.14), and where the foot really stood (it may slip)."""
    axes = new_axes(figure, bottom, height, "C  CoM trajectory and landing positions, seen from above")
    for place in walk.nominal:
        corners = sole_mm(1e3 * place.x_m, 1e3 * place.y_m, place.yaw_rad)
        axes.fill(*corners.T, facecolor="none", edgecolor=style.LIGHT, linewidth=0.6)
    nominal = np.array([(1e3 * p.x_m, 1e3 * p.y_m) for p in walk.nominal])
    axes.plot(*nominal.T, "+", color=style.GREY, markersize=5.5, markeredgewidth=0.8, label="landing, nominal")
    _shifted(axes, walk, nominal)
    for foot, color, word in ((0, style.RIGHT, "right"), (1, style.LEFT, "left")):
        mine = [entry for entry in walk.landed if entry[1] == foot]
        if mine:
            axes.plot(*np.array([(x, y) for _, _, x, y, _ in mine]).T, "o", color=color, markersize=2.6,
                      label=f"{word} foot, true")  # fmt: skip
            axes.fill(*sole_mm(*mine[-1][2:]).T, facecolor=color, alpha=0.18, edgecolor=color, linewidth=0.8)
    dash = (0, (3, 1.5))
    _tracks(
        axes, walk, (("c.com_plan_W_m", "CoM, plan", style.ORANGE, dash), ("p.true_com_W_m", "CoM", style.BLACK, "-"))
    )
    _finish_plan(axes)


def _shifted(axes: Axes, walk: Walk, nominal: np.ndarray) -> None:
    """The landings that the controller aimed at, each joined with its nominal one."""
    steps, shifts = walk.shifts_mm
    moved = [int(s) for s, d in zip(steps, shifts) if np.hypot(*d) > SHIFT_SHOWN_MM and s + 1 < len(nominal)]
    if not moved:
        return
    shift = {int(s): d for s, d in zip(steps, shifts)}
    ends = np.array([nominal[step + 1] + shift[step] for step in moved])
    for step, end in zip(moved, ends):
        axes.plot(*np.array([nominal[step + 1], end]).T, color=style.BLACK, linewidth=0.7)
    axes.plot(*ends.T, "D", markersize=3.2, markerfacecolor="white", markeredgecolor=style.BLACK, markeredgewidth=0.7,
              label="shifted by \u0394r")  # fmt: skip


def _tracks(axes: Axes, walk: Walk, signals: tuple) -> None:
    for name, label, color, dash in signals:
        track = walk.mm(name)
        if track is not None:
            axes.plot(*track[walk.until_fall][::4].T, color=color, linestyle=dash, label=label)


def _finish_plan(axes: Axes) -> None:
    axes.set(xlabel="x, forward (mm)", ylabel="y, left (mm)")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.03, 0.06)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 0.98), ncols=6, columnspacing=1.1, handletextpad=0.5)
    axes.title.set_position((0.0, 1.0))
    axes.set_title(axes.get_title(loc="left"), pad=17)


def design_plan(figure: Figure, walk: Walk, bottom: float, height: float) -> None:
    """Footprints and the reference CoP from above."""
    axes = new_axes(figure, bottom, height, "Footprints and reference CoP, seen from above")
    for print_ in walk.nominal:
        color = style.LEFT if print_.foot else style.RIGHT
        corners = sole_mm(1e3 * print_.x_m, 1e3 * print_.y_m, print_.yaw_rad)
        axes.fill(*corners.T, facecolor=color, alpha=0.05, edgecolor=color, linewidth=0.5)
        axes.plot(1e3 * print_.x_m, 1e3 * print_.y_m, "+", color=color, markersize=4, markeredgewidth=0.7)
    _tracks(
        axes,
        walk,
        (("c.cop_ref_W_m", "CoP, reference", style.BLACK, "-"), ("c.com_plan_W_m", "CoM, plan", style.ORANGE, "-")),
    )
    ends = walk.mm("c.cp_eos_W_m")
    if ends is not None:
        ticks = list(walk.step_ticks.values())
        axes.plot(*ends[ticks].T, "D", color=style.GREEN, markersize=2.6, label="capture point at the end of a step")
    _finish_plan(axes)


def design_time(figure: Figure, walk: Walk, bottom: float, height: float) -> None:
    """Reference CoP, capture point and CoM over time, along and across."""
    time = walk.t_s - walk_begins_s(walk)
    half = 0.47 * height
    for number, label in enumerate(("y, left (mm)", "x, forward (mm)")):
        axes = new_axes(figure, bottom + number * (height - half), half, "")
        for name, word, color, width in (("c.cop_ref_W_m", "CoP, reference", style.BLACK, 1.0),
                                         ("c.cp_ref_W_m", "capture point", style.GREEN, 0.9),
                                         ("c.com_plan_W_m", "CoM, plan", style.ORANGE, 1.2)):  # fmt: skip
            track = walk.mm(name)
            if track is not None:
                axes.plot(time, track[:, 1 - number], color=color, linewidth=width, label=word)
        axes.set(xlim=time_limits(walk), ylabel=label)
        axes.yaxis.set_label_coords(*LABEL_PLACE)
        if number == 0:
            axes.set_xlabel("time from the first step (s)")
        else:
            axes.set_xticklabels([])
            axes.set_title("Over time", pad=17)
            steps_above(axes, walk)
            axes.legend(loc="upper left", ncols=1)
