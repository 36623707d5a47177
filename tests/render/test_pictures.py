"""Pictures of runs: recording, scene, frame, strip, video, and their errors."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from hoap2 import parameters, pictures, recording, renderer
from hoap2.errors import UserError
from PIL import Image

TICKS = 600
STEP_TICKS = 150
PUSH_POINT_L_m = (-0.03, -0.068, 0.1)
CHEST = 1


def _robot(repo_root: Path) -> dict:
    return json.loads((repo_root / "firmware" / "hoap2.json").read_text())


def _signals() -> dict[str, np.ndarray]:
    """A robot that slides forward at 0.1 m/s on straight legs; three steps: right, left, right."""
    t = np.arange(TICKS) * 1e-3
    one, zero = np.ones(TICKS), np.zeros(TICKS)
    q = np.zeros((TICKS, 25))
    q[:, [6, 16]] = math.pi / 2
    x = 0.1 * t
    index = np.arange(TICKS) // STEP_TICKS
    stance = np.where(index == 0, 2, index % 2)  # step 1 lands the right foot
    stance[np.arange(TICKS) % STEP_TICKS < 10] = 2
    return {
        "p.true_base_pos_W_m": np.column_stack([x, zero, 0.237 * one]),
        "p.true_base_quat_W": np.column_stack([one, zero, zero, zero]),
        "p.true_q_rad": q,
        "p.true_com_W_m": np.column_stack([x, zero, 0.267 * one]),
        "p.true_cop_W_m": np.column_stack([x + 0.01, 0.02 * one]),
        "p.true_push_force_W_N": np.column_stack([zero, np.where((t >= 0.2) & (t <= 0.3), 9.0, 0.0), zero]),
        "p.true_foot_pos_W_m": np.column_stack([zero, -0.039 * one, zero, zero, 0.039 * one, zero]),
        "p.true_foot_yaw_W_rad": np.zeros((TICKS, 2)),
        "c.cp_est_W_m": np.column_stack([x + 0.02, zero]),
        "c.footprint_W_m_rad": np.column_stack([0.03 * index, np.where(index % 2 == 1, -0.039, 0.039), 0.1 * index]),
        "c.step_index": index[:, None],
        "c.stance_foot": stance[:, None],
    }


def _write(folder: Path, signals: dict[str, np.ndarray]) -> Path:
    table = parameters.table()
    rows = {f"{p[0]}.{s.name}": (p, s) for p in ("controller", "plant") for s in table.select(p, "output")}
    columns = {"t_s": np.arange(len(signals["p.true_q_rad"])) * 1e-3}
    for name, data in signals.items():
        for k, element in enumerate(table.element_names(rows[name][1])):
            columns[name[:2] + element] = np.ascontiguousarray(data[:, k])
    folder.mkdir(exist_ok=True)
    pyarrow.parquet.write_table(pyarrow.table(columns), folder / "signals.parquet")
    push = ", ".join(str(v) for v in PUSH_POINT_L_m)
    (folder / "run.toml").write_text(
        '[scenario]\nname = "slide"\n[controller]\n[plant]\nstart_pos_W_m = [0.0, 0.0]\nfloor_tilt_rad = [0.0, 0.02]\n'
        f"push_link = [{CHEST}]\npush_force_W_N = [[0.0, 9.0, 0.0]]\npush_point_L_m = [[{push}]]\n"
        "push_start_s = [0.2]\npush_duration_s = [0.1]\nblock_count = 1\nblock_centre_W_m = [[0.4, 0.0, 0.01]]\n"
        "block_size_m = [[0.1, 0.3, 0.02]]\nblock_yaw_W_rad = [0.2]\n"
    )
    return folder


@pytest.fixture
def run_dir(tmp_path: Path) -> Path:
    return _write(tmp_path / "run", _signals())


def test_links_are_where_the_robot_table_says(repo_root: Path) -> None:
    """The drawn kinematics against plain matrices made from hoap2.json."""
    robot = _robot(repo_root)
    order = [link["name"] for link in robot["links"]]
    rng = np.random.default_rng(1)
    scene = pictures.Scene()
    scene.q_rad = rng.uniform(-1.0, 1.0, 25)
    quat = rng.normal(size=4)
    scene.base_quat_W, scene.base_pos_W_m = quat, (0.3, -0.2, 0.4)
    w, x, y, z = quat / np.linalg.norm(quat)
    turn = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    poses = {"pelvis": np.eye(4)}
    poses["pelvis"][:3, :3] = np.eye(3) + 2 * w * turn + 2 * turn @ turn
    poses["pelvis"][:3, 3] = (0.3, -0.2, 0.4)
    waiting = list(enumerate(robot["joints"]))
    while waiting:
        k, joint = waiting.pop(0)
        if joint["parent"] not in poses:
            waiting.append((k, joint))
            continue
        a = np.array(joint["axis"], dtype=float)
        cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
        step = np.eye(4)
        step[:3, :3] += math.sin(scene.q_rad[k]) * cross + (1 - math.cos(scene.q_rad[k])) * cross @ cross
        step[:3, 3] = joint["origin_parent_m"]
        poses[joint["child"]] = poses[joint["parent"]] @ step
    for index, name in enumerate(order):
        np.testing.assert_allclose(scene.link_pose(index), poses[name][:3], atol=1e-12)


def test_footprints_are_the_starts_the_steps_and_the_present_target(run_dir: Path) -> None:
    run = recording.load(run_dir)
    assert [step.left for step in run.steps] == [False, True, False]
    assert len(run.footprints(100)) == 2
    first = run.footprints(STEP_TICKS + 50)
    assert len(first) == 3 and first[2] == pytest.approx((0.03, -0.039, 0.1, False))
    assert [p[3] for p in run.footprints(TICKS - 1)] == [False, True, False, True, False]


def test_scene_holds_the_row_of_the_run(run_dir: Path) -> None:
    run = recording.load(run_dir)
    scene = pictures.scene_from_run(250, run)
    np.testing.assert_allclose(scene.base_pos_W_m, (0.025, 0.0, 0.237))
    np.testing.assert_allclose(scene.cp_W_m, (0.045, 0.0))
    np.testing.assert_allclose(scene.floor_tilt_rad, (0.0, 0.02))
    assert scene.block_count == 1 and scene.block_yaw_W_rad[0] == pytest.approx(0.2)
    # the chest frame stands 34 mm ahead of and 55 mm above the hips
    np.testing.assert_allclose(scene.push_force_W_N, (0.0, 9.0, 0.0))
    np.testing.assert_allclose(scene.push_point_W_m, np.add(PUSH_POINT_L_m, (0.059, 0.0, 0.292)), atol=1e-12)
    assert np.all(pictures.scene_from_run(100, run).push_force_W_N == 0.0)


def test_camera_follows_without_delay_or_jerk(run_dir: Path) -> None:
    run = recording.load(run_dir)
    run.signal["true_base_pos_W_m"][:, 1] += 0.02 * np.sign(np.sin(np.arange(TICKS) / 5.0))
    targets = pictures.camera_targets(run)
    assert targets.shape == (TICKS, 3)
    assert np.abs(np.diff(targets, axis=0)).max() < 3e-4
    assert targets[TICKS // 2, 0] == pytest.approx(run.signal["true_base_pos_W_m"][TICKS // 2, 0], abs=3e-3)


def test_push_arrow_is_drawn_at_its_point(run_dir: Path) -> None:
    run = recording.load(run_dir)
    with_push, without = pictures.scene_from_run(250, run, "front"), pictures.scene_from_run(250, run, "front")
    without.show &= ~renderer.SHOW_PUSH
    with pictures.Renderer(320, 240, 1) as camera:
        changed = np.any(camera.draw(with_push) != camera.draw(without), axis=2)
        column, row, _ = camera.project(with_push, with_push.push_point_W_m)
    rows, columns = np.nonzero(changed)
    # seen from the front the force to the left points to the right of the picture; its tip is the point
    assert columns.max() == pytest.approx(column, abs=2.5)
    assert rows.mean() == pytest.approx(row, abs=2.5)
    assert columns.max() - columns.min() > 12


def test_frame_has_its_size_and_shows_robot_and_text(run_dir: Path, tmp_path: Path) -> None:
    path = pictures.write_frame(run_dir, 0.25, tmp_path / "a.png", size=(400, 300))
    image = np.asarray(Image.open(path).convert("RGB"))
    assert image.shape == (300, 400, 3)
    plain = np.asarray(Image.open(pictures.write_frame(run_dir, 0.25, tmp_path / "b.png", (400, 300), overlays=False)))
    assert np.any(image[:30, :150] != plain[:30, :150]) and np.any(image[-30:, :150] != plain[-30:, :150])
    assert plain[120:180, 170:230].std() > 20
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png", "b.png", "run"]


def test_strip_puts_moments_side_by_side(run_dir: Path, tmp_path: Path) -> None:
    path = pictures.strip(run_dir, [0.0, 0.3, 0.599], tmp_path / "strip.png", size=(120, 160))
    image = np.asarray(Image.open(path))
    assert image.shape == (160, 3 * 120 + 2 * 2, 3)
    assert np.any(image[:, :120] != image[:, 122:242])


@pytest.mark.skipif(shutil.which("ffprobe") is None, reason="ffprobe is not installed")
def test_video_has_the_right_number_of_pictures(run_dir: Path, tmp_path: Path) -> None:
    seen = []
    path = pictures.write_video(run_dir, tmp_path / "v.mp4", fps=20, size=(160, 120), slow=2.0,
                                progress=lambda done, total: seen.append((done, total)))  # fmt: skip
    entries = "stream=width,height,pix_fmt,codec_name,nb_read_frames,r_frame_rate"
    probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", entries, "-of", "json", path],
                           capture_output=True, text=True, check=True)  # fmt: skip
    stream = json.loads(probe.stdout)["streams"][0]
    # 0.599 s, twice as slow, at 20 pictures a second
    assert stream["nb_read_frames"] == "24" and stream["r_frame_rate"] == "20/1"
    assert (stream["width"], stream["height"], stream["pix_fmt"], stream["codec_name"]) == (160, 120, "yuv420p", "h264")
    assert seen[0] == (1, 24) and seen[-1] == (24, 24) and len(seen) == 24
    assert [p.name for p in tmp_path.iterdir() if p.name.startswith(".")] == []


@pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")
def test_stopped_or_broken_video_leaves_nothing(run_dir: Path, tmp_path: Path) -> None:
    assert pictures.write_video(run_dir, tmp_path / "v.mp4", size=(64, 48), progress=lambda d, n: d < 3) is None

    def fail(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pictures.write_video(run_dir, tmp_path / "v.mp4", size=(64, 48), progress=fail)
    assert [p.name for p in tmp_path.iterdir()] == ["run"]


def test_a_run_that_diverged_is_shown_up_to_there(tmp_path: Path) -> None:
    signals = _signals()
    signals["p.true_q_rad"][400:, 3] = np.nan
    run = recording.load(_write(tmp_path / "run", signals))
    assert run.end_s == pytest.approx(0.399)
    with pytest.raises(UserError, match="0 to 0.399 s"):
        run.row(0.5)


def test_a_plant_alone_has_pictures_too(tmp_path: Path) -> None:
    signals = {name: data for name, data in _signals().items() if name.startswith("p.")}
    run = recording.load(_write(tmp_path / "run", signals))
    assert len(run.footprints(500)) == 2
    assert np.isnan(pictures.scene_from_run(100, run).cp_W_m).all()
    pictures.write_frame(run, 0.1, tmp_path / "a.png", (64, 64))


def test_wrong_wishes_get_an_answer(run_dir: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(pattern: str, call, *arguments, **options) -> None:
        with pytest.raises(UserError, match=pattern):
            call(*arguments, **options)

    target = tmp_path / "a.png"
    refused("outside the run.*0 to 0.599 s", pictures.write_frame, run_dir, 7.0, target)
    refused("outside the run", pictures.write_frame, run_dir, math.nan, target)
    refused("unknown view 'up'.*quarter", pictures.write_frame, run_dir, 0.1, target, view="up")
    refused("each side must be", pictures.write_frame, run_dir, 0.1, target, (100000, 100))
    refused("must end in", pictures.write_frame, run_dir, 0.1, tmp_path / "a.txt")
    refused("no folder", pictures.write_frame, run_dir, 0.1, tmp_path / "none" / "a.png")
    refused("no run folder", pictures.write_frame, tmp_path / "none", 0.1, target)
    refused("at least one time", pictures.strip, run_dir, [], target)
    refused("even", pictures.write_video, run_dir, tmp_path / "v.mp4", size=(161, 120))
    refused("960x540", pictures.parse_size, "large")
    target.write_text("mine")
    refused("nothing was overwritten", pictures.write_frame, run_dir, 0.1, target)
    assert target.read_text() == "mine"
    monkeypatch.setenv("PATH", str(tmp_path))
    refused("ffmpeg is not installed", pictures.write_video, run_dir, tmp_path / "v.mp4")
    (run_dir / "signals.parquet").write_bytes(b"not a table")
    refused("cannot read", pictures.write_frame, run_dir, 0.1, tmp_path / "b.png")
    (run_dir / "signals.parquet").unlink()
    refused("signals.parquet is missing", pictures.write_frame, run_dir, 0.1, tmp_path / "b.png")


def test_a_missing_library_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOAP2_BUILD_DIR", str(tmp_path))
    monkeypatch.delenv("HOAP2_RENDER_LIBRARY", raising=False)
    with pytest.raises(UserError, match="libhoap2_render.so is missing.*build"):
        renderer.library_path()
    other = tmp_path / "libother.so"
    other.write_bytes(b"no library")
    monkeypatch.setenv("HOAP2_RENDER_LIBRARY", str(other))
    renderer.library.cache_clear()
    with pytest.raises(UserError, match="cannot load"):
        renderer.library()
    renderer.library.cache_clear()


def test_scene_knows_its_fields() -> None:
    scene = pictures.Scene()
    with pytest.raises(AttributeError, match="q_rad"):
        scene.q_deg = 1.0
    for k in range(renderer.MAX_FOOTPRINTS + 5):
        scene.add_footprint(float(k), 0.0, 0.0, k % 2 == 0)
    assert scene.footprint_count == renderer.MAX_FOOTPRINTS
    assert scene.footprint_W_m_rad[-1, 0] == renderer.MAX_FOOTPRINTS + 4
    copy = scene.copy()
    copy.base_pos_W_m[0] = 5.0
    assert scene.base_pos_W_m[0] == 0.0
