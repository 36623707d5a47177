"""The length of a frame on the modelled bus beside one worked out here, bit by bit, from ISO 11898-1."""

from __future__ import annotations

import ctypes
import random

import pytest

from hoap2.can import library
from hoap2.generate import can_length, can_table

TABLE = can_table.load()
FD_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)


def bits_of(value: int, width: int) -> list[int]:
    return [int(c) for c in format(value, f"0{width}b")]


def stuff(bits: list[int], dangling: bool) -> list[int]:
    """With the stuff bits in; `dangling`: also behind five equal bits at the very end."""
    out: list[int] = []
    for i, bit in enumerate(bits):
        out.append(bit)
        last = i == len(bits) - 1
        if len(out) >= 5 and len(set(out[-5:])) == 1 and (dangling or not last):
            out.append(1 - out[-1])
    return out


def crc15(bits: list[int]) -> int:
    crc = 0
    for bit in bits:
        crc = ((crc << 1) ^ (0x4599 if bit ^ crc >> 14 else 0)) & 0x7FFF
    return crc


def expected(identifier: int, data: bytes, flags: int) -> tuple[int, int]:
    """(nominal, data) bits up to the end of the intermission."""
    extended, fd, brs = (bool(flags & f) for f in (library.EXTENDED, library.FD, library.BRS))
    arbitration = [0, *(bits_of(identifier >> 18, 11) + [1, 1] + bits_of(identifier & 0x3FFFF, 18)
                        if extended else bits_of(identifier, 11))]  # fmt: skip
    payload = [bit for byte in data for bit in bits_of(byte, 8)]
    tail = 1 + 1 + 7 + 3
    if not fd:
        remote = bool(flags & library.REMOTE)
        control = [int(remote), *([0, 0] if extended else [0, 0]), *bits_of(len(data), 4)]
        covered = arbitration + control + ([] if remote else payload)
        return len(stuff(covered + bits_of(crc15(covered), 15), True)) + 1 + tail, 0
    head = [*arbitration, 0, *([] if extended else [0]), 1, 0, int(brs)]
    control = [0, *bits_of(FD_LENGTHS.index(len(data)), 4)]
    with_stuffing = stuff(head + control + payload, False)
    nominal = len(stuff(head, False))
    crc = 17 if len(data) <= 16 else 21
    fixed = len(range(0, 4 + crc, 4))
    rest = len(with_stuffing) - nominal + 4 + crc + fixed + 1  # the CRC delimiter with it
    return (nominal + tail, rest) if brs else (nominal + rest + tail, 0)


def measured(identifier: int, data: bytes, flags: int) -> tuple[int, int]:
    frame = library.Frame(identifier, len(data), flags, (ctypes.c_uint8 * 64)(*data))
    nominal, fast = ctypes.c_int32(), ctypes.c_int32()
    library.load().hoap2_link_frame_bits(ctypes.byref(frame), ctypes.byref(nominal), ctypes.byref(fast))
    return nominal.value, fast.value


FORMATS = {
    "classic": 0, "classic extended": library.EXTENDED, "remote": library.REMOTE,
    "fd": library.FD, "fd brs": library.FD | library.BRS, "fd brs extended": library.FD | library.BRS | library.EXTENDED,
}  # fmt: skip


@pytest.mark.parametrize("flags", FORMATS.values(), ids=FORMATS)
def test_frames_are_as_long_as_their_bits(flags: int):
    rng = random.Random(flags)
    for _ in range(1500):
        length = rng.choice(FD_LENGTHS) if flags & library.FD else rng.randint(0, 8)
        identifier = rng.choice((0, rng.getrandbits(11), 0x7FF)) << (18 if flags & library.EXTENDED else 0)
        if flags & library.EXTENDED:
            identifier |= rng.choice((0, rng.getrandbits(18), 0x3FFFF))
        # runs of equal bits are what stuffing is about
        data = bytes(rng.choice((0, 0xFF, 0xF8, 0x1F, rng.getrandbits(8))) for _ in range(length))
        if flags & library.REMOTE:
            data = bytes(length)
        assert measured(identifier, data, flags) == expected(identifier, data, flags)


def test_known_lengths():
    # without stuffing: 1 + 11 + 1 + 1 + 1 + 4 + 8 n + 15 + 1 + 1 + 1 + 7 + 3
    assert measured(0x2AA, b"\x55" * 8, 0)[0] in range(44 + 64 + 3, 44 + 64 + 3 + 6)
    worst = measured(0, bytes(8), 0)[0]
    assert worst <= 44 + 64 + 3 + (34 + 64 - 1) // 4


def test_the_worst_case_of_the_load_table_is_met_and_never_passed():
    """Random payloads stay below the bound; one made of runs comes close."""
    rng = random.Random(4)
    for frame in TABLE.frames:
        bound = can_length.worst_ns(frame, TABLE)
        spare = 8 * frame.length - frame.used_bits
        longest = 0
        for i in range(120):
            runs = "".join(str(i % 2) * 4 if i else "0" * 5 for i in range(200))
            text = runs[i % 9 :][: 8 * frame.length] if i < 60 else format(rng.getrandbits(8 * frame.length), f"0{8 * frame.length}b")
            data = bytearray(int(text[8 * b : 8 * b + 8], 2) for b in range(frame.length))
            for bit in range(8 * frame.length - spare, 8 * frame.length):
                data[bit // 8] &= ~(1 << bit % 8) & 0xFF
            nominal, fast = measured(frame.identifier, bytes(data), library.FD | library.BRS)
            longest = max(longest, nominal * 1000 + fast * 200)
        assert 0.93 * bound <= longest <= bound, frame.name
