"""One look for all drawn files: colours that any colour vision tells apart, text that stays text, page width."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib

from hoap2.errors import UserError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDTH_IN = 7.2  # a page of A4 between its margins
PNG_DPI = 220
# Okabe and Ito
BLACK, ORANGE, SKY, GREEN, BLUE, VERMILION, PURPLE = (
    "#000000", "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7"
)  # fmt: skip
RIGHT, LEFT = VERMILION, BLUE
FONT, FONTS = "'DejaVu Sans'", "'DejaVu Sans', Verdana, sans-serif"  # in an SVG: what is about as wide where it lacks
GREY, LIGHT = "#666666", "#d4d4d4"

RC = {
    "font.family": "DejaVu Sans", "font.size": 8.0, "axes.titlesize": 8.5,
    "axes.labelsize": 8.0, "xtick.labelsize": 7.5, "ytick.labelsize": 7.5, "legend.fontsize": 7.5,
    "axes.titlelocation": "left", "axes.titleweight": "bold", "axes.spines.top": False, "axes.spines.right": False,
    "axes.linewidth": 0.7, "axes.grid": True, "grid.color": "#e6e6e6", "grid.linewidth": 0.6, "axes.axisbelow": True,
    "xtick.major.width": 0.7, "ytick.major.width": 0.7, "xtick.major.size": 3.0, "ytick.major.size": 3.0,
    "lines.linewidth": 1.1, "legend.frameon": False, "legend.handlelength": 1.8, "legend.borderaxespad": 0.2,
    "svg.fonttype": "none", "svg.hashsalt": "hoap2", "figure.dpi": 100.0, "savefig.facecolor": "white",
    "figure.facecolor": "white",
}  # fmt: skip


@contextmanager
def drawing(width_in: float, height_in: float) -> Iterator[Figure]:
    """An empty figure of this size in the common look; close to nothing global is touched."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(RC):
        figure = Figure(figsize=(width_in, height_in))
        FigureCanvasAgg(figure)
        yield figure


def save(figure: Figure, base: Path) -> list[Path]:
    """Write <base>.png and <base>.svg, each whole or not at all; call inside `drawing`."""
    written = []
    for suffix, options in ((".png", {"dpi": PNG_DPI}), (".svg", {"metadata": {"Date": None}, "dpi": PNG_DPI})):
        path = base.with_name(base.name + suffix)
        part = path.with_name(f".{base.name}.part-{os.getpid()}{suffix}")
        try:
            figure.savefig(part, **options)
            if suffix == ".svg":
                part.write_text(part.read_text(encoding="utf-8").replace(FONT, FONTS), encoding="utf-8")
            part.replace(path)
        except OSError as error:
            raise UserError(f"cannot write {path}: {error.strerror or error}") from None
        finally:
            part.unlink(missing_ok=True)
        written.append(path)
    return written
