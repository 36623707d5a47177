"""How values travel in a run: outputs into the rows of the log, inputs out of them.

A side that can (an FMU) reads its outputs straight into a row of the log and takes its inputs straight from one,
so that no value is copied on its way from one product to the other. Any other side copies through its own arrays.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from hoap2 import parameters
from hoap2.errors import UserError
from hoap2.signal_log import PREFIX, Column, SignalLog

KINDS = ("real", "int")
RowCall = Callable[[int], None]  # moves the values of one side from or to the row of this number


class Side(Protocol):
    """What the master needs of a product, be it an FMU or a library.

    A side may also have `reads_into(real, integer)` and `writes_from(real, integer)`: RowCalls that move all its
    outputs into, or its inputs from, a row of these arrays (ticks, elements; the elements of a row are
    neighbours in memory) without using the arrays below. Arrays with fewer columns than there are inputs hold the
    first ones; the others, which are the operator's, keep what `set_input(name, values)` gave them.
    """

    outputs: list[Column]  # without prefix, reals first
    inputs: list[Column]
    real_out: np.ndarray  # float64, filled by get_outputs
    int_out: np.ndarray  # int32
    real_in: np.ndarray  # taken by set_inputs; starts at the product's defaults
    int_in: np.ndarray

    def get_outputs(self) -> None: ...
    def set_inputs(self) -> None: ...
    def step(self) -> None: ...


Place = np.ndarray | slice


def as_slice(index: np.ndarray) -> Place:
    """A run of neighbours as a slice, which copies faster than a list of places."""
    contiguous = np.array_equal(index, np.arange(index[0], index[0] + index.size))
    return slice(int(index[0]), int(index[0]) + index.size) if contiguous else index


def _places(source: Side, target: Side) -> dict[str, tuple[Place, Place]]:
    """Connections by equal names, by kind: where in the target's inputs, where in the source's outputs."""
    places = {}
    for kind in KINDS:
        where = {c.name: i for i, c in enumerate([c for c in source.outputs if c.kind == kind])}
        targets = [c.name for c in target.inputs if c.kind == kind]
        pairs = [(i, where[name]) for i, name in enumerate(targets) if name in where]
        if pairs:
            index_in, index_out = (as_slice(np.array(index)) for index in zip(*pairs))
            places[kind] = (index_in, index_out)
    return places


def connect(source: Side, target: Side) -> list[tuple[np.ndarray, np.ndarray, Place, Place]]:
    """Connections as (target array, source array, target index, source index), reals and ints."""
    return [
        (getattr(target, f"{kind}_in"), getattr(source, f"{kind}_out"), index_in, index_out)
        for kind, (index_in, index_out) in _places(source, target).items()
    ]


def check_connections(controller: Side, plant: Side) -> None:
    """An input of either side that the other does not drive is an error, not a default, but for the operator's."""
    for target, source, who, other in (
        (controller, plant, "controller", "plant"),
        (plant, controller, "plant", "controller"),
    ):
        have = {(c.name, c.kind) for c in source.outputs}
        open_ones = _operator_elements(who)
        missing = [c.name for c in target.inputs if (c.name, c.kind) not in have and c.name not in open_ones]
        if missing:
            raise UserError(
                f"the {other} has no output for {len(missing)} input(s) of the {who}: {', '.join(missing[:5])}",
                "both must use the names of docs/generated/signals.md",
            )


def _operator_elements(product: str) -> set[str]:
    return {e for s in parameters.operator_inputs(product).values() for e in parameters.table().element_names(s)}


def log_columns(controller: Side, plant: Side) -> list[Column]:
    """The log's columns: both products' outputs with their prefixes."""
    return [
        Column(PREFIX[product] + c.name, c.unit, c.kind)
        for product, side in (("controller", controller), ("plant", plant))
        for c in side.outputs
    ]


class Recorder:
    """Reads both products' outputs into rows of the log: `reads[i](k)` fills the part of product i in row k."""

    def __init__(self, controller: Side, plant: Side, log: SignalLog) -> None:
        self.log = log
        real, integer = controller.real_out.size, controller.int_out.size
        self.parts = ((log.real[:, :real], log.integer[:, :integer]), (log.real[:, real:], log.integer[:, integer:]))
        self.reads = tuple(reader(side, *part) for side, part in zip((controller, plant), self.parts))

    def row(self) -> None:
        """Fill the next row."""
        for read in self.reads:
            read(self.log.count)
        self.log.count += 1


def reader(side: Side, real: np.ndarray, integer: np.ndarray) -> RowCall:
    """Puts the outputs of a side into a row of these arrays."""
    if hasattr(side, "reads_into"):
        return side.reads_into(real, integer)
    get_outputs, real_out, int_out = side.get_outputs, side.real_out, side.int_out

    def read(k: int) -> None:
        get_outputs()
        real[k], integer[k] = real_out, int_out

    return read


def writer(source: Side, target: Side, real: np.ndarray, integer: np.ndarray) -> RowCall:
    """Sets the inputs of the target from a row of these arrays, which hold the source's outputs."""
    places, rows = _places(source, target), {"real": real, "int": integer}
    if hasattr(target, "writes_from") and _in_order(target, places):
        return target.writes_from(*(rows[kind][:, places[kind][1] if kind in places else slice(0)] for kind in KINDS))
    wires = [(getattr(target, f"{kind}_in"), rows[kind], *place) for kind, place in places.items()]
    set_inputs = target.set_inputs

    def write(k: int) -> None:
        for into, row_of, index_in, index_out in wires:
            into[index_in] = row_of[k][index_out]
        set_inputs()

    return write


def _in_order(target: Side, places: dict[str, tuple[Place, Place]]) -> bool:
    """The driven inputs of the target come first, and in the source their values are neighbours in the same order."""
    for kind in KINDS:
        index_in, index_out = places.get(kind, (slice(0, 0), slice(0, 0)))
        if not isinstance(index_in, slice) or index_in.start != 0 or not isinstance(index_out, slice):
            return False
    return True


Rows = tuple[np.ndarray, np.ndarray]  # reals and ints of a side's outputs, (ticks, elements)


class Link(Protocol):
    """What carries the outputs of each side to the inputs of the other."""

    def writers(self, controller: Side, plant: Side, of_controller: Rows, of_plant: Rows) -> tuple[RowCall, RowCall]:
        """What sets the inputs of the controller and those of the plant, called in this order at each tick."""


class DirectLink:
    """Values are copied."""

    def writers(self, controller: Side, plant: Side, of_controller: Rows, of_plant: Rows) -> tuple[RowCall, RowCall]:
        return writer(plant, controller, *of_plant), writer(controller, plant, *of_controller)
