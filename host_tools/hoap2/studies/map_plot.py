"""The figure of a map: small panels of survival and fall step for one parameter each, heat maps for two."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hoap2.figures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS = 3
PANEL_IN = 1.95
LOOKS = (
    (style.VERMILION, "o", "-"),
    (style.BLUE, "s", (0, (4, 1.5))),
    (style.GREEN, "^", ":"),
    (style.PURPLE, "D", "-."),
)


def write(base: Path, document: dict) -> list[Path]:
    """<base>.png and .svg of all sweeps over one parameter, and of each over two (alone: <base>, else <base>-<name>)."""
    lines = [sweep for sweep in document["sweeps"] if len(sweep["axes"]) == 1]
    maps = [sweep for sweep in document["sweeps"] if len(sweep["axes"]) == 2]
    written = _write_lines(base, lines, document["scenarios"]) if lines else []
    for sweep in maps:
        path = base if len(document["sweeps"]) == 1 else base.with_name(f"{base.name}-{sweep['name']}")
        with style.drawing(style.WIDTH_IN, 3.4) as figure:
            _heat_maps(figure, sweep, document["scenarios"])
            written += style.save(figure, path)
    return written


def _write_lines(base: Path, sweeps: list[dict], scenarios: list[str]) -> list[Path]:
    rows = math.ceil(len(sweeps) / COLUMNS)
    columns = min(COLUMNS, len(sweeps))
    height = PANEL_IN * rows + 0.5
    with style.drawing(style.WIDTH_IN if columns > 1 else 4.2, height) as figure:
        grid = figure.add_gridspec(rows, columns, left=0.09 if columns > 1 else 0.15, right=0.985, hspace=0.5,
                                   wspace=0.3, top=1 - 0.48 / height, bottom=0.5 / height)  # fmt: skip
        for number, sweep in enumerate(sweeps):
            inner = grid[number // columns, number % columns].subgridspec(2, 1, height_ratios=(1.1, 1.0), hspace=0.16)
            panels = figure.add_subplot(inner[0]), figure.add_subplot(inner[1])
            _panel(*panels, sweep, scenarios, number % columns == 0)
        handles, labels = figure.axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", ncols=len(labels))
        return style.save(figure, base)


HANDY = {"m": ("mm", 1e3), "rad": ("deg", 180.0 / math.pi), "s": ("ms", 1e3)}


def _short(value: str, unit: str) -> str:
    """A value as it is written at an axis, in the handy unit."""
    try:
        number = float(value)
    except ValueError:
        return value
    text = f"{number * HANDY.get(unit, ('', 1.0))[1]:.4g}"
    return text.replace("e+0", "e").replace("e+", "e").replace("-", "\N{MINUS SIGN}")


def _unit(axis: dict) -> str:
    return HANDY.get(axis["unit"], (axis["unit"],))[0]


def _panel(top: Axes, bottom: Axes, sweep: dict, scenarios: list[str], first: bool) -> None:
    """Share of survivors with its interval above, median and range of the fall step below; values evenly spaced."""
    axis = sweep["axes"][0]
    labels = [_short(value, axis["unit"]) for value in axis["values"]]
    places = np.arange(len(labels), dtype=float)
    width = max(1.0, len(labels) - 1.0)
    for number, name in enumerate(scenarios):
        color, marker, dash = LOOKS[number % len(LOOKS)]
        blocks = [cell[name.replace("-", "_")] for cell in sweep["cells"]]
        x = places + (number - 0.5 * (len(scenarios) - 1)) * 0.018 * width
        share = np.array([100 * b["survived_fraction"] if b["runs"] else np.nan for b in blocks])
        ends = np.array([b["wilson_95"]["survived_fraction"] for b in blocks]).T * 100
        top.errorbar(x, share, np.clip([share - ends[0], ends[1] - share], 0, None), color=color, marker=marker,
                     markersize=3, linestyle=dash, capsize=1.8, elinewidth=0.8, label=name)  # fmt: skip
        fell = [(place, b) for place, b in zip(x, blocks) if b["fall_steps"]]
        if fell:
            steps = np.array([b["median_fall_step"] for _, b in fell])
            reach = [[m - b["fall_steps"][0] for m, (_, b) in zip(steps, fell)],
                     [b["fall_steps"][-1] - m for m, (_, b) in zip(steps, fell)]]  # fmt: skip
            bottom.errorbar([p for p, _ in fell], steps, reach, color=color, marker=marker, markersize=3,
                            linestyle="none", capsize=1.8, elinewidth=0.8)  # fmt: skip
    unit = f" ({_unit(axis)})" if axis["unit"] else ""
    top.set_title(sweep["title"] + unit, fontsize=7.5, pad=3)
    top.set(ylim=(-6, 106), yticks=(0, 50, 100))
    bottom.set(ylim=(0, 37), yticks=(0, 18, 36))
    for axes in (top, bottom):
        axes.set_xlim(places.min() - 0.08 * width, places.max() + 0.08 * width)
        if axis["own"] is not None:
            axes.axvline(
                places[axis["values"].index(axis["own"])], color=style.GREY, linewidth=0.8, linestyle=(0, (1, 1.5))
            )
        axes.set_xticks(places, labels if axes is bottom else [""] * len(labels))
    if sum(map(len, labels)) > 26:
        bottom.tick_params(axis="x", labelrotation=35)
        for label in bottom.get_xticklabels():
            label.set(ha="right", rotation_mode="anchor")
    if first:
        top.set_ylabel("survived (%)")
        bottom.set_ylabel("fall step")


def _heat_maps(figure: Figure, sweep: dict, scenarios: list[str]) -> None:
    """One heat map a scenario: colour and upper line the survivors, lower line the median fall step."""
    first, second = sweep["axes"]
    shape = len(first["values"]), len(second["values"])
    grid = figure.add_gridspec(1, len(scenarios), left=0.1, right=0.9, top=0.89, bottom=0.17, wspace=0.12)
    image = None
    for number, name in enumerate(scenarios):
        axes = figure.add_subplot(grid[number])
        blocks = [cell[name.replace("-", "_")] for cell in sweep["cells"]]
        share = np.array([100 * b["survived_fraction"] if b["runs"] else np.nan for b in blocks]).reshape(shape)
        image = axes.imshow(share, cmap="cividis", vmin=0, vmax=100, origin="lower", aspect="auto")
        axes.grid(visible=False)
        for place, block in enumerate(blocks):
            row, column = divmod(place, shape[1])
            dark = block["runs"] and share[row, column] < 55
            axes.text(column, row, _cell(block), ha="center", va="center", fontsize=6.5, linespacing=1.25,
                      color="white" if dark else "black")  # fmt: skip
        axes.set_title(name)
        axes.set_xticks(range(shape[1]), [_star(value, second) for value in second["values"]])
        axes.set_yticks(range(shape[0]), [_star(value, first) for value in first["values"]] if not number else [])
        axes.set_xlabel(_name(second))
        if not number:
            axes.set_ylabel(_name(first))
    bar = figure.colorbar(image, cax=figure.add_axes((0.915, 0.17, 0.016, 0.72)))
    bar.set_label("survived (%)")
    figure.text(0.1, 0.015, "Each cell: survivors of runs, then median step of the fall. * the scenario's own value.",
                fontsize=7, color=style.GREY)  # fmt: skip


def _cell(block: dict) -> str:
    if not block["runs"]:
        return "error" if block["errors"] else "-"
    step = "" if block["median_fall_step"] is None else f"\n{block['median_fall_step']:g}"
    return f"{block['counts']['survived']}/{block['runs']}{step}"


def _star(value: str, axis: dict) -> str:
    return _short(value, axis["unit"]) + (" *" if value == axis["own"] else "")


def _name(axis: dict) -> str:
    return axis["name"] + (f" ({_unit(axis)})" if axis["unit"] else "")
