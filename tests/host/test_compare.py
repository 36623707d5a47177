"""Two runs side by side: what differs, what is held, what is refused."""

from __future__ import annotations

import json
import os
import shutil
import subprocess

import numpy as np
import pytest

from hoap2 import bounds, cli, compare, compare_page, compare_video, scenario
from hoap2.figures import walk_data
from fake_walks import DEG, fall_in_step, log_of_walk, run_folder
from test_figure import check_text, drawn


@pytest.fixture
def runs(tmp_path):
    """A walk that comes to its end, and one that falls in step 3 and ends 1 s later."""
    loaded = scenario.load("floor-walk-lpc")
    loaded.bounds = dict(bounds.ALWAYS)
    whole = run_folder(tmp_path / "whole", loaded, log_of_walk(loaded))
    loaded = scenario.load("floor-walk", ["controller.step_time_s=0.4", "plant.friction_mu=0.5"])
    log = log_of_walk(loaded)
    log.block("p.true_chest_rpy_rad")[:, 1] = 0.5 * DEG
    log.count = fall_in_step(log, 3) + 1000
    return whole, run_folder(tmp_path / "fallen", loaded, log)


def walks_of(runs):
    return tuple(walk_data.load(run) for run in runs)


def test_differences_are_b_less_a(runs):
    found = compare.document(*walks_of(runs))
    rows = {row["metric"]: row for row in found["metrics"]}
    assert rows["steps_taken"] | {"text": ""} == {"metric": "steps_taken", "unit": "", "text": "", "a": 36.0, "b": 2.0,
                                                  "difference": -34.0}  # fmt: skip
    assert rows["fall_step"]["a"] is None and rows["fall_step"]["b"] == 3.0 and rows["fall_step"]["difference"] is None
    changed = {row["parameter"]: (row["a"], row["b"]) for row in found["parameters"]}
    assert changed == {"controller.landing_control": ("on", "off"), "plant.friction_mu": (0.7, 0.5)}
    assert found["a"]["ok"] is True and found["b"]["fell"] is True


def test_names_tell_the_runs_apart(runs):
    first, second = walks_of(runs)
    assert compare.names(first, second) == ("A: floor-walk-lpc", "B: floor-walk")
    assert compare.names(first, first) == ("A: floor-walk-lpc (whole)", "B: floor-walk-lpc (whole)")


def test_page_and_files(runs, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["compare", *map(str, runs), "--no-video", "--out", "c"]) == 0
    folder = tmp_path / "out" / "compare" / "c"
    assert set(os.listdir(folder)) == {"compare.html", "compare.json", "compare.png", "compare.svg"}
    page = (folder / "compare.html").read_text()
    assert "<script" not in page and 'src="http' not in page and "<video" not in page
    for word in ("A: floor-walk-lpc: All bounds are met.", "B: floor-walk: Not ok.", "fell backward at",
                 "landing_control", "B less A"):  # fmt: skip
        assert word in page, word
    assert json.loads((folder / "compare.json").read_text())["b"]["fall_step"] == 3
    out = capsys.readouterr().out
    assert "plant.friction_mu" in out and "c" in out
    assert cli.main(["compare", *map(str, runs), "--no-video", "--out", "c"]) == 2
    assert "nothing was overwritten" in capsys.readouterr().err


def test_curves_can_be_read(runs, monkeypatch, tmp_path):
    figures, walks = drawn(monkeypatch), walks_of(runs)
    compare_page.curves(walks, compare.names(*walks), tmp_path / "compare")
    check_text(figures[0])


def test_bad_folders(runs, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    study = tmp_path / "study"
    study.mkdir()
    (study / "study.json").write_text("{}")
    for arguments, message in (
        ([runs[0], runs[0]], "compared with itself"),
        ([runs[0], "nowhere"], "there is no run folder nowhere"),
        ([study, runs[0]], "is a study"),
        ([tmp_path, runs[0]], "no complete run folder"),
    ):
        assert cli.main(["compare", *map(str, arguments)]) == 2
        assert message in capsys.readouterr().err.replace("\n", " ")
    assert not (tmp_path / "out").exists()


def test_a_run_that_has_ended_says_so(runs):
    side = compare_video._side(walks_of(runs)[1], "B: x")
    last = len(side.run.t_s) - 1
    assert side.row(3.0) == 3000 and side.row(99.0) == last
    assert side.text(2.0) == "B: x   t = 2.00 s   step 1"
    assert side.text(2.96) == "B: x   t = 2.96 s   fallen"
    assert side.text(side.run.end_s) != side.text(side.run.end_s + 0.04)
    assert side.text(99.0) == f"B: x   fell backward, ended at {side.run.end_s:.2f} s"


def test_the_video_is_as_long_as_the_longer_run(tmp_path):
    folders = []
    for name, ticks in (("a", 401), ("b", 1001)):
        loaded = scenario.load("floor-walk")
        log = log_of_walk(loaded)
        log.count = ticks
        folders.append(run_folder(tmp_path / name, loaded, log))
    walks, calls = walks_of(folders), []
    path = compare_video.write(walks, ("A", "B"), tmp_path / "c.mp4", lambda done, total: calls.append(total) is None)
    assert path.exists() and len(calls) == calls[0] == 26  # 1 s at 25 frames a second, both ends
    if shutil.which("ffprobe"):
        shown = ["-count_frames", "-show_entries", "stream=nb_read_frames,width", "-of", "json"]
        done = subprocess.run(["ffprobe", "-v", "error", *shown, path], capture_output=True, text=True, check=True)
        [stream] = json.loads(done.stdout)["streams"]
        assert int(stream["nb_read_frames"]) == 26
        assert stream["width"] == 2 * compare_video.SIDE_PX[0] + compare_video.GAP_PX
    stopped = compare_video.write(walks, ("A", "B"), tmp_path / "d.mp4", lambda done, total: done < 3)
    assert stopped is None and not (tmp_path / "d.mp4").exists() and not list(tmp_path.glob(".*"))


def test_held_pictures_are_not_drawn_again(tmp_path, monkeypatch):
    """The shorter run costs nothing once it has ended, and its caption is written on a clean picture."""
    drawn_rows = []

    class Camera:
        def __init__(self, width, height, samples):
            self.shape = (height, width, 3)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def draw(self, scene, out=None):
            drawn_rows.append(scene)
            return np.full(self.shape, 90, np.uint8)

    pictures = []

    class Video:
        def write(self, picture):
            pictures.append(picture.copy())

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

    monkeypatch.setattr(compare_video, "Renderer", Camera)
    monkeypatch.setattr(compare_video.video_file, "writing", lambda *_: Video())
    folders = []
    for name, ticks in (("a", 201), ("b", 1001)):
        loaded = scenario.load("floor-walk")
        log = log_of_walk(loaded)
        log.count = ticks
        folders.append(run_folder(tmp_path / name, loaded, log))
    compare_video.write(walks_of(folders), ("A", "B"), tmp_path / "c.mp4", lambda done, total: True)
    assert len(pictures) == 26 and len(drawn_rows) == 26 + 6, "26 of B, 6 of A: 0 to 0.2 s"
    width = compare_video.SIDE_PX[0]
    assert (pictures[-1][:, :width] == pictures[-2][:, :width]).all()
    assert (pictures[3][:, :width] != pictures[-1][:, :width]).any(), "the caption tells that A has ended"
