"""Bounds: what a run's numbers must meet, on both sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hoap2 import parameters
from hoap2.errors import UserError


@dataclass(frozen=True)
class Bound:
    """The closed interval a metric must lie in."""

    low: float
    high: float


# A run is no success without these; a scenario that shows a fall states its own bound.
ALWAYS = {"fell": Bound(0.0, 0.0), "fault_count": Bound(0.0, 0.0)}


def parse(raw: dict, known: dict[str, object]) -> dict[str, Bound]:
    """The [bounds] table of a scenario, the bounds that hold always put first."""
    bounds = dict(ALWAYS)
    for name, sides in raw.items():
        if name not in known:
            raise parameters.unknown("metric in [bounds]", name, known)
        where = f'[bounds] "{name}"'
        if not isinstance(sides, dict) or set(sides) != {"min", "max"}:
            raise UserError(f"{where} needs both sides: {{ min = ..., max = ... }}")
        for side, value in sides.items():
            if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
                raise UserError(f"{where}: {side} needs a number, not {value!r}")
        if sides["min"] > sides["max"]:
            raise UserError(f"{where}: min {sides['min']:g} is above max {sides['max']:g}")
        bounds[name] = Bound(float(sides["min"]), float(sides["max"]))
    return bounds


def lookup(metrics: dict, name: str) -> float | None:
    """A metric by its dotted name as a number; None where the run did not produce it."""
    value = metrics
    for part in name.split("."):
        value = value.get(part) if isinstance(value, dict) else None
    if isinstance(value, bool):
        return float(value)
    return float(value) if isinstance(value, int | float) and not math.isnan(value) else None


def judge(bounds: dict[str, Bound], metrics: dict) -> dict[str, dict]:
    """{name: {value, min, max, ok}}; a metric without a value is not ok."""
    verdict = {}
    for name, bound in bounds.items():
        value = lookup(metrics, name)
        ok = value is not None and bound.low <= value <= bound.high
        verdict[name] = {"value": value, "min": bound.low, "max": bound.high, "ok": ok}
    return verdict
