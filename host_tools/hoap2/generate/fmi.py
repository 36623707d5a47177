"""FMI: model descriptions (2.0 and 3.0) and the field tables of the FMU's C code.

FMI 3.0 has one variable a row of signals.toml, FMI 2.0 one scalar an element; both
number them in the same order (inputs, outputs, parameters; reals first), from 1 on.
"""

from __future__ import annotations

import hashlib
import json
import math
import uuid
from xml.sax.saxutils import quoteattr

from .c_headers import BANNER, number
from .tables import GROUPS, Signal, Table

PRODUCT_TEXT = {
    "controller": "HOAP-2 walking controller: encoders, IMU and foot force cells in, drive settings of 25 joints out",
    "plant": "HOAP-2 robot in the Open Dynamics Engine: drive settings in, sensors and the truth out",
}
LOG_CATEGORIES = {
    "logStatusError": "refused calls and failed steps, with the reason",
    "logStatusWarning": "accepted, but worth a look",
    "logEvents": "initialisation, reset, state restored",
}
# unit -> exponents of the SI base units (rad is a base unit of its own in FMI)
UNITS: dict[str, dict[str, int]] = {
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N.m/rad": {"kg": 1, "m": 2, "s": -2, "rad": -1},
    "N.m.s/rad": {"kg": 1, "m": 2, "s": -1, "rad": -1},
    "N/m": {"kg": 1, "s": -2},
    "N.s/m": {"kg": 1, "s": -1},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Pa/m": {"kg": 1, "m": -2, "s": -2},
    "Pa/m2": {"kg": 1, "m": -3, "s": -2},
    "Pa.s/m": {"kg": 1, "m": -2, "s": -1},
    "s": {"s": 1},
    "1/s": {"s": -1},
    "1/s2": {"s": -2},
    "1": {},
}
DEGREES = {"rad": "deg", "rad/s": "deg/s"}
XML_BANNER = "<!-- Generated from firmware/signals.toml and firmware/hoap2.json by ./hoap2 generate: do not edit. -->"


def rows(table: Table, product: str) -> list[Signal]:
    """All rows of a product in the order of the value references."""
    return [s for group in GROUPS for s in table.select(product, group)]


def token(table: Table, product: str) -> str:
    """guid and instantiationToken: a hash of everything that the two sides must agree on."""
    described = [
        (s.group, s.name, s.kind, s.shape, s.unit, s.default, s.low, s.high, s.tunable, s.enum)
        for s in rows(table, product)
    ]
    text = json.dumps([product, table.schema, table.tick_us, described, table.enums, table.robot], sort_keys=True)
    return "{" + str(uuid.UUID(bytes=hashlib.sha256(text.encode()).digest()[:16])) + "}"


def variable_text(table: Table, s: Signal, sized: bool) -> str:
    """Description of a variable: text, size, meaning of the numbers of an enumeration."""
    text = s.text
    if sized and s.shape:
        text += f" [{' x '.join(s.size_names)}]"
    if s.enum:
        text += ": " + ", ".join(f"{i} {name}" for i, name in enumerate(table.enums[s.enum]))
    return text


def _value(s: Signal, x: float) -> str:
    return repr(float(x)) if s.kind == "real" else str(int(x))


def _range_attributes(s: Signal) -> str:
    out = ""
    if s.kind == "int" and s.group == "parameter":
        return f' min="{int(s.low)}" max="{int(s.high)}"'
    for key, value in (("min", s.low), ("max", s.high)):
        if not math.isinf(value):
            out += f' {key}="{_value(s, value)}"'
    return out


def _unit_attributes(s: Signal) -> str:
    if s.kind != "real" or s.unit == "1":
        return ""
    display = f' displayUnit="{DEGREES[s.unit]}"' if s.unit in DEGREES else ""
    return f' unit="{s.unit}"{display}'


def _units(table: Table, product: str) -> str:
    used = {s.unit for s in rows(table, product) if s.kind == "real"} - {"1"}
    out = ["  <UnitDefinitions>"]
    for unit in [u for u in UNITS if u in used]:
        base = "".join(f' {k}="{v}"' for k, v in UNITS[unit].items())
        display = f'<DisplayUnit name="{DEGREES[unit]}" factor="{180.0 / math.pi!r}"/>' if unit in DEGREES else ""
        out.append(f'    <Unit name="{unit}"><BaseUnit{base}/>{display}</Unit>')
    missing = used - set(UNITS)
    if missing:
        raise ValueError(f"units without a definition in fmi.py: {sorted(missing)}")
    return "\n".join(out + ["  </UnitDefinitions>"])


def categories() -> str:
    inner = "".join(
        f"\n    <Category name={quoteattr(k)} description={quoteattr(v)}/>" for k, v in LOG_CATEGORIES.items()
    )
    return f"  <LogCategories>{inner}\n  </LogCategories>"


def _variability(s: Signal) -> str:
    if s.group == "parameter":
        return "tunable" if s.tunable else "fixed"
    return "continuous" if s.kind == "real" else "discrete"


def _header(table: Table, product: str, version: str, extra: str) -> str:
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n{XML_BANNER}\n<fmiModelDescription fmiVersion="{version}" '
        f'modelName="hoap2_{product}"\n  {extra}="{token(table, product)}"\n'
        f"  description={quoteattr(PRODUCT_TEXT[product])}\n"
        f'  version="{table.schema}" license="BSD-3-Clause" author="the hoap2 authors" generationTool="hoap2 generate" '
        'variableNamingConvention="structured"'
    )


def fmi2_xml(table: Table, product: str, source_files: bool) -> str:
    """modelDescription.xml of FMI 2.0; `@SOURCE_FILES@` is filled in when the FMU is packed."""
    out = [
        _header(table, product, "2.0", "guid") + ">",
        f'  <CoSimulation modelIdentifier="hoap2_{product}" canHandleVariableCommunicationStepSize="true" '
        'canGetAndSetFMUstate="true" canSerializeFMUstate="true" canNotUseMemoryManagementFunctions="true"'
        + (">\n@SOURCE_FILES@\n  </CoSimulation>" if source_files else "/>"),
        _units(table, product),
        categories(),
        f'  <DefaultExperiment startTime="0" stepSize="{table.tick_us / 1e6!r}"/>',
        "  <ModelVariables>",
    ]
    outputs, reference = [], 0
    for s in rows(table, product):
        type_name = "Real" if s.kind == "real" else "Integer"
        text = quoteattr(variable_text(table, s, sized=False))
        initial = (
            ' initial="calculated"' if s.group == "output" else ' initial="exact"' if s.group == "parameter" else ""
        )
        for name, default in zip(table.element_names(s), s.default, strict=True):
            reference += 1
            start = "" if s.group == "output" else f' start="{_value(s, default)}"'
            out.append(
                f'    <ScalarVariable name="{name}" valueReference="{reference}" description={text} '
                f'causality="{s.group}" variability="{_variability(s)}"{initial}>'
                f"<{type_name}{_unit_attributes(s)}{_range_attributes(s)}{start}/></ScalarVariable>"
            )
            if s.group == "output":
                outputs.append(reference)
    # no output answers an input before the next step: no algebraic loop through these FMUs
    direct = "".join(f'<Unknown index="{i}" dependencies=""/>' for i in outputs)
    initial_unknowns = "".join(f'<Unknown index="{i}"/>' for i in outputs)
    out += [
        "  </ModelVariables>",
        "  <ModelStructure>",
        f"    <Outputs>{direct}</Outputs>",
        f"    <InitialUnknowns>{initial_unknowns}</InitialUnknowns>",
        "  </ModelStructure>",
        "</fmiModelDescription>",
    ]
    return "\n".join(out) + "\n"


def fmi3_xml(table: Table, product: str) -> str:
    """modelDescription.xml of FMI 3.0, arrays as arrays."""
    step = repr(table.tick_us / 1e6)
    out = [
        _header(table, product, "3.0", "instantiationToken") + ">",
        f'  <CoSimulation modelIdentifier="hoap2_{product}" canHandleVariableCommunicationStepSize="true" '
        f'fixedInternalStepSize="{step}" canGetAndSetFMUState="true" canSerializeFMUState="true"/>',
        _units(table, product),
        categories(),
        f'  <DefaultExperiment startTime="0" stepSize="{step}"/>',
        "  <ModelVariables>",
        '    <Float64 name="time" valueReference="0" causality="independent" variability="continuous" '
        'description="simulated time"/>',
    ]
    outputs = []
    for reference, s in enumerate(rows(table, product), start=1):
        type_name = "Float64" if s.kind == "real" else "Int32"
        initial = (
            ' initial="calculated"' if s.group == "output" else ' initial="exact"' if s.group == "parameter" else ""
        )
        start = "" if s.group == "output" else f' start="{" ".join(_value(s, x) for x in s.default)}"'
        head = (
            f'    <{type_name} name="{s.name}" valueReference="{reference}" description='
            f'{quoteattr(variable_text(table, s, sized=True))} causality="{s.group}" variability="{_variability(s)}"'
            f"{initial}{_unit_attributes(s)}{_range_attributes(s)}{start}"
        )
        sizes = "".join(f'<Dimension start="{n}"/>' for n in s.shape)
        out.append(f"{head}>{sizes}</{type_name}>" if sizes else f"{head}/>")
        if s.group == "output":
            outputs.append(reference)
    out += ["  </ModelVariables>", "  <ModelStructure>"]
    out += [f'    <Output valueReference="{i}" dependencies=""/>' for i in outputs]
    out += [f'    <InitialUnknown valueReference="{i}"/>' for i in outputs]
    return "\n".join(out + ["  </ModelStructure>", "</fmiModelDescription>"]) + "\n"


def fields_header(table: Table, product: str) -> str:
    """The C table: value reference -> struct, kind, offset, count, range; and each element's name."""
    prefix = "hoap2" if product == "controller" else "hoap2_plant"
    struct = {"input": "inputs", "output": "outputs", "parameter": "params"}
    fields, names = [], []
    for s in rows(table, product):
        low, high = number(s.low), number(s.high)
        fields.append(
            f'  {{"{s.name}", HOAP2_FMU_{s.group.upper()}, HOAP2_FMU_{s.kind.upper()}, {int(s.tunable)}, '
            f"{len(names) + 1}u, {s.count}u, offsetof({prefix}_{struct[s.group]}_t, {s.name}), {low}, {high}}},"
        )
        names += table.element_names(s)
    if len(set(names)) != len(names) or len({s.name for s in rows(table, product)}) != len(rows(table, product)):
        raise ValueError(f"{product}: a name is used twice; inputs, outputs and parameters share one name space")
    quoted = ",\n  ".join(f'"{name}"' for name in names)
    guard = f"HOAP2_FMU_{product.upper()}_FIELDS_H"
    return (
        f'{BANNER}#ifndef {guard}\n#define {guard}\n#include <math.h>\n#include <stddef.h>\n\n#include "../product.h"\n'
        f'#include "{prefix}/generated/{"signals.h" if product == "controller" else "plant_signals.h"}"\n\n'
        f'#define HOAP2_FMU_TOKEN "{token(table, product)}"\n'
        f"enum {{ HOAP2_FMU_FIELDS = {len(fields)}, HOAP2_FMU_ELEMENTS = {len(names)} }};\n\n"
        "/* name, group, kind, tunable, FMI 2 value reference of the first element, elements, offset, range */\n"
        "static const hoap2_fmu_field_t FIELDS[HOAP2_FMU_FIELDS] = {\n" + "\n".join(fields) + "\n};\n\n"
        f"static const char *const ELEMENT_NAMES[HOAP2_FMU_ELEMENTS] = {{\n  {quoted}}};\n#endif\n"
    )
