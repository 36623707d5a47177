"""How long a CAN FD frame is on the bus (ISO 11898-1), to the bit, with the worst stuffing that a payload gives it."""

from __future__ import annotations

from .can_table import LENGTHS, CanTable, Frame

# After the CRC delimiter: ACK slot, ACK delimiter, end of frame, intermission.
TAIL_BITS = 1 + 1 + 7 + 3


def header_bits(identifier: int, length: int) -> tuple[list[int], list[int]]:
    """Start of frame to BRS, and ESI and DLC: what goes at the nominal and at the data rate."""
    arbitration = [0, *(identifier >> i & 1 for i in range(10, -1, -1)), 0, 0, 1, 0, 1]  # SOF ID RRS IDE FDF res BRS
    dlc = LENGTHS.index(length)
    return arbitration, [0, *(dlc >> i & 1 for i in (3, 2, 1, 0))]


def _walk(states: dict, bits: list[int | None], place: int) -> dict:
    """One bit after the other: (last bit, run of it) -> most stuff bits [nominal, data]. None is a bit of any value."""
    for bit in bits:
        after: dict = {}
        for (last, run), (nominal, data) in states.items():
            for value in (0, 1) if bit is None else (bit,):
                stuffed = run == 5
                # the stuff bit is the complement of the five, and counts as the first of the next run
                before = (1 - last, 1) if stuffed else (last, run)
                count = (nominal + (stuffed and place == 0), data + (stuffed and place == 1))
                key = (value, before[1] + 1 if value == before[0] else 1)
                if key not in after or sum(count) > sum(after[key]):
                    after[key] = count
        states = after
    return states


def worst_ns(frame: Frame, table: CanTable) -> int:
    """Longest time on the bus, intermission included, over all payloads that the frame may have."""
    nominal_ns, data_ns = (10**9 // table.raw[key] for key in ("nominal_bit_s", "data_bit_s"))
    arbitration, control = header_bits(frame.identifier, frame.length)
    payload = [None] * frame.used_bits + [0] * (8 * frame.length - frame.used_bits)
    # on the bus a byte's most significant bit comes first
    payload = [payload[8 * byte + 7 - i] for byte in range(frame.length) for i in range(8)]
    states = _walk({(1, 0): (0, 0)}, arbitration, 0)
    states = _walk(states, [*control, *payload], 1)
    stuff = max(states.values(), key=lambda s: s[0] * nominal_ns + s[1] * data_ns)
    crc_bits, fixed = (17, 6) if frame.length <= 16 else (21, 7)
    # BRS and CRC delimiter change the rate at their sample points: together one nominal and one data bit
    nominal = len(arbitration) + stuff[0] + TAIL_BITS
    data = len(control) + 8 * frame.length + stuff[1] + 4 + crc_bits + fixed + 1
    return nominal * nominal_ns + data * data_ns


def average_load(table: CanTable, bus: int) -> float:
    """Part of the time that the periodic frames of a bus take, all with their worst stuffing."""
    tick_ns = 1000 * table.raw["tick_us"]
    return sum(worst_ns(f, table) / (f.period_ticks * tick_ns) for f in table.of_bus(bus) if f.period_ticks)


def busiest_tick_ns(table: CanTable, bus: int) -> int:
    """The most that the periodic frames of one tick take on a bus."""
    frames = [f for f in table.of_bus(bus) if f.period_ticks]
    cycle = max(f.period_ticks for f in frames)
    due = (sum(worst_ns(f, table) for f in frames if tick % f.period_ticks == f.offset_ticks) for tick in range(cycle))
    return max(due)
