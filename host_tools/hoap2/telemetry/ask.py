"""Asks something of a run from another process, and waits for its answer."""

from __future__ import annotations

import secrets
import time
from dataclasses import dataclass

from hoap2.errors import UserError
from hoap2.telemetry import transport, types
from hoap2.telemetry.listen import Listener

START_HINT = "start one: ./hoap2 run floor-walk --realtime --accept-commands"


@dataclass(frozen=True)
class Answer:
    """accepted: carried out, at `time_s` of the simulation. reason: why not, or a remark."""

    accepted: bool
    reason: str
    time_s: float
    kind: str
    name: str
    value: tuple[float, ...]


def ask(kind: str, name: str, value: list[float], url: str | None, timeout_s: float, sender: str = "shell") -> Answer:
    """Send a command to the run that is heard on this URL. UserError when none is there, listens or answers."""
    if not transport.hears(transport.url_or_default(url)):
        raise UserError(f"no run can be asked on {url}", "give --lcm the udpm:// URL of the run")
    with Listener(url, [types.RUN, types.HEALTH, types.ANSWER]) as listener:
        message = types.type_of(types.COMMAND)()
        message.run_id, message.command_id = _running(listener, timeout_s), secrets.randbits(62)
        message.kind, message.name, message.sender = kind, name, sender
        message.value, message.n = list(value), len(value)
        listener.publish(types.COMMAND, message)
        return _answer_to(listener, message, timeout_s)


def _running(listener: Listener, timeout_s: float) -> int:
    """run_id of the run that is heard: each run tells how it does, whether or not it takes commands."""
    end = time.monotonic() + timeout_s
    while time.monotonic() < end:
        listener.poll(0.1)
        for channel in (types.RUN, types.HEALTH):
            told = listener.latest.get(channel)
            if told is not None and told.state != told.ENDED:
                return told.run_id
    ended = types.RUN in listener.latest or types.HEALTH in listener.latest
    raise UserError("the run has ended" if ended else f"no run is heard on {listener.url}", START_HINT)


def _answer_to(listener: Listener, command, timeout_s: float) -> Answer:
    answers: list = []

    def keep(channel: str, message) -> None:
        if channel == types.ANSWER and (message.run_id, message.command_id) == (command.run_id, command.command_id):
            answers.append(message)

    listener.on_message = keep
    end = time.monotonic() + timeout_s
    while not answers and time.monotonic() < end:
        listener.poll(0.05)
        run = listener.latest.get(types.RUN)
        if run is not None and run.run_id == command.run_id and not run.accepts_commands:
            raise UserError(f"the run of {run.scenario} takes no commands", "it must be started with --accept-commands")
    if not answers:
        raise UserError(f"the run gave no answer within {timeout_s:g} s", "has it just ended, or does it hang?")
    found = answers[0]
    return Answer(bool(found.accepted), found.reason, found.time_us / 1e6, found.kind, found.name, tuple(found.value))
