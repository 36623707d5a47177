"""`study`: the sand walks of section 7.3 over many seeds, and how their outcome depends on the parameters."""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(add_completion=False, help="Many runs of the sand walks of section 7.3, judged together.",
                  no_args_is_help=True)  # fmt: skip

Seeds = Annotated[str | None, typer.Option(metavar="RANGE", help="Seeds: 101-150 or 1,3,5-7.")]
Overrides = Annotated[
    list[str] | None, typer.Option("--set", metavar="A.B=VALUE", help="Override a value in every run.")
]
Jobs = Annotated[int | None, typer.Option(min=1, max=256, help="Runs at a time; all processors unless given.")]
Out = Annotated[str | None, typer.Option(metavar="NAME", help="Name of the study's folder in out/, or a path.")]
Resume = Annotated[Path | None, typer.Option(metavar="FOLDER", help="Go on with a stopped study, or add seeds to one.")]
Json = Annotated[bool, typer.Option("--json", help="Print study.json on standard output.")]


def _shown(document: dict, code: int, json: bool) -> int:
    if json:
        from hoap2.runfolder import jsonable

        print(json_module.dumps(jsonable(document), indent=2, ensure_ascii=False))
    return code


@app.command()
def sand(
    seeds: Seeds = None,
    overrides: Overrides = None,
    jobs: Jobs = None,
    out: Out = None,
    resume: Resume = None,
    json: Json = False,
) -> int:
    """sand-walk, sand-walk-lpc, floor-walk and floor-walk-lpc over seeds (101-150 unless given).

    Writes study.json, runs.csv, table.csv and study.png/.svg into a folder, and prints the table. Every run that
    has ended is kept at once: after Ctrl-C go on with --resume FOLDER. Runs of other parameters or other FMUs do
    not count as done. Exit code: 0 all runs done, 1 some ended by an error, 2 bad input, 130 stopped.
    """
    from rich.console import Console

    from hoap2 import parallel
    from hoap2.studies import sand as study

    wish = study.Wish(seeds, tuple(overrides or ()), jobs or parallel.cores(), out, resume)
    document, code = study.run(wish, Console(stderr=True, highlight=False), show=not json)
    return _shown(document, code, json)


@app.command(name="map")
def parameter_map(
    vary: Annotated[
        list[str] | None,
        typer.Option(
            "--vary", metavar="A.B=LOW:HIGH:COUNT", help="A parameter's grid, or its values A.B=V1,V2; at most two."
        ),
    ] = None,
    sweep: Annotated[
        list[str] | None, typer.Option("--sweep", metavar="NAME", help="One of the predefined sweeps.")
    ] = None,
    list_sweeps: Annotated[bool, typer.Option("--list", help="List the predefined sweeps and stop.")] = False,
    scenarios: Annotated[
        list[str] | None,
        typer.Option("--scenario", metavar="SCENARIO", help="sand-walk and sand-walk-lpc unless given."),
    ] = None,
    seeds: Seeds = None,
    overrides: Overrides = None,
    jobs: Jobs = None,
    out: Out = None,
    resume: Resume = None,
    json: Json = False,
) -> int:
    """How the outcome depends on parameters: survival, its interval and the fall step in each cell of a grid.

    Without --vary or --sweep all predefined sweeps are run (seeds 1-12 unless given). Files, --resume and exit codes
    as for `study sand`.
    """
    from rich.console import Console

    from hoap2 import parallel
    from hoap2.studies import parameter_map as study
    from hoap2.studies import shown
    from hoap2.studies.sweep import PREDEFINED

    if list_sweeps:
        shown.predefined(Console(highlight=False), PREDEFINED)
        return 0
    wish = study.Wish(tuple(vary or ()), tuple(sweep or ()), tuple(scenarios or ()), seeds, tuple(overrides or ()),
                      jobs or parallel.cores(), out, resume)  # fmt: skip
    document, code = study.run(wish, Console(stderr=True, highlight=False), show=not json)
    return _shown(document, code, json)
