"""The co-simulation master: Jacobi, one tick a step, both products as equal partners.

At each communication point all outputs of both are read into the log, then the
inputs of both are set, then both step. So neither sees the other's new values
before the next point, and any master that does the same gets the same figures.
"""

from __future__ import annotations

import array
import math
import signal
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from hoap2 import metrics, parameters
from hoap2.errors import UserError
from hoap2.pace import BATCH_TICKS, Pace
from hoap2.signal_log import SignalLog
from hoap2.telemetry.run_telemetry import RunTelemetry
from hoap2.wiring import DirectLink, Link, Recorder, Side, check_connections, connect, log_columns

__all__ = [
    "Commands", "Company", "Outcome", "Recorder", "Side", "StopRequest", "Timing", "connect", "log_columns", "run",
]  # fmt: skip

HOUSEKEEPING_TICKS = 10
FALL_WATCH_TICKS = 100  # at most this long between two looks for a fall
PROGRESS_PERIOD_NS = 100_000_000


class StopRequest:
    """SIGINT and SIGTERM as a flag that the loop reads; a second signal gets through."""

    def __init__(self) -> None:
        self.signal: int | None = None
        self._before: dict[int, object] = {}

    def __enter__(self) -> StopRequest:
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, signal.SIGTERM):
                self._before[number] = signal.signal(number, self._note)
        return self

    def _note(self, number: int, _frame) -> None:
        self.signal = number
        self._restore()

    def _restore(self) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)
        self._before.clear()

    def __exit__(self, *_) -> None:
        self._restore()


class Timing:
    """Wall-clock durations of the loop's parts, a tick each; nothing here may reach the signals."""

    PARTS = ("set", "controller", "plant", "get_and_log")  # in the order of a tick

    def __init__(self, capacity: int) -> None:
        # array.array takes a number in half the time that a NumPy array needs
        self.ns = {part: array.array("q", bytes(8 * capacity)) for part in self.PARTS}
        self.loop_s = 0.0
        self.ticks = 0

    def _spread(self, part: str) -> dict:
        if not self.ticks:
            return {"median": None, "p99": None}
        median, p99 = np.percentile(np.frombuffer(self.ns[part], dtype=np.int64)[: self.ticks], (50, 99))
        return {"median": float(median) / 1e3, "p99": float(p99) / 1e3}

    def summary(self) -> dict:
        """Medians and 99th percentiles; `exchange_and_log_us` is all of the loop but the steps, its mean a tick."""
        steps_ns = sum(sum(self.ns[part][: self.ticks]) for part in ("controller", "plant"))
        rest = (self.loop_s * 1e6 - steps_ns / 1e3) / self.ticks if self.ticks else None
        simulated_s = self.ticks * parameters.table().tick_us / 1e6
        return {
            "real_time_factor": simulated_s / self.loop_s if self.loop_s > 0 else None,
            **{f"{part}_us": self._spread(part) for part in ("controller", "plant", "set", "get_and_log")},
            "exchange_and_log_us": rest,
            "loop_s": self.loop_s,
        }


@dataclass
class Outcome:
    """What the loop leaves: the log, the timing, and why it ended early if it did."""

    log: SignalLog
    timing: Timing
    interrupted: bool = False
    error: str | None = None
    warnings: list[str] = field(default_factory=list)
    link: Link = field(default_factory=DirectLink)


class Commands(Protocol):
    """Whoever asks something of a run while it goes on."""

    def open(self, log: SignalLog) -> None:
        """The rows that the run is going to fill."""

    def poll(self, tick: int) -> int | None:
        """Called between two batches of ticks, `tick` done: what is set on the products now, tick + 1 uses.

        Returns the tick at which it must be called again at the latest, if there is one.
        """


@dataclass
class Company:
    """Who goes along with a run; nobody of them may change what it computes but `commands`."""

    progress: Callable[[SignalLog], None] | None = None
    telemetry: RunTelemetry | None = None
    pace: Pace | None = None  # keeps the run to the wall clock
    commands: Commands | None = None


def run(controller: Side, plant: Side, ticks: int, stop_after_fall_s: float, stop: StopRequest,
        company: Company | None = None, link: Link | None = None) -> Outcome:  # fmt: skip
    """Step both initialised sides `ticks` times, or until a fall, an error or a stop request.

    link: what carries the values from one to the other; without it they go directly.
    """
    check_connections(controller, plant)
    company = company or Company()
    log = SignalLog(log_columns(controller, plant), ticks + 1)
    outcome = Outcome(log, Timing(ticks), link=link or DirectLink())
    fall = _FallWatch(log, stop_after_fall_s, company.telemetry)
    if company.commands is not None:
        company.commands.open(log)
    if company.telemetry is not None:
        company.telemetry.open(log, outcome.timing.ns["controller"], outcome.timing.ns["plant"])
    started = time.perf_counter()
    try:
        _run(_Loop(controller, plant, outcome), ticks, fall, stop, company)
    except Exception as error:  # whatever a product throws: the run so far is kept and marked
        outcome.error = f"{type(error).__name__} at t = {outcome.timing.ticks * 1e-3:.3f} s: {error}"
    outcome.timing.loop_s = time.perf_counter() - started
    outcome.interrupted = stop.signal is not None
    if company.telemetry is not None:
        _end(company.telemetry, outcome, fall)
    return outcome


def _end(telemetry: RunTelemetry, outcome: Outcome, fall: _FallWatch) -> None:
    telemetry.rows()  # what an error left
    fall.look()
    fell = None if fall.tick is None else "fell"
    telemetry.close(outcome.error or ("stopped" if outcome.interrupted else None) or fell or "done")


def _run(loop: _Loop, ticks: int, fall: _FallWatch, stop: StopRequest, company: Company) -> None:
    """A few ticks at a time, with what need not be done every tick between them."""
    now = time.perf_counter_ns
    progress, telemetry, pace, commands = company.progress, company.telemetry, company.pace, company.commands
    next_progress = now()
    batch = HOUSEKEEPING_TICKS if pace is None else BATCH_TICKS
    done, last = 0, ticks
    loop.recorder.row()
    if pace is not None:
        pace.start()
    if telemetry is not None:
        telemetry.rows()
    while done < last and stop.signal is None:
        due = None if commands is None else commands.poll(done)
        last = min(last, fall.last_tick(done))
        if progress is not None and now() >= next_progress:
            progress(loop.log)
            next_progress = now() + PROGRESS_PERIOD_NS
        # batches end on whole multiples; an end that has passed already, by a fall seen late, is followed by one tick more
        end = min(last, done - done % batch + batch)
        end = max(done + 1, end if due is None else min(end, due))
        loop.advance(done, end)
        done = end
        if pace is not None:
            pace.wait(done)
        if telemetry is not None:
            telemetry.rows()
    if progress is not None:
        progress(loop.log)


class _Loop:
    """Exchange, step and log, tick by tick."""

    def __init__(self, controller: Side, plant: Side, outcome: Outcome) -> None:
        self.log, self.timing = outcome.log, outcome.timing
        self.recorder = Recorder(controller, plant, self.log)
        self.writes = outcome.link.writers(controller, plant, *self.recorder.parts)
        self.steps = controller.step, plant.step

    def advance(self, first: int, last: int) -> None:
        """Ticks first to last - 1; the rows up to `last` are filled. What was done before an error is counted."""
        set_controller, set_plant = self.writes
        step_controller, step_plant = self.steps
        get_controller, get_plant = self.recorder.reads
        set_ns, controller_ns, plant_ns, get_ns = (self.timing.ns[part] for part in Timing.PARTS)
        now, done = time.perf_counter_ns, first
        t3 = now()
        try:
            for k in range(first, last):
                set_controller(k)
                set_plant(k)
                t0 = now()
                step_controller()
                t1 = now()
                step_plant()
                t2 = now()
                done += 1
                get_controller(done)
                get_plant(done)
                set_ns[k], controller_ns[k], plant_ns[k] = t0 - t3, t1 - t0, t2 - t1
                t3 = now()
                get_ns[k] = t3 - t2
                self.log.count = done + 1
        finally:
            self.timing.ticks = done


class _FallWatch:
    """Where the run may end: a while after the tick of a fall. Looks at each row once."""

    def __init__(self, log: SignalLog, stop_after_fall_s: float, telemetry: RunTelemetry | None) -> None:
        self.log, self.seen, self.telemetry = log, 0, telemetry
        self.tick: int | None = None  # of the fall
        self.extra = round(stop_after_fall_s * 1e6 / parameters.table().tick_us)
        # A fall is to be seen before the run's end that follows from it, so that this end is exact.
        self.period = max(1, min(self.extra, FALL_WATCH_TICKS) // HOUSEKEEPING_TICKS) * HOUSEKEEPING_TICKS
        names = ("p.true_chest_rpy_rad.x", "p.true_chest_rpy_rad.y", "p.other_contacts")
        missing = [name[2:] for name in names if name not in log]
        if missing:
            raise UserError(f"the plant does not tell {', '.join(missing)}: a fall could not be seen")

    def last_tick(self, tick: int) -> float:
        """The last tick of the run as far as is known at this one."""
        if tick % self.period == 0:
            self.look()
        return math.inf if self.tick is None else self.tick + self.extra

    def look(self) -> None:
        """At the rows since the last look."""
        rows = slice(self.seen, self.log.count)
        tilt = metrics.chest_tilt_rad(self.log.column("p.true_chest_rpy_rad.x")[rows],
                                      self.log.column("p.true_chest_rpy_rad.y")[rows])  # fmt: skip
        fallen = (tilt > metrics.FALL_TILT_RAD) | (self.log.column("p.other_contacts")[rows] > 0)
        if fallen.any() and self.tick is None:
            self.tick = self.seen + int(np.argmax(fallen))
            if self.telemetry is not None:
                tilted = tilt[self.tick - self.seen] > metrics.FALL_TILT_RAD
                how = "chest tilt" if tilted else "contact beside the soles"
                self.telemetry.event("fall", f"fell at {self.tick * 1e-3:.3f} s ({how})", self.tick)
        self.seen = self.log.count
