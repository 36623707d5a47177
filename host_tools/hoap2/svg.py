"""Figures as inline SVG: curves, dots, filled outlines and bars on axes, in the page's own text colour.

No more than the report needs: a general plotting library takes longer to import than these take to draw.
Lengths are in units of the figure, WIDTH of them across.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape

import numpy as np

from hoap2.axes import INK, Axes, Limits, Patch, Stroke

WIDTH = 648.0
FONT, SMALL = 9.0, 8.0
GRAINS = 20  # a path's coordinates are whole numbers of 1/20 unit
LETTER = 0.6  # width of a letter as a part of the font's size, on average
LEGEND_ROOM, ROW_GAP, COLUMN_GAP, RIGHT_MARGIN = 14.0, 8.0, 14.0, 2.0
TICK = 3.0
GRID, SPINE = Stroke(width=0.6, alpha=0.12), Stroke(width=0.8)


def ticks(limits: Limits, most: int) -> list[tuple[float, str]]:
    """At most about `most` round numbers within the limits, and how they are written."""
    low, high = limits
    raw = (high - low) / max(1, most)
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(m * power for m in (1.0, 2.0, 2.5, 5.0, 10.0) if m * power >= raw * (1 - 1e-9))
    decimals = next(d for d in range(20) if abs(round(step, d) - step) < 1e-6 * step)
    first, last = math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6)
    return [(i * step, f"{i * step:.{decimals}f}".replace("-", "\u2212")) for i in range(first, last + 1)]


def path(x: np.ndarray, y: np.ndarray, dots: bool = False) -> str:
    """The points in units as path data in grains; a point that is not finite interrupts the line."""
    points = np.column_stack((x, y)) * GRAINS
    finite = np.isfinite(points).all(axis=1)
    parts = []
    for run in np.split(np.arange(len(points)), np.flatnonzero(np.diff(finite)) + 1):
        if run.size and finite[run[0]]:
            parts.append(_run_path(np.rint(points[run]).astype(np.int64), dots))
    return "".join(parts)


def _run_path(points: np.ndarray, dots: bool) -> str:
    moves = np.diff(points, axis=0)
    moves = moves[(moves != 0).any(axis=1)]
    start = f"M{points[0, 0]} {points[0, 1]}"
    if dots:
        return start + "h0" + "".join(f"m{dx} {dy}h0" for dx, dy in moves.tolist())
    return start + "l" + (" ".join(map(str, moves.ravel().tolist())) or "0 0")


def text(x: float, y: float, content: str, anchor: str = "start", more: str = "") -> str:
    """A line of text; `anchor` start, middle or end."""
    place = f' text-anchor="{anchor}"' if anchor != "start" else ""
    return f'<text x="{x:.1f}" y="{y:.1f}"{place}{more and " " + more}>{escape(content)}</text>'


@dataclass(frozen=True)
class Box:
    """Where axes are in the figure, and what data they show."""

    left: float
    top: float
    width: float
    height: float
    x_limits: Limits
    y_limits: Limits

    @property
    def bottom(self) -> float:
        return self.top + self.height

    @property
    def right(self) -> float:
        return self.left + self.width

    def x(self, value):
        """Data to units."""
        return self.left + (value - self.x_limits[0]) * (self.width / (self.x_limits[1] - self.x_limits[0]))

    def y(self, value):
        """Data to units."""
        return self.bottom - (value - self.y_limits[0]) * (self.height / (self.y_limits[1] - self.y_limits[0]))


def _y_ticks(limits: Limits, height: float) -> list[tuple[float, str]]:
    return ticks(limits, min(7, max(3, round(height / 18))))


def _frame(axes: Axes, box: Box) -> Iterable[str]:
    """Grid, ticks, their numbers, labels and the two spines."""
    y_ticks = _y_ticks(box.y_limits, box.height)
    x_ticks = [(float(i), name) for i, name in enumerate(axes.names)] or ticks(box.x_limits, round(box.width / 65))
    across = [(box.x(v), name) for v, name in x_ticks]
    up = [(box.y(v), name) for v, name in y_ticks]
    yield _strokes(GRID, [f"M{x:.1f} {box.top:.1f}V{box.bottom:.1f}" for x, _ in across]
                   + [f"M{box.left:.1f} {y:.1f}H{box.right:.1f}" for y, _ in up])  # fmt: skip
    yield _strokes(SPINE, [f"M{box.left:.1f} {box.top:.1f}V{box.bottom:.1f}H{box.right:.1f}"]
                   + [f"M{x:.1f} {box.bottom:.1f}v{TICK:g}" for x, _ in across]
                   + [f"M{box.left:.1f} {y:.1f}h{-TICK:g}" for y, _ in up])  # fmt: skip
    for x, name in across if axes.names or axes.x_numbers else []:
        if axes.names:
            yield text(x + 3, box.bottom + 11, name, "end", f'font-size="{SMALL:g}" '
                       f'transform="rotate(-60 {x + 3:.1f} {box.bottom + 11:.1f})"')  # fmt: skip
        else:
            yield text(x, box.bottom + 13, name, "middle")
    for y, name in up:
        yield text(box.left - 6, y + 3.2, name, "end")
    if axes.x_label:
        yield text(box.left + box.width / 2, box.bottom + 26, axes.x_label, "middle")
    if axes.y_label:
        x, y = box.left - 12 - _room(y_ticks), box.top + box.height / 2
        yield text(x, y, axes.y_label, "middle", f'transform="rotate(-90 {x:.1f} {y:.1f})"')


def _room(tick_list: list[tuple[float, str]]) -> float:
    """The width of the longest number of the ticks."""
    return FONT * LETTER * max((len(name) for _, name in tick_list), default=0)


def _strokes(stroke: Stroke, pieces: list[str]) -> str:
    return f'<path d="{"".join(pieces)}" fill="none" {stroke.attributes()}/>' if pieces else ""


def _patch(patch: Patch, corners: Iterable[tuple[float, float]]) -> str:
    fill = f'fill="{patch.fill}"' + (f' fill-opacity="{patch.fill_alpha:g}"' if patch.fill_alpha != 1.0 else "")
    edge = " " + patch.edge.attributes() if patch.edge else ""
    return f'<path d="M{"L".join(f"{x:.1f} {y:.1f}" for x, y in corners)}Z" {fill}{edge}/>'


def _content(axes: Axes, box: Box) -> Iterable[str]:
    """Marks, patches, levels, curves and notes."""
    by_stroke: dict[Stroke, list[str]] = {}
    for x, stroke in axes.marks:
        by_stroke.setdefault(stroke, []).append(f"M{box.x(x):.2f} {box.top:.1f}V{box.bottom:.1f}")
    for level, stroke in axes.levels:
        by_stroke.setdefault(stroke, []).append(f"M{box.left:.1f} {box.y(level):.1f}H{box.right:.1f}")
    yield from (_strokes(stroke, pieces) for stroke, pieces in by_stroke.items())
    yield from (_patch(p, zip(box.x(p.corners[:, 0]), box.y(p.corners[:, 1]))) for p in axes.patches)
    if axes.curves:
        yield f'<g transform="scale({1 / GRAINS:g})" stroke-linejoin="round">'
        for x, y, stroke in axes.curves:
            yield f'<path d="{path(box.x(x), box.y(y), stroke.dots)}" {stroke.attributes(GRAINS)}/>'
        yield "</g>"
    for x, content, color in axes.notes:
        yield text(box.x(x) + 3, box.top + 9, content, more=f'font-size="{SMALL:g}" fill="{color}"')


def _legend(axes: Axes, box: Box) -> Iterable[str]:
    """Above the axes at the right, where it covers no curve; each label once."""
    entries = list(dict(axes.entries).items()) if axes.legend else []
    sample, gap = 18.0, 12.0
    widths = [sample + 5 + SMALL * LETTER * len(label) for label, _ in entries]
    x, y = box.right - sum(widths) - gap * max(0, len(entries) - 1), box.top - 5
    for (label, kind), width in zip(entries, widths):
        if isinstance(kind, Patch):
            yield _patch(kind, [(x, y - 5), (x + sample, y - 5), (x + sample, y), (x, y)])
        else:
            start, length = (x + sample / 2, 0.0) if kind.dots else (x, sample)
            yield _strokes(kind, [f"M{start:.1f} {y - 2.5:.1f}h{length:g}"])
        yield text(x + sample + 5, y, label, more=f'font-size="{SMALL:g}"')
        x += width + gap


@dataclass
class Figure:
    """Axes in rows and columns below each other."""

    rows: list[list[Axes]]
    height: float
    foot: float = 30.0  # room below the last row

    def svg(self, label: str) -> str:
        """The whole figure; `label` says to those who cannot see it what it shows."""
        parts = [f'<svg viewBox="0 0 {WIDTH:g} {self.height:g}" role="img" aria-label="{escape(label)}" '
                 f'font-size="{FONT:g}" fill="{INK}" overflow="visible">']  # fmt: skip
        for axes, box in self._boxes():
            parts += [*_frame(axes, box), '<g fill="none">', *_content(axes, box), "</g>", *_legend(axes, box)]
            if axes.title:
                parts.append(text(box.left, box.top - 5, axes.title))
        return "\n".join(filter(None, [*parts, "</svg>"]))

    def _boxes(self) -> Iterable[tuple[Axes, Box]]:
        """The place of each of the axes; those of a column begin where the longest of their numbers leaves room."""
        height = (self.height - self.foot - ROW_GAP * (len(self.rows) - 1)) / len(self.rows) - LEGEND_ROOM
        columns = len(self.rows[0])
        room = (WIDTH - RIGHT_MARGIN - COLUMN_GAP * (columns - 1)) / columns
        for j in range(columns):
            stack = [row[j] for row in self.rows]
            left = 20.0 + max(_room(_y_ticks(axes.limits(room, height)[1], height)) for axes in stack)
            for i, axes in enumerate(stack):
                top = LEGEND_ROOM + i * (height + LEGEND_ROOM + ROW_GAP)
                yield axes, Box(j * (room + COLUMN_GAP) + left, top, room - left, height,
                                *axes.limits(room - left, height))  # fmt: skip
