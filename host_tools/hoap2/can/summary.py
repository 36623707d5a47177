"""What a run over CAN has to say in summary.json."""

from __future__ import annotations

import numpy as np

from hoap2 import parameters
from hoap2.can import library
from hoap2.can.link import CanLink
from hoap2.generate import can_table

ERROR_STATES = ("error active", "error passive", "bus-off")


def _named(values, names) -> dict[str, int]:
    """The counts that are not zero, by name."""
    return {name: int(value) for name, value in zip(names, values) if value}


def _latency(counts: library.Counts) -> dict[str, dict]:
    """By message: frames delivered, mean and largest time from queueing to arrival."""
    out = {}
    for kind in can_table.load().kinds:
        frames = counts.frames[kind.priority]
        if frames:
            out[kind.name] = {"frames": frames, "mean_us": counts.latency_sum_ns[kind.priority] / frames / 1e3,
                              "max_us": counts.latency_max_ns[kind.priority] / 1e3}  # fmt: skip
    return out


def _state(ticks: np.ndarray) -> str:
    """The controller's node at the end."""
    words = can_table.load().raw["enum"]["controller_state"]
    return words[int(ticks[-1, library.TICK_FIELDS.index("state")])] if len(ticks) else words[0]


def summarise(link: CanLink) -> dict:
    """Bus load, latency, losses, refusals, safe modes; percentages of the time of the run."""
    counts, ticks = link.counts(), link.ticks
    tick_us = parameters.table().tick_us
    buses = {}
    for i, name in enumerate(can_table.load().buses):
        busy_us = ticks[:, i] if len(ticks) else np.zeros(1)
        buses[name] = {
            "load_percent": 100 * counts.busy_ns[i] / (1e3 * tick_us * max(1, counts.ticks)),
            "busiest_tick_us": float(busy_us.max()),
            "queued": counts.queued[i], "delivered": counts.delivered[i], "pending": counts.pending[i],
            "lost": _named(counts.lost[i], library.CAUSES),
            "error_frames": counts.error_frames[i], "changed": counts.changed[i],
        }  # fmt: skip
    refused = library.refusals()
    return {
        "buses": buses,
        "lost_percent": 100 * sum(map(sum, counts.lost)) / max(1, sum(counts.queued)),
        "latency": _latency(counts),
        "refused_by_controller": _named(counts.refused_by_controller, refused),
        "refused_by_boards": _named(counts.refused_by_boards, refused),
        "holds": counts.holds,
        "hold_ticks": counts.hold_ticks,
        "clipped": counts.clipped,
        "controller_state": _state(ticks),
        "worst_error_state": ERROR_STATES[int(ticks[:, library.TICK_FIELDS.index("bus_modes")].max())]
                             if len(ticks) else ERROR_STATES[0],
    }


def notes(can: dict) -> list[str]:
    """What the user should know at once."""
    said = []
    if can["controller_state"] == "doubled":
        said.append("another controller is on the CAN bus: both fell silent, the boards hold; let only one run")
    if can["controller_state"] == "stopped":
        said.append("emergency stop over CAN: the drives damp until the power is switched")
    if can["worst_error_state"] == ERROR_STATES[2]:
        said.append("a node on the CAN bus was bus-off: many bit errors, or two senders of one identifier")
    if can["clipped"]:
        said.append(f"{can['clipped']} values of the controller did not fit their CAN field and were clipped")
    return said
