"""What can be asked of a run: the kinds of commands, and the checks that need nothing but the table of signals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from hoap2 import parameters
from hoap2.errors import UserError, nearest
from hoap2.generate.tables import Signal

MOST_VALUES = 32
LONGEST_TEXT = 80
LONGEST_PUSH_S = 2.0
STEP_INPUTS = {"length_m": "step_length_request_m", "sideways_m": "step_sideways_request_m",
               "turn_rad": "step_turn_request_rad"}  # fmt: skip
WALKS = {"start": "walk", "stop": "stop"}  # name -> walk_request
USAGE = {
    "walk": "walk start | walk stop",
    "step": "step length_m | sideways_m | turn_rad, and one value",
    "push": "push, a link, and force x y z (N, world frame) and duration (s)",
    "set": "set, a tunable parameter, and its value",
}


class Refused(Exception):
    """A command that is not carried out; the text says why and what would be."""


@dataclass(frozen=True)
class Command:
    """A command as it was asked for, its texts made fit to be shown."""

    command_id: int
    kind: str
    name: str
    value: tuple[float, ...]
    sender: str = ""

    def __str__(self) -> str:
        return " ".join([self.kind, self.name, *(f"{v:g}" for v in self.value)])


def printable(text: str) -> str:
    """At most LONGEST_TEXT characters, none that would disturb a terminal."""
    return "".join(c if c.isprintable() else "?" for c in text[:LONGEST_TEXT])


def of_message(message) -> Command:
    """A decoded command_t; the values as far as a command can have any."""
    return Command(message.command_id, printable(message.kind), printable(message.name),
                   tuple(message.value[: MOST_VALUES + 1]), printable(message.sender))  # fmt: skip


def step_ranges() -> dict[str, Signal]:
    """What `step` can set, with its range and unit."""
    known = parameters.operator_inputs("controller")
    return {name: known[signal] for name, signal in STEP_INPUTS.items()}


def tunables() -> dict[str, Signal]:
    """What `set` can change."""
    return {name: s for name, s in parameters.known("controller").items() if s.tunable}


def links() -> list[str]:
    return [link["name"] for link in parameters.table().robot["links"]]


def most_push_N() -> float:
    """The largest component of a push."""
    return parameters.operator_inputs("plant")["push_now_force_W_N"].high


def check(command: Command) -> None:
    """Raise Refused when kind, name, number of values, range or size is wrong."""
    if command.kind not in USAGE:
        raise Refused(f"unknown kind '{command.kind}'; known: {', '.join(USAGE)}")
    if not all(math.isfinite(v) for v in command.value):
        raise Refused("a value is not a finite number")
    {"walk": _check_walk, "step": _check_step, "push": _check_push, "set": _check_set}[command.kind](command)


def _known(command: Command, names: Sequence[str], what: str) -> None:
    if command.name not in names:
        hint = nearest(command.name, names) or ("known: " + ", ".join(names) if len(names) < 8 else "")
        raise Refused(f"unknown {what} '{command.name}'" + (f"; {hint}" if hint else ""))


def _count(command: Command, count: int) -> None:
    if len(command.value) != count:
        raise Refused(f"{count} value{'s' * (count != 1)} needed, not {len(command.value)}: {USAGE[command.kind]}")


def _check_walk(command: Command) -> None:
    _known(command, list(WALKS), "walk command")
    _count(command, 0)


def _check_step(command: Command) -> None:
    ranges = step_ranges()
    _known(command, list(ranges), "step value")
    _count(command, 1)
    signal = ranges[command.name]
    if not signal.low <= command.value[0] <= signal.high:
        raise Refused(f"{command.name} = {command.value[0]:g} is out of range {parameters.range_text(signal)}")


def _check_push(command: Command) -> None:
    _known(command, links(), "link")
    _count(command, 4)
    *force, duration = command.value
    most = most_push_N()
    if max(map(abs, force)) > most:
        raise Refused(f"a push of more than {most:g} N along an axis is not taken")
    if not any(force):
        raise Refused("a push without a force")
    if not 0.001 <= duration <= LONGEST_PUSH_S:
        raise Refused(f"a push lasts 0.001 to {LONGEST_PUSH_S:g} s, not {duration:g} s")


def _check_set(command: Command) -> None:
    signals = tunables()
    row = row_of_tunable(command.name)
    if row is None and command.name in parameters.known("controller"):
        raise Refused(f"{command.name} cannot change while the robot runs; tunable: {', '.join(signals)}")
    if row is None:
        _known(command, list(signals), "tunable parameter")
    if command.name in signals and len(command.value) not in (1, row.count):
        counts = " or ".join(str(n) for n in sorted({1, row.count}))
        raise Refused(f"{command.name} takes {counts} value{'s' * (row.count > 1)}, not {len(command.value)}")
    if command.name not in signals:
        _count(command, 1)
    try:
        for value in command.value:
            parameters.check("controller", row.name, value)
    except UserError as error:
        raise Refused(error.message) from None


def row_of_tunable(name: str) -> Signal | None:
    """The tunable row that a row's or an element's name means (`lpc_gain`, `lpc_gain.x`)."""
    table = parameters.table()
    return next((s for s in tunables().values() if name == s.name or name in table.element_names(s)), None)
