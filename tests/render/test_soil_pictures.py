"""Pictures of runs on soil: replay from the log, colours and their legend, views."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hoap2 import picture_labels, pictures, recording, soil_replay
from hoap2.errors import UserError
from PIL import Image
from test_pictures import TICKS, _signals, _write

SUNK_m = 0.006


def _sink(folder: Path, **plant: str) -> Path:
    """The sliding robot of the other picture tests in sand: from half of the run on 6 mm deep."""
    signals = _signals()
    depth = np.where(np.arange(TICKS) < TICKS // 2, 0.0, SUNK_m)
    base = signals["p.true_base_pos_W_m"]
    base[:, 2] += 0.0005 - depth
    signals["p.true_sinkage_m"] = np.column_stack([depth, depth])
    _write(folder, signals)
    values = {"ground": '"soil"', "soil_centre_m": "[0.1, 0.0]", "soil_size_m": "[0.6, 0.4, 0.15]"} | plant
    lines = "".join(f"{name} = {value}\n" for name, value in values.items())
    (folder / "run.toml").write_text('[scenario]\nname = "sink"\n[controller]\n[plant]\n' + lines)
    return folder


@pytest.fixture
def sand_dir(tmp_path: Path) -> Path:
    return _sink(tmp_path / "run")


def test_feet_press_the_soil_where_they_were(sand_dir: Path) -> None:
    run = recording.load(sand_dir)
    with soil_replay.SoilReplay(run) as replay:
        assert np.all(replay.surface(TICKS // 2 - 2).change_m == 0.0)
        surface = replay.surface(TICKS - 1)
        grid, change_m = surface.grid, surface.change_m
        x_m = grid["low_x_m"] + (np.arange(grid["nx"]) + 0.5) * grid["cell_m"]
        y_m = grid["low_y_m"] + (np.arange(grid["ny"]) + 0.5) * grid["cell_m"]
        rows, columns = np.nonzero(change_m < -0.8 * SUNK_m)
        # Soles of 98 x 63 mm at y = +-39 mm that slid from x = 30 mm to x = 60 mm, toes 60.5 mm ahead of the ankle.
        assert -0.012 < x_m[columns].min() < -0.002 and 0.108 < x_m[columns].max() < 0.122
        assert np.abs(y_m[rows]).max() == pytest.approx(0.0705, abs=0.005)
        assert np.abs(y_m[rows]).min() == pytest.approx(0.0075, abs=0.005)
        assert -1.2 * SUNK_m < change_m.min() and change_m.max() > 0.0002
        assert replay.note == ""


def test_any_order_gives_the_same_ground(sand_dir: Path) -> None:
    run = recording.load(sand_dir)
    with soil_replay.SoilReplay(run) as forward, soil_replay.SoilReplay(run) as other:
        early, late = (forward.surface(row).change_m.copy() for row in (TICKS // 2 + 50, TICKS - 1))
        assert np.array_equal(other.surface(TICKS - 1).change_m, late)
        assert np.array_equal(other.surface(TICKS - 1).change_m, late)
        assert np.array_equal(other.surface(TICKS // 2 + 50).change_m, early)
        assert not np.array_equal(early, late)
        with pytest.raises(IndexError):
            other.surface(TICKS)


def test_a_video_replays_the_run_once(sand_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if shutil.which("ffmpeg") is None:
        pytest.skip("ffmpeg is not installed")
    shown, real = [], soil_replay.SoilReplay.surface

    def surface(self, row: int):
        shown.append((self._done, row + 1))
        return real(self, row)

    monkeypatch.setattr(soil_replay.SoilReplay, "surface", surface)
    path = pictures.write_video(sand_dir, tmp_path / "v.mp4", fps=20, size=(160, 120))
    assert len(shown) == 12 and shown[0][0] == 0
    assert all(after[0] == before[1] for before, after in zip(shown, shown[1:]))
    assert path is not None and path.stat().st_size > 1000


def test_the_legend_has_the_colours_of_the_ground(sand_dir: Path) -> None:
    """Level soil of one colour, seen from above in the light, against the five stops of the legend."""
    run = recording.load(sand_dir)
    scene = pictures.scene_from_run(0, run, "pool", overlays=True)
    scene.show = 64 | 32
    scene.base_pos_W_m[0] += 20.0
    full_m, rise_m = 0.01, 0.01 * picture_labels.SOIL_RISE_SHARE
    with pictures.Renderer(160, 120, 1) as camera, soil_replay.SoilReplay(run) as replay:
        level = np.zeros((int(replay.grid["ny"]), int(replay.grid["nx"])))
        for change_m, stop in zip((-full_m, -0.5 * full_m, 0.0, 0.5 * rise_m, rise_m), picture_labels.SOIL):
            camera.set_soil(replay.grid, level, level + change_m, full_m)
            seen = camera.draw(scene)[45:75, 60:100].reshape(-1, 3).mean(axis=0)
            np.testing.assert_allclose(seen, stop, atol=7)


def test_frames_show_the_soil_with_its_scale(sand_dir: Path, tmp_path: Path) -> None:
    def frame(name: str, t_s: float, **options) -> np.ndarray:
        path = pictures.write_frame(sand_dir, t_s, tmp_path / name, size=(640, 360), **options)
        return np.asarray(Image.open(path).convert("RGB")).astype(int)

    early, late = frame("a.png", 0.2, view="pool"), frame("b.png", 0.599, view="pool")
    plain = frame("c.png", 0.2, view="pool", overlays=False)
    panel = early[8:52, 500:632]
    # The scale's bar stands in the top right corner: somewhere dark blue, and no such colour without it.
    dark = np.abs(panel - picture_labels.SOIL[0]).max(axis=2) < 12
    assert dark.any() and not (np.abs(plain - picture_labels.SOIL[0]).max(axis=2) < 12).any()
    # Sand has more red than blue.
    assert np.mean(early[60:300, :, 0] > early[60:300, :, 2] + 20) > 0.3
    near = frame("d.png", 0.599, view="feet")
    assert np.any(near != late)


def test_the_tracks_are_blue(sand_dir: Path) -> None:
    run = recording.load(sand_dir)
    scene = pictures.scene_from_run(0, run, "pool")
    scene.base_pos_W_m[0] += 20.0  # it would hide them
    scene.show = 64
    blue = []
    with pictures.Renderer(320, 180, 1) as camera, soil_replay.SoilReplay(run) as replay:
        for row in (100, TICKS - 1):
            replay.show(camera, row)
            picture = camera.draw(scene).astype(int)
            blue.append(picture[:, :, 2] > picture[:, :, 0] + 15)
        assert not blue[0].any()
        rows, columns = np.nonzero(blue[1])
        # Seen from above, ahead is right and left is up: two tracks about the line through the start.
        column, row, _ = camera.project(scene, (0.058, 0.0, 0.0))
    assert columns.mean() == pytest.approx(column, abs=3) and rows.mean() == pytest.approx(row, abs=2)
    assert len(rows) > 500


def test_the_scale_is_left_out_where_it_does_not_fit() -> None:
    picture = np.zeros((120, 120, 3), dtype=np.uint8)
    picture_labels.sinkage_scale(picture, 0.01)
    assert not picture.any()
    picture = np.zeros((360, 640, 3), dtype=np.uint8)
    picture_labels.sinkage_scale(picture, 0.01)
    assert picture[:60, 480:].any() and not picture[80:].any() and not picture[:, :320].any()


@pytest.mark.parametrize(("depth_m", "scale_m"),
                         [(0.0, 0.01), (0.0031, 0.005), (0.0099, 0.01), (0.015, 0.02), (9.0, 0.2)])  # fmt: skip
def test_the_scale_ends_at_a_round_depth(sand_dir: Path, depth_m: float, scale_m: float) -> None:
    run = recording.load(sand_dir)
    run.signal["true_sinkage_m"] = np.array([[0.0, np.nan], [depth_m, 0.0]])
    assert soil_replay.full_scale_m(run) == scale_m
    del run.signal["true_sinkage_m"]
    assert soil_replay.full_scale_m(run) == 0.01


def test_what_cannot_be_shown_says_why(sand_dir: Path, tmp_path: Path) -> None:
    run = recording.load(sand_dir)
    run.signal["true_base_pos_W_m"][400:, 0] += 2.0  # jumps out of the pool
    with soil_replay.SoilReplay(run) as replay:
        ground = replay.surface(402).change_m.copy()
        assert np.array_equal(replay.surface(TICKS - 1).change_m, ground)
        assert "left the soil pool" in replay.note
    run.plant["soil_cell_m"] = 0.04
    with pytest.raises(UserError, match="soil_cell_m"):
        soil_replay.SoilReplay(run)
    rigid = recording.load(_write(tmp_path / "rigid", _signals()))
    assert soil_replay.of_run(rigid) is None
    with pytest.raises(UserError, match="rigid floor"):
        pictures.write_frame(rigid, 0.1, tmp_path / "a.png", view="pool")


def test_the_command_knows_the_views(sand_dir: Path) -> None:
    command = [sys.executable, "-m", "hoap2.cli", "frame", str(sand_dir), "--time", "0.5", "--view", "feet"]
    answer = subprocess.run([*command, "--size", "320x180"], capture_output=True, text=True, check=False)
    assert answer.returncode == 0, answer.stderr
    assert Image.open(answer.stdout.strip()).size == (320, 180)
