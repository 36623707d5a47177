"""`bench`: what the parts of a run cost on this machine."""

from __future__ import annotations

import json as json_module
from typing import Annotated

import typer

ROWS = (
    ("controller_us", "controller tick, walking", 6.0),
    ("plant_us", "plant step", None),
    ("fmu_exchange_us", "FMU exchange, both (set, step call, get)", 20.0),
    ("log_us", "log", 3.0),
)


def command(
    repeat: Annotated[int, typer.Option(min=1, max=100, help="Repetitions; the table shows their median.")] = 3,
    seconds: Annotated[float, typer.Option(min=3.0, max=60.0, help="Simulated time of each measured walk.")] = 6.0,
    fmi: Annotated[int, typer.Option(min=2, max=3, help="FMI version of the measured FMUs.")] = 3,
    json: Annotated[bool, typer.Option("--json", help="Every repetition, machine-readable.")] = False,
) -> int:
    """Time the controller tick, the plant step, the FMU exchange, the log, and a whole run.

    The figures are for reading: nothing is judged, the exit code is 0.
    """
    from rich.console import Console

    from hoap2 import bench

    status = Console(stderr=True, highlight=False)
    runs = []
    for number in range(repeat):
        if status.is_terminal:
            with status.status(f"measuring, {number + 1} of {repeat}"):
                runs.append(bench.once(seconds, fmi))
        else:
            runs.append(bench.once(seconds, fmi))
    document = {"machine": bench.machine(), "fmi": fmi, "runs": runs}
    if json:
        print(json_module.dumps(document, indent=2))
    else:
        _show(document)
    return 0


def _median(runs: list[dict], name: str, key: str | None = None) -> float:
    values = sorted(run[name][key] if key else run[name] for run in runs)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def _show(document: dict) -> None:
    from rich.console import Console
    from rich.table import Table

    runs, machine = document["runs"], document["machine"]
    table = Table(title=f"a tick of 1 ms, in us (median of {len(runs)})", title_justify="left", box=None,
                  padding=(0, 2))
    for name, justify in (("part", "left"), ("median", "right"), ("p99", "right"), ("bound", "right")):
        table.add_column(name, justify=justify)
    for name, text, bound in ROWS:
        p99 = f"{_median(runs, name, 'p99'):.1f}" if runs[0][name]["p99"] is not None else ""
        table.add_row(text, f"{_median(runs, name, 'median'):.1f}", p99, f"{bound:g}" if bound else "")
    console = Console(highlight=False, soft_wrap=True)
    console.print(table)
    console.print(f"  exchange: {_median(runs, 'fmu_exchange_share'):.0%} of models and exchange")
    console.print(f"  whole run: {_median(runs, 'real_time_factor'):.2f} x real time "
                  f"({_median(runs, 'run_wall_s'):.1f} s for {_median(runs, 'simulated_s'):.1f} s, start and report "
                  f"included), peak memory {_median(runs, 'peak_memory_mb'):.0f} MB")
    console.print(f"  {machine['processor']}, {machine['cores']} cores, load {machine['load']:.1f}, "
                  f"FMI {document['fmi']}")
