"""Panels of the book's figures over time: snapshots, roll and pitch, shifts of the landing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hoap2 import picture_labels
from hoap2.figures import snapshots, style
from hoap2.figures.measured import walk_begins_s, walk_fall_step
from hoap2.figures.walk_data import DEG, Walk

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT_IN, RIGHT_IN = 0.62, 0.12  # margins of every panel
FALL_MARGIN_S = 0.5  # the fall itself leaves the frame, so that what led to it can be seen
LABEL_PLACE = (-0.062, 0.5)  # of a y label, in parts of the axes


def new_axes(figure: Figure, bottom: float, height: float, title: str, left: float = 0.0) -> Axes:
    x = (LEFT_IN + left) / style.WIDTH_IN
    axes = figure.add_axes((x, bottom, 1 - x - RIGHT_IN / style.WIDTH_IN, height))
    axes.set_title(title)
    return axes


def strip(figure: Figure, walk: Walk, bottom: float, height: float) -> None:
    """A: snapshots, the time since the first step below each."""
    times = snapshots.moments(walk)
    axes = new_axes(figure, bottom, height, "A  Snapshots")
    high_px = round(1.3 * style.PNG_DPI * height * figure.get_figheight())
    wide_in = (style.WIDTH_IN - LEFT_IN - RIGHT_IN) / len(times)
    size = round(1.3 * style.PNG_DPI * wide_in), high_px
    shown = snapshots.take(walk, times, size, "side" if walk.on_soil else "quarter")
    for place, picture in enumerate(shown):
        axes.imshow(picture, extent=(place + 0.01, place + 0.99, 0, 1), aspect="auto", interpolation="lanczos")
    begin = walk_begins_s(walk)
    axes.set(xlim=(0, len(times)), ylim=(0, 1), yticks=[])
    axes.set_xticks(np.arange(len(times)) + 0.5, [_moment(walk, t, begin) for t in times])
    axes.tick_params(length=0)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)
    full_mm = snapshots.sinkage_scale_mm(walk)
    if full_mm is not None:
        _sand_colours(figure, bottom + height + 0.09 / figure.get_figheight(), full_mm)


def _sand_colours(figure: Figure, bottom: float, full_mm: float) -> None:
    """What the colours of the sand mean, above the snapshots at the right."""
    width, height = 1.1 / style.WIDTH_IN, 0.09 / figure.get_figheight()
    left = 1 - (RIGHT_IN + 1.95) / style.WIDTH_IN
    axes = figure.add_axes((left, bottom, width, height))
    place = np.linspace(0, len(picture_labels.SOIL) - 1, 200)
    colours = [np.interp(place, range(len(picture_labels.SOIL)), channel) for channel in zip(*picture_labels.SOIL)]
    axes.imshow(np.stack(colours, axis=1)[None] / 255.0, aspect="auto")
    axes.set_axis_off()
    raised = full_mm * picture_labels.SOIL_RISE_SHARE
    for x, anchor, text in ((-0.06, "right", f"sand: sunk {full_mm:g} mm"), (1.06, "left", f"raised {raised:g} mm")):
        axes.text(x, 0.4, text, transform=axes.transAxes, ha=anchor, va="center", fontsize=7.5)


def _moment(walk: Walk, t: float, begin: float) -> str:
    row = min(int(np.searchsorted(walk.t_s, t)), walk.log.count - 1)
    step = int(walk.log.column("c.step_index")[row])
    text = f"{t - begin:.1f} s"
    if walk.fall_s is not None and t > walk.fall_s:
        return f"{text}, fallen"
    return f"{text}, step {step}"


def steps_above(axes: Axes, walk: Walk) -> None:
    """Step numbers along the upper edge, and the fall."""
    begin = walk_begins_s(walk)
    shown = {step: walk.t_s[tick] - begin for step, tick in walk.step_ticks.items() if step == 1 or step % 5 == 0}
    upper = axes.secondary_xaxis("top")
    upper.set_xticks(list(shown.values()), [str(step) for step in shown])
    upper.tick_params(length=2.5, pad=1)
    axes.annotate(
        "step", (0, 1), (-8, 4), xycoords="axes fraction", textcoords="offset points", ha="right", fontsize=7.5
    )


def mark_fall(axes: Axes, walk: Walk, label: bool) -> None:
    if walk.fall_s is None:
        return
    at = walk.fall_s - walk_begins_s(walk)
    axes.axvline(at, color=style.BLACK, linewidth=1.0, linestyle=(0, (4, 2)))
    if label:
        side = ((-3, -3), "right") if at > 0.85 * time_limits(walk)[1] else ((3, -3), "left")
        axes.annotate(f"fell, step {walk_fall_step(walk)}", (at, 1), side[0], xycoords=("data", "axes fraction"),
                      textcoords="offset points", va="top", ha=side[1], fontsize=7.5,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6})  # fmt: skip


def time_limits(walk: Walk) -> tuple[float, float]:
    begin = walk_begins_s(walk)
    return -0.6, float(walk.t_s[-1] - begin)


def angles(figure: Figure, walk: Walk, bottom: float, height: float) -> None:
    """B: roll and pitch over time, which begins with the first step."""
    half = 0.47 * height
    upper = new_axes(figure, bottom + height - half, half, "")
    lower = new_axes(figure, bottom, half, "")
    _angle(upper, walk, "roll", 0, style.VERMILION)
    _angle(lower, walk, "pitch", 1, style.BLUE)
    mark_fall(upper, walk, True)
    mark_fall(lower, walk, False)
    upper.set_title("B  Roll and pitch of the chest", pad=17)
    upper.set_xticklabels([])
    steps_above(upper, walk)
    lower.set_xlabel("time from the first step (s); pitch > 0: forward, roll > 0: to the right")


def _angle(axes: Axes, walk: Walk, name: str, column: int, color: str) -> None:
    time, curves = walk.t_s - walk_begins_s(walk), [walk.chest_deg[:, column]]
    axes.plot(time, curves[0], color=color, label=f"{name}, truth")
    if f"c.{name}_est_rad" in walk.log:
        curves.append(walk.log.column(f"c.{name}_est_rad") * DEG)
        axes.plot(time, curves[1], color=style.BLACK, linewidth=0.7, linestyle=(0, (3, 1.5)),
                  label="as the robot senses it")  # fmt: skip
    axes.axhline(0.0, color=style.GREY, linewidth=0.5)
    axes.set(xlim=time_limits(walk), ylim=_angle_limits(walk, curves), ylabel=f"{name} (deg)")
    axes.yaxis.set_label_coords(*LABEL_PLACE)
    axes.legend(loc="lower left", ncols=2, bbox_to_anchor=(0.0, -0.03))


def _angle_limits(walk: Walk, curves: list[np.ndarray]) -> tuple[float, float]:
    """The range from the first step to shortly before a fall, with room for the legend below."""
    first, end = min(walk.step_ticks.values()), walk.log.count
    if walk.fall_tick is not None:
        end = max(first + 2, walk.fall_tick - round(FALL_MARGIN_S / (walk.t_s[1] - walk.t_s[0])))
    shown = np.concatenate([curve[first:end] for curve in curves] + [np.array([-0.2, 0.2])])
    low, high = float(shown.min()), float(shown.max())
    return low - 0.32 * (high - low), high + 0.1 * (high - low)


def shift(figure: Figure, walk: Walk, bottom: float, height: float) -> None:
    """C: modification of the landing position, a value a step, over time."""
    axes = new_axes(figure, bottom, height, "")
    steps, shifts = walk.shifts_mm
    begin = walk_begins_s(walk)
    ends = np.array([walk.t_s[walk.step_ticks[int(s)]] - begin for s in steps if int(s) in walk.step_ticks])
    for axis, (label, color, marker) in enumerate((("along", style.BLUE, "o"), ("across", style.VERMILION, "s"))):
        if shifts.size:
            axes.step(ends, shifts[: len(ends), axis], where="post", color=color, label=f"\u0394r {label} the walk")
            axes.plot(ends, shifts[: len(ends), axis], marker, color=color, markersize=2.2)
    axes.axhline(0.0, color=style.GREY, linewidth=0.5)
    low, high = (float(shifts.min()), float(shifts.max())) if shifts.size else (0.0, 0.0)
    room = max(2.0, high - low)
    axes.set(xlim=time_limits(walk), ylim=(min(low, -1.0) - 0.1 * room, max(high, 1.0) + 0.35 * room))
    axes.set(xlabel="time from the first step (s)", ylabel="\u0394r (mm)")
    axes.yaxis.set_label_coords(*LABEL_PLACE)
    mark_fall(axes, walk, False)
    axes.legend(loc="upper left", ncols=2)
