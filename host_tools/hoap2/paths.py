"""Where the parts of a checkout and of its build are."""

from __future__ import annotations

import os
from pathlib import Path

from hoap2.errors import UserError

ROOT = Path(__file__).resolve().parents[2]


def build_dir() -> Path:
    """The build in use: HOAP2_BUILD_DIR, or build/release."""
    return Path(os.environ.get("HOAP2_BUILD_DIR") or ROOT / "build" / "release")


def built(relative: str) -> Path:
    """A built file, such as `sim/libhoap2_plant.so`; an error that says what to do when it is not there."""
    path = build_dir() / relative
    if not path.exists():
        raise UserError(f"{path} is missing", "build it: ./hoap2 fmu build (or set HOAP2_BUILD_DIR)", exit_code=3)
    return path


def _built_since(library: Path, header: str) -> Path:
    """The library; an error when the header that lays out its structs has changed since it was built."""
    if (ROOT / header).stat().st_mtime > library.stat().st_mtime:
        raise UserError(f"{library} is older than {header}", "build it again: ./hoap2 fmu build", exit_code=3)
    return library


def controller_library() -> Path:
    """The controller's C interface."""
    return _built_since(built("firmware/libhoap2_controller.so"), "firmware/include/hoap2/generated/signals.h")


def plant_library() -> Path:
    """The plant's C interface."""
    return _built_since(built("sim/libhoap2_plant.so"), "sim/include/hoap2_plant/generated/plant_signals.h")


def telemetry_library() -> Path:
    """The LCM publisher."""
    library = built("host_tools/telemetry/libhoap2_telemetry.so")
    return _built_since(library, "host_tools/telemetry/generated/places.hpp")


def can_library() -> Path:
    """The CAN interface's C functions, with the modelled link."""
    return _built_since(built("sim/can/libhoap2_can.so"), "firmware/can/generated/can_table.h")


def fmu(product: str, fmi: int) -> Path:
    """An FMU of this build: product `controller` or `plant`, fmi 2 or 3."""
    return built(f"fmu/hoap2_{product}_fmi{fmi}.fmu")


def ls_bus_fmu(flavour: str) -> Path:
    """An FMU with bus terminals: `controller`, `plant` or `can_bus`."""
    from hoap2.generate import ls_bus

    return built(f"fmu/{ls_bus.identifier(flavour)}.fmu")
