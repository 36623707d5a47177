"""Frames by name and unit: the generated DBC files through cantools, and candump's notation of a frame."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import can
import cantools
from cantools.database import Message as Layout
from crccheck.crc import Crc8Autosar

from hoap2.errors import UserError, nearest
from hoap2.paths import ROOT

GENERATED = ROOT / "firmware" / "can" / "generated"
CRC, COUNTER, PROTOCOL = "crc", "counter", "protocol"
_FRAME = re.compile(r"([0-9A-Fa-f]{3}|[0-9A-Fa-f]{8})#(?:(R)(\d?)|#([0-9A-Fa-f])([0-9A-Fa-f.]*)|([0-9A-Fa-f.]*))")
FD_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)


@dataclass(frozen=True)
class Value:
    """A signal of a frame."""

    name: str
    value: float | int | str
    unit: str

    def __str__(self) -> str:
        shown = f"{self.value:.6g}" if isinstance(self.value, float) else str(self.value)
        return f"{self.name}={shown}{' ' + self.unit if self.unit else ''}"


def crc_of(identifier: int, data: bytes) -> int:
    """CRC-8 of a frame of ours (docs/generated/can.md): over the identifier and what follows the CRC."""
    return Crc8Autosar.calc(identifier.to_bytes(2, "little") + data[1:])


class Messages:
    """The messages of some DBC files; frames that both buses have are equal in both."""

    def __init__(self, files: Iterable[Path]) -> None:
        self.by_identifier: dict[int, Layout] = {}
        self.by_name: dict[str, Layout] = {}
        self.protocol: int | None = None
        for file in files:
            try:
                database = cantools.database.load_file(file)
            except (OSError, ValueError, cantools.Error) as error:
                raise UserError(f"{file} is not a DBC file that can be read: {error}") from None
            self._take(file, database)

    def _take(self, file: Path, database) -> None:
        version = re.fullmatch(r"\d+\.([0-9A-F]{4})", database.version or "")
        protocol = int(version[1], 16) if version else None
        if self.by_name and protocol != self.protocol:
            raise UserError(f"{file} is of protocol {_hex(protocol)}, the other of {_hex(self.protocol)}",
                            "take the files of one version: ./hoap2 generate")  # fmt: skip
        self.protocol = protocol
        for layout in database.messages:
            self.by_identifier[layout.frame_id] = layout
            self.by_name[layout.name] = layout

    def layout(self, message: can.Message) -> Layout | None:
        plain = not (message.is_error_frame or message.is_remote_frame)
        layout = self.by_identifier.get(message.arbitration_id) if plain else None
        return layout if layout and layout.is_extended_frame == message.is_extended_id else None

    def name(self, message: can.Message) -> str:
        """The message's name, `error`, or an empty text."""
        if message.is_error_frame:
            return "error"
        layout = self.layout(message)
        return layout.name if layout else ""

    def values(self, message: can.Message) -> list[Value]:
        """Every signal of a frame, without CRC and counter; empty for a frame that `fault` tells of."""
        layout = self.layout(message)
        if layout is None or self.fault(message):
            return []
        decoded = layout.decode(bytes(message.data), decode_choices=True)
        return [Value(s.name, _plain(decoded[s.name]), s.unit or "") for s in layout.signals
                if s.name in decoded and s.name not in (CRC, COUNTER)]  # fmt: skip

    def fault(self, message: can.Message) -> str:
        """What is wrong with a frame of ours, or an empty text."""
        layout = self.layout(message)
        if layout is None:
            return ""
        if len(message.data) != layout.length:
            return f"{len(message.data)} bytes, not {layout.length}"
        if self.protocol is not None and message.data[0] != crc_of(message.arbitration_id, bytes(message.data)):
            return "CRC wrong"
        return ""

    def foreign_protocol(self, message: can.Message) -> int | None:
        """The protocol that the sender speaks, if it tells one and it is not that of these files."""
        layout = self.layout(message)
        if layout is None or self.protocol is None or PROTOCOL not in layout.signal_tree or self.fault(message):
            return None
        told = int(layout.decode(bytes(message.data), decode_choices=False)[PROTOCOL])
        return told if told != self.protocol else None

    def encode(self, name: str, values: Mapping[str, float | str]) -> can.Message:
        """A frame by names; a signal that is not given is 0, CRC and protocol are filled in."""
        if name not in self.by_name:
            raise self.unknown(name)
        layout = self.by_name[name]
        known = [s.name for s in layout.signals]
        for given in values:
            if given not in known:
                has = f"it has {', '.join(known)}"
                raise UserError(f"{name} has no signal '{given}'", nearest(given, known) or has)
        filled = {s: 0 for s in known} | ({PROTOCOL: self.protocol} if PROTOCOL in known else {}) | dict(values)
        try:
            data = bytearray(layout.encode(filled))
        except (cantools.Error, ValueError, OverflowError) as error:
            raise UserError(f"{name}: {error}") from None
        if CRC in known and CRC not in values and self.protocol is not None:
            data[0] = crc_of(layout.frame_id, bytes(data))
        return can.Message(arbitration_id=layout.frame_id, is_extended_id=layout.is_extended_frame, data=data,
                           is_fd=self.fd, bitrate_switch=self.fd)  # fmt: skip

    def unknown(self, name: str) -> UserError:
        near = nearest(name, self.by_name)
        return UserError(f"no message '{name}'", near or "./hoap2 can scan --messages lists them")

    @cached_property
    def fd(self) -> bool:
        """Whether the bus is CAN FD."""
        return any(layout.length > 8 for layout in self.by_name.values())


def _hex(protocol: int | None) -> str:
    return "none" if protocol is None else f"0x{protocol:04X}"


def _plain(value) -> float | int | str:
    return value if isinstance(value, (int, float)) else str(value)


def generated_files() -> list[Path]:
    """The DBC files of this checkout."""
    return sorted(GENERATED.glob("*.dbc"))


def load(files: Iterable[Path] | None = None) -> Messages:
    """Messages of these DBC files, or of the generated ones."""
    return Messages(list(files) if files else generated_files())


def parse(text: str) -> can.Message:
    """A frame in candump's notation: 123#DEADBEEF, 12345678#R8, 123##1 and data for CAN FD (1: fast data)."""
    found = _FRAME.fullmatch(text)
    if not found:
        raise UserError(f"'{text}' is not a frame", "such as 061#DEADBEEF, 12345678#R8 (remote), 061##1DEAD (CAN FD)")
    identifier, remote, dlc, flags, fd_data, data = found.groups()
    common = {"arbitration_id": int(identifier, 16), "is_extended_id": len(identifier) == 8}
    if common["arbitration_id"] > (0x1FFFFFFF if common["is_extended_id"] else 0x7FF):
        raise UserError(f"the identifier of '{text}' has more than {29 if common['is_extended_id'] else 11} bits")
    if remote:
        if dlc and int(dlc) > 8:
            raise UserError(f"'{text}': a remote frame asks for at most 8 bytes")
        return can.Message(**common, is_remote_frame=True, dlc=int(dlc or 0))
    digits = (fd_data if flags else data).replace(".", "")
    if len(digits) % 2:
        raise UserError(f"the data of '{text}' have half a byte")
    octets = bytes.fromhex(digits)
    if len(octets) not in (FD_LENGTHS if flags else range(9)):
        raise UserError(f"{len(octets)} bytes do not make a {'CAN FD' if flags else 'CAN'} frame",
                        f"CAN FD has {', '.join(map(str, FD_LENGTHS[9:]))} beyond 8: 061##1...")  # fmt: skip
    bits = int(flags, 16) if flags else 0
    return can.Message(**common, data=octets, is_fd=bool(flags), bitrate_switch=bool(bits & 1),
                       error_state_indicator=bool(bits & 2))  # fmt: skip


def rounds(words: list[str], dbc: list[Path] | None) -> Callable[[int], list[can.Message]]:
    """Round number -> its frames: in candump's notation, or one by NAME signal=value ..., its counter going on."""
    if "#" in words[0]:
        parsed = [parse(word) for word in words]
        return lambda _i: parsed
    table, values = load(dbc), {}
    for word in words[1:]:
        name, equals, value = word.partition("=")
        if not equals:
            raise UserError(f"'{word}' is not signal=value")
        try:
            values[name] = float(value)
        except ValueError:
            values[name] = value  # a word of the DBC's value table
    first = values.get(COUNTER, 0)

    def numbered(i: int):
        own = COUNTER in [s.name for s in table.by_name[words[0]].signals]
        return [table.encode(words[0], {**values, COUNTER: (first + i) % 256} if own else values)]

    table.encode(words[0], values)  # before the bus is opened
    return numbered
