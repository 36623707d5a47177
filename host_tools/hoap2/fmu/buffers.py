"""The arrays that an FMU instance exchanges, and the parameters that it was given."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping

import numpy as np
import numpy.typing as npt
from fmpy.model_description import ModelDescription

from .archive import FmuVariableError, Row, nearest

DTYPE = {"real": np.float64, "int": np.int32}


class Exchange:
    """One direction and kind: an array, its references, and the FMI call that moves it."""

    def __init__(self, rows: list[Row], kind: str, version: int):
        self._made_of = rows, kind, version
        self.slices: dict[str, slice] = {}
        self.element_names: list[str] = []
        references: list[int] = []
        for row in rows:
            start = len(self.element_names)
            self.element_names += row.element_names
            self.slices[row.name] = slice(start, len(self.element_names))
            references += row.references
        self.array = np.zeros(len(self.element_names), dtype=DTYPE[kind])
        self._references = (ctypes.c_uint32 * len(references))(*references)
        self._count = ctypes.c_size_t(len(references))
        self._sizes = (ctypes.c_size_t(self.array.size),) if version == 3 else ()
        self.arguments = self.arguments_for(ctypes.c_void_p(self.array.ctypes.data))

    def arguments_for(self, values: ctypes.c_void_p) -> tuple:
        """The FMI call's arguments after the instance, for values at this address (which may change later)."""
        return (self._references, self._count, values, *self._sizes)

    def leading(self, count: int) -> Exchange:
        """The first rows alone, of `count` elements in all, with an array of their own."""
        if count == self.array.size:
            return self
        rows, kind, version = self._made_of
        ends = [where.stop for where in self.slices.values()]
        if count and count not in ends:
            raise ValueError(f"{count} elements are no whole rows: these end at {ends}")
        return Exchange(rows[: ends.index(count) + 1 if count else 0], kind, version)

    def check_rows(self, rows: np.ndarray) -> None:
        """Each row of (ticks, elements) can be handed to FMI as it lies in memory."""
        fits = rows.ndim == 2 and rows.dtype == self.array.dtype and rows.shape[1] == self.array.size
        if not fits or (rows.shape[1] > 1 and rows.strides[1] != rows.itemsize):
            raise ValueError(f"rows of {self.array.size} neighbouring {self.array.dtype} are needed")


class RowCall:
    """An FMI call that moves its values from or to rows of an array, which stay where they are."""

    def __init__(self, function: Callable[..., int], handle: ctypes.c_void_p, part: Exchange, rows: np.ndarray):
        part.check_rows(rows)
        self.function, self.rows = function, rows  # `rows` kept: the call has but its address
        self.values = ctypes.c_void_p()
        self.arguments = (handle, *part.arguments_for(self.values))
        self.address, self.stride = rows.ctypes.data, rows.strides[0]


class ParameterValues:
    """Parameters by row name or element name, checked, as the arrays that FMI wants."""

    def __init__(self, rows: Mapping[str, Row], product: str, description: ModelDescription):
        self._rows = {r.name: r for r in rows.values() if r.group == "parameter"}
        self._row_of_element = {name: r for r in self._rows.values() for name in r.element_names}
        self._product, self._description = product, description
        self._present: dict[str, np.ndarray] = {}

    def resolve(self, name: str, value: float | int | npt.ArrayLike) -> tuple[Row, np.ndarray]:
        """The row that a name means, and all of its elements with the new value in place."""
        try:
            given = np.asarray(value, dtype=np.float64).reshape(-1)
        except (TypeError, ValueError) as e:
            raise FmuVariableError(f"parameter {name}: {value!r} is not a number or a list of numbers") from e
        if name in self._rows:
            row = self._rows[name]
            if given.size not in (1, row.count):
                raise FmuVariableError(f"parameter {name} has {row.count} elements, {given.size} were given")
            values = np.broadcast_to(given, (row.count,))
        elif name in self._row_of_element:
            row = self._row_of_element[name]
            if given.size != 1:
                raise FmuVariableError(f"parameter {name} is one number, {given.size} were given")
            values = self._present_values(row).copy()
            values[row.element_names.index(name)] = given[0]
        else:
            raise FmuVariableError(f"the {self._product} has no parameter {name}{nearest(name, self._rows)}")
        if row.kind == "int" and not np.array_equal(values, np.round(values)):
            raise FmuVariableError(f"parameter {name} is an integer: {values.tolist()} is not")
        return row, np.ascontiguousarray(values, dtype=DTYPE[row.kind])

    def keep(self, row: Row, values: np.ndarray) -> None:
        """Remember what the FMU took."""
        self._present[row.name] = values.astype(np.float64)

    def _present_values(self, row: Row) -> np.ndarray:
        """As set before, else the start values of the description."""
        if row.name not in self._present:
            starts = {v.name: v.start for v in self._description.modelVariables}
            scalars = len(row.references) == row.count and row.name not in starts
            found = [starts[n] for n in (row.element_names if scalars else (row.name,))]
            numbers = found[0] if isinstance(found[0], list) else " ".join(map(str, found)).split()
            self._present[row.name] = np.array([float(x) for x in numbers])
        return self._present[row.name]
