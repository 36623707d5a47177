"""Scenarios: one TOML file each, checked, with overrides, resolved into parameters of both products."""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from hoap2 import bounds, metric_names, parameters, soil_presets
from hoap2.can import parameters as can_parameters
from hoap2.errors import UserError
from hoap2.generate.tables import PRODUCTS, ROOT

FOLDER = ROOT / "sim" / "scenarios"
SCENARIO_KEYS = {"name", "title", "section", "text", "duration_s", "sensors", "solver", "link"}
RUN_KEYS = {"stop_after_fall_s": (0.0, 60.0), "settle_s": (0.0, 60.0), "stand_speed_m_s": (0.0, 1.0)}
RUN_DEFAULTS = {"stop_after_fall_s": 1.0, "settle_s": 2.0, "stand_speed_m_s": 0.02}
PUSH_KEYS = {"link", "force_W_N", "point_L_m", "start_s", "duration_s", "ramp_s"}
BLOCK_KEYS = {"centre_W_m", "size_m", "yaw_W_rad"}
TABLES = {"scenario", "controller", "plant", "can", "soil", "push", "block", "bounds", "run", "record"}
DURATION_RANGE_S = (0.01, 600.0)
# Both products must agree on these; given for one, they hold for the other.
MIRRORED = (("start_pos_W_m", "start_pos_W_m"), ("start_yaw_W_rad", "start_yaw_W_rad"),
            ("posture_rad", "start_posture_rad"))  # fmt: skip


@dataclass
class Scenario:
    """A scenario with everything resolved.

    explicit: names ("plant.friction_mu") set in the file or on the command line.
    forced: the ones of the command line, which a seed's draws leave alone.
    """

    name: str
    title: str
    section: str
    text: str
    duration_s: float
    values: parameters.Values
    bounds: dict[str, bounds.Bound]
    options: dict[str, float]
    seed: int = 0
    draws: dict = field(default_factory=dict)
    explicit: set[str] = field(default_factory=set)
    forced: set[str] = field(default_factory=set)
    link: str = "direct"  # or "can", "ls-bus"
    can: dict[str, float] = field(default_factory=can_parameters.defaults)  # of the modelled link

    @property
    def sensors(self) -> str:
        preset = int(self.values["plant"]["sensor_preset"][0])
        return parameters.table().enums["sensor_preset"][preset]

    @property
    def steps_planned(self) -> int:
        """Steps of the walk that the controller's parameters ask for."""
        values = self.values["controller"]
        walks = parameters.table().enums["behaviour"][int(values["behaviour"][0])] == "walk_cp"
        return int(values["steps_forward"][0] + values["steps_in_place"][0]) if walks else 0


def names() -> list[str]:
    """The scenarios that come with the project."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def _find(name: str) -> Path:
    if name.endswith(".toml") or "/" in name:
        path = Path(name)
        if not path.is_file():
            inside = f"; a run is repeated by its own {path / 'run.toml'}" if (path / "run.toml").is_file() else ""
            raise UserError(f"no scenario file {name}",
                            f"give a name of `./hoap2 list` or the path of a .toml file{inside}")  # fmt: skip
        return path
    if name not in names():
        error = parameters.unknown("scenario", name, names())
        raise UserError(error.message, f"{error.hint} (`./hoap2 list` shows them all)")
    return FOLDER / f"{name}.toml"


def load(name: str, overrides: list[str] | None = None, sensors: str | None = None,
         duration_s: float | None = None) -> Scenario:  # fmt: skip
    """Read a scenario by name or path, apply `a.b=value` overrides, check and resolve it."""
    path = _find(name)
    try:
        raw = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, OSError) as error:
        raise UserError(f"{path}: {error}") from None
    try:
        return _resolve(raw, path, overrides or [], sensors, duration_s)
    except UserError as error:
        raise UserError(f"{path.name}: {error.message}", error.hint) from None


def _resolve(raw: dict, path: Path, overrides: list[str], sensors: str | None, duration_s: float | None) -> Scenario:
    _check_tables(raw)
    forced = {_override(raw, text) for text in overrides}
    if sensors is not None:
        raw["scenario"]["sensors"] = sensors
        forced.add("plant.sensor_preset")
    if duration_s is not None:
        raw["scenario"]["duration_s"] = duration_s
    _check_tables(raw)
    head = raw["scenario"]
    if "sensors" in head:
        raw.setdefault("plant", {})["sensor_preset"] = head["sensors"]
    if "solver" in head:
        raw.setdefault("plant", {})["solver"] = head["solver"]
    _expand(raw, "push", PUSH_KEYS, "push", _push)
    _expand(raw, "block", BLOCK_KEYS, "block", _block)
    values, explicit = _parameters(raw, soil_presets.resolve(raw, forced))
    options = RUN_DEFAULTS | {k: _number(f"run.{k}", v, *RUN_KEYS[k]) for k, v in raw.get("run", {}).items()}
    scenario = Scenario(
        name=_name(head.get("name", path.stem)), title=head["title"], section=head.get("section", ""),
        text=" ".join(head.get("text", "").split()), duration_s=0.0, values=values,
        bounds=bounds.parse(raw.get("bounds", {}), metric_names.NAMES), options=options, explicit=explicit,
        forced=forced, link=_link(head.get("link", "direct")), can=can_parameters.check(raw.get("can", {})),
    )  # fmt: skip
    if scenario.link != "direct" and "controller.stale_limit_ticks" not in explicit:
        values["controller"]["stale_limit_ticks"] = (float(can_parameters.STALE_LIMIT_TICKS),)
    if scenario.link != "can" and raw.get("can"):
        raise UserError("[can] is for runs over CAN", "add link = \"can\" to [scenario], or --link can")
    wanted = head.get("duration_s", _own_duration(scenario))
    scenario.duration_s = _whole_ticks(_number("scenario.duration_s", wanted, *DURATION_RANGE_S))
    record = raw.get("record", {})
    scenario.seed, scenario.draws = int(record.get("seed", 0)), dict(record.get("draws", {}))
    return scenario


def _link(name: str) -> str:
    if name not in can_parameters.LINKS:
        raise parameters.unknown("link", name, can_parameters.LINKS)
    return name


def _name(name) -> str:
    """The name of a scenario is that of its folder of runs."""
    if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9._-]*", name):
        raise UserError(f"scenario name {name!r} cannot name a folder", "use letters, digits, '-', '_' and '.'")
    return name


def _own_duration(scenario: Scenario) -> float:
    """Without duration_s: start-up, calibration, the walk and a time of standing after it."""
    values = scenario.values["controller"]
    before = values["start_up_s"][0] + values["calibrate_s"][0]
    walk = values["start_shift_s"][0] + scenario.steps_planned * values["step_time_s"][0]
    return before + (walk if scenario.steps_planned else 0.0) + scenario.options["settle_s"]


def _whole_ticks(duration_s: float) -> float:
    tick_us = parameters.table().tick_us
    return math.ceil(duration_s * 1e6 / tick_us - 1e-6) * tick_us / 1e6


def _number(where: str, value, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UserError(f"{where} needs a number, not {value!r}")
    if not low <= value <= high:
        raise UserError(f"{where} = {value:g} is out of range [{low:g}, {high:g}]")
    return float(value)


def _check_tables(raw: dict) -> None:
    for name, content in raw.items():
        if name not in TABLES:
            raise parameters.unknown("table", name, TABLES)
        wanted = list if name in ("push", "block") else dict
        if not isinstance(content, wanted):
            raise UserError(f"{name} must be written [[{name}]]" if wanted is list else f"{name} must be a table")
    head = raw.get("scenario", {})
    for key, value in head.items():
        if key not in SCENARIO_KEYS:
            raise parameters.unknown("key of [scenario]", key, SCENARIO_KEYS)
        if key != "duration_s" and not isinstance(value, str):
            raise UserError(f"scenario.{key} needs a text, not {value!r}")
    if "title" not in head:
        raise UserError("[scenario] needs a title")
    for key in raw.get("run", {}):
        if key not in RUN_KEYS:
            raise parameters.unknown("key of [run]", key, RUN_KEYS)


def _override(raw: dict, text: str) -> str:
    """Put one `a.b=value` into the raw document; returns the full name it sets."""
    target, equals, literal = text.partition("=")
    target = target.strip()
    if not equals or "." not in target:
        raise UserError(f"--set {text!r}: write it as table.name=value, for example controller.step_length_m=0.02")
    try:
        value = tomllib.loads(f"v = {literal.strip()}")["v"]
    except tomllib.TOMLDecodeError:
        value = literal.strip()
    head, _, rest = target.partition(".")
    if head not in TABLES - {"record"}:
        raise parameters.unknown(f"table in --set {target}:", head, TABLES - {"record"})
    if head in ("push", "block"):
        number, _, key = rest.partition(".")
        count = len(raw.get(head, []))
        if not number.isdigit() or not 1 <= int(number) <= count or not key:
            raise UserError(f"--set {target}: the scenario has {count} of [[{head}]]; write {head}.1.name=value")
        raw[head][int(number) - 1][key] = value
    elif head == "bounds":
        name, _, side = rest.rpartition(".")
        if side not in ("min", "max") or not name:
            raise UserError(f"--set {target}: write it as bounds.<metric>.min=... or bounds.<metric>.max=...")
        raw.setdefault("bounds", {}).setdefault(name, {})[side] = value
    else:
        raw.setdefault(head, {})[rest] = value
    return target


def _expand(raw: dict, name: str, keys: set[str], size: str, convert) -> None:
    """Turn [[push]] or [[block]] entries into the plant's arrays."""
    entries = raw.get(name, [])
    if not entries:
        return
    limit = parameters.table().sizes[size]
    if len(entries) > limit:
        raise UserError(f"at most {limit} of [[{name}]], not {len(entries)}")
    plant = raw.setdefault("plant", {})
    arrays: dict[str, list] = {}
    for number, entry in enumerate(entries, 1):
        for key in entry:
            if key not in keys:
                raise parameters.unknown(f"key of [[{name}]]", key, keys)
        for key, value in convert(entry, f"[[{name}]] {number}").items():
            arrays.setdefault(key, []).append(value)
    for key, rows in arrays.items():
        if key in plant:
            raise UserError(f"give either [[{name}]] or plant.{key}, not both")
        signal = parameters.known("plant")[key]
        width = signal.count // signal.shape[0]
        rest = signal.default[len(rows) * width :]
        padding = [list(rest[i : i + 3]) for i in range(0, len(rest), 3)] if width > 1 else list(rest)
        plant[key] = rows + padding
    if name == "block":
        plant["block_count"] = len(entries)


def _field(entry: dict, where: str, key: str, length: int, default=None):
    value = entry.get(key, default)
    if value is None:
        raise UserError(f"{where} needs {key}")
    items = value if isinstance(value, list) else [value]
    if isinstance(value, list) != (length > 1) or len(items) != length or any(
        isinstance(v, bool) or not isinstance(v, int | float) for v in items
    ):
        raise UserError(f"{where}: {key} needs {'a number' if length == 1 else f'{length} numbers'}, not {value!r}")
    return value


def _push(entry: dict, where: str) -> dict:
    links = [link["name"] for link in parameters.table().robot["links"]]
    if entry.get("link", "chest") not in links:
        raise parameters.unknown(f"link in {where}", str(entry["link"]), links)
    return {
        "push_link": links.index(entry.get("link", "chest")),
        "push_force_W_N": _field(entry, where, "force_W_N", 3),
        "push_point_L_m": _field(entry, where, "point_L_m", 3, [0.0, 0.0, 0.0]),
        "push_start_s": _field(entry, where, "start_s", 1),
        "push_duration_s": _field(entry, where, "duration_s", 1),
        "push_ramp_s": _field(entry, where, "ramp_s", 1, 0.0),
    }


def _block(entry: dict, where: str) -> dict:
    return {
        "block_centre_W_m": _field(entry, where, "centre_W_m", 3),
        "block_size_m": _field(entry, where, "size_m", 3),
        "block_yaw_W_rad": _field(entry, where, "yaw_W_rad", 1, 0.0),
    }


def _parameters(raw: dict, preset: dict[str, object]) -> tuple[parameters.Values, set[str]]:
    values, explicit = parameters.defaults(), set()
    for name, value in preset.items():
        values["plant"][name] = parameters.check("plant", name, value)
    for product in PRODUCTS:
        for name, value in raw.get(product, {}).items():
            values[product][name] = parameters.check(product, name, value)
            explicit.add(f"{product}.{name}")
    for ours, theirs in MIRRORED:
        pair = (("controller", ours), ("plant", theirs))
        for (a, name_a), (b, name_b) in (pair, pair[::-1]):
            if f"{a}.{name_a}" in explicit and f"{b}.{name_b}" not in explicit:
                values[b][name_b] = values[a][name_a]
    return values, explicit
