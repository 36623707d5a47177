"""The pace on a clock that the test moves: absolute deadlines, overruns, and the schedule moved after a long stop."""

from __future__ import annotations

import pytest

from hoap2 import pace
from hoap2.pace import Pace

MS = 1_000_000


class Clock:
    """perf_counter_ns and sleep without time passing by itself; a sleep wakes late by `late_ns`."""

    def __init__(self, monkeypatch, late_ns: int = 0) -> None:
        self.now, self.late_ns, self.slept = 10**12, late_ns, []
        monkeypatch.setattr(pace.time, "perf_counter_ns", lambda: self.now)
        monkeypatch.setattr(pace.time, "sleep", self.sleep)

    def sleep(self, seconds: float) -> None:
        self.slept.append(round(seconds * 1e9))
        self.now += round(seconds * 1e9) + self.late_ns


def test_deadlines_are_absolute(monkeypatch):
    """Waking late does not add up: tick k is due k ms after the start, whatever was before."""
    clock, paced = Clock(monkeypatch, late_ns=70_000), Pace()
    paced.start()
    begin = clock.now
    for tick in range(5, 1001, 5):
        clock.now += 2 * MS  # work
        paced.wait(tick)
        assert clock.now == begin + tick * MS + 70_000 and paced.lag_us == pytest.approx(70)
    assert paced.overruns == 0 and paced.moved_s == 0.0


def test_work_that_ends_late_is_an_overrun_and_is_caught_up(monkeypatch):
    clock, paced = Clock(monkeypatch), Pace()
    paced.start()
    begin = clock.now
    clock.now += 12 * MS
    paced.wait(5)
    assert (paced.overruns, paced.lag_us, clock.slept) == (1, 7000.0, [])
    paced.wait(10)  # twice as fast as the wall clock, not at once: those who listen must keep up
    assert paced.overruns == 2 and paced.lag_us == 4500.0 and clock.now == begin + 14.5 * MS
    paced.wait(15)
    assert paced.overruns == 2 and paced.lag_us == 2000.0 and clock.now == begin + 17 * MS
    paced.wait(20)
    assert clock.now == begin + 20 * MS and paced.overruns == 2 and paced.lag_us == 0.0
    assert paced.summary() == {"overruns": 2, "worst_lag_us": 7000.0, "moved_s": 0.0}


def test_after_a_long_stop_the_schedule_is_moved(monkeypatch):
    """A stopped process does not rush through what it missed."""
    clock, paced = Clock(monkeypatch), Pace()
    paced.start()
    begin = clock.now
    clock.now += 3000 * MS
    paced.wait(5)
    assert paced.moved_s == pytest.approx(2.995) and clock.slept == []
    paced.wait(10)
    assert clock.slept == [5 * MS] and clock.now == begin + 3005 * MS
