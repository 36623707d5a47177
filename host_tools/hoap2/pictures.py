"""Pictures of runs: a frame of any moment, a strip of moments, the video.

Both take a run folder or a Recording: write_frame("out/floor-walk/first", 3.2, "frame.png", view="side").
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from hoap2 import picture_labels as labels
from hoap2 import recording, renderer, soil_replay, video_file
from hoap2.errors import UserError
from hoap2.recording import Recording
from hoap2.renderer import Renderer, Scene

__all__ = ["VIEWS", "Renderer", "Scene", "parse_size", "scene_from_run", "strip", "write_frame", "write_video"]

DISTANCE_M = 1.3
FEET_OVER_FLOOR_M = 0.025
POOL_MARGIN = 1.12
FOLLOW_S = 0.6  # width of the smoothing of the camera's way
TARGET_OVER_HIPS_M = 0.015
SUPERSAMPLING_UP_TO_PX = 2048


@dataclass(frozen=True)
class View:
    """Where the camera stands relative to the heading at the start, and what it looks at: hips, feet or pool."""

    azimuth_rad: float
    elevation_rad: float
    distance_m: float = DISTANCE_M
    target: str = "hips"


VIEWS = {
    "quarter": View(math.radians(-48), math.radians(13)),
    "side": View(math.radians(-90), math.radians(6)),  # from the right: the robot walks from left to right
    "front": View(0.0, math.radians(6)),
    "back": View(math.radians(155), math.radians(13)),
    "top": View(math.radians(-90), math.radians(86), 1.6),
    "feet": View(math.radians(-58), math.radians(22), 0.62, "feet"),
    "pool": View(math.radians(-90), math.radians(88), 0.0, "pool"),  # as far away as it takes
}


def _view(name: str) -> View:
    if name not in VIEWS:
        raise UserError(f"unknown view '{name}'", "known: " + ", ".join(VIEWS))
    return VIEWS[name]


def parse_size(text: str) -> tuple[int, int]:
    """`960x540` as (width, height)."""
    try:
        width, height = (int(part) for part in text.lower().split("x"))
    except ValueError:
        raise UserError(f"'{text}' is no picture size", "write it as 960x540") from None
    return width, height


def _load(run: Recording | str | Path) -> Recording:
    return run if isinstance(run, Recording) else recording.load(run)


def camera_targets(run: Recording) -> np.ndarray:
    """The point the camera looks at, (ticks, 3): the way of the hips, smoothed without delay."""
    way = run.signal["true_base_pos_W_m"] + (0.0, 0.0, TARGET_OVER_HIPS_M)
    half = max(1, round(FOLLOW_S / max(1e-4, np.median(np.diff(run.t_s)) if len(run.t_s) > 1 else 1e-3)))
    window = np.hanning(2 * half + 1)
    window /= window.sum()
    # Beyond both ends the robot is taken to go on as it does there.
    padded = np.concatenate([2 * way[:1] - way[half:0:-1] if len(way) > half else np.repeat(way[:1], half, axis=0), way,
                             np.repeat(way[-1:], half, axis=0)])  # fmt: skip
    return np.column_stack([np.convolve(padded[:, i], window, mode="valid") for i in range(3)])


def _set_terrain(scene: Scene, run: Recording) -> None:
    scene.floor_tilt_rad = run.plant.get("floor_tilt_rad", [0.0, 0.0])
    start = run.plant.get("start_pos_W_m", [0.0, 0.0])
    scene.floor_origin_W_m = [start[0], start[1], 0.0]
    count = min(int(run.plant.get("block_count", 0)), renderer.MAX_BLOCKS)
    if count:
        scene.block_centre_W_m[:count] = np.reshape(run.plant["block_centre_W_m"], (-1, 3))[:count]
        scene.block_size_m[:count] = np.reshape(run.plant["block_size_m"], (-1, 3))[:count]
        scene.block_yaw_W_rad[:count] = np.ravel(run.plant["block_yaw_W_rad"])[:count]
    scene.block_count = count


def _floor_height_m(run: Recording, x_W_m: float, y_W_m: float) -> float:
    """Of the tilted floor (Rx(tilt x) Ry(tilt y) through the start point) in the world."""
    about_x, about_y = run.plant.get("floor_tilt_rad", [0.0, 0.0])
    start = run.plant.get("start_pos_W_m", [0.0, 0.0])
    return (math.sin(about_x) * (y_W_m - start[1]) - math.tan(about_y) * (x_W_m - start[0])) / math.cos(about_x)


def _aim(scene: Scene, run: Recording, seen: View, hips_W_m: np.ndarray, aspect: float) -> None:
    """Point the camera. hips_W_m: the smoothed point that it follows; aspect: width by height of the picture."""
    scene.camera_azimuth_rad = seen.azimuth_rad + float(run.plant.get("start_yaw_W_rad", 0.0))
    scene.camera_elevation_rad, scene.camera_distance_m = seen.elevation_rad, seen.distance_m
    scene.camera_target_W_m = hips_W_m
    if seen.target == "feet":
        scene.camera_target_W_m[2] = _floor_height_m(run, *hips_W_m[:2]) + FEET_OVER_FLOOR_M
    elif seen.target == "pool":
        x_m, y_m = run.plant["soil_centre_m"]
        yaw = float(run.plant.get("start_yaw_W_rad", 0.0))
        start = run.plant.get("start_pos_W_m", [0.0, 0.0])
        place = (start[0] + math.cos(yaw) * x_m - math.sin(yaw) * y_m,
                 start[1] + math.sin(yaw) * x_m + math.cos(yaw) * y_m)  # fmt: skip
        scene.camera_target_W_m = (*place, _floor_height_m(run, *place))
        length_m, width_m, _ = run.plant["soil_size_m"]
        tall_m = POOL_MARGIN * max(width_m, length_m / aspect)
        scene.camera_distance_m = 0.5 * tall_m / math.tan(0.5 * renderer.FOV_Y_RAD)


def scene_from_run(table_row: int, run: Recording, view: str = "quarter", target_W_m=None,
                   overlays: bool = True, aspect: float = 16 / 9) -> Scene:  # fmt: skip
    """The scene at one row of a recording (`Recording.row(t_s)` finds it), without its soil."""
    seen = _view(view)
    if seen.target == "pool" and not run.on_soil:
        raise UserError(f"view '{view}' shows the pool of a run on soil; this run has a rigid floor")
    scene = Scene()
    scene.base_pos_W_m = run.values("true_base_pos_W_m", table_row)
    scene.base_quat_W = run.values("true_base_quat_W", table_row)
    scene.q_rad = run.values("true_q_rad", table_row)
    scene.com_W_m = run.values("true_com_W_m", table_row)
    scene.cop_W_m = run.values("true_cop_W_m", table_row)
    if run.values("cp_est_W_m", table_row) is not None:
        scene.cp_W_m = run.values("cp_est_W_m", table_row)
    for x, y, yaw, left in run.footprints(table_row):
        scene.add_footprint(x, y, yaw, left)
    _set_terrain(scene, run)
    pushes = run.active_pushes(float(run.t_s[table_row]))
    if pushes:
        link, point_L_m = pushes[0]
        pose = scene.link_pose(link)
        scene.push_force_W_N = run.values("true_push_force_W_N", table_row)
        scene.push_point_W_m = pose[:, :3] @ point_L_m + pose[:, 3]
    _aim(scene, run, seen, camera_targets(run)[table_row] if target_W_m is None else target_W_m, aspect)
    if not overlays:
        scene.show = renderer.SHOW_PUSH | renderer.SHOW_SHADOW
    return scene


def _has_push(run: Recording) -> bool:
    return bool(np.any(np.asarray(run.plant.get("push_duration_s", [0.0])) > 0.0))


def _caption(run: Recording, row: int) -> str:
    text = f"{run.name}   t = {run.t_s[row]:.2f} s"
    step = run.values("step_index", row)
    return f"{text}   step {int(step[0])}" if step is not None and step[0] > 0 else text


def stills(run: Recording, rows: Iterable[int], view: str, overlays: bool,
            size: tuple[int, int]) -> Iterator[np.ndarray]:  # fmt: skip
    """Pictures with smooth edges: four samples a pixel, at twice the size where that is possible."""
    width, height = size
    factor = 2 if max(width, height) <= SUPERSAMPLING_UP_TO_PX else 1
    targets, soil = camera_targets(run), soil_replay.of_run(run)
    # One camera for all: it takes longer than a picture.
    with Renderer(width * factor, height * factor, samples=4) as camera:
        for row in rows:
            if soil is not None:
                soil.show(camera, row)
            picture = camera.draw(scene_from_run(row, run, view, targets[row], overlays, width / height))
            if factor != 1:
                picture = np.array(Image.fromarray(picture).resize((width, height), Image.Resampling.BOX))
            yield picture


def _write_on(picture: np.ndarray, run: Recording, row: int) -> None:
    """Time, legend of the marks, and of the colours of the soil."""
    labels.caption(picture, _caption(run, row))
    labels.legend(picture, _has_push(run))
    if run.on_soil:
        labels.sinkage_scale(picture, soil_replay.full_scale_m(run))


def _check_target(path: Path, suffixes: tuple[str, ...], overwrite: bool) -> Path:
    path = Path(path)
    if path.suffix.lower() not in suffixes:
        raise UserError(f"{path}: the name must end in {' or '.join(suffixes)}")
    if path.exists() and not overwrite:
        raise UserError(f"{path} is there already; nothing was overwritten", "give another name")
    if not path.parent.is_dir():
        raise UserError(f"there is no folder {path.parent}")
    return path


def _save(picture: np.ndarray, path: Path) -> Path:
    """Write beside the place, then rename: a picture is there whole or not at all."""
    part = path.with_name(f".{path.stem}.part-{os.getpid()}{path.suffix}")
    try:
        Image.fromarray(picture).save(part)
        part.replace(path)
    except OSError as error:
        raise UserError(f"cannot write {path}: {error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)
    return path


def write_frame(run: Recording | str | Path, t_s: float, path: str | Path, size: tuple[int, int] = (1280, 720),
                view: str = "quarter", overlays: bool = True, overwrite: bool = False) -> Path:  # fmt: skip
    """One moment of a run as a picture file."""
    path = _check_target(Path(path), (".png", ".jpg", ".webp"), overwrite)
    run = _load(run)
    row = run.row(t_s)
    (picture,) = stills(run, [row], view, overlays, size)
    if overlays:
        _write_on(picture, run, row)
    return _save(picture, path)


def strip(run: Recording | str | Path, times: list[float], path: str | Path, size: tuple[int, int] = (320, 480),
          view: str = "quarter", overlays: bool = True, overwrite: bool = False) -> Path:  # fmt: skip
    """Snapshots side by side, each `size` large."""
    path = _check_target(Path(path), (".png", ".jpg", ".webp"), overwrite)
    if not times:
        raise UserError("a strip needs at least one time")
    run = _load(run)
    rows = [run.row(t) for t in times]
    pictures = list(stills(run, rows, view, overlays, size))
    for row, picture in zip(rows, pictures):
        labels.caption(picture, f"{run.t_s[row]:.2f} s")
    gap = np.full((size[1], 2, 3), 255, dtype=np.uint8)
    parts = [part for picture in pictures for part in (picture, gap)][:-1]
    return _save(np.concatenate(parts, axis=1), path)


def _feed(run: Recording, rows: list[int], size: tuple[int, int], view: str, samples: int, out: video_file.VideoFile,
          progress: Callable[[int, int], object] | None) -> bool:  # fmt: skip
    """Draw the rows into the encoder; False when progress asked to stop (it returned False)."""
    targets, soil = camera_targets(run), soil_replay.of_run(run)
    with Renderer(*size, samples=samples) as camera:
        picture = np.empty((size[1], size[0], 3), dtype=np.uint8)
        for done, row in enumerate(rows):
            if soil is not None:
                soil.show(camera, row)
            camera.draw(scene_from_run(row, run, view, targets[row], aspect=size[0] / size[1]), picture)
            _write_on(picture, run, row)
            out.write(picture)
            if progress is not None and progress(done + 1, len(rows)) is False:
                return False
    return True


def write_video(run: Recording | str | Path, path: str | Path, fps: float = 25.0, size: tuple[int, int] = (960, 540),
                slow: float = 1.0, progress: Callable[[int, int], object] | None = None, view: str = "quarter",
                samples: int = 4, overwrite: bool = False) -> Path | None:  # fmt: skip
    """The whole run as MP4 (H.264). slow = 2 plays at half speed. progress(done, total) may return False to stop;
    then nothing is left behind and the answer is None."""
    path = _check_target(Path(path), (".mp4",), overwrite)
    if size[0] % 2 or size[1] % 2:
        raise UserError(f"video size {size[0]}x{size[1]}: both sides must be even")
    if not (0.0 < fps <= 240.0 and 0.05 <= slow <= 100.0):
        raise UserError("video: fps must be in (0, 240] and slow in [0.05, 100]")
    run = _load(run)
    count = max(1, math.floor((run.end_s - run.t_s[0]) * slow * fps) + 1)
    rows = [int(r) for r in np.searchsorted(run.t_s, run.t_s[0] + np.arange(count) / (slow * fps) - 1e-9)]
    rows = [min(r, len(run.t_s) - 1) for r in rows]
    with video_file.writing(path, size, fps) as video:
        complete = _feed(run, rows, size, view, samples, video, progress)
        if not complete:
            video.discard()
    return path if complete else None
