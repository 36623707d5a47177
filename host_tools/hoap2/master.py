"""The co-simulation master: Jacobi, one tick a step, both products as equal partners.

At each communication point all outputs of both are read and logged, then the
inputs of both are set, then both step. So neither sees the other's new values
before the next point, and any master that does the same gets the same figures.
"""

from __future__ import annotations

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
from hoap2.signal_log import PREFIX, Column, SignalLog

HOUSEKEEPING_TICKS = 10
PROGRESS_PERIOD_NS = 100_000_000


class Side(Protocol):
    """What the master needs of a product, be it an FMU or a library."""

    outputs: list[Column]  # without prefix, reals first
    inputs: list[Column]
    real_out: np.ndarray  # float64, filled by get_outputs
    int_out: np.ndarray  # int32
    real_in: np.ndarray  # taken by set_inputs; starts at the product's defaults
    int_in: np.ndarray

    def get_outputs(self) -> None: ...
    def set_inputs(self) -> None: ...
    def step(self) -> None: ...


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


@dataclass
class Timing:
    """Wall-clock durations; nothing here may reach the signals."""

    controller_ns: np.ndarray
    plant_ns: np.ndarray
    loop_s: float = 0.0
    ticks: int = 0

    def summary(self) -> dict:
        def spread(ns: np.ndarray) -> dict:
            if not self.ticks:
                return {"median": None, "p99": None}
            return {"median": float(np.median(ns)) / 1e3, "p99": float(np.percentile(ns, 99)) / 1e3}

        tick_s = parameters.table().tick_us / 1e6
        steps_ns = float(self.controller_ns[: self.ticks].sum() + self.plant_ns[: self.ticks].sum())
        rest = (self.loop_s * 1e6 - steps_ns / 1e3) / self.ticks if self.ticks else None
        return {
            "real_time_factor": self.ticks * tick_s / self.loop_s if self.loop_s > 0 else None,
            "controller_us": spread(self.controller_ns[: self.ticks]),
            "plant_us": spread(self.plant_ns[: self.ticks]),
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


def connect(source: Side, target: Side) -> list[tuple[np.ndarray, np.ndarray, np.ndarray | slice, np.ndarray | slice]]:
    """Connections by equal names: (target array, source array, target index, source index), reals and ints."""
    wires = []
    for kind, into, out in (("real", "real_in", "real_out"), ("int", "int_in", "int_out")):
        where = {c.name: i for i, c in enumerate([c for c in source.outputs if c.kind == kind])}
        targets = [c.name for c in target.inputs if c.kind == kind]
        pairs = [(i, where[name]) for i, name in enumerate(targets) if name in where]
        if pairs:
            index_in, index_out = (_as_slice(np.array(index)) for index in zip(*pairs))
            wires.append((getattr(target, into), getattr(source, out), index_in, index_out))
    return wires


def _as_slice(index: np.ndarray) -> np.ndarray | slice:
    """A run of neighbours as a slice, which copies faster than a list of places."""
    contiguous = np.array_equal(index, np.arange(index[0], index[0] + index.size))
    return slice(int(index[0]), int(index[0]) + index.size) if contiguous else index


def check_connections(controller: Side, plant: Side) -> None:
    """An input of either side that the other does not drive is an error, not a default."""
    for target, source, who, other in (
        (controller, plant, "controller", "plant"),
        (plant, controller, "plant", "controller"),
    ):
        have = {(c.name, c.kind) for c in source.outputs}
        missing = [c.name for c in target.inputs if (c.name, c.kind) not in have]
        if missing:
            raise UserError(
                f"the {other} has no output for {len(missing)} input(s) of the {who}: {', '.join(missing[:5])}",
                "both must use the names of docs/generated/signals.md",
            )


def log_columns(controller: Side, plant: Side) -> list[Column]:
    """The log's columns: both products' outputs with their prefixes."""
    return [
        Column(PREFIX[product] + c.name, c.unit, c.kind)
        for product, side in (("controller", controller), ("plant", plant))
        for c in side.outputs
    ]


class Recorder:
    """Copies both products' outputs into the log's next row."""

    def __init__(self, controller: Side, plant: Side, log: SignalLog) -> None:
        self.log = log
        self.c, self.p = controller, plant
        self.real_split = controller.real_out.size
        self.int_split = controller.int_out.size

    def row(self) -> None:
        log, k = self.log, self.log.count
        real, integer = log.real[k], log.integer[k]
        real[: self.real_split] = self.c.real_out
        real[self.real_split :] = self.p.real_out
        integer[: self.int_split] = self.c.int_out
        integer[self.int_split :] = self.p.int_out
        log.count = k + 1


def run(controller: Side, plant: Side, ticks: int, stop_after_fall_s: float, stop: StopRequest,
        progress: Callable[[SignalLog], None] | None = None) -> Outcome:  # fmt: skip
    """Step both initialised sides `ticks` times, or until a fall, an error or a stop request."""
    check_connections(controller, plant)
    log = SignalLog(log_columns(controller, plant), ticks + 1)
    outcome = Outcome(log, Timing(np.zeros(ticks, dtype=np.int64), np.zeros(ticks, dtype=np.int64)))
    started = time.perf_counter()
    try:
        _loop(controller, plant, ticks, stop_after_fall_s, stop, progress, outcome)
    except Exception as error:  # whatever a product throws: the run so far is kept and marked
        outcome.error = f"{type(error).__name__} at t = {outcome.timing.ticks * 1e-3:.3f} s: {error}"
    outcome.timing.loop_s = time.perf_counter() - started
    outcome.interrupted = stop.signal is not None
    return outcome


def _loop(controller: Side, plant: Side, ticks: int, stop_after_fall_s: float, stop: StopRequest,
          progress: Callable[[SignalLog], None] | None, outcome: Outcome) -> None:  # fmt: skip
    log, timing = outcome.log, outcome.timing
    recorder = Recorder(controller, plant, log)
    wires = connect(plant, controller) + connect(controller, plant)
    fall = _FallWatch(log, stop_after_fall_s)
    now = time.perf_counter_ns
    next_progress = now()
    k, last = 0, ticks
    while True:
        controller.get_outputs()
        plant.get_outputs()
        recorder.row()
        if k >= last:
            break
        if k % HOUSEKEEPING_TICKS == 0:
            if stop.signal is not None:
                break
            last = min(last, fall.last_tick())
            if progress is not None and now() >= next_progress:
                progress(log)
                next_progress = now() + PROGRESS_PERIOD_NS
        for into, out, index_in, index_out in wires:
            into[index_in] = out[index_out]
        controller.set_inputs()
        plant.set_inputs()
        t0 = now()
        controller.step()
        t1 = now()
        plant.step()
        t2 = now()
        timing.controller_ns[k] = t1 - t0
        timing.plant_ns[k] = t2 - t1
        k += 1
        timing.ticks = k
    if progress is not None:
        progress(log)


class _FallWatch:
    """Where the run may end: a while after the tick of a fall. Looks at each row once."""

    def __init__(self, log: SignalLog, stop_after_fall_s: float) -> None:
        self.log, self.seen, self.end = log, 0, math.inf
        self.extra = round(stop_after_fall_s * 1e6 / parameters.table().tick_us)
        names = ("p.true_chest_rpy_rad.x", "p.true_chest_rpy_rad.y", "p.other_contacts")
        missing = [name[2:] for name in names if name not in log]
        if missing:
            raise UserError(f"the plant does not tell {', '.join(missing)}: a fall could not be seen")

    def last_tick(self) -> float:
        rows = slice(self.seen, self.log.count)
        tilt = metrics.chest_tilt_rad(self.log.column("p.true_chest_rpy_rad.x")[rows],
                                      self.log.column("p.true_chest_rpy_rad.y")[rows])  # fmt: skip
        fallen = (tilt > metrics.FALL_TILT_RAD) | (self.log.column("p.other_contacts")[rows] > 0)
        if fallen.any() and self.end == math.inf:
            self.end = self.seen + int(np.argmax(fallen)) + self.extra
        self.seen = self.log.count
        return self.end
