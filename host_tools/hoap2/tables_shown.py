"""What a run or a study prints when it is done."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from hoap2 import metric_names

OK, MISSED = "[green]ok[/]", "[bold red]missed[/]"


UNITS = {"m": ("mm", 1e3), "s": ("ms", 1e3), "m/s": ("mm/s", 1e3)}  # handier on a screen


def in_unit(name: str, value: float | None) -> str:
    """A metric in its handy unit, for a column of a table."""
    if value is None:
        return "-"
    text = f"{value * UNITS.get(metric_names.NAMES[name][0], ('', 1.0))[1]:.2f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def number(value, digits: int = 4) -> str:
    """A number for reading: short, a dash when there is none."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    return str(value)


def bounds_table(summary: dict) -> Table:
    """The bounds of one run."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for name, style in (("bound", ""), ("value", "right"), ("min", "right"), ("max", "right"), ("", "")):
        table.add_column(name, justify="right" if style else "left")
    for name, entry in summary["bounds"].items():
        unit = metric_names.NAMES.get(name, ("", ""))[0]
        table.add_row(f"{name} [dim]{unit}[/]", number(entry["value"]), number(entry["min"]), number(entry["max"]),
                      OK if entry["ok"] else MISSED)  # fmt: skip
    return table


def falls_as_wanted(summary: dict) -> bool:
    """Whether a fall is what the scenario shows, and all its bounds are met."""
    return summary["ok"] and summary["bounds"].get("fell", {}).get("min", 0) == 1


def can_line(can: dict) -> str:
    """Load and losses of a run over CAN."""
    loads = ", ".join(f"{name} {bus['load_percent']:.1f} %" for name, bus in can["buses"].items())
    refused = sum((*can["refused_by_controller"].values(), *can["refused_by_boards"].values()))
    return (f"CAN: load {loads}; {can['lost_percent']:.2g} % of the frames lost, {refused} refused, "
            f"{can['holds']} safe modes of boards")  # fmt: skip


def show_summary(summary: dict, console: Console) -> None:
    """Verdict, bounds and folder of one run."""
    verdict = "[bold green]ok[/]" if summary["ok"] else "[bold red]not ok[/]"
    notes = []
    if summary["interrupted"]:
        notes.append("interrupted")
    if summary["error"]:
        notes.append(summary["error"])
    if summary.get("fell"):
        wanted = "as the chapter: " if falls_as_wanted(summary) else ""
        when = f"{summary['fall_time_s']:.2f} s, step {summary['fall_step']}"
        notes.append(f"{wanted}fell {summary['fall_direction']} at {when}")
    if summary.get("faults"):
        notes.append("faults: " + ", ".join(summary["faults"]))
    console.print(f"{summary['scenario']}: {verdict}" + "".join(f"; {note}" for note in notes))
    console.print(bounds_table(summary))
    factor = summary["real_time_factor"]
    if factor:
        medians = [number(summary[key]["median"]) for key in ("controller_us", "plant_us")]
        console.print(
            f"{summary['duration_s']:.2f} s simulated at {factor:.2f} x real time; "
            f"controller {medians[0]} us, plant {medians[1]} us a tick", soft_wrap=True,
        )  # fmt: skip
    if "can" in summary:
        console.print(can_line(summary["can"]), soft_wrap=True)
    for note in summary.get("notes", []):
        console.print(f"[yellow]note:[/] {note}")
    console.print(f"run folder: {summary['folder']}", soft_wrap=True)
