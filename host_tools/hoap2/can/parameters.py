"""The disturbances of the modelled link in a scenario: the table [can]."""

from __future__ import annotations

import math

from hoap2 import parameters
from hoap2.errors import UserError
from hoap2.generate import can_table

LINKS = ("direct", "can", "ls-bus")
# The controller gives up in the fifth tick without a board's measurements, as the boards do without its heartbeat.
STALE_LIMIT_TICKS = can_table.load().raw["alive_limit_ticks"] - 1


def known() -> dict[str, can_table.Disturbance]:
    return {d.name: d for d in can_table.load().disturbances}


def defaults() -> dict[str, float]:
    return {name: d.default for name, d in known().items()}


def check(raw: dict) -> dict[str, float]:
    """Every parameter of the link, the given ones checked; UserError where one is wrong."""
    values = defaults()
    for name, value in raw.items():
        if name not in values:
            raise parameters.unknown("parameter of the CAN link", name, values)
        values[name] = _number(known()[name], value)
    return values


def _number(row: can_table.Disturbance, value) -> float:
    where = f"can.{row.name}"
    if isinstance(value, str) and row.words:
        if value not in row.words:
            raise parameters.unknown(f"value of {where}", value, row.words)
        value = row.words.index(value)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UserError(f"{where} needs a number, not {value!r}")
    if row.kind == "int" and value != int(value):
        raise UserError(f"{where} needs a whole number, not {value!r}")
    if not math.isfinite(value) or not row.low <= value <= row.high:
        raise UserError(f"{where} = {value:g} is out of range [{row.low:g}, {row.high:g}] ({row.text})")
    return float(value)


def plain(values: dict[str, float]) -> dict[str, float | int | str]:
    """As a reader writes them."""
    rows = known()
    return {n: rows[n].words[int(v)] if rows[n].words else int(v) if rows[n].kind == "int" else v
            for n, v in values.items()}  # fmt: skip
