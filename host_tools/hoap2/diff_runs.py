"""`diff`: where two runs part: the first tick with unequal values, and how far each signal goes from there."""

from __future__ import annotations

import tomllib
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from hoap2 import parameters, signal_names
from hoap2.errors import UserError
from hoap2.run_source import Source
from hoap2.signal_log import SignalLog
from hoap2.telemetry import log_file

SHOWN = 12


@dataclass(frozen=True)
class Parting:
    """One column from where it differs: tick, both values there, and its largest difference."""

    name: str
    unit: str
    tick: int
    a: float
    b: float
    largest: float
    largest_tick: int


def partings(a: SignalLog, b: SignalLog, tolerance: float = 0.0, sparse: Collection[str] = ()) -> list[Parting]:
    """Every common column that differs by more than the tolerance, those that do first at the top. NaN equals NaN.

    Of the columns in `sparse` only every tenth tick is known.
    """
    count, found = min(a.count, b.count), []
    there = {c.name for c in (*b.reals, *b.ints)}
    for column in (*a.reals, *a.ints):
        if column.name not in there:
            continue
        step = log_file.TRUTH_TICKS if column.name in sparse else 1
        x, y = (log.column(column.name)[:count:step].astype(float) for log in (a, b))
        nan = np.isnan(x) != np.isnan(y)
        difference = np.where(np.isnan(x) | np.isnan(y), 0.0, np.abs(x - y))
        unequal = nan | (difference > tolerance)
        if unequal.any():
            k, most = int(np.argmax(unequal)), int(np.argmax(difference))
            found.append(Parting(column.name, column.unit, step * k, float(x[k]), float(y[k]), float(difference[most]),
                                 step * most))  # fmt: skip
    return sorted(found, key=lambda p: (p.tick, -p.largest))


def parameters_apart(a: Source, b: Source) -> list[dict]:
    """The values of run.toml that differ (not the record of the run); [] when one of them has none."""
    files = [source.folder / "run.toml" for source in (a, b)]
    if not all(source.path.suffix == ".parquet" and file.is_file() for source, file in zip((a, b), files)):
        return []
    documents = [_flat(tomllib.loads(Path(file).read_text(encoding="utf-8"))) for file in files]
    names = [n for n in dict.fromkeys((*documents[0], *documents[1])) if not n.startswith(("record.", "scenario."))]
    return [{"parameter": n, "a": documents[0].get(n), "b": documents[1].get(n)}
            for n in names if documents[0].get(n) != documents[1].get(n)]  # fmt: skip


def _flat(value: dict, prefix: str = "") -> dict:
    out: dict = {}
    for key, item in value.items():
        out |= _flat(item, f"{prefix}{key}.") if isinstance(item, dict) else {prefix + key: item}
    return out


def document(a: Source, b: Source, tolerance: float) -> dict:
    """All that `diff --json` prints."""
    names = [{c.name for c in (*s.log.reals, *s.log.ints)} for s in (a, b)]
    if not names[0] & names[1]:
        raise UserError(f"{a.path} and {b.path} have no signal in common")
    sparse = a.sparse | b.sparse
    found, tick_s = partings(a.log, b.log, tolerance, sparse), parameters.table().tick_us / 1e6
    first = found[0].tick if found else min(a.log.count, b.log.count) if a.log.count != b.log.count else None
    return {
        "a": str(a.path), "b": str(b.path), "equal": first is None and names[0] == names[1],
        "ticks": [a.log.count, b.log.count], "tolerance": tolerance,
        "first_tick": first, "first_s": None if first is None else first * tick_s,
        "only_in_a": sorted(names[0] - names[1]), "only_in_b": sorted(names[1] - names[0]),
        "parameters": parameters_apart(a, b),
        "signals": [vars(p) | {"t_s": p.tick * tick_s, "largest_s": p.largest_tick * tick_s} for p in found],
    }  # fmt: skip


def show(found: dict, console: Console) -> None:
    """For people: the verdict, the parameters, the signals in the order in which they part."""
    if not console.is_terminal:
        console = Console(highlight=False, width=160)
    if found["equal"]:
        console.print(f"equal: {found['ticks'][0]} ticks, every signal" + _within(found))
        return
    for row in found["parameters"]:
        console.print(f"{row['parameter']}: {row['a']} | {row['b']}", soft_wrap=True)
    for key, who in (("only_in_a", "first"), ("only_in_b", "second")):
        if found[key]:
            console.print(f"only in the {who}: {len(found[key])} signals ({', '.join(found[key][:3])})")
    if found["first_tick"] is None:
        return
    lengths = found["ticks"]
    if not found["signals"]:
        console.print(f"equal up to the end of the shorter one{_within(found)}: {lengths[0]} and {lengths[1]} ticks")
        return
    at = [s for s in found["signals"] if s["tick"] == found["first_tick"]]
    wholes = dict.fromkeys(signal_names.whole(s["name"]) for s in at)
    console.print(f"they part at {found['first_s']:.3f} s (tick {found['first_tick']}){_within(found)}, "
                  f"in {', '.join(list(wholes)[:6])}{' and more' if len(wholes) > 6 else ''}")  # fmt: skip
    if lengths[0] != lengths[1]:
        console.print(f"one is longer: {lengths[0]} and {lengths[1]} ticks")
    console.print(_table(found["signals"]))


def _within(found: dict) -> str:
    return f" (within {found['tolerance']:g})" if found["tolerance"] else ""


def _table(signals: list[dict]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    table.add_column("signal", no_wrap=True)
    for head in ("parts at s", "A", "B", "largest difference", "at s"):
        table.add_column(head, justify="right", no_wrap=True)
    for s in signals[:SHOWN]:
        unit = "" if s["unit"] == "1" else f" {s['unit']}"
        table.add_row(s["name"], f"{s['t_s']:.3f}", f"{s['a']:.9g}", f"{s['b']:.9g}", f"{s['largest']:.3g}{unit}",
                      f"{s['largest_s']:.3f}")  # fmt: skip
    if len(signals) > SHOWN:
        table.add_row(f"and {len(signals) - SHOWN} more (--json)")
    return table
