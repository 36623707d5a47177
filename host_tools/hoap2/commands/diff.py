"""`diff`: where two runs part."""

from __future__ import annotations

import json as json_module
from typing import Annotated

import typer


def command(
    first: Annotated[
        str, typer.Argument(metavar="RUN", help="A run folder, a scenario (its latest run), or a log file.")
    ],
    second: Annotated[str, typer.Argument(metavar="RUN", help="Another one.")],
    tolerance: Annotated[float, typer.Option(metavar="X", min=0.0, help="Differences up to this do not count.")] = 0.0,
    json: Annotated[bool, typer.Option("--json", help="Everything, on standard output.")] = False,
) -> int:
    """Say at which tick two runs part, in which signals, and how far they get from each other.

    Equal means equal to the bit in every signal, unless --tolerance says otherwise. Exit code: 0 equal, 1 not.
    """
    from rich.console import Console

    from hoap2 import diff_runs, run_source
    from hoap2.runfolder import jsonable

    sources = [run_source.load(run) for run in (first, second)]
    for note in (note for source in sources for note in source.notes):
        typer.echo(f"note: {note}", err=True)
    found = diff_runs.document(*sources, tolerance)
    if json:
        print(json_module.dumps(jsonable(found), indent=2))
    else:
        diff_runs.show(found, Console(highlight=False))
    return 0 if found["equal"] else 1
