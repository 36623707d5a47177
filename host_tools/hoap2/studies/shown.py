"""What a study prints."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

PLAIN_WIDTH = 160


def _wide(console: Console) -> Console:
    return console if console.is_terminal else Console(file=console.file, highlight=False, width=PLAIN_WIDTH)


def _number(value: float | None, scale: float = 1.0, digits: int = 2) -> str:
    return "-" if value is None else f"{value * scale:.{digits}f}"


def fraction(block: dict, name: str) -> str:
    """`48 of 50 (87-99 %)`, with the 95 % interval."""
    if not block["runs"]:
        return "-"
    low, high = block["wilson_95"][f"{name}_fraction"]
    return f"{block['counts'][name]} of {block['runs']} ({100 * low:.0f}-{100 * high:.0f} %)"


def falls(block: dict) -> str:
    """`18 (12-25)`: median and range of the fall steps."""
    steps = block["fall_steps"]
    return f"{block['median_fall_step']:g} ({steps[0]}-{steps[-1]})" if steps else "-"


def directions(block: dict) -> str:
    """`backward 48, left 1`."""
    return ", ".join(f"{word} {count}" for word, count in block["fall_directions"].items()) or "-"


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for number, name in enumerate(columns):
        table.add_column(name, justify="left" if number == 0 else "right", no_wrap=number == 0)
    return table


def sand(document: dict, console: Console) -> None:
    """The four scenarios below each other, then the paired difference on the floor."""
    console = _wide(console)
    table = _table("scenario", "survived\n(95 %)", "fell", "step of the fall\nmedian (range)", "max pitch\nmedian deg",
                   "rms roll\nmedian deg", "sinkage\nmedian mm", "landing shift\nrms mm", "errors")  # fmt: skip
    for key in ("sand_walk", "sand_walk_lpc", "floor_walk", "floor_walk_lpc"):
        block = document[key]
        table.add_row(key.replace("_", "-"), fraction(block, "survived"), directions(block), falls(block),
                      _number(block["median_max_pitch_deg"]), _number(block["median_rms_roll_deg"], digits=3),
                      _number(block["median_sinkage_mid_stance_m"], 1e3),
                      _number(block["median_landing_shift_rms_m"], 1e3),
                      f"[red]{block['errors']}[/]" if block["errors"] else "0")  # fmt: skip
    console.print(table)
    block = document["sand_walk"]
    console.print(f"sand-walk fell backward: {fraction(block, 'fell_backward')}")
    console.print(f"rms roll on the floor, with landing position control less without: {difference(document)}")
    ending(document, console, "sand")


def difference(document: dict) -> str:
    """`-0.012 deg (95 %: -0.015 to -0.009), 50 pairs, -3.1 % of 0.38 deg`."""
    found = document["floor_roll_rms_difference_deg"]
    if found["mean"] is None:
        return "too few pairs"
    low, high = found["mean_95"]
    share = f", {100 * found['mean'] / found['mean_of_base']:+.1f} % of {found['mean_of_base']:.3f} deg"
    return f"{found['mean']:+.4f} deg (95 %: {low:+.4f} to {high:+.4f}), {found['pairs']} pairs{share}"


def ending(document: dict, console: Console, study: str) -> None:
    """Errors, where the files are, and how a stopped study goes on."""
    for number, (where, text) in enumerate(document["errors"].items()):
        if number == 5:
            console.print(f"[red]error:[/] and {len(document['errors']) - 5} more, in study.json")
            break
        console.print(f"[red]error:[/] {where}: {text.splitlines()[0]}", soft_wrap=True)
    if document["interrupted"]:
        console.print(f"stopped after {document['runs_done']} of {document['runs_planned']} runs; go on with: "
                      f"./hoap2 study {study} --resume {document['folder']}", soft_wrap=True)  # fmt: skip
    if document["runs_kept_from_before"]:
        console.print(f"{document['runs_kept_from_before']} runs were there already")
    console.print(f"study folder: {document['folder']}", soft_wrap=True)


def _plain(value: str) -> str:
    """A value of an axis, a number without needless digits."""
    try:
        return f"{float(value):.6g}"
    except ValueError:
        return value


def parameter_map(document: dict, console: Console) -> None:
    """A table a sweep: a line a cell, the scenarios beside each other; a star marks the scenario's own value."""
    console = _wide(console)
    for sweep in document["sweeps"]:
        table = _table(*(axis["name"] + (f"\n{axis['unit']}" if axis["unit"] else "") for axis in sweep["axes"]), *(
            f"{name}\n{what}" for name in document["scenarios"] for what in ("survived (95 %)", "fell", "step (range)")
        ))  # fmt: skip
        for cell in sweep["cells"]:
            values = [_plain(value) + (" *" if value == axis["own"] else "")
                      for axis, value in zip(sweep["axes"], cell["values"].values())]  # fmt: skip
            blocks = [cell[name.replace("-", "_")] for name in document["scenarios"]]
            columns = [
                text for block in blocks for text in (fraction(block, "survived"), directions(block), falls(block))
            ]
            table.add_row(*values, *columns)
        console.print(f"[bold]{sweep['title']}[/]" + (f"  (with {', '.join(sweep['set'])})" if sweep["set"] else ""),
                      soft_wrap=True)  # fmt: skip
        console.print(table)
        console.print()
    ending(document, console, "map")


def predefined(console: Console, sweeps) -> None:
    """The sweeps that come with the project."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for name in ("sweep", "parameter", "values"):
        table.add_column(name, no_wrap=name == "sweep")
    for each in sweeps:
        table.add_row(
            each.name, "\n".join(a.name for a in each.axes), "\n".join(", ".join(a.values) for a in each.axes)
        )
    console.print(table)
