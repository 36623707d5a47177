"""The figure of the sand study: what became of the runs, when they fell, how far they leaned, and the paired rolls."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hoap2 import bounds
from hoap2.figures import style
from hoap2.studies import groups

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BOOK_FALL_STEP = 18
OUTCOMES = (
    ("survived", style.SKY, ""), ("fell backward", style.VERMILION, "////"), ("fell otherwise", style.PURPLE, "...."),
    ("stood, walk not done", style.LIGHT, ""),
)  # fmt: skip


def write(base: Path, document: dict, rows: dict[str, list[dict]]) -> list[Path]:
    """<base>.png and .svg. rows: the summaries of each scenario."""
    with style.drawing(style.WIDTH_IN, 6.6) as figure:
        grid = figure.add_gridspec(2, 2, left=0.135, right=0.985, top=0.9, bottom=0.08, hspace=0.4, wspace=0.3)
        whole = {name: [row for row in found if groups.counts(row)] for name, found in rows.items()}
        _outcomes(figure.add_subplot(grid[0, 0]), document, whole)
        _fall_steps(figure.add_subplot(grid[0, 1]), whole)
        _pitch(figure.add_subplot(grid[1, 0]), whole)
        _difference(figure.add_subplot(grid[1, 1]), document["floor_roll_rms_difference_deg"])
        return style.save(figure, base)


def outcome(row: dict) -> str:
    """One of OUTCOMES."""
    if row["fell"]:
        return "fell backward" if row["fell_backward"] else "fell otherwise"
    return "survived" if row["survived"] else "stood, walk not done"


def _outcomes(axes: Axes, document: dict, rows: dict[str, list[dict]]) -> None:
    """Stacked shares, with the Wilson interval of the survivors."""
    names = list(rows)
    axes.set_title("A  Outcome of the runs", pad=32)
    axes.grid(axis="y", visible=False)
    left = np.zeros(len(names))
    for word, color, hatch in OUTCOMES:
        share = np.array([100 * np.mean([outcome(r) == word for r in rows[n]]) if rows[n] else 0.0 for n in names])
        if share.any():
            axes.barh(names, share, left=left, height=0.55, color=color, hatch=hatch, edgecolor="white", linewidth=0.4,
                      label=word)  # fmt: skip
        left += share
    for place, name in enumerate(names):
        block = document[name.replace("-", "_")]
        if block["runs"]:
            low, high = (100 * end for end in block["wilson_95"]["survived_fraction"])
            middle = 100 * block["survived_fraction"]
            axes.errorbar(middle, place, xerr=[[middle - low], [high - middle]], color=style.BLACK, capsize=3,
                          linewidth=1.2, fmt="o", markersize=3)  # fmt: skip
    axes.set(xlim=(-3, 103), xlabel="share of the runs (%)\nblack: survived, with its 95 % interval")
    axes.invert_yaxis()
    axes.legend(loc="lower left", bbox_to_anchor=(-0.3, 1.0), ncols=2, columnspacing=1.0)


def _fall_steps(axes: Axes, rows: dict[str, list[dict]]) -> None:
    """How many runs fell at which step, by the direction of the fall for sand-walk."""
    axes.set_title("B  Step of the fall", pad=32)
    falls = {
        name: [row for row in found if row["fell"] and row["fall_step"] is not None] for name, found in rows.items()
    }
    steps = [row["fall_step"] for found in falls.values() for row in found]
    axes.set(xlabel="step", ylabel="runs")
    if not steps:
        axes.text(0.5, 0.5, "no run fell", transform=axes.transAxes, ha="center", color=style.GREY)
        axes.set(xlim=(0, 37), yticks=[])
        return
    edges = np.arange(0, max(*steps, 36) + 2)
    bottom = np.zeros(len(edges))
    colors = (style.VERMILION, style.SKY, style.ORANGE, style.GREEN)
    for (name, found), color in zip(falls.items(), colors):
        count = Counter(row["fall_step"] for row in found)
        heights = np.array([count.get(int(edge), 0) for edge in edges])
        if heights.any():
            axes.bar(edges, heights, 0.85, bottom, color=color, label=name)
        bottom += heights
    own = [row["fall_step"] for row in falls.get("sand-walk", [])]
    if own:
        axes.axvline(float(np.median(own)), color=style.ORANGE, linewidth=2.0,
                     label=f"median here: {np.median(own):g}")  # fmt: skip
    axes.axvline(BOOK_FALL_STEP, color=style.BLACK, linewidth=1.0, linestyle=(0, (4, 2)), label="book: 18")
    axes.set(xlim=(0, 37), ylim=(0, 1.08 * bottom.max()))
    axes.yaxis.get_major_locator().set_params(integer=True)
    axes.legend(loc="lower left", bbox_to_anchor=(-0.03, 1.0), ncols=2, columnspacing=1.0)


def _pitch(axes: Axes, rows: dict[str, list[dict]]) -> None:
    """Largest pitch of each run, one column a scenario, on a logarithmic scale; the median below each name."""
    axes.set_title("C  Largest pitch, and its median")
    axes.grid(axis="x", visible=False)
    medians = [""] * len(rows)
    for place, found in enumerate(rows.values()):
        pitch = np.array([v for v in (bounds.lookup(row, "pitch_deg.max") for row in found) if v])
        if not pitch.size:
            continue
        spread = (np.arange(pitch.size) * 0.618034 % 1.0 - 0.5) * 0.5  # even, and the same every time
        axes.plot(place + spread, pitch, "o", markersize=2.6, color=style.BLUE, alpha=0.55, markeredgewidth=0)
        middle = float(np.median(pitch))
        axes.plot([place - 0.34, place + 0.34], [middle, middle], color=style.BLACK, linewidth=1.6)
        medians[place] = f"\n{middle:.2g}\N{DEGREE SIGN}"
    axes.set_yscale("log")
    axes.axhline(45.0, color=style.VERMILION, linewidth=0.9, linestyle=(0, (4, 2)))
    axes.annotate("45\N{DEGREE SIGN}: fallen", (len(rows) - 0.45, 46.0), ha="right", va="bottom", fontsize=7.5)
    axes.set(ylabel="largest pitch (deg)", xlim=(-0.55, len(rows) - 0.45))
    axes.set_xticks(range(len(rows)), [name.replace("-walk", "\nwalk") + text for name, text in zip(rows, medians)])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.yaxis.set_minor_formatter("")


def _difference(axes: Axes, found: dict) -> None:
    """rms roll on the floor, with landing position control less without, pair by pair, sorted."""
    axes.set_title("D  Floor: roll with control less without")
    axes.set(ylabel="difference of rms roll (deg)", xlabel="pairs of runs with the same seed, sorted")
    values = np.sort(list(found["differences"].values()))
    axes.axhline(0.0, color=style.BLACK, linewidth=0.7)
    if found["mean"] is None:
        axes.text(0.5, 0.6, "too few pairs", transform=axes.transAxes, ha="center", color=style.GREY)
        return
    low, high = found["mean_95"]
    axes.axhspan(low, high, color=style.SKY, alpha=0.45, linewidth=0, label="95 % interval of the mean")
    axes.axhline(found["mean"], color=style.BLUE, label=f"mean {found['mean']:+.2g} deg")
    axes.plot(np.arange(1, values.size + 1), values, "o", markersize=3, color=style.BLACK)
    axes.legend(loc="upper left")
