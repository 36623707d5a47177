"""LCM types: state_t, gait_t and truth_t carry every output of signals.toml; the others are listed here.

The fields of a message stand in the order of the table: header, reals, ints. The same list, as C++ places of the
members, lets the publisher fill a message from a row of the run's signals.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass

from .tables import MESSAGES, Signal, Table

PACKAGE = "hoap2_lcm"
BANNER = "Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit."
LCM_TYPES = {"real": "double", "int": "int32_t"}
PREFIX = {"controller": "c", "plant": "p"}


@dataclass(frozen=True)
class Field:
    """One member of a message; `size` as it stands in the .lcm file: numbers, or the name of a count."""

    kind: str
    name: str
    text: str
    size: tuple[str, ...] = ()

    def line(self) -> str:
        return f"  // {self.text}\n  {self.kind} {self.name}{''.join(f'[{n}]' for n in self.size)};"


@dataclass(frozen=True)
class Message:
    """One LCM type; `constants` are (kind, name, value)."""

    name: str
    text: str
    fields: tuple[Field, ...]
    constants: tuple[tuple[str, str, int], ...] = ()

    def text_of_file(self) -> str:
        lines = [f"// {BANNER}", f"package {PACKAGE};", "", f"// {self.text}", f"struct {self.name} {{"]
        lines += [field.line() for field in self.fields]
        lines += [f"  const {kind} {name} = {value};" for kind, name, value in self.constants]
        return "\n".join([*lines, "}"]) + "\n"


def _fields(rows: list[tuple[str, ...]]) -> tuple[Field, ...]:
    return tuple(Field(kind, name, text, tuple(size)) for kind, name, text, *size in rows)


HEADER = _fields([
    ("int64_t", "run_id", "random, one for each run; record.run_id of its run.toml"),
    ("int64_t", "sequence", "counts the messages of this channel and run from 0"),
    ("int64_t", "tick", "tick of the run that this message tells of"),
    ("int64_t", "time_us", "simulated time, us"),
])  # fmt: skip
STATES = (("int32_t", "RUNNING", 0), ("int32_t", "PAUSED", 1), ("int32_t", "ENDED", 2))

HEALTH = Message("health_t", "How the run is doing on its machine; the only message that tells of the wall clock.",
    HEADER + _fields([
        ("double", "controller_us", "controller step, mean since the last message"),
        ("double", "controller_max_us", "controller step, longest since the last message"),
        ("double", "plant_us", "plant step, mean since the last message"),
        ("double", "plant_max_us", "plant step, longest since the last message"),
        ("double", "telemetry_us", "telemetry a tick, mean since the last message"),
        ("double", "lag_us", "how far a paced run is behind the wall clock; 0 when not paced"),
        ("double", "real_time_factor", "simulated over wall time since the last message"),
        ("int64_t", "overruns", "batches of ticks that ended after their deadline, so far"),
        ("int64_t", "published", "messages sent live so far"),
        ("int64_t", "dropped", "messages that the transport refused so far"),
        ("int64_t", "decimated", "messages of the log that were left out of the live view so far"),
        ("int32_t", "fault", "fault word of the controller"),
        ("int32_t", "paced", "1 when the run keeps to the wall clock"),
        ("int32_t", "state", "RUNNING, PAUSED or ENDED"),
    ]), STATES)  # fmt: skip

EVENT = Message("event_t", "Something happened.",
    HEADER + _fields([
        ("string", "kind", "run_started, step, fault, fall, command_accepted, command_refused, push, run_ended, note"),
        ("string", "text", "for people"),
    ]))  # fmt: skip

RUN_FIELDS = HEADER + _fields([
    ("string", "scenario", "name"),
    ("string", "title", "title of the scenario"),
    ("int64_t", "seed", "0 is the nominal run"),
    ("string", "sensors", "sensor preset"),
    ("string", "version", "of this project"),
    ("int64_t", "schema_hash", "SCHEMA_HASH of the sender: of the table of signals and the names in it"),
    ("double", "duration_s", "planned, simulated"),
    ("int32_t", "accepts_commands", "1 when the run listens to commands"),
    ("int32_t", "state", "RUNNING, PAUSED or ENDED"),
    ("string", "run_toml", "text of run.toml"),
    ("string", "folder", "run folder, where the run is made"),
])  # fmt: skip

COMMAND = Message("command_t", "Asks the run for something.",
    _fields([
        ("int64_t", "run_id", "run that is meant"),
        ("int64_t", "command_id", "chosen by the sender; the answer carries it"),
        ("string", "kind", "what is asked for"),
        ("string", "name", "what it is about: a parameter, a link"),
        ("int32_t", "n", "length of value"),
        ("double", "value", "numbers of the command", "n"),
        ("string", "sender", "who asks, for the log"),
    ]))  # fmt: skip

ANSWER = Message("answer_t", "The run's answer to a command.",
    HEADER + _fields([
        ("int64_t", "command_id", "of the command"),
        ("int32_t", "accepted", "1 accepted, 0 refused"),
        ("string", "reason", "why it is refused"),
        ("string", "kind", "of the command"),
        ("string", "name", "of the command"),
        ("int32_t", "n", "length of value"),
        ("double", "value", "numbers as they were taken", "n"),
    ]))  # fmt: skip

TEXTS = {
    "state": "What the robot senses, and the references of its drives. Every tick.",
    "gait": "What the controller does: mode, gait, estimates, references, faults. Every tick.",
    "truth": "What the plant knows and the robot does not. Every tenth tick.",
}


def field_name(signal: Signal) -> str:
    """The signal's name; one that the header has already gets its product in front."""
    taken = {field.name for field in HEADER}
    return f"{signal.product}_{signal.name}" if signal.name in taken else signal.name


def carried(table: Table, message: str) -> list[Signal]:
    """The outputs that this message carries, in its order: reals first, controller before plant."""
    rows = [s for p in PREFIX for s in table.select(p, "output") if s.telemetry == message]
    return [s for s in rows if s.kind == "real"] + [s for s in rows if s.kind == "int"]


def _of_signals(table: Table, name: str) -> Message:
    fields = []
    for s in carried(table, name):
        words = ", ".join(f"{i} {word}" for i, word in enumerate(table.enums[s.enum])) if s.enum else ""
        unit = f" [{s.unit}]" if s.kind == "real" else ""
        text = s.text + unit + (f" ({words})" if words else "")
        fields.append(Field(LCM_TYPES[s.kind], field_name(s), text, tuple(map(str, s.shape))))
    if len({f.name for f in (*HEADER, *fields)}) != len(HEADER) + len(fields):
        raise ValueError(f"telemetry {name}: two outputs have one name")
    return Message(f"{name}_t", TEXTS[name], HEADER + tuple(fields))


def schema_hash(table: Table) -> int:
    """63 bits over what a receiver must know to read the messages: outputs, labels, enums, faults."""
    outputs = [(s.product, s.name, s.kind, s.shape, s.unit, s.enum, s.telemetry)
               for p in PREFIX for s in table.select(p, "output")]  # fmt: skip
    known = json.dumps([table.schema, table.tick_us, outputs, table.labels, table.enums, table.faults])
    return int.from_bytes(hashlib.sha256(known.encode()).digest()[:8], "big") >> 1


def messages(table: Table) -> list[Message]:
    run = Message("run_t", "Which run this is: at its start, each second of the wall clock, at its end.", RUN_FIELDS,
                  (*STATES, ("int64_t", "SCHEMA_HASH", schema_hash(table))))  # fmt: skip
    return [*(_of_signals(table, name) for name in MESSAGES), HEALTH, EVENT, run, COMMAND, ANSWER]


def files(table: Table) -> dict[str, str]:
    """Name of each .lcm file -> its text."""
    return {f"{message.name}.lcm": message.text_of_file() for message in messages(table)}


def places_header(table: Table) -> str:
    """C++: where the outputs lie in the messages, in the order of `carried`."""
    out = [f"// {BANNER}", "#ifndef HOAP2_TELEMETRY_PLACES_H", "#define HOAP2_TELEMETRY_PLACES_H", "#include <cstddef>"]
    out += [f'#include "{PACKAGE}/{name}_t.hpp"' for name in MESSAGES]
    out += ["", "namespace hoap2::telemetry {", "", "struct place_t {", "  std::size_t offset;",
            "  int count;", "  bool real; // double; else int32_t", "};", "",
            "struct fault_name_t {", "  int bit;", "  const char *name;", "};", ""]  # fmt: skip
    faults = ", ".join(f'{{{bit}, "{name}"}}' for name, bit in table.faults.items())
    modes = ", ".join(f'"{name}"' for name in table.enums["mode"])
    out += [f"inline constexpr fault_name_t FAULT_NAMES[] = {{{faults}}};",
            f"inline constexpr const char *MODE_NAMES[] = {{{modes}}};"]  # fmt: skip
    for name in MESSAGES:
        of_type = f"{PACKAGE}::{name}_t"
        out.append(f"inline constexpr place_t {name.upper()}_PLACES[] = {{")
        for s in carried(table, name):
            real = "true" if s.kind == "real" else "false"
            out.append(f"    {{offsetof({of_type}, {field_name(s)}), {s.count}, {real}}},")
        out.append("};")
    return "\n".join([*out, "", "} // namespace hoap2::telemetry", "#endif"]) + "\n"


RATES = {
    "state_t": "1 kHz", "gait_t": "1 kHz", "truth_t": "100 Hz", "health_t": "100 Hz", "event_t": "when it happens",
    "run_t": "at start and end; live also each second of the wall clock", "command_t": "when somebody asks",
    "answer_t": "to each command",
}  # fmt: skip


def page(table: Table) -> str:
    """docs/generated/telemetry.md: every message with its fields."""
    out = ["# LCM messages", "", "Generated from `firmware/signals.toml`: do not edit. How they are used: "
           "[telemetry.md](../telemetry.md).", "",
           f"Package `{PACKAGE}`, schema {schema_hash(table)}. All but `command_t` begin with the same four fields:", ""]  # fmt: skip
    out += _rows(HEADER)
    for message in messages(table):
        channel = f"HOAP2_{message.name.removesuffix('_t').upper()}"
        common = message.fields[: len(HEADER)] == HEADER
        out += [f"## `{channel}`: {message.name}, {RATES[message.name]}", "", message.text, ""]
        out += _rows(message.fields[len(HEADER) :] if common else message.fields)
        if message.constants:
            words = [f"{name} = {value}" for _, name, value in message.constants if name != "SCHEMA_HASH"]
            out += [f"Constants: {', '.join(words)}.", ""]
    return "\n".join(out)


def _rows(fields: tuple[Field, ...]) -> list[str]:
    lines = ["| field | type | |", "|---|---|---|"]
    return [*lines, *(f"| `{f.name}` | {f.kind}{''.join(f'[{n}]' for n in f.size)} | {f.text} |" for f in fields), ""]
