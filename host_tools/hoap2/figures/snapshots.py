"""Snapshots of a run as bare pictures, for panel A of the book's figures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from hoap2 import pictures, recording
from hoap2.figures.walk_data import Walk
from hoap2.renderer import Renderer

COUNT = 6
AFTER_FALL_S = 0.35


def moments(walk: Walk, count: int = COUNT) -> list[float]:
    """Times from the first step to the end, or to shortly after the fall."""
    first = walk.t_s[min(walk.step_ticks.values(), default=0)]
    end = walk.t_s[-1] if walk.fall_s is None else min(walk.t_s[-1], walk.fall_s + AFTER_FALL_S)
    return [float(t) for t in np.linspace(first, end, count)]


def take(walk: Walk, times: list[float], size_px: tuple[int, int], view: str = "side") -> list[np.ndarray]:
    """A picture a time, (height, width, 3) uint8, with smooth edges."""
    run = recording.of_log(Path(walk.folder), walk.log, walk.scenario)
    targets, found = pictures.camera_targets(run), []
    with Renderer(2 * size_px[0], 2 * size_px[1], samples=4) as camera:
        for t in times:
            row = run.row(min(t, run.end_s))
            picture = camera.draw(pictures.scene_from_run(row, run, view, targets[row]))
            found.append(np.array(Image.fromarray(picture).resize(size_px, Image.Resampling.BOX)))
    return found
