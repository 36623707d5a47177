"""Signals as a user names them: a column, a whole signal of the table, an element without its product, or a pattern."""

from __future__ import annotations

import fnmatch
from collections.abc import Iterable

from hoap2.errors import UserError, nearest
from hoap2.signal_log import PREFIX, SignalLog

WILD = "*?["


def find(log: SignalLog, name: str) -> list[str]:
    """The columns that a name means: `p.r_knee.true_tau_Nm`, `r_knee.true_tau_Nm`, `cp_est_W_m`, `*knee*`.

    An element of a signal that both products tell means the one, of `c.` or `p.`, that is there.
    """
    columns = [column.name for column in (*log.reals, *log.ints)]
    if any(sign in name for sign in WILD):
        found = [c for c in columns if fnmatch.fnmatchcase(c, name) or fnmatch.fnmatchcase(c[2:], name)]
    else:
        found = [c for c in columns if name in (c, c[2:])] or [c for c in columns if name in _wholes(c)]
    if not found:
        known = {word for c in columns for word in (c, c[2:], *_wholes(c))}
        hint = nearest(name, sorted(known)) or "docs/generated/signals.md lists them; patterns such as '*knee*' work"
        raise UserError(f"this run has no signal '{name}'", hint)
    return found


def find_all(log: SignalLog, names: Iterable[str]) -> list[str]:
    """The columns of several names, each once."""
    return list(dict.fromkeys(column for name in names for column in find(log, name)))


def _wholes(column: str) -> tuple[str, ...]:
    """The whole signal that a column is an element of, with and without its product.

    `c.cp_est_W_m.x` -> cp_est_W_m; `p.r_knee.true_tau_Nm` -> true_tau_Nm; `c.foot_ref_W_m.r.x` -> foot_ref_W_m.
    """
    signal = whole(column)
    return (signal, column[:2] + signal)


def whole(column: str) -> str:
    """Name of the signal in the table that this column is an element of."""
    parts = column.split(".")[1:]
    return next((part for part in parts if part in _signals()), parts[0])


def _signals() -> set[str]:
    from hoap2 import parameters

    table = parameters.table()
    return {s.name for p in PREFIX for s in table.select(p, "output")}
