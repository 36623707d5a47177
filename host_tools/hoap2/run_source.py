"""What a command that takes a RUN may be given: a run folder, a scenario (its latest run), or an LCM log."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from hoap2 import signal_log
from hoap2.errors import UserError, nearest
from hoap2.signal_log import SignalLog
from hoap2.telemetry import log_file
from hoap2.telemetry.run_telemetry import LOG_NAME

SIGNALS_NAME = "signals.parquet"


def folder_of(run: str) -> Path:
    """The run folder: a path, or the latest run of a scenario below out/."""
    from hoap2 import scenario

    path = Path(run)
    if path.is_dir():
        return path
    runs = [folder for folder in (Path("out") / run).glob("[!.]*/") if (folder / SIGNALS_NAME).exists()]
    if runs and "/" not in run:
        return max(runs, key=lambda folder: (folder / SIGNALS_NAME).stat().st_mtime)
    if run in scenario.names():
        raise UserError(f"no run of {run} in {Path('out').resolve()}", f"make one: ./hoap2 run {run}")
    raise UserError(f"there is no run folder {run}", nearest(run, scenario.names()))


def log_of(run: str) -> Path:
    """The LCM log of a run, or the log itself."""
    path = Path(run)
    if path.is_file():
        return path
    folder = folder_of(run)
    if not (folder / LOG_NAME).is_file():
        raise UserError(f"{folder} holds no {LOG_NAME}",
                        f"it was made without; once more with it: ./hoap2 run {folder / 'run.toml'}")  # fmt: skip
    return folder / LOG_NAME


@dataclass
class Source:
    """The signals of a run and where they are from.

    folder: for files beside it. notes: what was wrong with them. sparse: columns that are known every tenth tick only.
    """

    name: str
    path: Path
    folder: Path
    log: SignalLog
    notes: list[str] = field(default_factory=list)
    sparse: frozenset[str] = frozenset()


def load(run: str) -> Source:
    """The signals of a run folder (signals.parquet) or of an LCM log."""
    path = Path(run)
    if path.is_file() and path.suffix == ".parquet":
        return Source(path.stem, path, path.parent, signal_log.read(path))
    if path.is_file():
        log, notes = log_file.read_signals(path)
        return Source(path.stem, path, path.parent, log, notes, log_file.sparse_columns())
    folder = folder_of(run)
    return Source(f"{folder.resolve().parent.name}/{folder.resolve().name}", folder / SIGNALS_NAME, folder,
                  signal_log.read(folder / SIGNALS_NAME))  # fmt: skip
