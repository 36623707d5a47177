"""The firmware's codec beside an independent one: cantools with the generated DBC files."""

from __future__ import annotations

import ctypes
import random
from pathlib import Path

import cantools
import pytest

from hoap2.can import library
from hoap2.generate import can_length, can_table

TABLE = can_table.load()
FRAMES = [pytest.param(i, id=f"{TABLE.buses[f.bus]}-{f.name}") for i, f in enumerate(TABLE.frames)]


@pytest.fixture(scope="module")
def databases(repo_root: Path) -> list[cantools.database.can.Database]:
    folder = repo_root / "firmware" / "can" / "generated"
    return [cantools.database.load_file(folder / f"hoap2_{name}.dbc") for name in TABLE.buses]


def crc8(identifier: int, data: bytes) -> int:
    """CRC-8 of a frame as docs/generated/can.md tells it, bit by bit."""
    crc = 0xFF
    for byte in (*identifier.to_bytes(2, "little"), *data[1:]):
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1) ^ (0x12F if crc & 0x80 else 0)
    return crc ^ 0xFF


def encode(index: int, counter: int, raw: list[int]) -> bytes:
    frame, values = library.Frame(), (ctypes.c_int32 * 64)(*raw)
    assert library.load().hoap2_can_encode(index, counter, values, ctypes.byref(frame)) == 0
    assert frame.identifier == TABLE.frames[index].identifier and frame.flags == library.FD | library.BRS
    return bytes(frame.data[: frame.length])


def decode(index: int, data: bytes) -> tuple[int, library.Message]:
    bus, identifier = TABLE.frames[index].bus, TABLE.frames[index].identifier
    frame = library.Frame(identifier, len(data), library.FD | library.BRS, (ctypes.c_uint8 * 64)(*data))
    message = library.Message()
    return library.load().hoap2_can_decode(bus, ctypes.byref(frame), ctypes.byref(message)), message


def draw(index: int, rng: random.Random) -> list[int]:
    return [rng.choice((f.low, f.high, rng.randint(f.low, f.high))) if not f.real else rng.getrandbits(30)
            for f in (p.field for p in TABLE.frames[index].placed)]  # fmt: skip


def as_value(field: can_table.Field, raw: int) -> float:
    """The value that a raw integer stands for."""
    return ctypes.c_float.from_buffer_copy(raw.to_bytes(4, "little")).value if field.real else raw * field.lsb


@pytest.mark.parametrize("index", FRAMES)
def test_what_the_firmware_encodes_cantools_decodes(index: int, databases):
    frame, rng = TABLE.frames[index], random.Random(index)
    message = databases[frame.bus].get_message_by_frame_id(frame.identifier)
    for _ in range(60):
        raw, counter = draw(index, rng), rng.randrange(256)
        data = encode(index, counter, raw)
        got = message.decode(data, decode_choices=False)
        assert got.pop("crc") == crc8(frame.identifier, data) == data[0]
        assert got.pop("counter") == counter
        assert got == {p.name: as_value(p.field, v) for p, v in zip(frame.placed, raw)}


@pytest.mark.parametrize("index", FRAMES)
def test_what_cantools_encodes_the_firmware_decodes(index: int, databases):
    frame, rng = TABLE.frames[index], random.Random(1000 + index)
    message = databases[frame.bus].get_message_by_frame_id(frame.identifier)
    for _ in range(60):
        raw, counter = draw(index, rng), rng.randrange(256)
        values = {p.name: as_value(p.field, v) for p, v in zip(frame.placed, raw)}
        data = bytearray(message.encode({**values, "crc": 0, "counter": counter}, strict=False))
        data[0] = crc8(frame.identifier, data)
        refused, got = decode(index, data)
        assert refused == 0 and got.counter == counter and got.layout == index
        assert list(got.raw[: len(raw)]) == raw


def test_dbc_files_say_what_the_bus_is(databases):
    for bus, database in enumerate(databases):
        attributes = database.dbc.attributes
        assert attributes["BusType"].value == "CAN FD" and attributes["Protocol"].value == TABLE.protocol
        assert {n.name for n in database.nodes} == {"controller", *(b.name for b in TABLE.boards if b.bus == bus)}
        for frame in TABLE.of_bus(bus):
            message = database.get_message_by_frame_id(frame.identifier)
            assert message.is_fd and not message.is_extended_frame and message.length == frame.length
            assert message.senders == [frame.sender] and (message.cycle_time or 0) == frame.period_ticks
            signal_names = {p.name: p for p in frame.placed}
            for signal in message.signals:
                if signal.name in signal_names and signal_names[signal.name].field.enum:
                    assert signal.choices
        stop = database.get_message_by_name("stop_controller")
        assert stop.frame_id == 0 == min(m.frame_id for m in database.messages)


def test_only_frames_of_the_longest_that_fit_a_classic_frame_are_longer(databases):
    """Heartbeats, parameters, emergency stop and time sync also fit a classic CAN frame."""
    for frame in TABLE.frames:
        if frame.kind.name in ("stop", "beat", "board_beat", "request", "reply", "time_sync", "answer"):
            assert frame.length <= 8


@pytest.mark.parametrize("bus", range(len(TABLE.buses)))
def test_bus_load_is_below_the_limit(bus: int):
    load = can_length.average_load(TABLE, bus)
    assert 0.4 < load <= TABLE.raw["load_limit"] == 0.7
    assert can_length.busiest_tick_ns(TABLE, bus) < 1_000_000
