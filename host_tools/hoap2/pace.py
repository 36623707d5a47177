"""Keeps a run to the wall clock: tick k is over k milliseconds after the start, to absolute deadlines.

It decides when ticks are done, never what they do.
"""

from __future__ import annotations

import time

from hoap2 import parameters

BATCH_TICKS = 5  # done at once, then shown
CATCH_UP = 2  # times as fast as the wall clock at most: a burst of messages would be too much for those who listen
GIVE_UP_NS = 250_000_000  # farther behind than this the schedule is moved: the lost time is not caught up


class Pace:
    """`wait` after each batch of ticks. lag_us: now after its deadline; an overrun is work that ended after it."""

    def __init__(self) -> None:
        self.tick_ns = parameters.table().tick_us * 1000
        self.origin_ns: int | None = None
        self._last: tuple[int, int] = (0, 0)  # tick and time of the last return
        self.lag_us = 0.0
        self.worst_lag_us = 0.0
        self.overruns = 0
        self.moved_s = 0.0

    def start(self) -> None:
        """Tick 0 is now."""
        self.origin_ns = time.perf_counter_ns()
        self._last = (0, self.origin_ns)

    def wait(self, tick: int) -> None:
        """Return when this tick is due; when it was due already, as soon as catching up allows."""
        due = self.origin_ns + tick * self.tick_ns
        now = time.perf_counter_ns()
        self.overruns += now >= due
        last_tick, last_ns = self._last
        until = max(due, last_ns + (tick - last_tick) * self.tick_ns // CATCH_UP)
        if now < until:
            time.sleep((until - now) / 1e9)
            now = time.perf_counter_ns()
        self._last = (tick, now)
        self.lag_us = (now - due) / 1e3
        self.worst_lag_us = max(self.worst_lag_us, self.lag_us)
        if now - due > GIVE_UP_NS:
            self.origin_ns += now - due
            self.moved_s += (now - due) / 1e9

    def summary(self) -> dict:
        """For timing.json."""
        return {"overruns": self.overruns, "worst_lag_us": self.worst_lag_us, "moved_s": self.moved_s}
