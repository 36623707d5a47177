"""What the terminal shows: the last messages, the events, and how well the messages come."""

from __future__ import annotations

import time
from collections import deque
from dataclasses import dataclass

from hoap2.telemetry import types
from hoap2.telemetry.command_kinds import printable
from hoap2.telemetry.listen import Listener

KEPT_EVENTS = 200
SILENT_S = 2.0  # a run that says nothing for so long is called silent
RATE_PERIOD_S = 1.0


@dataclass(frozen=True)
class Event:
    time_s: float
    kind: str
    text: str


class View:
    """Follows the run that is heard on a URL, until it is over, then the next one. `poll` takes what has come."""

    def __init__(self, url: str | None) -> None:
        self.listener = Listener(url, None, self._note, (types.EVENT, types.RUN))
        self.events: deque[Event] = deque(maxlen=KEPT_EVENTS)
        self.run_id: int | None = None
        self.end = ""  # how the run ended
        self.runs_seen = 0
        self.rates: dict[str, float] = {}  # messages a second of the wall clock
        self._own: dict[str, object] = {}  # the last messages of the run that is followed
        self._heard_s: float | None = None  # when the newest of them came
        self.real_time: float | None = None  # simulated over wall time, of the last period
        self._before: dict[str, int] = {}
        self._before_us: tuple[int | None, int] = (None, 0)  # run, its simulated time
        self._measured_s = time.monotonic()

    def poll(self, timeout_s: float) -> None:
        self.listener.poll(timeout_s)
        for channel in (types.HEALTH, types.GAIT):  # a late monitor hears these first
            told = self.listener.latest.get(channel) if self.run_id is None else None
            if told is not None:
                self._new_run(told.run_id)
        now = time.monotonic()
        if now - self._measured_s >= RATE_PERIOD_S:
            counts = {channel: counter.received for channel, counter in self.listener.counters.items()}
            passed = now - self._measured_s
            self.rates = {channel: (n - self._before.get(channel, 0)) / passed for channel, n in counts.items()}
            self._before, self._measured_s = counts, now
            self._measure_time(passed)

    def _measure_time(self, passed_s: float) -> None:
        told = self.latest(types.HEALTH)
        time_us = 0 if told is None else told.time_us
        run_before, us_before = self._before_us
        if run_before == self.run_id and not self.ended:
            self.real_time = (time_us - us_before) / 1e6 / passed_s
        self._before_us = self.run_id, time_us

    def latest(self, channel: str):
        """The last message of a channel, of the run that is followed."""
        message = self.listener.latest.get(channel)
        if message is not None and message.run_id == self.run_id and message is not self._own.get(channel):
            self._own[channel] = message
            self._heard_s = max(self._heard_s or 0.0, self.listener.last_s[channel])
        return self._own.get(channel)

    @property
    def silent_s(self) -> float | None:
        """For how long nothing has come of this run; None before its first message."""
        for channel in (types.HEALTH, types.GAIT, types.RUN):
            self.latest(channel)
        return None if self._heard_s is None else time.monotonic() - self._heard_s

    @property
    def ended(self) -> bool:
        told = self.latest(types.RUN) or self.latest(types.HEALTH)
        return bool(self.end) or (told is not None and told.state == told.ENDED)

    @property
    def complete(self) -> bool:
        """There is something of everything that a run publishes."""
        wanted = (types.RUN, types.STATE, types.GAIT, types.TRUTH, types.HEALTH)
        return all(self.latest(channel) is not None for channel in wanted)

    def close(self) -> None:
        self.listener.close()

    def _new_run(self, run_id: int) -> None:
        self.run_id, self.end, self.real_time, self._heard_s = run_id, "", None, time.monotonic()
        self._own.clear()
        self.runs_seen += 1
        self.events.clear()

    def _note(self, channel: str, message) -> None:
        if message.run_id != self.run_id:
            if channel == types.RUN and message.state == message.ENDED:
                return  # the last words of another one
            if self.run_id is not None and not self.ended and (self.silent_s or 0.0) < SILENT_S:
                return  # of two runs at once the first is followed
            self._new_run(message.run_id)
        if channel == types.EVENT:
            text = printable(message.text)
            self.events.append(Event(message.time_us / 1e6, message.kind, text))
            if message.kind == "run_ended":
                self.end = text or "ended"
