"""The soil of a run that is under way: its pool again, moved through by the poses of truth_t.

The plant has a pose each millisecond, the messages one each 10 ms; between them the way is taken to be straight.
"""

from __future__ import annotations

import numpy as np

from hoap2.monitor.track import SoilTeller, pack
from hoap2.soil_replay import Pool

FULL_SCALE_M = 0.010  # of the colours: how deep the run will sink is not known yet
MAX_GAP_TICKS = 60  # over a longer gap the way is not known
LOOK_TICKS = 100  # between two looks at the surface


class LiveSoil:
    """The pool of a live run, and what of it the pages have been told."""

    def __init__(self, plant: dict) -> None:
        self._pool = Pool(plant)
        surface = self._pool.look()
        self._teller = SoilTeller(self._pool.grid, FULL_SCALE_M, surface.height_m - surface.change_m)
        self._last: tuple[int, np.ndarray] | None = None
        self._looked = 0
        self.note = ""

    def move(self, message) -> None:
        """The next truth_t."""
        row = np.concatenate([message.true_base_pos_W_m, message.true_base_quat_W, message.true_q_rad])
        tick = message.tick
        if self._last is None:
            self._advance(row[None])
            if tick > 0:
                self.note = f"tracks from {message.time_us / 1e6:.1f} s on"
        elif 0 < tick - self._last[0] <= MAX_GAP_TICKS:
            share = np.arange(1, tick - self._last[0] + 1)[:, None] / (tick - self._last[0])
            before = self._last[1].copy()
            if before[3:7] @ row[3:7] < 0.0:
                before[3:7] *= -1.0  # the same orientation, on the same half of the sphere
            self._advance(before + share * (row - before))
        elif tick != self._last[0]:
            self.note = f"tracks are incomplete: nothing came from {self._last[0] / 1000:.1f} to {tick / 1000:.1f} s"
        self._last = (tick, row)

    def _advance(self, rows: np.ndarray) -> None:
        quat = rows[:, 3:7] / np.linalg.norm(rows[:, 3:7], axis=1, keepdims=True)
        self._pool.advance(*(np.ascontiguousarray(part) for part in (rows[:, :3], quat, rows[:, 7:])))

    def whole(self) -> bytes:
        """Everything told so far, for a page that has just come."""
        cells = np.flatnonzero(self._teller.whole() != self._teller.base_m).astype(np.uint32)
        return self._pack("soil", cells, self._teller.whole()[cells], base=True)

    def changes(self) -> bytes | None:
        """What changed since, at most ten times a simulated second."""
        if self._last is None or 0 <= self._last[0] - self._looked < LOOK_TICKS:
            return None
        self._looked = self._last[0]
        cells, heights = self._teller.changes(self._pool.look().height_m)
        return self._pack("soil_changes", cells, heights) if len(cells) else None

    def _pack(self, kind: str, cells: np.ndarray, heights: np.ndarray, base: bool = False) -> bytes:
        arrays = {"t_s": np.array([(self._last[0] if self._last else 0) * 1e-3]),
                  "count": np.array([len(cells)], dtype=np.uint32), "cells": cells, "heights": heights}  # fmt: skip
        header = {"kind": kind, "note": self.note}
        if base:
            header["grid"] = self._teller.header()
            arrays["base"] = self._teller.base_m
        return pack(header, arrays)
