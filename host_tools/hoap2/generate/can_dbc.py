"""A DBC file for each bus: CAN FD, with ranges, words, senders, cycle times and the protocol's hash."""

from __future__ import annotations

from .can_table import CONTROLLER, HEADER_BITS, CanTable, Frame, Placed
from .tables import Table

ATTRIBUTES = """\
BA_DEF_ "BusType" STRING;
BA_DEF_ "Protocol" INT 0 65535;
BA_DEF_ "Baudrate" INT 0 1000000;
BA_DEF_ "BaudrateCANFD" INT 0 16000000;
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","reserved","reserved","reserved","reserved",\
"reserved","reserved","reserved","reserved","reserved","reserved","reserved","StandardCAN_FD","ExtendedCAN_FD";
BA_DEF_ BO_ "CANFD_BRS" ENUM "0","1";
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_DEF_ BO_ "GenMsgSendType" ENUM "Cyclic","IfActive";
BA_DEF_DEF_ "BusType" "CAN FD";
BA_DEF_DEF_ "Protocol" 0;
BA_DEF_DEF_ "Baudrate" 1000000;
BA_DEF_DEF_ "BaudrateCANFD" 5000000;
BA_DEF_DEF_ "VFrameFormat" "StandardCAN_FD";
BA_DEF_DEF_ "CANFD_BRS" "1";
BA_DEF_DEF_ "GenMsgCycleTime" 0;
BA_DEF_DEF_ "GenMsgSendType" "IfActive";"""


def _number(value: float) -> str:
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def _signal(placed: Placed, receivers: str) -> str:
    f = placed.field
    sign = "-" if f.signed or f.real else "+"
    low, high = ("0", "0") if f.real else (_number(f.low * f.lsb), _number(f.high * f.lsb))
    unit = "" if f.unit == "1" else f.unit
    return (f' SG_ {placed.name} : {placed.first_bit}|{f.bits}@1{sign} ({_number(f.lsb)},0) [{low}|{high}] "{unit}" '
            f"{receivers}")  # fmt: skip


def _message(frame: Frame) -> str:
    receivers = ",".join(frame.receivers)
    lines = [f"BO_ {frame.identifier} {frame.name}: {frame.length} {frame.sender}",
             f' SG_ crc : 0|8@1+ (1,0) [0|255] "" {receivers}',
             f' SG_ counter : 8|{HEADER_BITS - 8}@1+ (1,0) [0|255] "" {receivers}']  # fmt: skip
    return "\n".join(lines + [_signal(p, receivers) for p in frame.placed])


def dbc(table: CanTable, signals: Table, bus: int) -> str:
    frames = table.of_bus(bus)
    words = {**table.raw["enum"], **signals.enums}
    nodes = " ".join([CONTROLLER, *(b.name for b in table.boards if b.bus == bus)])
    values, types, comments, attributes = [], [], [], []
    for frame in frames:
        comments.append(f'CM_ BO_ {frame.identifier} "{frame.kind.text}";')
        if frame.period_ticks:
            cycle_ms = frame.period_ticks * table.raw["tick_us"] // 1000
            attributes += [f'BA_ "GenMsgCycleTime" BO_ {frame.identifier} {cycle_ms};',
                           f'BA_ "GenMsgSendType" BO_ {frame.identifier} 0;']  # fmt: skip
        for p in frame.placed:
            comments.append(f'CM_ SG_ {frame.identifier} {p.name} "{p.field.text}";')
            if p.field.enum:
                named = " ".join(f'{i} "{word}"' for i, word in enumerate(words[p.field.enum]))
                values.append(f"VAL_ {frame.identifier} {p.name} {named} ;")
            if p.field.real:
                types.append(f"SIG_VALTYPE_ {frame.identifier} {p.name} : 1;")
    about = (f"hoap2, {table.buses[bus]} bus, protocol 0x{table.protocol:04X}. Generated from firmware/can.toml by "
             "./hoap2 generate: do not edit. crc: CRC-8, see docs/generated/can.md.")  # fmt: skip
    head = [f'VERSION "{table.raw["schema"]}.{table.protocol:04X}"', "", "NS_ :", "", "BS_:", "", f"BU_: {nodes}", ""]
    bit_rates = [f'BA_ "{name}" {table.raw[key]};' for name, key in
                 (("Baudrate", "nominal_bit_s"), ("BaudrateCANFD", "data_bit_s"))]  # fmt: skip
    parts = ["\n\n".join(_message(f) for f in frames), "", f'CM_ "{about}";', *comments, ATTRIBUTES,
             f'BA_ "Protocol" {table.protocol};', 'BA_ "BusType" "CAN FD";', *bit_rates, *attributes, *values,
             *types]  # fmt: skip
    return "\n".join([*head, *parts]) + "\n"
