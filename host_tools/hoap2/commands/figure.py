"""`figure`: the figures of section 7.3, laid out as the book's, beside what the book reports."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    number: Annotated[str | None, typer.Argument(metavar="[NUMBER]", help="7.8, 7.10, 7.11, 7.12 or 7.13.")] = None,
    run: Annotated[Path | None, typer.Option(metavar="FOLDER", help="Draw this run; else one is made.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the run that is made; 0 is nominal.")] = 0,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Where; else in the run folder.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite the files.")] = False,
) -> int:
    """Draw a figure of section 7.3 as PNG and SVG, and print the files' names. Without a number: list the figures."""
    from rich.console import Console

    from hoap2.figures import book

    if number is None:
        for each in book.FIGURES.values():
            print(f"{each.number:<5} {each.title}  (run: {each.scenario})")
        print("Draw one: ./hoap2 figure 7.11")
        return 0
    from hoap2.figures import make

    for path in make.figure(book.find(number), run, seed, out, force, Console(stderr=True, highlight=False)):
        print(path)
    return 0
