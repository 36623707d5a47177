"""A finished run for other tools: tables (CSV, Parquet), MCAP for Foxglove, and rerun's own format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hoap2 import signal_names
from hoap2.errors import UserError
from hoap2.run_source import Source

PICTURE_HZ = 50.0  # poses of the links


@dataclass(frozen=True)
class Order:
    """What is wanted: `columns` of the run, every so many ticks; progress(done, total)."""

    source: Source
    columns: list[str]
    every: int
    progress: Callable[[int, int], None]

    @property
    def rows(self) -> np.ndarray:
        """Ticks to export."""
        return np.arange(0, self.source.log.count, self.every)


def order(source: Source, wanted: list[str], every: int, progress: Callable[[int, int], None]) -> Order:
    """An order for all columns, or the named ones."""
    log = source.log
    if not log.count:
        raise UserError(f"{source.path} is empty")
    every_column = [c.name for c in (*log.reals, *log.ints)]
    chosen = set(signal_names.find_all(log, wanted)) if wanted else set(every_column)
    return Order(source, [name for name in every_column if name in chosen], every, progress)


def run(form: str, wanted: Order, path: Path, force: bool) -> Path:
    """Write one format (`csv`, `parquet`, `mcap`, `rrd`); the file is there whole or not at all."""
    if path.exists() and not force:
        raise UserError(
            f"{path} is there already; nothing was overwritten", "choose another name with --out, or --force"
        )
    if form in ("csv", "parquet"):
        from hoap2.export.tables import write
    elif form == "mcap":
        from hoap2.export.mcap_file import write
    else:
        from hoap2.export.rrd_file import write
    part = path.with_name(f".{path.name}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write(wanted, part, form)
        part.rename(path)
    except OSError as error:
        raise UserError(f"cannot write {path}: {error.strerror or error}", "choose another place with --out") from None
    finally:
        part.unlink(missing_ok=True)
    return path


def missing_package(name: str, form: str) -> UserError:
    """The error for a package that is installed on need."""
    return UserError(f"the Python package {name} is not installed",
                     f"./hoap2 export --{form} installs it (host_tools/requirements/{form}.txt)", 3)  # fmt: skip
