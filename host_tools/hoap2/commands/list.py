"""`list`: the scenarios that come with the project."""

from __future__ import annotations

import json as json_module
from typing import Annotated

import typer


def command(
    json: Annotated[bool, typer.Option("--json", help="Machine-readable, on standard output.")] = False,
) -> int:
    """The scenarios, with the section of the chapter and what each one shows."""
    from hoap2 import scenario

    rows = []
    for name in scenario.names():
        loaded = scenario.load(name)
        rows.append({
            "name": name, "section": loaded.section, "title": loaded.title, "text": loaded.text,
            "duration_s": loaded.duration_s, "sensors": loaded.sensors,
        })  # fmt: skip
    rows.sort(key=lambda row: (row["section"], row["name"]))
    if json:
        print(json_module.dumps(rows, indent=2, ensure_ascii=False))
        return 0
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 1, 0))
    table.add_column("scenario", no_wrap=True, style="bold")
    table.add_column("section", no_wrap=True)
    table.add_column("what it shows")
    for row in rows:
        table.add_row(row["name"], row["section"], f"{row['title']}. {row['text']}")
    Console(highlight=False).print(table)
    print("Run one: ./hoap2 run NAME   (a path to a .toml file of your own works too)")
    return 0
