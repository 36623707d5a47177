"""The telemetry of one run: what the master calls between its batches of ticks.

It reads the rows of the run's signals and never writes them. Once it is open nothing here ends a run: what fails is
noted, and the run goes on without.
"""

from __future__ import annotations

import ctypes
import secrets
from dataclasses import dataclass
from pathlib import Path

from hoap2 import __version__, parameters
from hoap2.generate import lcm_types
from hoap2.generate.tables import MESSAGES
from hoap2.pace import Pace
from hoap2.signal_log import PREFIX, SignalLog
from hoap2.telemetry import library, types

LOG_NAME = "telemetry.lcm"


def new_run_id() -> int:
    """A random number above 0 with 63 bits."""
    return secrets.randbits(63) or 1


@dataclass(frozen=True)
class About:
    """What run_t tells of the run."""

    run_id: int
    scenario: str
    title: str
    seed: int
    sensors: str
    duration_s: float
    run_toml: str
    folder: str
    accepts_commands: bool = False


def columns_of(log: SignalLog, message: str) -> ctypes.Array:
    """Column of the log for each element of a message, in its order; -1 where this run has none."""
    table = parameters.table()
    where = {c.name: i for group in (log.reals, log.ints) for i, c in enumerate(group)}
    columns = [where.get(PREFIX[s.product] + element, -1)
               for s in lcm_types.carried(table, message) for element in table.element_names(s)]  # fmt: skip
    return (ctypes.c_int32 * len(columns))(*columns)


class RunTelemetry:
    """Log and live view of one run. `open` comes first; `notes` says what went wrong."""

    def __init__(self, about: About, log_path: Path | None, url: str | None, pace: Pace | None = None) -> None:
        self.about, self.log_path, self.url, self.pace = about, log_path, url, pace
        self.notes: list[str] = []
        self.counts: dict[str, int] = {}
        self._publisher: library.Publisher | None = None
        self._signals: SignalLog | None = None
        library.load()
        types.bindings()

    def open(self, log: SignalLog, controller_ns, plant_ns) -> None:
        """Take the arrays of a run: its signals, and the durations of its steps (array.array, ns).

        Raises UserError when a sink cannot be opened.
        """
        config = library.Config(
            run_id=self.about.run_id, paced=self.pace is not None, tick_us=parameters.table().tick_us
        )
        config.log_path = None if self.log_path is None else str(self.log_path).encode()
        config.live_url = None if self.url is None else self.url.encode()
        config.real = log.real.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
        config.real_stride = log.real.strides[0] // log.real.itemsize
        config.integer = log.integer.ctypes.data_as(ctypes.POINTER(ctypes.c_int32))
        config.integer_stride = log.integer.strides[0] // log.integer.itemsize
        for name, array in (("controller_ns", controller_ns), ("plant_ns", plant_ns)):
            setattr(config, name, ctypes.cast(array.buffer_info()[0], ctypes.POINTER(ctypes.c_int64)))
        self._held = [columns_of(log, message) for message in MESSAGES], controller_ns, plant_ns
        for i, columns in enumerate(self._held[0]):
            config.columns[i] = columns
        config.push_column = next((i for i, c in enumerate(log.reals) if c.name == "p.true_push_force_W_N.x"), -1)
        self._signals = log
        self._publisher = library.Publisher(config)
        self._send_run(types.type_of(types.RUN).RUNNING)
        self.event("run_started", f"{self.about.scenario}: {self.about.title}", tick=0)

    @property
    def publisher(self) -> library.Publisher | None:
        """The open publisher, to listen to it within this process."""
        return self._publisher

    def rows(self) -> None:
        """What the log has got since the last call."""
        pace = self.pace
        if pace is None:
            self._publisher.rows(self._signals.count, 0.0, 0)
        else:
            self._publisher.rows(self._signals.count, pace.lag_us, pace.overruns)

    def send(self, channel: str, message, tick: int = -1, where: int = library.TO_LOG | library.LIVE) -> None:
        """A message of any channel; its header is filled in (tick: -1 is the last row's)."""
        self._publisher.send(channel, message.encode(), tick, where)

    def event(self, kind: str, text: str, tick: int = -1) -> None:
        """Something happened (at an earlier tick, if given)."""
        message = types.type_of(types.EVENT)()
        message.kind, message.text = kind, text
        self.send(types.EVENT, message, tick)

    def close(self, how: str) -> None:
        """The run is over; `how` is for people."""
        if self._publisher is None:
            return
        self.event("run_ended", how)
        self._send_run(types.type_of(types.RUN).ENDED)
        publisher = self._publisher
        publisher.finish(True)
        self._publisher = None
        self.counts = publisher.counts()
        if publisher.problem():
            self.notes.append(f"{LOG_NAME}: {publisher.problem()}")
        if self.counts["dropped"]:
            self.notes.append(f"the transport refused {self.counts['dropped']} live messages")
        publisher.destroy()

    def _send_run(self, state: int) -> None:
        about, message = self.about, types.type_of(types.RUN)()
        for name in ("scenario", "title", "seed", "sensors", "duration_s", "run_toml", "folder"):
            setattr(message, name, getattr(about, name))
        message.version, message.schema_hash = __version__, message.SCHEMA_HASH
        message.accepts_commands, message.state = int(about.accepts_commands), state
        self.send(types.RUN, message)
