"""Values of an axis against the one that the scenarios have anyway: factors of it, and which one it is."""

from __future__ import annotations

import dataclasses
import tomllib

from hoap2 import parameters, scenario
from hoap2.errors import UserError
from hoap2.scenario import Scenario
from hoap2.studies.sweep import Axis, Sweep


def resolve(sweep: Sweep, base: str, overrides: list[str]) -> Sweep:
    """The sweep with factors (`x0.8`) worked out from the value that the scenario `base` has with the overrides."""
    nominal = scenario.load(base, [*overrides, *sweep.sets])
    axes = tuple(
        dataclasses.replace(axis, values=tuple(_literal(axis.name, value, nominal) for value in axis.values))
        for axis in sweep.axes
    )
    return dataclasses.replace(sweep, axes=axes)


def _literal(name: str, value: str, nominal: Scenario) -> str:
    """`x0.8` as the number or list that it stands for; anything else as it is."""
    try:
        factor = float(value.removeprefix("x"))
    except ValueError:
        return value
    if not value.startswith("x"):
        return value
    own = _own(name, nominal)
    if own is None:
        raise UserError(f"{name}: {value} needs a number to multiply", "give the values themselves")
    numbers = [number * factor if factor != 1.0 else number for number in own]
    texts = [repr(n) if factor == 1.0 else f"{n:.6g}" for n in numbers]
    return texts[0] if len(set(texts)) == 1 else f"[{', '.join(texts)}]"


def _own(name: str, nominal: Scenario) -> tuple[float, ...] | None:
    product, _, parameter = name.partition(".")
    signal = parameters.known(product).get(parameter) if product in nominal.values else None
    return None if signal is None or signal.enum else nominal.values[product][parameter]


def find(axis: Axis, sweep: Sweep, base: str, overrides: list[str]) -> str | None:
    """The value among the axis's that the scenario has anyway, as it is written there."""
    product, _, name = axis.name.partition(".")
    nominal = scenario.load(base, [*overrides, *sweep.sets])
    if axis.name == "scenario.sensors":
        return nominal.sensors
    if product not in nominal.values or name not in nominal.values[product]:
        return None
    return next((v for v in axis.values if _flat(product, name, v) == nominal.values[product][name]), None)


def _flat(product: str, name: str, value: str) -> tuple[float, ...]:
    try:
        literal = tomllib.loads(f"v = {value}")["v"]
    except tomllib.TOMLDecodeError:
        literal = value
    return parameters.check(product, name, literal)


def unit(axis: Axis) -> str:
    """The unit of the axis; an empty text for words and plain numbers."""
    product, _, name = axis.name.partition(".")
    known = parameters.known(product) if product in ("controller", "plant") else {}
    return known[name].unit if name in known and not known[name].enum and known[name].unit != "1" else ""
