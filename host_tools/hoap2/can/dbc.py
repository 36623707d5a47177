"""The generated DBC files through cantools, and whether they fit the firmware."""

from __future__ import annotations

from pathlib import Path

from hoap2 import paths
from hoap2.can import library
from hoap2.errors import UserError
from hoap2.generate import can_table

FOLDER = paths.ROOT / "firmware" / "can" / "generated"


def path_of(bus: str) -> Path:
    """The DBC file of a bus: right or left."""
    buses = can_table.load().buses
    if bus not in buses:
        raise UserError(f"no bus '{bus}'", f"known: {', '.join(buses)}")
    return FOLDER / f"hoap2_{bus}.dbc"


def load(bus: str, path: Path | None = None):
    """A cantools database of this bus; UserError where its protocol is not that of the built firmware."""
    try:
        import cantools
    except ImportError:
        raise UserError("cantools is missing", "pip install -r host_tools/requirements/can.txt", 3) from None
    path = path or path_of(bus)
    try:
        database = cantools.database.load_file(path, database_format="dbc", strict=True)
    except (OSError, cantools.database.Error, ValueError) as error:
        raise UserError(f"cannot read {path}: {error}") from None
    attribute = database.dbc.attributes.get("Protocol") if database.dbc else None
    theirs, ours = (attribute.value if attribute else None), library.load().hoap2_can_protocol()
    if theirs != ours:
        said = "none" if theirs is None else f"0x{theirs:04X}"
        raise UserError(f"{path} is of protocol {said}, the firmware speaks 0x{ours:04X}",
                        "take the DBC of the same version, or build again: ./hoap2 fmu build")  # fmt: skip
    return database
