"""LCM log files: every whole message, what was passed over, and the signals of a run rebuilt from them."""

from __future__ import annotations

import mmap
import struct
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from hoap2 import parameters
from hoap2.errors import UserError
from hoap2.generate import lcm_types
from hoap2.generate.tables import MESSAGES
from hoap2.signal_log import PREFIX, Column, SignalLog, columns_of
from hoap2.telemetry import types

EVENT_HEADER = struct.Struct(">4sqqii")  # sync word, number, time in us, length of the channel's name, of the data
SYNC = (0xEDA1DA01).to_bytes(4, "big")
LONGEST_NAME = 63
SELF_TEST = "LCM_SELF_TEST"  # what liblcm says to itself when it begins to listen
TRUTH_TICKS = 10  # truth is logged every tenth tick
_DTYPES = {"real": ">f8", "int": ">i4"}


@dataclass(frozen=True)
class Logged:
    """One event: its time in the log (us), its channel, and the encoded message."""

    time_us: int
    channel: str
    data: bytes


class LogFile:
    """The good messages of a log, in order; iterate it once, then `problems` says what was not good.

    liblcm's reader does not tell a log that is cut off from a whole one, and lengths that lie bring it down.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.foreign: Counter[str] = Counter()
        self.malformed: Counter[str] = Counter()
        self.messages = 0
        self.last_us = 0
        self.cut_bytes = 0  # at the end: a message that was begun
        self.damaged_bytes = 0  # between messages
        self.other_schema = False  # a run in it was made with another table of signals
        try:
            with path.open("rb") as file:
                self._data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) if path.stat().st_size else b""
        except OSError as error:
            raise UserError(f"cannot read {path}: {error.strerror}") from None
        begin = self._data[: len(SYNC)]
        if not SYNC.startswith(begin):
            raise UserError(f"{path} is not an LCM log")

    def __iter__(self) -> Iterator[Logged]:
        at, size = 0, len(self._data)
        while at < size:
            found = self._event(at)
            if found is not None:
                end, logged = found
                yield from self._judged(logged)
                at = end
                continue
            begin = self._next_event(at)
            if begin is None:
                self.cut_bytes = size - at
                return
            self.damaged_bytes += begin - at
            at = begin

    def _event(self, at: int) -> tuple[int, Logged] | None:
        """The event that begins here and where it ends; None when there is none, or not all of it."""
        name_at = at + EVENT_HEADER.size
        if name_at > len(self._data):
            return None
        sync, _, time_us, name_length, length = EVENT_HEADER.unpack_from(self._data, at)
        end = name_at + name_length + length
        if sync != SYNC or not 0 < name_length <= LONGEST_NAME or length < 0 or end > len(self._data):
            return None
        name = self._data[name_at : name_at + name_length].decode(errors="replace")
        return end, Logged(time_us, name, self._data[name_at + name_length : end])

    def _next_event(self, at: int) -> int | None:
        """Where the next whole event begins after damage."""
        while (at := self._data.find(SYNC, at + 1)) >= 0:
            if self._event(at) is not None:
                return at
        return None

    def _judged(self, event: Logged) -> Iterator[Logged]:
        if event.channel == SELF_TEST:
            return
        try:
            types.check(event.channel, event.data)
        except types.Foreign:
            self.foreign[event.channel] += 1
            return
        except types.Malformed:
            self.malformed[event.channel] += 1
            return
        if event.channel == types.RUN:
            run = types.decode(event.channel, event.data)
            self.other_schema |= run.schema_hash != run.SCHEMA_HASH
        self.messages += 1
        self.last_us = event.time_us
        yield event

    def problems(self) -> list[str]:
        """What a reader of the log should know, a line each."""
        said = []
        if self.cut_bytes:
            said.append(f"{self.path} is cut off in mid-message: read up to {self.last_us / 1e6:.3f} s "
                        f"({self.messages} messages), {self.cut_bytes} bytes left over")  # fmt: skip
        if self.damaged_bytes:
            said.append(f"{self.path}: {self.damaged_bytes} damaged bytes between messages were passed over")
        if self.other_schema:
            said.append(f"{self.path} is of a run with another table of signals: enums and faults may have other names")
        if self.malformed:
            said.append(f"{self.path}: {self.malformed.total()} damaged messages were passed over")
        if self.foreign:
            said.append(f"{self.path}: {self.foreign.total()} messages that are not of this version were passed over "
                        f"({', '.join(sorted(self.foreign)[:5])})")  # fmt: skip
        return said


@lru_cache(maxsize=None)
def dtype_of(message: str) -> np.dtype:
    """Layout of an encoded state, gait or truth message."""
    fields = [("fingerprint", ">u8"), *((f.name, ">i8") for f in lcm_types.HEADER)]
    for signal in lcm_types.carried(parameters.table(), message):
        fields.append((lcm_types.field_name(signal), _DTYPES[signal.kind], signal.shape))
    return np.dtype(fields)


def sparse_columns() -> frozenset[str]:
    """The columns that a log holds every tenth tick only."""
    table = parameters.table()
    return frozenset(PREFIX[s.product] + element for s in lcm_types.carried(table, "truth")
                     for element in table.element_names(s))  # fmt: skip


def read_signals(path: Path) -> tuple[SignalLog, list[str]]:
    """The signals of the (last) run in a log, row k at tick k, and what was wrong with the log.

    Truth is logged every tenth tick: the values between are NaN (ints: those of the tick before).
    """
    log = LogFile(path)
    parts: dict[str, list[bytes]] = {name: [] for name in MESSAGES}
    run_id = None
    for event in log:
        name = event.channel.removeprefix(types.PREFIX).lower()
        if name not in parts:
            continue
        this = types.header(event.data)[0]
        if this != run_id:
            run_id = this
            parts = {name: [] for name in MESSAGES}
        parts[name].append(event.data)
    blocks = {name: np.frombuffer(b"".join(data), dtype=dtype_of(name)) for name, data in parts.items()}
    ticks = [int(block["tick"].max()) for block in blocks.values() if block.size]
    if not ticks:
        raise UserError(f"{path} holds no signals of a run", *(["; ".join(log.problems())] if log.problems() else []))
    return _rows(blocks, max(ticks) + 1), log.problems()


def _rows(blocks: dict[str, np.ndarray], count: int) -> SignalLog:
    columns: list[Column] = [column for product in PREFIX for column in columns_of(product)]
    signals = SignalLog(columns, count)
    signals.count = count
    signals.real[:], signals.integer[:] = np.nan, 0
    for name, block in blocks.items():
        rows = block["tick"]
        for signal in lcm_types.carried(parameters.table(), name):
            into = signals.block(PREFIX[signal.product] + signal.name)
            values = block[lcm_types.field_name(signal)].reshape(len(rows), -1)
            into[rows] = values
            if signal.kind == "int" and rows.size:  # held
                into[rows[0] :] = values[np.searchsorted(rows, np.arange(rows[0], count), side="right") - 1]
    return signals
