"""Two runs in one video: the same time on both sides; what has ended keeps its last picture and says so."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hoap2 import picture_labels as labels
from hoap2 import pictures, recording, soil_replay, video_file
from hoap2.figures.walk_data import Walk
from hoap2.recording import Recording
from hoap2.renderer import Renderer

FPS, SIDE_PX, GAP_PX = 25.0, (638, 720), 4
VIEW = "quarter"


@dataclass
class Side:
    """One of the two runs, ready to be drawn."""

    run: Recording
    name: str
    ending: str
    targets: np.ndarray
    soil: soil_replay.SoilReplay | None
    fall_s: float | None

    def row(self, t_s: float) -> int:
        return min(int(np.searchsorted(self.run.t_s, t_s - 1e-9)), len(self.run.t_s) - 1)

    def picture(self, row: int, camera: Renderer) -> np.ndarray:
        """The run at a row, without words."""
        if self.soil is not None:
            self.soil.show(camera, row)
        scene = pictures.scene_from_run(row, self.run, VIEW, self.targets[row], aspect=SIDE_PX[0] / SIDE_PX[1])
        return camera.draw(scene)

    def write_on(self, picture: np.ndarray, t_s: float) -> None:
        """What it is, the time, and the meaning of the sand's colours, in place."""
        labels.caption(picture, self.text(t_s))
        if self.soil is not None:
            labels.sinkage_scale(picture, self.soil.full_scale_m)

    def text(self, t_s: float) -> str:
        """`A: sand-walk   t = 3.20 s   step 5`, or how it ended."""
        if t_s > self.run.end_s + 1e-9:
            return f"{self.name}   {self.ending}"
        if self.fall_s is not None and t_s >= self.fall_s:
            return f"{self.name}   t = {t_s:.2f} s   fallen"
        step = self.run.values("step_index", self.row(t_s))
        return f"{self.name}   t = {t_s:.2f} s" + (
            f"   step {int(step[0])}" if step is not None and step[0] > 0 else ""
        )


def _side(walk: Walk, name: str) -> Side:
    run = recording.of_log(walk.folder, walk.log, walk.scenario)
    what = f"fell {walk.summary['fall_direction']}, " if walk.summary.get("fell") else ""
    what += "then an error, " if walk.summary.get("error") else ""
    ending = f"{what}ended at {run.end_s:.2f} s"
    return Side(run, name, ending, pictures.camera_targets(run), soil_replay.of_run(run), walk.fall_s)


def write(walks: tuple[Walk, Walk], names: tuple[str, str], path: Path,
          progress: Callable[[int, int], bool]) -> Path | None:  # fmt: skip
    """The longer run's time from its begin to its end; None, and no file, when progress returned False."""
    sides = [_side(walk, name) for walk, name in zip(walks, names)]
    end_s = max(side.run.end_s for side in sides)
    count = math.floor(end_s * FPS) + 1
    width, height = SIDE_PX
    whole = np.full((height, 2 * width + GAP_PX, 3), 255, dtype=np.uint8)
    last: list[tuple[int, np.ndarray] | None] = [None, None]
    # a camera each: the ground belongs to the camera
    with (
        video_file.writing(path, (2 * width + GAP_PX, height), FPS) as video,
        Renderer(width, height, samples=4) as first,
        Renderer(width, height, samples=4) as second,
    ):
        for k in range(count):
            for number, (side, camera) in enumerate(zip(sides, (first, second))):
                row, bare = side.row(k / FPS), last[number]
                if bare is None or bare[0] != row:  # a run that has ended is not drawn again
                    bare = last[number] = row, side.picture(row, camera)
                place = whole[:, number * (width + GAP_PX) : number * (width + GAP_PX) + width]
                place[...] = bare[1]
                side.write_on(place, k / FPS)
            labels.legend(whole[:, :width])
            video.write(whole)
            if not progress(k + 1, count):
                video.discard()
                return None
    return path
