"""`bench`: what things cost on this machine."""

from __future__ import annotations

import contextlib
import json as json_module
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    help="What things cost on this machine. The figures are for reading: nothing is judged, the exit code is 0.",
)
Repeat = Annotated[int, typer.Option(min=1, max=100, help="Repetitions; shown is their median.")]
Json = Annotated[bool, typer.Option("--json", help="Machine-readable, with every repetition, on standard output.")]


@contextlib.contextmanager
def _status() -> Iterator[Callable[[str], None]]:
    """Tell what is under way: a moving line on a terminal, else a line each on standard error."""
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    if not console.is_terminal:
        yield lambda text: console.print(f"bench: {text}")
        return
    with console.status("") as status:
        yield lambda text: status.update(text)


@app.command()
def plant(
    seconds: Annotated[float, typer.Option(min=2.0, max=17.0, help="Simulated time of the walk.")] = 8.0,
    repeat: Repeat = 3,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="The picture; else out/bench/plant-<time>.png.")
    ] = None,
    json: Json = False,
) -> int:
    """A step of the plant beside the same robot in dWorldStep and in MuJoCo.

    All do the recorded drive commands of floor-walk (start-up, standing, stepping): on the floor, and once more in the
    air without gravity. They take turns of 50 ticks on one core, stepped and timed by loops in C.
    """
    from hoap2.bench import plant as benchmark
    from hoap2.bench import plant_shown

    picture = out or Path("out") / "bench" / time.strftime("plant-%Y%m%d-%H%M%S.png")
    with _status() as status:
        document, runs = benchmark.run(seconds, repeat, status)
    plant_shown.draw(document, runs, picture)
    if json:
        print(json_module.dumps(document | {"picture": str(picture)}, indent=2))
    else:
        plant_shown.show(document, picture)
    return 0


@app.command()
def run(
    scenario: Annotated[str, typer.Option(metavar="SCENARIO", help="A name of `list`, or a .toml file.")] = "floor-walk",
    repeat: Repeat = 3,
    seconds: Annotated[
        float | None, typer.Option(min=3.0, max=60.0, help="Simulated time; else all of the scenario.")
    ] = None,
    fmi: Annotated[int, typer.Option(min=2, max=3, help="FMI version of the measured FMUs.")] = 3,
    json: Json = False,
) -> int:
    """A whole run of a scenario on one core: real-time factor, memory, and the parts of a tick.

    Parts: the controller, the plant, the exchange through FMI (set, get and the step calls), the log, and the rest of
    the loop. The video is left out, the report with its snapshots is not.
    """
    from hoap2.bench import chain, chain_shown

    with _status() as status:
        document = chain.run(scenario, repeat, fmi, seconds, status)
    if json:
        print(json_module.dumps(document, indent=2))
    else:
        chain_shown.show(document)
    return 0


@app.command()
def telemetry(
    repeat: Repeat = 3,
    seconds: Annotated[
        float | None, typer.Option(min=3.0, max=60.0, help="Simulated time; else all of floor-walk.")
    ] = None,
    json: Json = False,
) -> int:
    """What the LCM log and live publishing cost a tick, and a run with its log beside one without.

    Into a log alone, over memq, and over udpm in a network namespace, each at the full rate of 1 kHz.
    """
    from hoap2.bench import telemetry as benchmark
    from hoap2.bench import telemetry_shown

    with _status() as status:
        document = benchmark.run(repeat, seconds, status)
    if json:
        print(json_module.dumps(document, indent=2))
    else:
        telemetry_shown.show(document)
    return 0


@app.command()
def page(
    seconds: Annotated[float, typer.Option(min=10.0, max=580.0, help="How long it is watched, after a warm-up.")] = 60,
    lcm: Annotated[str | None, typer.Option("--lcm", metavar="URL", help="LCM URL; else LCM_DEFAULT_URL.")] = None,
    json: Json = False,
) -> int:
    """The web monitor's page beside a paced run in headless Chromium: pictures a second, memory, messages lost."""
    from hoap2.bench import page as benchmark

    with _status() as status:
        document = benchmark.run(seconds, lcm, status)
    if json:
        print(json_module.dumps(document, indent=2))
    else:
        benchmark.show(document)
    return 0


@app.command()
def can(repeat: Repeat = 3, json: Json = False) -> int:
    """The frames of a tick: encoding and decoding them, and the modelled link with its boards and buses."""
    from hoap2.bench import can as benchmark

    with _status() as status:
        document = benchmark.run(repeat, status)
    if json:
        print(json_module.dumps(document, indent=2))
    else:
        benchmark.show(document)
    return 0
