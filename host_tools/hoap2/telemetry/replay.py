"""Publishes the log of a finished run again, at the pace of its times."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hoap2.errors import UserError
from hoap2.telemetry import transport, types
from hoap2.telemetry.log_file import Logged, LogFile

SPEEDS = (0.01, 100.0)
RUN_PERIOD_S = 1.0  # run_t is repeated so often, as in a run: who comes late learns what is played
STEP_S = 0.002  # messages due within this are sent together


@dataclass
class Replayed:
    """What was sent."""

    published: int = 0
    simulated_s: float = 0.0
    stopped: bool = False
    problems: tuple[str, ...] = ()


def replay(path: Path, url: str | None, speed: float, first_s: float, last_s: float, stopped: Callable[[], bool],
           progress: Callable[[float], None]) -> Replayed:  # fmt: skip
    """Publish the messages with first_s <= time <= last_s, `speed` times as fast as they were.

    The bytes are the log's; run_t alone is numbered anew, for it is repeated.
    """
    if not SPEEDS[0] <= speed <= SPEEDS[1]:
        raise UserError(f"--speed {speed:g} is outside {SPEEDS[0]:g} to {SPEEDS[1]:g}")
    log, player = LogFile(path), _Player(url, speed, first_s)
    done = Replayed()
    for event in log:
        t_s = event.time_us / 1e6
        if t_s > last_s or stopped():
            break
        if t_s < first_s:
            player.remember(event)
            continue
        player.wait(t_s)
        player.send(event)
        done.published, done.simulated_s = player.published, t_s - first_s
        if player.published % 500 == 0:
            progress(t_s)
    done.stopped = stopped()
    if not done.published and not done.stopped:
        raise UserError(f"{path} holds nothing to play between {first_s:g} and {last_s:g} s",
                        f"it ends at {log.last_us / 1e6:g} s")  # fmt: skip
    done.problems = tuple(log.problems())
    return done


class _Player:
    """A connection with the clock of the replay."""

    def __init__(self, url: str | None, speed: float, first_s: float) -> None:
        self.lcm = transport.connect(url)
        self.speed, self.first_s = speed, first_s
        self.begin_s: float | None = None
        self.published = 0
        self.run: Logged | None = None
        self.run_at_s = 0.0
        self.runs_sent = 0

    def remember(self, event: Logged) -> None:
        """Of what lies before the part that is played, which run it is."""
        if event.channel == types.RUN:
            self.run = event

    def wait(self, t_s: float) -> None:
        now = time.monotonic()
        if self.begin_s is None:
            self.begin_s = now
        due = self.begin_s + (t_s - self.first_s) / self.speed
        while now < due - STEP_S:
            time.sleep(min(due - now, RUN_PERIOD_S))
            now = time.monotonic()
            self._repeat_run(now)
        self._repeat_run(now)

    def _repeat_run(self, now: float) -> None:
        if self.run is not None and now - self.run_at_s >= RUN_PERIOD_S:
            self.run_at_s = now
            self.lcm.publish(types.RUN, self._numbered_run())

    def _numbered_run(self) -> bytes:
        """The run_t with a sequence number that counts, or a listener would take it for a repetition."""
        message = types.decode(types.RUN, self.run.data)
        message.sequence = self.runs_sent
        self.runs_sent += 1
        return message.encode()

    def send(self, event: Logged) -> None:
        if event.channel == types.RUN:
            self.run, self.run_at_s = event, time.monotonic()
            self.lcm.publish(types.RUN, self._numbered_run())
        else:
            self.lcm.publish(event.channel, event.data)
        self.published += 1
