"""`export`: a run for other tools."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

NAMES = {"mcap": "run.mcap", "csv": "signals.csv", "parquet": "export.parquet", "rrd": "run.rrd"}


def command(
    run: Annotated[
        str, typer.Argument(metavar="RUN", help="A run folder, a scenario (its latest run), or a log file.")
    ],
    mcap: Annotated[bool, typer.Option("--mcap", help="For Foxglove: signals, events, the robot in 3D.")] = False,
    csv: Annotated[bool, typer.Option("--csv", help="For a spreadsheet: a column a signal.")] = False,
    parquet: Annotated[
        bool, typer.Option("--parquet", help="For pandas: chosen signals, or those of a log file.")
    ] = False,
    rrd: Annotated[bool, typer.Option("--rrd", help="For rerun (installs rerun-sdk, 170 MB).")] = False,
    signals: Annotated[
        list[str] | None, typer.Option("--signal", metavar="NAME", help="Only this signal or pattern; may be repeated.")
    ] = None,
    every: Annotated[int, typer.Option(min=1, metavar="N", help="Every N-th tick.")] = 1,
    out: Annotated[Path | None, typer.Option(metavar="FILE", help="Where; else beside the run's files.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite the file.")] = False,
) -> int:
    """Write a run in the formats asked for, and print the files' names."""
    from rich.console import Console

    from hoap2 import export, run_source
    from hoap2.errors import UserError
    from hoap2.progress import PartProgress

    forms = [form for form, asked in (("mcap", mcap), ("csv", csv), ("parquet", parquet), ("rrd", rrd)) if asked]
    if not forms:
        raise UserError("no format given", "one or more of --mcap, --csv, --parquet, --rrd")
    if out is not None and len(forms) > 1:
        raise UserError("--out names one file", "give one format at a time")
    source = run_source.load(run)
    console = Console(stderr=True, highlight=False)
    for note in source.notes:
        console.print(f"note: {note}", soft_wrap=True)
    for form in forms:
        progress = PartProgress(form, console)
        try:
            wanted = export.order(source, signals or [], every, lambda done, total: progress(done, total))
            path = export.run(form, wanted, out or source.folder / NAMES[form], force)
        finally:
            progress.close()
        print(path)
    return 0
