"""The protocol page: buses, boards, frames to the bit, bus load."""

from __future__ import annotations

from .can_length import average_load, busiest_tick_ns, worst_ns
from .can_table import HEADER_BITS, CanTable, Frame, Kind
from .tables import Table

INTRO = """\
# CAN protocol

Generated from `firmware/can.toml`: do not edit. [can.md](../can.md) tells how it is used.

CAN FD, {nominal:g} / {data:g} Mbit/s, 11-bit identifiers, {buses} buses. Protocol `0x{protocol:04X}`, a hash of the table: nodes
with another one refuse each other's frames. The DBC of each bus: {dbcs}.

Identifier = priority << 5 | node; the smaller one wins. The controller is node 0. In a frame to or from a board the node
is the board's. Payload, least significant bit first:

| bits | |
|---|---|
| 0-7 | CRC-8: polynomial 0x{poly:02X}, start and final XOR 0xFF, over the identifier (two bytes, low one first), then bytes 1 to the end |
| 8-15 | message counter of the sender, a count a frame of this identifier |
| 16- | fields as below; spare bits at the end are zero |

Value = raw x step. Multi-byte fields are little-endian (Intel)."""


def _step(lsb: float) -> str:
    return "" if lsb == 1.0 else f"{lsb:.10g}"


def _bits(first: int, bits: int) -> str:
    return f"{first}-{first + bits - 1}" if bits > 1 else str(first)


def _field_table(kind: Kind, frame: Frame, words: dict) -> list[str]:
    out = ["| bits | field | type | step | unit | range | |", "|---|---|---|---|---|---|---|",
           "| 0-7 | crc | u8 | | | | |", f"| 8-{HEADER_BITS - 1} | counter | u8 | | | | |"]  # fmt: skip
    bit = HEADER_BITS
    for field in (*kind.fixed, *kind.each):
        total = field.bits * field.repeat
        where = _bits(bit, total) + (f" + {sum(f.bits for f in kind.each)} j" if field.each else "")
        kind_of = "f32" if field.real else f"{'i' if field.signed else 'u'}{field.bits}"
        span = "" if field.real or field.enum else f"{field.low * field.lsb:.6g} ... {field.high * field.lsb:.6g}"
        named = f" ({', '.join(f'{i} {w}' for i, w in enumerate(words[field.enum]))})" if field.enum else ""
        times = f"{field.repeat} x " if field.repeat > 1 else ""
        unit = "" if field.unit == "1" else field.unit
        out.append(f"| {where} | {field.name} | {times}{kind_of} | {_step(field.lsb)} | {unit} | {span} | "
                   f"{field.text}{named} |")  # fmt: skip
        bit += total
    if kind.each:
        out += ["", "j counts the joints of the board from 0."]
    return out


def _message(kind: Kind, table: CanTable, words: dict) -> list[str]:
    frames = [f for f in table.frames if f.kind == kind]
    out = [f"## {kind.name}", "", kind.text[0].upper() + kind.text[1:] + ".", "",
           "| identifier | bus | frame | from | to | bytes | period (ms) | longest (us) |",
           "|---|---|---|---|---|---|---|---|"]  # fmt: skip
    for f in frames:
        to = "all" if len(f.receivers) > 1 else f.receivers[0]
        period = f"{f.period_ticks * table.raw['tick_us'] / 1000:g}" if f.period_ticks else "when needed"
        out.append(f"| 0x{f.identifier:03X} | {table.buses[f.bus]} | {f.name} | {f.sender} | {to} | {f.length} | "
                   f"{period} | {worst_ns(f, table) / 1000:.1f} |")  # fmt: skip
    return [*out, "", *_field_table(kind, frames[0], words), ""]


def _load(table: CanTable) -> list[str]:
    limit = table.raw["load_limit"]
    out = ["## Bus load", "",
           "Each periodic frame at its period, with the most stuff bits that any payload gives it: arbitration, control, "
           "payload, stuff count, CRC with its fixed stuff bits, acknowledgement, end of frame and intermission, to the bit "
           "(`host_tools/hoap2/generate/can_length.py`).", "",
           "| bus | frames a second | average load | limit | busiest millisecond |", "|---|---|---|---|---|"]  # fmt: skip
    for bus, name in enumerate(table.buses):
        load = average_load(table, bus)
        if load > limit:
            raise ValueError(f"the {name} bus is loaded with {load:.1%}, more than {limit:.0%}")
        rate = sum(1e6 / (f.period_ticks * table.raw["tick_us"]) for f in table.of_bus(bus) if f.period_ticks)
        out.append(f"| {name} | {rate:.0f} | {100 * load:.1f} % | {100 * limit:.0f} % | "
                   f"{busiest_tick_ns(table, bus) / 1e3:.0f} us |")  # fmt: skip
    return [*out, ""]


def page(table: CanTable, signals: Table) -> str:
    raw, words = table.raw, {**table.raw["enum"], **signals.enums}
    dbcs = ", ".join(f"`firmware/can/generated/hoap2_{name}.dbc`" for name in table.buses)
    out = [INTRO.format(nominal=raw["nominal_bit_s"] / 1e6, data=raw["data_bit_s"] / 1e6, buses=len(table.buses),
                        protocol=table.protocol, poly=raw["crc8_poly"], dbcs=dbcs), "",
           "## Boards", "", "| node | board | bus | kind | joints |", "|---|---|---|---|---|"]  # fmt: skip
    for b in table.boards:
        joints = ", ".join(table.joint_names[j] for j in b.joints)
        out.append(f"| {b.node} | {b.name} | {table.buses[b.bus]} | {b.kind} | {joints} |")
    out += ["", *_load(table)]
    for kind in table.kinds:
        out += _message(kind, table, words)
    out += ["## Parameters of the boards", "", "| number | name | range | |", "|---|---|---|---|"]
    for i, p in enumerate(raw["parameter"]):
        span = " ... ".join(f"{v:g}" for v in p["range"]) if "range" in p else "read only"
        out.append(f"| {i} | {p['name']} | {span} | {p['text']}{', of each joint' if 'each' in p else ''} |")
    out += ["", "## Why a frame is refused", "", "| word | |", "|---|---|"]
    out += [*(f"| {name} | {text} |" for name, text in raw["refusal"].items()), ""]
    out += ["## Disturbances of the modelled link", "", "The table `[can]` of a scenario, or `--set can.name=value`.", "",
            "| name | unit | default | range | |", "|---|---|---|---|---|"]  # fmt: skip
    for d in table.disturbances:
        named = f" ({', '.join(f'{i} {w}' for i, w in enumerate(d.words))})" if d.words else ""
        unit = "int" if d.kind == "int" else d.unit
        out.append(f"| `{d.name}` | {unit} | {d.default:g} | {d.low:g} ... {d.high:g} | {d.text}{named} |")
    return "\n".join([*out, ""])
