"""What goes over buses: reading several at once, counting, and playing a log."""

from __future__ import annotations

import queue
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import can

from hoap2.can import interfaces, messages
from hoap2.errors import UserError

WAITING = 200_000  # messages read but not yet handled; more are lost, and counted


class Reader(can.Listener):
    """Reads some buses in a thread; iterate over what comes, in the order it came.

    Ends after `count` messages or `duration_s`; a bus that fails ends it with a UserError.
    """

    def __init__(self, buses: list[can.BusABC], count: int | None = None, duration_s: float | None = None) -> None:
        self.lost = 0
        self._queue: queue.Queue[can.Message | Exception] = queue.Queue(WAITING)
        self._left, self._end_s = count, None if duration_s is None else time.monotonic() + duration_s
        self._notifier = can.Notifier(buses, [self], timeout=0.1)

    def on_message_received(self, msg: can.Message) -> None:
        try:
            self._queue.put_nowait(msg)
        except queue.Full:
            self.lost += 1

    def on_error(self, exc: Exception) -> None:
        self._queue.put(exc)

    def __iter__(self) -> Iterator[can.Message]:
        while self._left is None or self._left > 0:
            wait_s = 0.2 if self._end_s is None else min(0.2, self._end_s - time.monotonic())
            try:
                got = self._queue.get(timeout=max(0.0, wait_s))
            except queue.Empty:
                if self._end_s is not None and time.monotonic() >= self._end_s:
                    return
                continue
            if isinstance(got, Exception):
                raise UserError(f"the bus failed: {got}", exit_code=1)
            if self._left is not None:
                self._left -= 1
            yield got

    def stop(self) -> None:
        if not self._notifier.stopped:
            self._notifier.stop(1.0)


@dataclass
class Tally:
    """How often an identifier came."""

    frames: int = 0
    first_s: float = 0.0
    last_s: float = 0.0
    lengths: set[int] = field(default_factory=set)
    faults: int = 0

    def take(self, message: can.Message, fault: str) -> None:
        if not self.frames:
            self.first_s = message.timestamp
        self.frames += 1
        self.last_s = message.timestamp
        self.lengths.add(message.dlc)
        self.faults += bool(fault)

    @property
    def rate_hz(self) -> float:
        span_s = self.last_s - self.first_s
        return (self.frames - 1) / span_s if span_s > 0 else 0.0


def open_all(interface: str, channels: list[str] | None, options: dict | None = None) -> list[can.BusABC]:
    """A node on each channel; all are closed again when one cannot be opened."""
    buses: list[can.BusABC] = []
    try:
        for channel in channels or [None]:
            buses.append(interfaces.open_bus(interface, channel, options))
    except BaseException:
        close_all(buses)
        raise
    return buses


def close_all(buses: list[can.BusABC]) -> None:
    for bus in buses:
        bus.shutdown()


def writer(path: Path):
    """A writer of python-can by the file's suffix; .log is candump's format."""
    try:
        return can.Logger(str(path))
    except (ValueError, OSError, ImportError) as error:
        known = "suffixes: .log (candump), .asc, .blf, .csv, .db, .trc"
        raise UserError(f"cannot write {path}: {error}", known) from None


def read_log(path: Path) -> Iterator[can.Message]:
    """The messages of a log; a place that is not as it should be is an error that says how far it was good."""
    if not path.exists():
        raise UserError(f"no file {path}")
    good = 0
    try:
        for message in can.LogReader(str(path)):
            if len(message.data) not in (messages.FD_LENGTHS if message.is_fd else range(9)):
                raise ValueError(f"it has {len(message.data)} bytes")
            yield message
            good += 1
    except (ValueError, IndexError, KeyError, TypeError, OSError, UnicodeDecodeError) as error:
        raise UserError(f"{path}: what follows message {good} is not a message: {error}",
                        "the log is cut off or damaged there" if good else "is it a log? (.log is candump -L)",
                        exit_code=1) from None  # fmt: skip


def play(log: Iterator[can.Message], bus_of: Callable[[can.Message], can.BusABC | None], speed: float) -> int:
    """Send messages at their times, speed times as fast (0: as fast as the bus takes them); the number sent."""
    sent, start_s, zero_s = 0, time.monotonic(), None
    for message in log:
        bus = bus_of(message)
        if bus is None:
            continue
        zero_s = message.timestamp if zero_s is None else zero_s
        if speed > 0:
            wait_s = start_s + (message.timestamp - zero_s) / speed - time.monotonic()
            if wait_s > 0:
                time.sleep(wait_s)
        send(bus, message)
        sent += 1
    return sent


def send(bus: can.BusABC, message: can.Message) -> None:
    """Send; UserError when the bus does not take it."""
    try:
        bus.send(message, timeout=2.0)
    except (can.CanError, OSError, ValueError) as error:
        what = f"{message.arbitration_id:03X}"
        raise UserError(f"{bus.channel_info} does not take {what}: {error}", exit_code=1) from None
