"""The tables of `bench telemetry`."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from hoap2.bench import measure

BOUND_US = {"log": 3.0, "udpm": 10.0, "udpm, a listener": 10.0}
BOUND_RATIO = 1.10


def show(document: dict) -> None:
    """For people; nothing is judged, the bounds are shown beside."""
    console = Console(highlight=False)
    if not console.is_terminal:
        console = Console(highlight=False, width=120)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for head in ("into", "us a tick", "of processor", "bound", "sender, us a tick", "messages a tick", "dropped"):
        table.add_column(head, justify="left" if head == "into" else "right", no_wrap=True)
    for name, row in document["sinks"].items():
        messages = (row["logged"] or row["published"]) / document["ticks"]
        sender = "" if name == "log" else f"{row['sender_us']:.2f}"
        bound = f"{BOUND_US[name]:g}" if name in BOUND_US else ""
        table.add_row(
            name, f"{row['us']:.2f}", f"{row['cpu_us']:.2f}", bound, sender, f"{messages:.2f}", f"{row['dropped']:.0f}"
        )
    console.print(table)
    if "udpm" not in document["sinks"]:
        console.print("udpm: not measured, there are no network namespaces here (unshare, ip)")
    loop = document["loop"]
    console.print(f"the loop of {document['scenario']} with its log: {loop['ratio']:.3f} times as long as without, "
                  f"{loop['cpu_ratio']:.3f} times the processor time (bound {BOUND_RATIO:.2f}): "
                  f"{loop['with_log_ms']:.0f} and {loop['without_ms']:.0f} ms; "
                  f"signals {'equal to the bit' if loop['equal'] else 'NOT EQUAL'}", soft_wrap=True)  # fmt: skip
    warning = measure.busy(document["machine"])
    if warning:
        console.print(warning, soft_wrap=True)
