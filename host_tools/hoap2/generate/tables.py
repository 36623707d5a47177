"""The two source tables, read and checked."""

from __future__ import annotations

import json
import math
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
ROBOT_JSON = ROOT / "firmware" / "hoap2.json"
SIGNALS_TOML = ROOT / "firmware" / "signals.toml"
PRODUCTS = ("controller", "plant")
GROUPS = ("input", "output", "parameter")
MESSAGES = ("state", "gait", "truth")  # the LCM messages that carry outputs


@dataclass(frozen=True)
class Signal:
    """One row of signals.toml with everything resolved.

    default: one number an element, row-major.
    """

    product: str
    group: str
    name: str
    kind: str  # "real" or "int"
    shape: tuple[int, ...]
    size_names: tuple[str, ...]
    unit: str
    default: tuple[float, ...]
    low: float
    high: float
    tunable: bool
    enum: str
    text: str
    telemetry: str = ""  # the LCM message that carries this output
    operator: bool = False  # an input that no output of the other product drives

    @property
    def count(self) -> int:
        return math.prod(self.shape)


@dataclass
class Table:
    """signals.toml and hoap2.json together."""

    robot: dict
    sizes: dict[str, int]
    labels: dict[str, list[str]]
    enums: dict[str, list[str]]
    faults: dict[str, int]
    fault_texts: dict[str, str]
    tick_us: int
    schema: int
    signals: list[Signal] = field(default_factory=list)

    def select(self, product: str, group: str) -> list[Signal]:
        """Rows of one product and group, reals first, each in file order (the C layout)."""
        rows = [s for s in self.signals if s.product == product and s.group == group]
        return [s for s in rows if s.kind == "real"] + [s for s in rows if s.kind == "int"]

    def element_names(self, signal: Signal) -> list[str]:
        """FMI 2 structured name of each element, row-major: `r_knee.q_ref_rad`, `com_W_m.x`, `push[1].x`."""
        names = [signal.name]
        for axis in signal.size_names:
            labels = self.labels.get(axis)
            if axis == "joint":
                names = [f"{label}.{name}" for name in names for label in labels]
            elif labels:
                names = [f"{name}.{label}" for name in names for label in labels]
            else:
                names = [f"{name}[{i + 1}]" for name in names for i in range(self.sizes[axis])]
        return names


def load_robot() -> dict:
    return json.loads(ROBOT_JSON.read_text())


def _resolve_default(value, count: int, robot: dict) -> tuple[float, ...]:
    if isinstance(value, str):
        kind, key = value.split(":")
        if kind == "servo":
            inner = robot["servo"]["velocity_loop_1_s"]
            outer = robot["servo"]["position_loop_1_s"] if key == "kp" else 1.0
            return tuple(j["armature_kgm2"] * inner * outer for j in robot["joints"])
        if kind == "posture":
            angles = robot["postures_deg"][key]
            return tuple(math.radians(angles.get(j["name"], 0.0)) for j in robot["joints"])
        raise ValueError(f"unknown default {value!r}")
    if isinstance(value, list):
        if len(value) != count:
            raise ValueError(f"default {value} has {len(value)} elements, not {count}")
        return tuple(float(v) for v in value)
    return (float(value),) * count


def load() -> Table:
    """Read both tables; raise ValueError with the row's name where one is wrong."""
    robot = load_robot()
    raw = tomllib.loads(SIGNALS_TOML.read_text())
    labels = dict(raw["label"])
    labels["joint"] = [j["name"] for j in robot["joints"]]
    faults = {name: row["bit"] for name, row in raw["fault"].items()}
    fault_texts = {name: row["text"] for name, row in raw["fault"].items()}
    table = Table(robot, raw["size"], labels, raw["enum"], faults, fault_texts, raw["tick_us"], raw["schema"])
    for product in PRODUCTS:
        for group in GROUPS:
            for row in raw[product][group]:
                table.signals.append(_signal(table, product, group, row))
        _check_operator_inputs(table, product)
    return table


def _check_operator_inputs(table: Table, product: str) -> None:
    """What the other product drives lies in one piece: of each kind, the operator's inputs come last."""
    for kind in ("real", "int"):
        of_operator = [s.operator for s in table.select(product, "input") if s.kind == kind]
        if of_operator != sorted(of_operator):
            raise ValueError(f"{product}.input: the {kind} inputs from the operator must come last")


def _signal(table: Table, product: str, group: str, row: dict) -> Signal:
    known = {"name", "size", "type", "unit", "default", "range", "tunable", "enum", "text", "telemetry", "from"}
    where = f"{product}.{group} {row.get('name')}"
    if set(row) - known:
        raise ValueError(f"{where}: unknown keys {sorted(set(row) - known)}")
    names = tuple(row.get("size", []))
    shape = tuple(table.sizes[n] for n in names)
    low, high = row.get("range", (-math.inf, math.inf))
    if group == "parameter" and "range" not in row:
        raise ValueError(f"{where}: a parameter needs a range")
    default = _resolve_default(row.get("default", 0.0), math.prod(shape), table.robot)
    if not all(low <= d <= high for d in default):
        raise ValueError(f"{where}: default outside its range")
    if row.get("enum", "") and row["enum"] not in table.enums:
        raise ValueError(f"{where}: unknown enum {row['enum']}")
    if (group == "output") != (row.get("telemetry") in MESSAGES):
        raise ValueError(f"{where}: an output, and nothing else, needs telemetry = one of {', '.join(MESSAGES)}")
    if "from" in row and (row["from"] != "operator" or group != "input"):
        raise ValueError(f"{where}: only an input is from somebody, and that is the operator")
    return Signal(product, group, row["name"], row.get("type", "real"), shape, names, row.get("unit", "1"), default,
                  float(low), float(high), row.get("tunable", False), row.get("enum", ""), row["text"],
                  row.get("telemetry", ""), "from" in row)
