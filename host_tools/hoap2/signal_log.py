"""The log of a run: every output of both products at every tick, in memory and as a Parquet file."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from hoap2 import parameters
from hoap2.errors import UserError

ROW_GROUP = 20000  # ticks; bounds what writing takes beside the log
PREFIX = {"controller": "c.", "plant": "p."}


@dataclass(frozen=True)
class Column:
    """One scalar signal: `c.roll_est_rad`, `p.r_knee.true_tau_Nm`."""

    name: str
    unit: str
    kind: str  # "real" or "int"


@lru_cache(maxsize=1)
def _signals() -> dict[str, object]:
    table = parameters.table()
    return {PREFIX[p] + s.name: s for p in PREFIX for s in table.select(p, "output")}


def columns_of(product: str) -> list[Column]:
    """The columns of a product's outputs, in the order of its C structure and its FMU."""
    table = parameters.table()
    return [
        Column(PREFIX[product] + element, signal.unit, signal.kind)
        for signal in table.select(product, "output")
        for element in table.element_names(signal)
    ]


class SignalLog:
    """Preallocated rows; row k holds all outputs at tick k. `count` rows are filled.

    The arrays are not cleared: a row costs memory only once it is written.
    """

    def __init__(self, columns: list[Column], capacity: int) -> None:
        self.reals = [c for c in columns if c.kind == "real"]
        self.ints = [c for c in columns if c.kind == "int"]
        self.real = np.empty((capacity, len(self.reals)))
        self.integer = np.empty((capacity, len(self.ints)), dtype=np.int32)
        self.count = 0
        self._index = {c.name: i for group in (self.reals, self.ints) for i, c in enumerate(group)}
        self._is_int = {c.name for c in self.ints}

    @property
    def t_s(self) -> np.ndarray:
        return np.arange(self.count) * (parameters.table().tick_us / 1e6)

    def __contains__(self, name: str) -> bool:
        return name in self._index

    def column(self, name: str) -> np.ndarray:
        """One scalar signal over time (a view)."""
        data = self.integer if name in self._is_int else self.real
        return data[: self.count, self._index[name]]

    def block(self, name: str) -> np.ndarray | None:
        """A whole signal of the table, (ticks, elements); None when this run does not have it."""
        signal = _signals()[name]
        prefix = name[:2]
        elements = [prefix + element for element in parameters.table().element_names(signal)]
        if any(element not in self._index for element in elements):
            return None
        data = self.integer if elements[0] in self._is_int else self.real
        index = [self._index[element] for element in elements]
        if index == list(range(index[0], index[0] + len(index))):
            return data[: self.count, index[0] : index[0] + len(index)]
        return data[: self.count, index]

    def write(self, path: Path) -> None:
        """One column a scalar signal, time first, the unit in each field's metadata."""
        fields = [pyarrow.field("t_s", pyarrow.float64(), metadata={"unit": "s"})]
        for column in self.reals + self.ints:
            kind = pyarrow.float64() if column.kind == "real" else pyarrow.int32()
            fields.append(pyarrow.field(column.name, kind, metadata={"unit": column.unit}))
        schema, t_s = pyarrow.schema(fields), self.t_s
        with pyarrow.parquet.ParquetWriter(path, schema, compression="zstd", use_dictionary=False) as writer:
            for first in range(0, max(1, self.count), ROW_GROUP):
                rows = slice(first, min(first + ROW_GROUP, self.count))
                arrays = [pyarrow.array(t_s[rows])]
                for column in self.reals + self.ints:
                    arrays.append(pyarrow.array(np.ascontiguousarray(self.column(column.name)[rows])))
                writer.write_table(pyarrow.Table.from_arrays(arrays, schema=schema))


def read(path: Path) -> SignalLog:
    """The log of a finished run."""
    try:
        table = pyarrow.parquet.read_table(path)
    except (OSError, pyarrow.ArrowInvalid) as error:
        raise UserError(f"cannot read {path}: {error}") from None
    columns = []
    for field in table.schema:
        unit = (field.metadata or {}).get(b"unit", b"1").decode()
        if field.name != "t_s":
            columns.append(Column(field.name, unit, "int" if pyarrow.types.is_integer(field.type) else "real"))
    log = SignalLog(columns, table.num_rows)
    log.count = table.num_rows
    for column in columns:
        log.column(column.name)[:] = table[column.name].to_numpy()
    return log
