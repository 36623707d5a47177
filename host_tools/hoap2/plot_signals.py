"""`plot`: chosen signals of a run over time, a panel for each group, as a picture."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib
import numpy as np

from hoap2 import parameters, plots, signal_names
from hoap2.errors import UserError
from hoap2.run_source import Source

matplotlib.use("Agg")
from matplotlib.figure import Figure  # noqa: E402

PANEL_LINES = 25
PANELS = 12
FORMATS = (".png", ".svg", ".pdf")
DEGREES = {"rad": ("deg", 180.0 / math.pi), "rad/s": ("deg/s", 180.0 / math.pi)}
COLOURS = ("#d55e00", "#0a84d0", "#009e73", "#cc79a7", "#e69f00", "#5c3d9e", "#7f7f7f", "#56b4e9")
CYCLE = matplotlib.cycler(linestyle=("-", "--", ":", "-.")) * matplotlib.cycler(color=COLOURS)


def panels_of(source: Source, wanted: list[str]) -> list[list[str]]:
    """The columns of each panel: one panel an argument, whose names are parted by commas."""
    panels = [signal_names.find_all(source.log, [n for n in group.split(",") if n]) for group in wanted]
    if len(panels) > PANELS:
        raise UserError(f"{len(panels)} panels are too many for one picture", f"at most {PANELS}")
    for group, columns in zip(wanted, panels):
        if len(columns) > PANEL_LINES:
            raise UserError(f"'{group}' means {len(columns)} signals, too many for one panel",
                            f"at most {PANEL_LINES}; for example {columns[0]}")  # fmt: skip
        units = {_unit(source, c) for c in columns}
        if len(units) > 1:
            raise UserError(f"'{group}' mixes units: {', '.join(sorted(units))}", "give them as arguments of their own")
    return panels


def draw(source: Source, wanted: list[str], first_s: float, last_s: float, path: Path, degrees: bool = True) -> Path:
    """One panel below the other over simulated time; angles in degrees unless told otherwise."""
    if path.suffix.lower() not in FORMATS:
        raise UserError(f"{path}: a picture ends in {', '.join(FORMATS)}")
    panels = panels_of(source, wanted)
    t_s = source.log.t_s
    rows = (t_s >= first_s) & (t_s <= last_s)
    if not rows.any():
        raise UserError(f"the run has nothing between {first_s:g} and {last_s:g} s", f"it lasts {t_s[-1]:g} s")
    with matplotlib.rc_context(plots.STYLE | {"axes.prop_cycle": CYCLE}):
        figure = Figure(figsize=(plots.WIDTH_IN, 0.6 + 2.2 * len(panels)), layout="constrained")
        all_axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axes, columns in zip(all_axes, panels):
            _panel(axes, source, columns, t_s, rows, degrees)
        all_axes[-1].set_xlabel("t (s)")
        figure.suptitle(source.name, fontsize=9, x=0.01, ha="left")
        for text in figure.findobj(lambda artist: hasattr(artist, "get_color") and artist.get_color() == plots.INK):
            text.set_color("#222222")
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=120, facecolor="white")
    return path


def _panel(axes, source: Source, columns: list[str], t_s: np.ndarray, rows: np.ndarray, degrees: bool) -> None:
    unit, scale = DEGREES.get(_unit(source, columns[0]), (None, 1.0)) if degrees else (None, 1.0)
    whole = {signal_names.whole(c) for c in columns}
    title = next(iter(whole)) if len(whole) == 1 else ""
    enum = _enum(columns)
    for column in columns:
        values = source.log.column(column)[rows]
        label = column if not title else _element(column, title)
        there = np.isfinite(values)
        if column in _ints(source):
            axes.step(t_s[rows], values, where="post", label=label)
        else:
            axes.plot(*plots.thin(t_s[rows][there], scale * values[there], bins=2000), label=label)
    if enum:
        axes.set_yticks(range(len(enum)), [word.replace("_", " ") for word in enum])
    axes.set_title(title or ", ".join(sorted(whole)))
    axes.set_ylabel(unit or _unit(source, columns[0]) if _unit(source, columns[0]) != "1" else "")
    if len(columns) > 1 or not title:
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), ncols=1 + (len(columns) > 13))


def _ints(source: Source) -> set[str]:
    return {column.name for column in source.log.ints}


def _unit(source: Source, column: str) -> str:
    return next((c.unit for c in (*source.log.reals, *source.log.ints) if c.name == column), "1")


def _enum(columns: list[str]) -> list[str]:
    """The words of the numbers, when all columns are of one enum."""
    table = parameters.table()
    enums = {s.name: s.enum for product in ("controller", "plant") for s in table.select(product, "output")}
    names = {enums.get(signal_names.whole(column), "") for column in columns}
    return table.enums[names.pop()] if len(names) == 1 and names != {""} else []


def _element(column: str, whole: str) -> str:
    parts = [part for part in column.split(".")[1:] if part != whole]
    return " ".join(parts) or column
