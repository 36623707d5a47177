"""The SSP: both FMI 2.0 FMUs and every connection between them."""

from __future__ import annotations

from .fmi import UNITS, XML_BANNER, rows
from .tables import PRODUCTS, Signal, Table


def connections(table: Table) -> list[tuple[str, str, str, str]]:
    """(from product, from element, to product, to element): outputs feed inputs of the same name.

    The operator's inputs are left open.
    """
    found = []
    for source, sink in (("plant", "controller"), ("controller", "plant")):
        outputs = {s.name: s for s in table.select(source, "output")}
        for s in table.select(sink, "input"):
            if s.operator:
                continue
            if s.name not in outputs:
                raise ValueError(f"the {sink}'s input {s.name} has no output of that name in the {source}")
            output = outputs[s.name]
            if (output.kind, output.shape, output.unit) != (s.kind, s.shape, s.unit):
                raise ValueError(f"{s.name}: kind, size or unit differ between {source} and {sink}")
            found += [(source, name, sink, name) for name in table.element_names(s)]
    return found


def _connector(s: Signal, name: str) -> str:
    unit = f' unit="{s.unit}"' if s.kind == "real" and s.unit != "1" else ""
    kind = f"<ssc:Real{unit}/>" if s.kind == "real" else "<ssc:Integer/>"
    return f'          <ssd:Connector name="{name}" kind="{s.group}">{kind}</ssd:Connector>'


def _component(table: Table, product: str) -> str:
    lines = [
        _connector(s, name) for s in rows(table, product) if s.group != "parameter" for name in table.element_names(s)
    ]
    return (
        f'      <ssd:Component name="{product}" type="application/x-fmu-sharedlibrary" '
        f'source="resources/hoap2_{product}_fmi2.fmu" implementation="CoSimulation">\n        <ssd:Connectors>\n'
        + "\n".join(lines)
        + "\n        </ssd:Connectors>\n      </ssd:Component>"
    )


def _units(table: Table) -> str:
    used = {s.unit for p in PRODUCTS for s in rows(table, p) if s.kind == "real" and s.group != "parameter"} - {"1"}
    lines = []
    for unit in [u for u in UNITS if u in used]:
        base = "".join(f' {k}="{v}"' for k, v in UNITS[unit].items())
        lines.append(f'    <ssc:Unit name="{unit}"><ssc:BaseUnit{base}/></ssc:Unit>')
    return "  <ssd:Units>\n" + "\n".join(lines) + "\n  </ssd:Units>"


def system_structure(table: Table) -> str:
    """SystemStructure.ssd."""
    lines = [
        f'      <ssd:Connection startElement="{a}" startConnector="{x}" endElement="{b}" endConnector="{y}"/>'
        for a, x, b, y in connections(table)
    ]
    components = "\n".join(_component(table, product) for product in PRODUCTS)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n' + XML_BANNER + "\n"
        '<ssd:SystemStructureDescription name="hoap2" version="1.0"\n'
        '    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"\n'
        '    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">\n'
        '  <ssd:System name="hoap2" description="HOAP-2: walking controller and robot">\n'
        f"    <ssd:Elements>\n{components}\n    </ssd:Elements>\n"
        "    <ssd:Connections>\n" + "\n".join(lines) + "\n    </ssd:Connections>\n  </ssd:System>\n"
        f"{_units(table)}\n"
        '  <ssd:DefaultExperiment startTime="0"/>\n</ssd:SystemStructureDescription>\n'
    )
