"""Parameter values: checked against signals.toml, kept flat (row-major), printed nested."""

from __future__ import annotations

import math
from functools import lru_cache

from hoap2.errors import UserError, nearest
from hoap2.generate import tables

Values = dict[str, dict[str, tuple[float, ...]]]  # product -> parameter -> flat values


@lru_cache(maxsize=1)
def table() -> tables.Table:
    """The signal table, read once a process."""
    return tables.load()


@lru_cache(maxsize=4)
def known(product: str) -> dict[str, tables.Signal]:
    """Parameters of a product by name."""
    return {s.name: s for s in table().select(product, "parameter")}


@lru_cache(maxsize=4)
def operator_inputs(product: str) -> dict[str, tables.Signal]:
    """Inputs of a product that the other one does not drive, by name."""
    return {s.name: s for s in table().select(product, "input") if s.operator}


def defaults() -> Values:
    """Every parameter of both products at its default."""
    return {p: {name: s.default for name, s in known(p).items()} for p in tables.PRODUCTS}


def unknown(what: str, name: str, names) -> UserError:
    """An error that names the nearest known word, or all of them."""
    names = sorted(names)
    return UserError(f"unknown {what} '{name}'", nearest(name, names) or "known: " + ", ".join(names))


def range_text(signal: tables.Signal) -> str:
    unit = "" if signal.unit == "1" else f" {signal.unit}"
    return f"[{signal.low:g}, {signal.high:g}]{unit}"


def check(product: str, name: str, value) -> tuple[float, ...]:
    """The flat values of one parameter.

    value: a number (fills the array), a flat or nested list, or the name of an enum's entry.
    Raises UserError where name, type, length or range is wrong.
    """
    if name not in known(product):
        raise unknown(f"parameter of the {product}", name, known(product))
    signal = known(product)[name]
    where = f"{product}.{name}"
    flat = _flatten(value, signal.shape, where)
    if len(flat) == 1 and signal.count > 1 and not isinstance(value, list):
        flat = flat * signal.count
    if len(flat) != signal.count:
        raise UserError(f"{where} has {signal.count} elements {_shape_text(signal)}, not {len(flat)}")
    return tuple(_number(signal, where, element) for element in flat)


def _shape_text(signal: tables.Signal) -> str:
    return "(" + " x ".join(f"{n} {size}" for n, size in zip(signal.shape, signal.size_names)) + ")"


def _flatten(value, shape: tuple[int, ...], where: str) -> list:
    if not isinstance(value, list):
        return [value]
    if any(isinstance(v, list) for v in value):
        if len(shape) < 2 or len(value) != shape[0] or any(
            not isinstance(v, list) or len(v) != shape[1] for v in value
        ):
            wanted = " x ".join(str(n) for n in shape) if shape else "a single number"
            raise UserError(f"{where}: the list does not have the shape {wanted}")
        return [element for row in value for element in row]
    return list(value)


def _number(signal: tables.Signal, where: str, value) -> float:
    if isinstance(value, str) and signal.enum:
        entries = table().enums[signal.enum]
        if value not in entries:
            raise unknown(f"value of {where}", value, entries)
        value = entries.index(value)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise UserError(f"{where} needs a number, not {value!r}")
    if signal.kind == "int" and value != int(value):
        raise UserError(f"{where} needs a whole number, not {value!r}")
    if not math.isfinite(value) or not signal.low <= value <= signal.high:
        raise UserError(f"{where} = {value:g} is out of range {range_text(signal)} ({signal.text})")
    return float(value)


def plain(signal: tables.Signal, flat: tuple[float, ...]) -> int | float | str | list:
    """The values as a reader writes them: a number, an enum's word, a list or a list of rows."""
    kind = int if signal.kind == "int" else float
    values = [kind(v) for v in flat]
    if not signal.shape:
        return table().enums[signal.enum][values[0]] if signal.enum else values[0]
    if len(signal.shape) == 1:
        return values
    row = signal.shape[1]
    return [values[i : i + row] for i in range(0, len(values), row)]
