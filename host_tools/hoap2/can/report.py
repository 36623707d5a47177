"""The part of the report that tells of a run over CAN, and the run folder's can.parquet."""

from __future__ import annotations

from html import escape
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from hoap2 import parameters, plots
from hoap2.can import library
from hoap2.can.link import CanLink
from hoap2.generate import can_table
from hoap2.tables_shown import number

FILE_NAME = "can.parquet"
BIN_TICKS = 20


def write_ticks(path: Path, link: CanLink) -> None:
    """A row each tick: time on the wire, frames lost and refused, boards in their safe mode."""
    ticks = link.ticks
    names = ["t_s", *library.TICK_FIELDS]
    columns = [np.arange(len(ticks)) * parameters.table().tick_us / 1e6, *ticks.T]
    pyarrow.parquet.write_table(pyarrow.table(dict(zip(names, columns))), path, compression="zstd")


def section(link: CanLink, summary: dict) -> str:
    """The HTML of it; `summary` is that of can.summary."""
    picture = plots.svg(figure(link.ticks), "can")
    parts = [
        "<h2>CAN</h2>",
        f"<figure><h3>Bus load and losses</h3>{picture}<figcaption>Mean over {BIN_TICKS} ms; events as they happened. "
        "A board is in its safe mode when it holds or is stopped.</figcaption></figure>",
        _table(["bus", "load (%)", "busiest tick (us)", "frames", "delivered", "lost", "error frames"],
               [_bus_row(name, bus) for name, bus in summary["buses"].items()]),
        _table(["message", "frames", "mean latency (us)", "longest (us)"],
               [[name, number(row["frames"]), number(row["mean_us"]), number(row["max_us"])]
                for name, row in summary["latency"].items()]),
        _table(["", ""], _events(summary)),
    ]  # fmt: skip
    return "".join(parts)


def _bus_row(name: str, bus: dict) -> list[str]:
    lost = ", ".join(f"{count} {cause.replace('_', ' ')}" for cause, count in bus["lost"].items()) or "0"
    return [name, number(bus["load_percent"], 3), number(bus["busiest_tick_us"]), number(bus["queued"]),
            number(bus["delivered"]), lost, number(bus["error_frames"])]  # fmt: skip


def _events(summary: dict) -> list[list[str]]:
    def refused(counts: dict) -> str:
        return ", ".join(f"{count} {reason}" for reason, count in counts.items()) or "0"

    return [
        ["frames lost (%)", number(summary["lost_percent"], 3)],
        ["frames refused by the controller", refused(summary["refused_by_controller"])],
        ["frames refused by the boards", refused(summary["refused_by_boards"])],
        ["times that a board went to its safe mode", number(summary["holds"])],
        ["ticks in safe mode, summed over the boards", number(summary["hold_ticks"])],
        ["values that the coding could not hold", number(summary["clipped"])],
        ["worst error state of a node", summary["worst_error_state"]],
        ["controller's node at the end", summary["controller_state"]],
    ]


def _table(head: list[str], rows: list[list[str]]) -> str:
    lines = ["<tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows]
    return f'<div class="scroll"><table class="numbers">{"".join(lines)}</table></div>'


def figure(ticks: np.ndarray):
    """Load of both buses, and what went wrong, over time."""
    fig, axes = plots.stack(2, 3.6)
    tick_s = parameters.table().tick_us / 1e6
    whole = len(ticks) // BIN_TICKS * BIN_TICKS
    t_s = np.arange(0, whole, BIN_TICKS) * tick_s
    top, bottom = axes[0, 0], axes[1, 0]
    for i, (name, colour) in enumerate(zip(can_table.load().buses, (plots.RIGHT, plots.LEFT))):
        load = ticks[:whole, i].reshape(-1, BIN_TICKS).mean(axis=1) / (tick_s * 1e4)
        top.plot(t_s, load, color=colour, label=name)
    top.axhline(100 * can_table.load().raw["load_limit"], color=plots.INK, linestyle="--", linewidth=0.8)
    top.set_ylabel("load (%)")
    top.set_ylim(0, 105)
    plots.legend(top)
    all_s = np.arange(len(ticks)) * tick_s
    for column, label, colour in ((2, "frames lost", plots.RIGHT), (3, "frames refused", plots.LEFT),
                                  (4, "boards in safe mode", plots.THIRD)):  # fmt: skip
        bottom.plot(*plots.thin(all_s, ticks[:, column]), label=label, color=colour)
    bottom.set_ylabel("a tick")
    bottom.set_ylim(bottom=0)
    bottom.set_xlabel("t (s)")
    plots.legend(bottom)
    for a in (top, bottom):
        a.margins(x=0.0)
    return fig
