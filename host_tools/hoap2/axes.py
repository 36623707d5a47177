"""What is on a figure's axes, in data units, and which ranges it takes. svg.py draws it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

INK = "currentColor"  # the page's own text colour
BEYOND = 1e12  # a value like this is of a run that diverged, and left out

Limits = tuple[float, float]


@dataclass(frozen=True)
class Stroke:
    """How a curve or an edge is drawn."""

    color: str = INK
    width: float = 1.2
    dash: str = ""  # lengths of dash and gap, "3.3 1.4"
    alpha: float = 1.0
    dots: bool = False  # a dot of this width at each point instead of a line

    def but(self, **changes) -> Stroke:
        """The same with some properties changed."""
        return replace(self, **changes)

    def attributes(self, scale: float = 1.0) -> str:
        """As SVG attributes, lengths times `scale`."""
        text = f'stroke="{self.color}" stroke-width="{self.width * scale:g}"'
        if self.dash:
            text += f' stroke-dasharray="{" ".join(f"{float(d) * scale:g}" for d in self.dash.split())}"'
        if self.alpha != 1.0:
            text += f' stroke-opacity="{self.alpha:g}"'
        return text + (' stroke-linecap="round"' if self.dots else "")


@dataclass(frozen=True)
class Patch:
    """A filled outline: corners (n, 2) in data units."""

    corners: np.ndarray
    fill: str = "none"
    fill_alpha: float = 1.0
    edge: Stroke | None = None


def _widened(low: float, high: float, margin: float) -> Limits:
    """The range with a part of it added on both sides; never too narrow to write numbers at it."""
    if not high - low > max(1e-12, 1e-9 * max(abs(low), abs(high))):
        half = max(0.05 * abs(low), 1e-3)
        return low - half, low + half
    return low - margin * (high - low), high + margin * (high - low)


@dataclass
class Axes:
    """One pair of axes: what is on them in data units, then where they are in the figure."""

    title: str = ""
    x_label: str = ""
    y_label: str = ""
    margins: tuple[float, float] = (0.0, 0.05)  # part of the range that is added on both sides
    y_floor: float | None = None  # where y begins instead of below the least value
    equal: bool = False  # one scale for x and y
    names: list[str] = field(default_factory=list)  # labels of x = 0, 1, ... instead of numbers
    x_numbers: bool = True  # write the numbers at the x ticks
    legend: bool = True
    curves: list[tuple[np.ndarray, np.ndarray, Stroke]] = field(default_factory=list)
    patches: list[Patch] = field(default_factory=list)
    levels: list[tuple[float, Stroke]] = field(default_factory=list)
    marks: list[tuple[float, Stroke]] = field(default_factory=list)  # vertical, from bottom to top
    notes: list[tuple[float, str, str]] = field(default_factory=list)  # x, text, colour; at the top
    entries: list[tuple[str, Stroke | Patch]] = field(default_factory=list)  # of the legend
    share_y: Axes | None = None

    def line(self, x: np.ndarray, y: np.ndarray, stroke: Stroke, label: str = "") -> None:
        """A curve through points, or dots at them."""
        y = np.asarray(y, dtype=float)
        self.curves.append((np.asarray(x, dtype=float), np.where(np.abs(y) < BEYOND, y, np.nan), stroke))
        if label:
            self.entries.append((label, stroke.but(width=max(stroke.width, 2.0)) if stroke.dots else stroke))

    def bars(self, heights: np.ndarray, width: float, fill: str, alpha: float, label: str) -> None:
        """A bar at each of x = 0, 1, ..."""
        half = 0.5 * width
        for i, height in enumerate(heights):
            self.patches.append(Patch(np.array([[i - half, 0], [i - half, height], [i + half, height], [i + half, 0]]),
                                      fill, alpha))  # fmt: skip
        self.entries.append((label, Patch(np.zeros((0, 2)), fill, alpha)))

    def own_limits(self) -> tuple[Limits, Limits]:
        """The ranges of all that is on the axes, with their margins."""
        data = [(x, y) for x, y, _ in self.curves] + [(p.corners[:, 0], p.corners[:, 1]) for p in self.patches]
        levels = np.array([level for level, _ in self.levels])
        found = []
        for axis, margin in enumerate(self.margins):
            values = np.concatenate([pair[axis] for pair in data] + ([levels] if axis else []) + [np.zeros(0)])
            values = values[np.isfinite(values)]
            low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 1.0)
            found.append(_widened(low, high, margin))
        x, y = found
        return x, y if self.y_floor is None else (self.y_floor, y[1])

    def limits(self, width: float, height: float) -> tuple[Limits, Limits]:
        """The ranges shown on axes of this size."""
        x, y = self.own_limits()
        if self.share_y is not None:
            other = self.share_y.own_limits()[1]
            y = min(y[0], other[0]), max(y[1], other[1])
        if self.equal:
            scale = max((x[1] - x[0]) / width, (y[1] - y[0]) / height)
            x, y = (((low + high - scale * size) / 2, (low + high + scale * size) / 2)
                    for (low, high), size in ((x, width), (y, height)))  # fmt: skip
        return x, y
