"""CSV and Parquet: one column a signal, time first."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.csv
import pyarrow.parquet

from hoap2.export import Order

BATCH = 5000


def write(wanted: Order, path: Path, form: str) -> None:
    """Names as in signals.parquet; the unit is in Parquet's field metadata. What is not known is empty."""
    log, rows = wanted.source.log, wanted.rows
    known = {c.name: c for c in (*log.reals, *log.ints)}
    ints = {c.name for c in log.ints}
    fields = [pyarrow.field("t_s", pyarrow.float64(), metadata={"unit": "s"})]
    for name in wanted.columns:
        kind = pyarrow.int32() if name in ints else pyarrow.float64()
        fields.append(pyarrow.field(name, kind, metadata={"unit": known[name].unit}))
    schema = pyarrow.schema(fields)
    with _writer(path, schema, form) as writer:
        for first in range(0, len(rows), BATCH):
            some = rows[first : first + BATCH]
            arrays = [pyarrow.array(log.t_s[some])]
            for name in wanted.columns:
                values = np.ascontiguousarray(log.column(name)[some])
                unknown = np.isnan(values) if name in wanted.source.sparse and name not in ints else None
                arrays.append(pyarrow.array(values, mask=unknown))
            writer.write_table(pyarrow.Table.from_arrays(arrays, schema=schema))
            wanted.progress(first + len(some), len(rows))


def _writer(path: Path, schema: pyarrow.Schema, form: str):
    if form == "csv":
        return pyarrow.csv.CSVWriter(path, schema)
    return pyarrow.parquet.ParquetWriter(path, schema, compression="zstd", use_dictionary=False)
