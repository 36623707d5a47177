"""The book's figures of section 7.3, drawn from a walk."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from hoap2.figures import panels, plan_panels, reported, style
from hoap2.figures.book import BookFigure
from hoap2.figures.panels import LEFT_IN, RIGHT_IN
from hoap2.figures.walk_data import Walk

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

LINE_IN = 0.155  # a line of the text block
HEAD_IN = 0.42  # the title
FOOT_IN = 0.52  # from the last panel to the text block
WRAP = (19, 37, 52)  # letters a line in each column of the text block
COLUMNS = (0.0, 0.19, 0.52)  # where they begin, as parts of the width between the margins
# Panels from above to below: the room above each and its height, in inches.
WALK = ((panels.strip, 0.3, 1.62), (panels.angles, 0.62, 2.2), (plan_panels.plan, 0.88, 2.4), (panels.shift, 0.56, 1.0))
DESIGN = ((plan_panels.design_plan, 0.48, 2.9), (plan_panels.design_time, 0.88, 2.6))


def write(book: BookFigure, walk: Walk, other: Walk | None, base: Path) -> list[Path]:
    """<base>.png and .svg. other: the same run without landing position control, where the figure compares."""
    rows = reported.rows(book.number, walk, other)
    stack = DESIGN if book.number == "7.8" else WALK
    total = HEAD_IN + sum(gap + height for _, gap, height in stack) + FOOT_IN + LINE_IN * (_lines(rows) + 1.2)
    with style.drawing(style.WIDTH_IN, total) as figure:
        _title(figure, book, walk, total)
        top = total - HEAD_IN
        for panel, gap, height in stack:
            top -= gap + height
            panel(figure, walk, top / total, height / total)
        _reported(figure, rows, (top - FOOT_IN) / total, total)
        return style.save(figure, base)


def _title(figure: Figure, book: BookFigure, walk: Walk, total: float) -> None:
    seed = f"seed {walk.summary['seed']}" if walk.summary["seed"] else "nominal run"
    left = LEFT_IN / style.WIDTH_IN
    figure.text(
        left, 1 - 0.16 / total, f"Fig. {book.number}  {book.title}", fontsize=9.5, fontweight="bold", va="center"
    )
    figure.text(left, 1 - 0.33 / total, f"made from {walk.scenario.name}, {seed}, sensors {walk.scenario.sensors}",
                fontsize=7.5, color=style.GREY, va="center")  # fmt: skip


def _lines(rows: list[reported.Row]) -> int:
    return sum(max(map(len, _wrapped(row))) for row in rows)


def _wrapped(row: reported.Row) -> list[list[str]]:
    return [textwrap.wrap(text, width) or [""] for text, width in zip(row, WRAP)]


def _reported(figure: Figure, rows: list[reported.Row], top: float, total: float) -> None:
    """The text block: what the book reports, and what is measured here."""
    width = 1 - (LEFT_IN + RIGHT_IN) / style.WIDTH_IN
    places = [LEFT_IN / style.WIDTH_IN + width * share for share in COLUMNS]
    line, y = LINE_IN / total, top
    for x, head in zip(places, ("", "the book reports", "measured here")):
        figure.text(x, y, head, fontsize=7.5, fontweight="bold", va="top")
    y -= line
    for row in rows:
        cells = _wrapped(row)
        for x, lines, color in zip(places, cells, (style.GREY, style.BLACK, style.BLACK)):
            for number, text in enumerate(lines):
                figure.text(x, y - number * line, text, fontsize=7.5, color=color, va="top")
        y -= line * max(map(len, cells))
