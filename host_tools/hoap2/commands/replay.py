"""`replay`: a finished run published again."""

from __future__ import annotations

import math
from typing import Annotated

import typer


def command(
    run: Annotated[
        str, typer.Argument(metavar="RUN", help="A run folder, a scenario (its latest run), or a log file.")
    ],
    speed: Annotated[float, typer.Option(metavar="X", help="How many times as fast as it was: 0.01 to 100.")] = 1.0,
    first: Annotated[float, typer.Option("--from", metavar="SECONDS", min=0.0, help="Where to begin.")] = 0.0,
    last: Annotated[float, typer.Option("--to", metavar="SECONDS", help="Where to end.")] = math.inf,
    loop: Annotated[bool, typer.Option("--loop", help="Again and again, until Ctrl-C.")] = False,
    lcm: Annotated[
        str | None, typer.Option(metavar="URL", help="Where to; else LCM_DEFAULT_URL, else udpm on this machine.")
    ] = None,
) -> int:
    """Publish telemetry.lcm of a run again, message by message, as it was published live.

    A monitor that listens shows it as it would show the run. Exit code 130 after Ctrl-C.
    """
    from rich.console import Console

    from hoap2 import run_source
    from hoap2.master import StopRequest
    from hoap2.telemetry import replay, transport

    path = run_source.log_of(run)
    console = Console(stderr=True, highlight=False)
    url = transport.url_or_default(lcm)
    transport.check_url(url)
    console.print(f"{path} to {url} at {speed:g} x", soft_wrap=True)
    with StopRequest() as stop, console.status("") as status:
        while True:
            done = replay.replay(path, url, speed, first, last, lambda: stop.signal is not None,
                                 lambda t_s: status.update(f"{t_s:6.2f} s"))  # fmt: skip
            if done.stopped or not loop:
                break
    for problem in done.problems:
        console.print(f"[yellow]note:[/] {problem}", soft_wrap=True)
    console.print(f"{done.published} messages, {done.simulated_s:.2f} s simulated")
    return 130 if done.stopped else 0
