"""The table of the CAN interface, read, checked and laid out to the bit."""

from __future__ import annotations

import hashlib
import json
import tomllib
from dataclasses import dataclass
from functools import lru_cache

from .tables import ROOT, load_robot

CAN_TOML = ROOT / "firmware" / "can.toml"
LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)  # payloads that CAN FD has
HEADER_BITS = 16  # CRC-8, counter
NODE_BITS = 5
CONTROLLER = "controller"
FIELD_KEYS = {"name", "bits", "signed", "float", "each", "repeat", "lsb", "low", "high", "unit", "enum",
              "enum_of_signals", "text"}  # fmt: skip
MESSAGE_KEYS = {"name", "priority", "sender", "boards", "period_ticks", "period_rc_ticks", "text", "field"}


@dataclass(frozen=True)
class Field:
    """One row of a message, before it is repeated."""

    name: str
    bits: int
    signed: bool
    real: bool  # IEEE single
    each: str
    repeat: int
    lsb: float
    low: int  # raw
    high: int
    unit: str
    enum: str
    text: str


@dataclass(frozen=True)
class Placed:
    """A field at its place in a frame; `name` is unique in the frame."""

    name: str
    field: Field
    first_bit: int


@dataclass(frozen=True)
class Kind:
    """A message of the table; `fixed` and `each` are its fields that stand once, and once a joint."""

    name: str
    priority: int
    sender: str
    boards: tuple[str, ...]
    period_ticks: int
    period_rc_ticks: int
    text: str
    fixed: tuple[Field, ...]
    each: tuple[Field, ...]


@dataclass(frozen=True)
class Board:
    """A node other than the controller; `joints` are indices of hoap2.json."""

    name: str
    node: int
    bus: int
    kind: str
    joints: tuple[int, ...]


@dataclass(frozen=True)
class Frame:
    """A message on a bus: of one board, or of the controller to all (board None)."""

    name: str
    kind: Kind
    board: Board | None
    bus: int
    identifier: int
    length: int
    sender: str
    receivers: tuple[str, ...]
    period_ticks: int  # 0: when needed
    offset_ticks: int
    placed: tuple[Placed, ...]

    @property
    def used_bits(self) -> int:
        return HEADER_BITS + sum(p.field.bits for p in self.placed)


@dataclass(frozen=True)
class Disturbance:
    """A parameter of the modelled link."""

    name: str
    kind: str  # "real" or "int"
    unit: str
    default: float
    low: float
    high: float
    words: tuple[str, ...]
    text: str


@dataclass(frozen=True)
class CanTable:
    """can.toml, resolved."""

    raw: dict
    joint_names: tuple[str, ...]
    buses: tuple[str, ...]
    boards: tuple[Board, ...]
    kinds: tuple[Kind, ...]
    frames: tuple[Frame, ...]
    disturbances: tuple[Disturbance, ...]
    protocol: int

    def of_bus(self, bus: int) -> list[Frame]:
        return [f for f in self.frames if f.bus == bus]


def _step(value: float | str, robot: dict) -> float:
    if not isinstance(value, str):
        return float(value)
    name, _, divisor = value.partition("/")
    steps = {**robot["servo"], **robot["imu"]}
    if not isinstance(steps.get(name), float):
        raise ValueError(f"lsb {value!r}: hoap2.json has no number {name!r} in servo or imu")
    return steps[name] / float(divisor or 1)


def _field(row: dict, where: str, robot: dict, words: dict) -> Field:
    if set(row) - FIELD_KEYS:
        raise ValueError(f"{where}: unknown keys {sorted(set(row) - FIELD_KEYS)}")
    bits, signed, real = row["bits"], row.get("signed", False), row.get("float", False)
    if not 1 <= bits <= 32 or (bits == 32 and not (signed or real)):
        raise ValueError(f"{where}: 1 to 31 bits, or 32 signed or float")
    lsb = _step(row.get("lsb", 1.0), robot)
    lowest, highest = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed or real else (0, (1 << bits) - 1)
    low = round(row["low"] / lsb) if "low" in row else lowest
    high = round(row["high"] / lsb) if "high" in row else highest
    if "enum" in row:
        high = len(words[row["enum"]]) - 1
    if not lowest <= low < high <= highest:
        raise ValueError(f"{where}: range beyond what {bits} bits hold")
    enum = row.get("enum", row.get("enum_of_signals", ""))
    return Field(row["name"], bits, signed, real, row.get("each", ""), row.get("repeat", 1), lsb, low, high,
                 row.get("unit", "1"), enum, row["text"])  # fmt: skip


def _kind(row: dict, robot: dict, words: dict) -> Kind:
    where = f"message {row.get('name')}"
    if set(row) - MESSAGE_KEYS:
        raise ValueError(f"{where}: unknown keys {sorted(set(row) - MESSAGE_KEYS)}")
    fields = [_field(f, f"{where}, field {f.get('name')}", robot, words) for f in row["field"]]
    fixed = tuple(f for f in fields if not f.each)
    each = tuple(f for f in fields if f.each)
    if fields != [*fixed, *each]:
        raise ValueError(f"{where}: fields of the joints stand last")
    period = row.get("period_ticks", 0)
    return Kind(row["name"], row["priority"], row["sender"], tuple(row.get("boards", ())), period,
                row.get("period_rc_ticks", period), row["text"], fixed, each)  # fmt: skip


def _boards(raw: dict, buses: tuple[str, ...], joint_names: tuple[str, ...]) -> tuple[Board, ...]:
    boards = tuple(Board(b["name"], b["node"], buses.index(b["bus"]), b["kind"],
                         tuple(joint_names.index(j) for j in b.get("joints", []))) for b in raw["board"])  # fmt: skip
    driven = sorted(j for b in boards for j in b.joints)
    if driven != list(range(len(joint_names))):
        raise ValueError("boards: every joint has one drive")
    if len({b.node for b in boards}) != len(boards) or not all(1 <= b.node < 1 << NODE_BITS for b in boards):
        raise ValueError(f"boards: nodes 1 to {(1 << NODE_BITS) - 1}, each once")
    return boards


def _place(kind: Kind, board: Board | None, joint_names: tuple[str, ...]) -> tuple[Placed, ...]:
    rows = [(f"{f.name}_{i}" if f.repeat > 1 else f.name, f) for f in kind.fixed for i in range(f.repeat)]
    rows += [(f"{joint_names[j]}_{f.name}", f) for j in (board.joints if board else ()) for f in kind.each]
    placed, bit = [], HEADER_BITS
    for name, field in rows:
        placed.append(Placed(name, field, bit))
        bit += field.bits
    return tuple(placed)


def _frame(kind: Kind, board: Board | None, bus: int, node: int, boards: tuple[Board, ...],
           joint_names: tuple[str, ...]) -> Frame:  # fmt: skip
    placed = _place(kind, board, joint_names)
    bits = HEADER_BITS + sum(p.field.bits for p in placed)
    length = next(n for n in LENGTHS if 8 * n >= bits)
    on_bus = tuple(b.name for b in boards if b.bus == bus)
    # the controller's frames to all, and the emergency stop of any node
    if board is None or kind.sender == "any":
        sender = board.name if board else CONTROLLER
        receivers = tuple(n for n in (CONTROLLER, *on_bus) if n != sender)
        name = f"{kind.name}_{sender}" if kind.sender == "any" else kind.name
    else:
        sender, receivers = (CONTROLLER, (board.name,)) if kind.sender == CONTROLLER else (board.name, (CONTROLLER,))
        name = f"{kind.name}_{board.name}"
    period = kind.period_rc_ticks if board and board.kind == "rc" else kind.period_ticks
    return Frame(name, kind, board, bus, kind.priority << NODE_BITS | node, length, sender, receivers, period,
                 (9 * node) % period if period else 0, placed)  # fmt: skip


def _frames(kinds: tuple[Kind, ...], boards: tuple[Board, ...], buses: tuple[str, ...],
            joint_names: tuple[str, ...]) -> tuple[Frame, ...]:  # fmt: skip
    frames = []
    for kind in kinds:
        for bus in range(len(buses)):
            if kind.sender == "any" or not kind.boards:
                frames.append(_frame(kind, None, bus, 0, boards, joint_names))
            for board in boards:
                if board.bus == bus and (kind.sender == "any" or board.kind in kind.boards):
                    frames.append(_frame(kind, board, bus, board.node, boards, joint_names))
    return tuple(sorted(frames, key=lambda f: (f.bus, f.identifier)))


@lru_cache(maxsize=1)
def load() -> CanTable:
    """Read and check can.toml; ValueError with the row's name where one is wrong."""
    robot, raw = load_robot(), tomllib.loads(CAN_TOML.read_text())
    joint_names = tuple(j["name"] for j in robot["joints"])
    buses = tuple(b["name"] for b in raw["bus"])
    boards = _boards(raw, buses, joint_names)
    kinds = tuple(_kind(row, robot, raw["enum"]) for row in raw["message"])
    if len({k.priority for k in kinds}) != len(kinds) or kinds[0].name != "stop" or kinds[0].priority != 0:
        raise ValueError("messages: one priority each, the emergency stop has 0")
    frames = _frames(kinds, boards, buses, joint_names)
    disturbances = tuple(Disturbance(d["name"], d.get("type", "real"), d.get("unit", "1"), float(d.get("default", 0)),
                                     float(d["range"][0]), float(d["range"][1]), tuple(d.get("words", ())), d["text"])
                         for d in raw["disturbance"])  # fmt: skip
    return CanTable(raw, joint_names, buses, boards, kinds, frames, disturbances, _protocol(raw, frames, joint_names))


def _protocol(raw: dict, frames: tuple[Frame, ...], joint_names: tuple[str, ...]) -> int:
    """16 bits over what two nodes must agree on: identifiers, layouts, steps, ranges, words, parameters."""
    layout = [(f.name, f.bus, f.identifier, f.length, f.period_ticks,
               [(p.name, p.first_bit, p.field.bits, p.field.signed, p.field.real, p.field.lsb, p.field.low,
                 p.field.high) for p in f.placed]) for f in frames]  # fmt: skip
    known = json.dumps([raw["schema"], raw["crc8_poly"], raw["enum"], raw["parameter"], layout, joint_names])
    return int.from_bytes(hashlib.sha256(known.encode()).digest()[:2], "big")
