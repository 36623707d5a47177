"""Snapshots of a run as bare pictures, for panel A of the book's figures."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hoap2 import pictures, recording, soil_replay
from hoap2.figures.walk_data import Walk

COUNT = 6
BEFORE_FALL_S, AFTER_FALL_S = 0.3, 0.35


def moments(walk: Walk, count: int = COUNT) -> list[float]:
    """Times evenly from the first step to the end; of a fall one shortly before it and one shortly after."""
    first = walk.t_s[min(walk.step_ticks.values(), default=0)]
    if walk.fall_s is None:
        return [float(t) for t in np.linspace(first, walk.t_s[-1], count)]
    before = np.linspace(first, max(first, walk.fall_s - BEFORE_FALL_S), count - 1)
    return [float(t) for t in (*before, min(walk.t_s[-1], walk.fall_s + AFTER_FALL_S))]


def take(walk: Walk, times: list[float], size_px: tuple[int, int], view: str = "side") -> list[np.ndarray]:
    """A picture a time, (height, width, 3) uint8, with smooth edges; sand is coloured by its sinkage."""
    run = recording.of_log(Path(walk.folder), walk.log, walk.scenario)
    rows = [run.row(min(t, run.end_s)) for t in times]
    return list(pictures.stills(run, rows, view, True, size_px))


def sinkage_scale_mm(walk: Walk) -> float | None:
    """The sinkage at the end of the sand's colours; None on the rigid floor."""
    run = recording.of_log(Path(walk.folder), walk.log, walk.scenario)
    return 1e3 * soil_replay.full_scale_m(run) if run.on_soil else None
