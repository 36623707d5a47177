"""Drawings made of characters: a canvas of braille dots, an artificial horizon, bars."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rich.style import Style
from rich.text import Text

DOT = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))  # [row][column] of a braille character
FAR_M = 10.0  # nothing is drawn so far away
SKY, GROUND = "#2b5a8c", "#6b4a2b"


class Canvas:
    """Dots (2 a column, 4 a row of the terminal) with one style a character, and characters laid over them.

    Coordinates are metres; x to the right, y upward, `centre` in the middle. A dot is as wide as it is high.
    """

    def __init__(self, columns: int, rows: int, centre: tuple[float, float], metres_a_dot: float) -> None:
        self.columns, self.rows = columns, rows
        self._centre, self._scale = centre, metres_a_dot
        self._bits = [[0] * columns for _ in range(rows)]
        self._style = [[""] * columns for _ in range(rows)]
        self._over: dict[tuple[int, int], tuple[str, str]] = {}

    def _dot(self, x_m: float, y_m: float) -> tuple[int, int]:
        x_m, y_m = max(-FAR_M, min(FAR_M, x_m)), max(-FAR_M, min(FAR_M, y_m))
        across = round((x_m - self._centre[0]) / self._scale + self.columns - 0.5)
        down = round(-(y_m - self._centre[1]) / self._scale + 2 * self.rows - 0.5)
        return across, down

    def put(self, across: int, down: int, style: str) -> None:
        """One dot; nothing happens outside of the canvas."""
        column, row = across // 2, down // 4
        if 0 <= column < self.columns and 0 <= row < self.rows:
            self._bits[row][column] |= DOT[down % 4][across % 2]
            self._style[row][column] = style

    def line(self, a: Sequence[float], b: Sequence[float], style: str) -> None:
        """Nothing when an end is not finite."""
        if not all(math.isfinite(v) for v in (*a, *b)):
            return
        (x0, y0), (x1, y1) = self._dot(*a), self._dot(*b)
        steps = max(abs(x1 - x0), abs(y1 - y0), 1)
        for i in range(steps + 1):
            self.put(round(x0 + (x1 - x0) * i / steps), round(y0 + (y1 - y0) * i / steps), style)

    def outline(self, corners: Sequence[Sequence[float]], style: str) -> None:
        for a, b in zip(corners, [*corners[1:], corners[0]]):
            self.line(a, b, style)

    def mark(self, point: Sequence[float], character: str, style: str) -> None:
        """A character in place of the dots there."""
        if not all(math.isfinite(v) for v in point):
            return
        across, down = self._dot(*point)
        if 0 <= across < 2 * self.columns and 0 <= down < 4 * self.rows:
            self._over[down // 4, across // 2] = character, style

    def text(self) -> Text:
        out = Text(no_wrap=True)
        for row in range(self.rows):
            for column in range(self.columns):
                character, style = self._over.get((row, column), ("", ""))
                if not character:
                    bits = self._bits[row][column]
                    character, style = (chr(0x2800 + bits), self._style[row][column]) if bits else (" ", "")
                out.append(character, style)
            out.append("\n" if row + 1 < self.rows else "")
        return out


def horizon(roll_rad: float, pitch_rad: float, columns: int, rows: int, gain: float) -> Text:
    """An artificial horizon: to the right the right side, the tilt times `gain`; half a character is 1 degree high."""
    out = Text(no_wrap=True)
    tilt = math.tan(max(-1.4, min(1.4, gain * roll_rad)))
    level = math.degrees(gain * pitch_rad)  # nose down: more of the ground, the horizon rises

    def colour(column: int, half: int) -> str:
        across, up = column - 0.5 * (columns - 1), 0.5 * (2 * rows - 1) - half
        return SKY if up > level + tilt * across else GROUND

    middle = columns // 2
    for row in range(rows):
        for column in range(columns):
            upper, lower = colour(column, 2 * row), colour(column, 2 * row + 1)
            if row == rows // 2 and abs(column - middle) in (0, 3, 4, 5):
                out.append("•" if column == middle else "━", Style(color="yellow", bgcolor=lower, bold=True))
            else:
                out.append("▀", Style(color=upper, bgcolor=lower))
        out.append("\n" if row + 1 < rows else "")
    return out


def bar(value: float, low: float, high: float, width: int, style: str, reference: float | None = None) -> Text:
    """Where a value lies between two limits, and a reference beside it."""
    cells = [("·", "bright_black")] * width

    def place(x: float) -> int:
        share = (x - low) / (high - low) if high > low else 0.5
        return max(0, min(width - 1, int(share * width)))

    if low < 0.0 < high:
        cells[place(0.0)] = ("┊", "bright_black")
    if reference is not None and math.isfinite(reference):
        cells[place(reference)] = ("│", "cyan")
    if math.isfinite(value):
        cells[place(value)] = ("■", style)
    out = Text(no_wrap=True)
    for character, its in cells:
        out.append(character, its)
    return out
