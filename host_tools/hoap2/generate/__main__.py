"""Write every generated file, or with --check say which are stale (exit 1)."""

from __future__ import annotations

import argparse
import sys

from . import c_headers, can_c, can_dbc, can_page, can_table, fmi, fmi_pages, lcm_types, ls_bus, mjcf, pages, ssp, urdf
from .tables import PRODUCTS, ROOT, Table, load


def outputs() -> dict[str, str]:
    """Path below the repository -> text."""
    table = load()
    firmware = "firmware/include/hoap2/generated"
    return {
        f"{firmware}/signals.h": c_headers.signals_header(table, "controller", "hoap2"),
        f"{firmware}/robot_model.h": c_headers.robot_header(table),
        f"{firmware}/names.h": c_headers.names_header(table),
        "sim/include/hoap2_plant/generated/plant_signals.h": c_headers.signals_header(table, "plant", "hoap2_plant"),
        "sim/model/hoap2.urdf": urdf.urdf(table),
        "sim/model/hoap2_mjcf.xml": mjcf.mjcf(table),
        "docs/generated/signals.md": pages.signals_page(table),
        **_fmu_outputs(table),
        **_telemetry_outputs(table),
        **_can_outputs(table),
    }


def _fmu_outputs(table: Table) -> dict[str, str]:
    out = {"fmu/generated/SystemStructure.ssd": ssp.system_structure(table)}
    for product in PRODUCTS:
        out[f"fmu/generated/{product}_fields.h"] = fmi.fields_header(table, product)
        out[f"fmu/generated/{product}_fmi2.xml"] = fmi.fmi2_xml(table, product, source_files=product == "controller")
        out[f"fmu/generated/{product}_fmi3.xml"] = fmi.fmi3_xml(table, product)
        out[f"fmu/generated/{product}.html"] = fmi_pages.page(table, product)
    return out


def _telemetry_outputs(table: Table) -> dict[str, str]:
    folder = "host_tools/telemetry"
    out = {f"{folder}/types/generated/{name}": text for name, text in lcm_types.files(table).items()}
    out["docs/generated/telemetry.md"] = lcm_types.page(table)
    return out | {f"{folder}/generated/places.hpp": lcm_types.places_header(table)}


def _can_outputs(table: Table) -> dict[str, str]:
    can, folder = can_table.load(), "firmware/can/generated"
    out = {f"{folder}/can_table.h": can_c.header(can), f"{folder}/can_table.c": can_c.source(can),
           "sim/include/hoap2_link/generated/disturbances.h": can_c.disturbances_header(can),
           "docs/generated/can.md": can_page.page(can, table)}  # fmt: skip
    out |= ls_bus.files(table, can)
    return out | {f"{folder}/hoap2_{name}.dbc": can_dbc.dbc(can, table, bus) for bus, name in enumerate(can.buses)}


def main() -> int:
    parser = argparse.ArgumentParser(prog="hoap2 generate", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; list stale files and exit 1 if any")
    check = parser.parse_args().check
    stale = []
    for name, text in outputs().items():
        path = ROOT / name
        if path.exists() and path.read_text() == text:
            continue
        stale.append(name)
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
    for name in stale:
        print(("stale: " if check else "wrote: ") + name)
    return 1 if check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
