"""FMI-LS-BUS 1.0.0: model descriptions with bus terminals, terminalsAndIcons, manifests, and the C code's tokens.

The rows of signals.toml keep their value references; four variables a terminal follow them.
"""

from __future__ import annotations

import hashlib
import uuid
from html import escape
from xml.sax.saxutils import quoteattr

from . import fmi, fmi_pages
from .c_headers import BANNER
from .can_table import CanTable
from .fmi_pages import STYLE
from .tables import PRODUCTS, Table

VERSION = "1.0.0"
MIME_TYPE = f'application/org.fmi-standard.fmi-ls-bus.can; version="{VERSION}"'
ROOM = 8192  # maxSize of the binaries; fmu/ls_bus/terminals.h has the same
BUS = "can_bus"
FLAVOURS = (*PRODUCTS, BUS)
MEMBERS = ("Rx_Clock", "Rx_Data", "Tx_Clock", "Tx_Data")
BANNER_XML = "<!-- Generated from firmware/can.toml by ./hoap2 generate: do not edit. -->"
BUS_TEXT = "The two CAN buses of HOAP-2: arbitration, frame lengths to the bit, error confinement"
MANIFEST_TEXT = (
    "Layered Standard for the simulation of bus communication on a Physical Signal Abstraction or Network "
    "Abstraction based level."
)


def identifier(flavour: str) -> str:
    """modelIdentifier and name of the file."""
    return "hoap2_can_bus" if flavour == BUS else f"hoap2_{flavour}_ls_bus"


def terminals(can: CanTable, flavour: str) -> list[str]:
    """Names of the terminals in the order of their value references."""
    if flavour != BUS:
        return list(can.buses)
    return [f"{bus}_{side}" for bus in can.buses for side in ("controller", "boards")]


def token(table: Table, can: CanTable, flavour: str) -> str:
    """instantiationToken: a hash of the tables on both sides of the terminals."""
    of_signals = fmi.token(table, flavour) if flavour in PRODUCTS else ""
    text = repr((flavour, of_signals, VERSION, ROOM, terminals(can, flavour), sorted(map(repr, can.frames))))
    return "{" + str(uuid.UUID(bytes=hashlib.sha256(text.encode()).digest()[:16])) + "}"


def _variables(name: str, first: int, is_bus: bool) -> list[str]:
    """The four variables of one terminal."""
    binary = f"mimeType={quoteattr(MIME_TYPE, {chr(34): '&quot;'})} maxSize=\"{ROOM}\""
    when = "at the end of each millisecond" if is_bus else "as soon as the node has sent"
    return [
        f'    <Clock name="{name}.Rx_Clock" valueReference="{first}" causality="input" variability="discrete" '
        'intervalVariability="triggered" description="something arrives"/>',
        f'    <Binary name="{name}.Rx_Data" valueReference="{first + 1}" causality="input" variability="discrete" '
        f'clocks="{first}" {binary} description="what arrives"><Start value=""/></Binary>',
        f'    <Clock name="{name}.Tx_Clock" valueReference="{first + 2}" causality="input" variability="discrete" '
        f'intervalVariability="countdown" description="counts down {when}"/>',
        f'    <Binary name="{name}.Tx_Data" valueReference="{first + 3}" causality="output" variability="discrete" '
        f'clocks="{first + 2}" {binary} description="what is sent"/>',
    ]


def model_description(table: Table, can: CanTable, flavour: str) -> str:
    """modelDescription.xml."""
    text = fmi.fmi3_xml(table, flavour) if flavour in PRODUCTS else _bus_description(table)
    first = 1 + (len(fmi.rows(table, flavour)) if flavour in PRODUCTS else 0)
    names = terminals(can, flavour)
    places = [first + len(MEMBERS) * i for i in range(len(names))]
    variables = [v for n, p in zip(names, places, strict=True) for v in _variables(n, p, flavour == BUS)]
    outputs = [f'    <Output valueReference="{p + 3}"/>' for p in places]
    for mark, lines in (("  </ModelVariables>\n", variables), ("  <ModelStructure>\n", outputs)):
        before, after = text.split(mark)
        added = "\n".join(lines) + "\n"
        text = before + (added + mark if mark.startswith("  </") else mark + added) + after
    if flavour in PRODUCTS:
        text = text.replace(f'modelIdentifier="hoap2_{flavour}"', f'modelIdentifier="{identifier(flavour)}"')
        text = text.replace(fmi.token(table, flavour), token(table, can, flavour))
        text = text.replace('fixedInternalStepSize=', 'hasEventMode="true" fixedInternalStepSize=')
        return text
    return text.replace("@TOKEN@", token(table, can, flavour))


def _bus_description(table: Table) -> str:
    step = repr(table.tick_us / 1e6)
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n{BANNER_XML}\n<fmiModelDescription fmiVersion="3.0" '
        f'modelName="{identifier(BUS)}"\n  instantiationToken="@TOKEN@"\n  description={quoteattr(BUS_TEXT)}\n'
        f'  version="{table.schema}" license="BSD-3-Clause" author="the hoap2 authors" '
        'generationTool="hoap2 generate" variableNamingConvention="structured">\n'
        f'  <CoSimulation modelIdentifier="{identifier(BUS)}" canHandleVariableCommunicationStepSize="true" '
        f'hasEventMode="true" fixedInternalStepSize="{step}" canGetAndSetFMUState="true" '
        'canSerializeFMUState="true"/>\n'
        f"{fmi.categories()}\n  <DefaultExperiment startTime=\"0\" stepSize=\"{step}\"/>\n  <ModelVariables>\n"
        '    <Float64 name="time" valueReference="0" causality="independent" variability="continuous" '
        'description="simulated time"/>\n'
        "  </ModelVariables>\n  <ModelStructure>\n  </ModelStructure>\n</fmiModelDescription>\n"
    )


def terminals_and_icons(can: CanTable, flavour: str) -> str:
    """terminalsAndIcons.xml."""
    out = [
        f'<?xml version="1.0" encoding="UTF-8"?>\n{BANNER_XML}\n<fmiTerminalsAndIcons fmiVersion="3.0">',
        "  <Terminals>",
    ]
    for name in terminals(can, flavour):
        out.append(
            f'    <Terminal terminalKind="org.fmi-ls-bus.network-terminal" '
            f'matchingRule="org.fmi-ls-bus.transceiver" name="{name}">'
        )
        out += [
            f'      <TerminalMemberVariable variableKind="signal" variableName="{name}.{member}" '
            f'memberName="{member}"/>'
            for member in MEMBERS
        ]
        out.append("    </Terminal>")
    return "\n".join([*out, "  </Terminals>", "</fmiTerminalsAndIcons>"]) + "\n"


def manifest(flavour: str) -> str:
    """extra/org.fmi-standard.fmi-ls-bus/fmi-ls-manifest.xml."""
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n{BANNER_XML}\n<fmiLayeredStandardManifest\n'
        '    xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest"\n'
        '    fmi-ls:fmi-ls-name="org.fmi-standard.fmi-ls-bus"\n'
        f'    fmi-ls:fmi-ls-version="{VERSION}"\n'
        f'    fmi-ls:fmi-ls-description="{MANIFEST_TEXT}"\n'
        f'    isBusSimulationFMU="{"true" if flavour == BUS else "false"}"/>\n'
    )


def _terminals_section(can: CanTable, flavour: str) -> str:
    rows = "\n".join(f"<li><code>{escape(name)}</code></li>" for name in terminals(can, flavour))
    return (
        f"<h2>Bus terminals</h2>\n<p>FMI-LS-BUS {VERSION}, CAN. With event mode, frames on these terminals take "
        f"the place of the values that controller and plant exchange otherwise.</p>\n<ul>\n{rows}\n</ul>\n"
    )


def page(table: Table, can: CanTable, flavour: str) -> str:
    """documentation/index.html."""
    text = fmi_pages.page(table, flavour) if flavour in PRODUCTS else _bus_page()
    return text.replace("</body>", _terminals_section(can, flavour) + "</body>")


def _bus_page() -> str:
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{identifier(BUS)}</title>'
        f"<style>{STYLE}</style></head><body>\n<h1>{identifier(BUS)}</h1>\n<p>{escape(BUS_TEXT)}. A bus simulation FMU "
        f"of FMI-LS-BUS {VERSION}: what its terminals take in goes on the wire, and what was completed within a "
        "millisecond leaves at its end.</p>\n</body></html>\n"
    )


def tokens_header(table: Table, can: CanTable) -> str:
    names = {"controller": "CONTROLLER", "plant": "PLANT", BUS: "BUS"}
    lines = "\n".join(f'#define HOAP2_LS_{names[f]}_TOKEN "{token(table, can, f)}"' for f in FLAVOURS)
    return f"{BANNER}#ifndef HOAP2_LS_BUS_TOKENS_H\n#define HOAP2_LS_BUS_TOKENS_H\n{lines}\n#endif\n"


def files(table: Table, can: CanTable) -> dict[str, str]:
    """Path below the repository -> text."""
    folder = "fmu/ls_bus/generated"
    out = {f"{folder}/tokens.h": tokens_header(table, can)}
    for flavour in FLAVOURS:
        out[f"{folder}/{flavour}.html"] = page(table, can, flavour)
        out[f"{folder}/{flavour}.xml"] = model_description(table, can, flavour)
        out[f"{folder}/{flavour}_terminals.xml"] = terminals_and_icons(can, flavour)
        out[f"{folder}/{flavour}_manifest.xml"] = manifest(flavour)
    return out
