"""`fmu`: build the FMUs and the SSP, and judge them."""

from __future__ import annotations

import json as json_module
import tempfile
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    help="The FMUs: controller and plant for FMI 2.0, FMI 3.0, FMI-LS-BUS (with the bus), and hoap2.ssp.",
)
Json = Annotated[bool, typer.Option("--json", help="Machine-readable, on standard output.")]


@app.command()
def build(json: Json = False) -> int:
    """Build what is out of date and say where the files are."""
    from hoap2.fmu.build import build as build_fmus

    files = build_fmus().files()
    if json:
        print(json_module.dumps([{"file": str(f), "bytes": f.stat().st_size} for f in files], indent=2))
        return 0
    for path in files:
        print(f"{path}  {path.stat().st_size / 1e3:.0f} kB")
    return 0


@app.command()
def check(
    quick: Annotated[bool, typer.Option("--quick", help="Leave out the compilation of the sources.")] = False,
    json: Json = False,
) -> int:
    """Judge the FMUs: schemas, fmpy, libcosim, states, steps, instances, threads, bus terminals, bad input.

    Exit code: 0 every check holds, 1 one does not.
    """
    from hoap2.fmu.build import built
    from hoap2.fmu.check import Context, run_checks

    with tempfile.TemporaryDirectory(prefix="hoap2_check_") as scratch:
        context = Context(built(), Path(scratch))
        if json:
            results = list(run_checks(context, quick))
            ok = all(r.ok for r in results)
            print(json_module.dumps({"ok": ok, "checks": [r.as_dict() for r in results]}, indent=2))
            return 0 if ok else 1
        return _show(context, quick)


def _show(context, quick: bool) -> int:
    from rich.console import Console
    from rich.table import Table

    from hoap2.fmu.check import run_checks

    console = Console(highlight=False)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("check", "of", "", "found"):
        table.add_column(title, no_wrap=title != "found", style="bold" if title == "check" else "")
    results, last = [], ""
    with console.status("") as status:
        for result in run_checks(context, quick, lambda c: status.update(f"{c.name}: {c.subject}")):
            results.append(result)
            verdict = "[green]ok[/]" if result.ok else "[bold red]failed[/]"
            table.add_row(
                result.check if result.check != last else "", result.subject, verdict, _escaped(result.detail)
            )
            last = result.check
    console.print(table)
    failed = [r for r in results if not r.ok]
    seconds = sum(r.seconds for r in results)
    console.print(
        f"{len(results) - len(failed)} of {len(results)} checks hold ({seconds:.0f} s); equal means to the bit"
    )
    return 1 if failed else 0


def _escaped(text: str) -> str:
    from rich.markup import escape

    return escape(text)
