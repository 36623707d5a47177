"""`command`: ask something of a run from a shell."""

from __future__ import annotations

import json as json_module
from typing import Annotated

import typer

CONTEXT_SETTINGS = {"ignore_unknown_options": True}  # negative numbers are no options


def command(
    words: Annotated[
        list[str], typer.Argument(metavar="KIND NAME [VALUE]...", help="walk, step, push or set, and what goes with it.")
    ],
    lcm: Annotated[
        str | None, typer.Option("--lcm", metavar="URL", help="Where the run publishes; else LCM_DEFAULT_URL.")
    ] = None,
    timeout: Annotated[float, typer.Option(min=0.1, metavar="SECONDS", help="Wait so long for run and answer.")] = 3.0,
    json: Annotated[bool, typer.Option("--json", help="Print the answer as JSON.")] = False,
) -> int:
    """Ask something of a run that was started with --accept-commands, and print its answer.

    \b
    ./hoap2 command walk start                 or stop
    ./hoap2 command step length_m 0.02         or sideways_m, turn_rad
    ./hoap2 command push chest 0 20 0 0.1      force x y z (N, world), time (s)
    ./hoap2 command set tpcc_kp_1_s2 30        a tunable parameter

    Exit code: 0 taken, 1 refused, 2 bad usage, or no run there.
    """
    from dataclasses import asdict

    from rich.console import Console

    from hoap2.errors import UserError
    from hoap2.telemetry import ask, command_kinds

    unknown = next((word for word in words if word.startswith("--")), None)
    if unknown is not None:
        raise UserError(f"no such option: {unknown}", "./hoap2 command --help")
    if len(words) < 2 or words[0] not in command_kinds.USAGE:
        raise UserError(f"not a command: {' '.join(words)}", "\n".join(command_kinds.USAGE.values()))
    kind, name, *value = words
    try:
        numbers = [float(v) for v in value]
    except ValueError as error:
        raise UserError(f"not a number: {error}", command_kinds.USAGE[kind]) from None
    answer = ask.ask(kind, name, numbers, lcm, timeout)
    if json:
        print(json_module.dumps(asdict(answer)))
    else:
        console = Console(highlight=False, soft_wrap=True)
        said = "[green]taken[/]" if answer.accepted else "[red]refused[/]"
        console.print(f"{said} at {answer.time_s:.3f} s", end="")
        console.print(f": {answer.reason}" if answer.reason else "", markup=False)
    return 0 if answer.accepted else 1
