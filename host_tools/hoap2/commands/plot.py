"""`plot`: signals of a run over time."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer


def command(
    run: Annotated[
        str, typer.Argument(metavar="RUN", help="A run folder, a scenario (its latest run), or a log file.")
    ],
    signals: Annotated[
        list[str],
        typer.Argument(metavar="SIGNAL...", help="Names, wholes or patterns; with commas between them in one panel."),
    ],
    out: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Where (.png, .svg, .pdf); else beside the run's files.")
    ] = None,
    first: Annotated[float, typer.Option("--from", metavar="SECONDS", help="Begin of the time axis.")] = 0.0,
    last: Annotated[float, typer.Option("--to", metavar="SECONDS", help="End of it.")] = math.inf,
    rad: Annotated[bool, typer.Option("--rad", help="Angles in rad, not in degrees.")] = False,
) -> int:
    """Draw signals of a run over time, a panel for each argument, and print the file's name.

    A name is a column of signals.parquet (`p.r_knee.true_tau_Nm`, `c.` and `p.` may be left out), a whole signal
    (`cp_est_W_m`), or a pattern ('*knee.q_*').
    """
    from hoap2 import plot_signals, run_source

    source = run_source.load(run)
    for note in source.notes:
        typer.echo(f"note: {note}", err=True)
    print(plot_signals.draw(source, signals, first, last, out or source.folder / _name(signals), degrees=not rad))
    return 0


def _name(signals: list[str]) -> str:
    words = "_".join(signals)
    return "plot_" + "".join(sign if sign.isalnum() or sign in "_.-" else "-" for sign in words)[:80] + ".png"
