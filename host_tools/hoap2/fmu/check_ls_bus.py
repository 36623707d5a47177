"""Checks of the FMUs with bus terminals: files, bytes, states, steps, and the loop of all three (docs/ls_bus.md)."""

from __future__ import annotations

import ctypes
import time
import zipfile
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

import fmpy
import fmpy.validation
import numpy as np
from lxml import etree

from ..generate import can_table, ls_bus
from ..generate.tables import PRODUCTS
from .check import Check, Context, require
from .check_files import SCHEMAS, schema_findings
from .instance import FmuInstance
from .ls_bus_loop import LsBusLoop, Terminals, open_loop
from .pair import Pair

TICKS = 1200
MANIFEST = "extra/org.fmi-standard.fmi-ls-bus/fmi-ls-manifest.xml"
TERMINALS = "terminalsAndIcons/terminalsAndIcons.xml"
LS = "{http://fmi-standard.org/fmi-ls-manifest}"
# What a node sends first: 1 Mbit/s, 5 Mbit/s, arbitration lost: buffer and retransmit. By the standard's tables.
FIRST_BYTES = bytes.fromhex("40000000 0d000000 01 40420f00 40000000 0d000000 02 404b4c00 40000000 0a000000 04 01")


def file_of(context: Context, flavour: str) -> Path:
    return context.files.ls_bus(flavour)


@contextmanager
def running(context: Context, stale_limit_ticks: int = 4):
    """A started loop."""
    files = {f: file_of(context, f) for f in ls_bus.FLAVOURS}
    loop, opened = open_loop(files, {"controller": {"stale_limit_ticks": stale_limit_ticks}})
    try:
        yield loop
    finally:
        for fmu in opened:
            fmu.close()


def outputs(loop: LsBusLoop) -> bytes:
    """All outputs of controller and plant."""
    sides = (loop.controller.fmu, loop.plant.fmu)
    for fmu in sides:
        fmu.read()
    return b"".join(array.tobytes() for fmu in sides for array in (fmu.outputs_real, fmu.outputs_int))


def run(loop: LsBusLoop, ticks: int) -> list[bytes]:
    """The outputs at each tick from now on."""
    rows = [outputs(loop)]
    for _ in range(ticks):
        loop.advance()
        rows.append(outputs(loop))
    return rows


def require_equal_rows(a: list[bytes], b: list[bytes], what: str) -> None:
    points = [i for i, (x, y) in enumerate(zip(a, b, strict=True)) if x != y]
    require(not points, f"{what}: outputs differ from tick {points[0] if points else 0} on")


def validate(context: Context, flavour: str) -> str:
    problems = fmpy.validation.validate_fmu(str(file_of(context, flavour)))
    require(not problems, "; ".join(problems[:3]))
    return "no findings"


def _check_terminal(terminal: etree._Element, variables: dict[str, etree._Element]) -> None:
    """One network terminal as the layered standard has it; the schema knows nothing of this."""
    name = terminal.get("name")
    kind = (terminal.get("terminalKind"), terminal.get("matchingRule"))
    require(kind == ("org.fmi-ls-bus.network-terminal", "org.fmi-ls-bus.transceiver"), f"{name}: {kind}")
    members = {m.get("memberName"): variables.get(m.get("variableName")) for m in terminal}
    require(set(members) == set(ls_bus.MEMBERS) and None not in members.values(), f"{name}: members {sorted(members)}")
    wanted = {"Rx_Clock": ("Clock", "input", "triggered"), "Tx_Clock": ("Clock", "input", "countdown"),
              "Rx_Data": ("Binary", "input", None), "Tx_Data": ("Binary", "output", None)}  # fmt: skip
    for member, expected in wanted.items():
        v = members[member]
        found = (v.tag, v.get("causality"), v.get("intervalVariability"))
        require(found == expected and v.get("variability") == "discrete", f"{name}.{member}: {found}")
        if v.tag == "Binary":
            clock = members[member.replace("Data", "Clock")].get("valueReference")
            require(v.get("clocks") == clock, f"{name}.{member} is of clock {v.get('clocks')}, not {clock}")
            require(v.get("mimeType") == ls_bus.MIME_TYPE, f"{name}.{member}: {v.get('mimeType')}")
    require(members["Rx_Data"].find("Start") is not None, f"{name}.Rx_Data has no start value")


def schemas(context: Context, flavour: str) -> str:
    """XML against the standard's schemas, and the layered standard's own rules on terminals and manifest."""
    with zipfile.ZipFile(file_of(context, flavour)) as archive:
        text = {name: archive.read(name) for name in ("modelDescription.xml", TERMINALS, MANIFEST)}
    judges = {"modelDescription.xml": "fmi3ModelDescription.xsd", TERMINALS: "fmi3TerminalsAndIcons.xsd"}
    for name, schema in judges.items():
        findings = schema_findings(text[name], SCHEMAS / "fmi3" / schema)
        require(not findings, f"{name}: {'; '.join(findings)}")
    variables = {v.get("name"): v for v in etree.fromstring(text["modelDescription.xml"]).find("ModelVariables")}
    found = etree.fromstring(text[TERMINALS]).findall("Terminals/Terminal")
    names = [t.get("name") for t in found]
    require(names == ls_bus.terminals(can_table.load(), flavour), f"terminals {names}")
    for terminal in found:
        _check_terminal(terminal, variables)
    manifest = dict(etree.fromstring(text[MANIFEST]).attrib)
    is_bus = "true" if flavour == ls_bus.BUS else "false"
    expected = {f"{LS}fmi-ls-name": "org.fmi-standard.fmi-ls-bus", f"{LS}fmi-ls-version": ls_bus.VERSION,
                f"{LS}fmi-ls-description": ls_bus.MANIFEST_TEXT, "isBusSimulationFMU": is_bus}  # fmt: skip
    require(manifest == expected, f"manifest: {manifest}")
    return f"{len(names)} terminals, manifest of {ls_bus.VERSION}"


def golden_bytes(context: Context) -> str:
    """What nodes send first, by the standard's tables."""
    for flavour in PRODUCTS:
        sent = first_sent(file_of(context, flavour), flavour)
        for name, data in sent.items():
            require(data.startswith(FIRST_BYTES), f"{flavour} {name} begins with {data[:36].hex(' ')}")
            frame = data[len(FIRST_BYTES) :]
            require(frame[:4] == bytes.fromhex("11000000"), f"{flavour} {name} goes on with {frame[:17].hex(' ')}")
            length, used = int.from_bytes(frame[4:8], "little"), int.from_bytes(frame[15:17], "little")
            require(length == 17 + used and frame[12:15] == b"\0\1\0", f"{flavour} {name}: frame {frame[:17].hex(' ')}")
    return "configuration, then CAN FD frames with bit rate switch"


def first_sent(path: Path, flavour: str) -> dict[str, bytes]:
    """What each terminal of a node sends at the start, with nothing connected."""
    with FmuInstance(path, flavour, event_mode=True) as fmu:
        fmu.initialize()
        part = Terminals(fmu, ls_bus.terminals(can_table.load(), flavour))
        sink = Sink(part.count)
        part.peers = [(sink, i) for i in range(part.count)]
        part.update()
        part.ask_countdowns(0)
        part.send(0)
        return dict(zip(part.names, sink.bytes, strict=True))


class Sink:
    """Takes what a terminal sends and keeps it."""

    def __init__(self, count: int):
        self.bytes = [b""] * count

    def take(self, place: int, address: int, size: int) -> None:
        self.bytes[place] += ctypes.string_at(address, size) if size else b""


def loop_equals_link(context: Context) -> str:
    """The three FMUs against the modelled link between the FMUs without terminals."""
    from ..can.link import CanLink
    from ..can.parameters import defaults
    from ..products import FmuSide

    with running(context) as loop:
        began = time.perf_counter()
        rows = run(loop, TICKS)
        us = (time.perf_counter() - began) / TICKS * 1e6
    reference = []
    controller = FmuInstance(context.files.fmu("controller", 3), "controller")
    plant = FmuInstance(context.files.fmu("plant", 3), "plant")
    with controller, plant:
        controller.set_parameters({"stale_limit_ticks": 4})
        logs = []
        for fmu in (controller, plant):
            fmu.initialize()
            logs.append((np.zeros((TICKS + 1, fmu.outputs_real.size)),
                         np.zeros((TICKS + 1, fmu.outputs_int.size), np.int32)))  # fmt: skip
        writes = CanLink(defaults(), 0).writers(FmuSide(controller), FmuSide(plant), *logs)
        for k in range(TICKS + 1):
            for fmu, (real, integer) in zip((controller, plant), logs, strict=True):
                fmu.read()
                real[k], integer[k] = fmu.outputs_real, fmu.outputs_int
            reference.append(b"".join(array[k].tobytes() for log in logs for array in log))
            for write in writes:
                write(k)
            for fmu in (controller, plant):
                fmu.step()
    require_equal_rows(rows, reference, "three FMUs and --link can")
    return f"{TICKS} ticks equal to --link can; {us:.0f} us a tick"


def states(context: Context) -> str:
    """Saved in the middle, gone on with, gone back to, and taken over by other instances."""
    with running(context) as loop:
        loop.advance(TICKS // 2)
        saved = loop.save()
        first = run(loop, TICKS // 4)
        loop.restore(saved)
        require_equal_rows(run(loop, TICKS // 4), first, "after a restore")
    with running(context) as other:
        other.restore(saved)
        require_equal_rows(run(other, TICKS // 4), first, "in other instances")
    return f"{len(saved[1])} FMUs restored; {TICKS // 4} ticks equal"


def odd_steps(context: Context) -> str:
    """Steps that are no part of a tick: nodes tick as each whole millisecond is reached."""
    with running(context) as loop:
        whole = run(loop, TICKS // 4)
    with running(context) as loop:
        loop.longest_step_ns = 370_000
        require_equal_rows(run(loop, TICKS // 4), whole, "steps of 0.37 ms")
    return "steps of 0.37 ms equal those of 1 ms"


def dormant(context: Context) -> str:
    """Without event mode the terminals sleep: signals go by the variables, as in the flavour without terminals."""
    files = [file_of(context, f) for f in PRODUCTS]
    with Pair.open(*files) as pair:
        said = [text for _, _, text in pair.plant.log]
        require(any("dormant" in text for text in said), f"the log does not say so: {said}")
        found = pair.run(TICKS // 4)
    with context.open_pair(3) as pair:
        wanted = pair.run(TICKS // 4)
    for product, trace in found.items():
        require(trace.first_difference(wanted[product]) is None, f"{product}: other outputs than without terminals")
    return "eventModeUsed=false: equal to the FMI 3.0 flavour; the log says why the bus sleeps"


def checks() -> list[Check]:
    """The checks of this file."""
    found: list[Check] = []
    each: dict[str, Callable[[Context, str], str]] = {"fmpy validate": validate, "XML, terminals, manifest": schemas}
    for name, function in each.items():
        found += [Check(name, f"{f} LS-BUS", lambda c, g=function, f=f: g(c, f)) for f in ls_bus.FLAVOURS]
    of_all: dict[str, Callable[[Context], str]] = {
        "golden bytes": golden_bytes, "without event mode": dormant, "any step": odd_steps,
        "states": states, "loop of three FMUs": loop_equals_link,
    }  # fmt: skip
    return found + [Check(name, "LS-BUS", function) for name, function in of_all.items()]
