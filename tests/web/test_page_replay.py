"""A finished run on the page, in a browser: the 3D view, the time line, the plots."""

from __future__ import annotations

import signal
from pathlib import Path

import numpy as np
import pytest
from hoap2 import recording, signal_log

RUN = "sand-walk-lpc/first"
LEAST_COLOURS = 300  # of a picture that shows something; an empty one has the background's few


def _choose(page) -> None:
    page.page.click(f'[data-run="{RUN}"]')
    page.until(lambda p: not p["live"] and p["rows"] > 0, "the run is shown")


def _hold_at(page, t_s: float) -> None:
    page.page.evaluate("t => { monitor.player.playing = false; monitor.player.seek(t); }", t_s)
    before = page.probe()["pictures"]
    page.until(lambda p: p["pictures"] > before, "a picture")


def _picture(page) -> np.ndarray:
    """Coarse colours of the 3D view, as drawn."""
    return np.array(page.page.evaluate("monitor.pixels().sample"))


@pytest.fixture
def replay(monitor, page):
    _, address = monitor()
    page.open(address)
    _choose(page)
    return page


def test_the_view_shows_the_robot_from_each_side(replay) -> None:
    _hold_at(replay, 3.0)
    assert replay.page.evaluate("monitor.pixels().distinct") > LEAST_COLOURS
    quarter = _picture(replay)
    replay.page.click('[data-view="side"]')
    replay.page.wait_for_timeout(500)
    assert np.mean(np.abs(_picture(replay) - quarter)) > 2.0, "the side view is another picture"
    replay.page.evaluate("monitor.view.robot.root.visible = false")
    empty = _picture(replay)
    replay.page.evaluate("monitor.view.robot.root.visible = true")
    assert np.mean(np.abs(_picture(replay) - empty)) > 2.0, "without the robot it is another picture"


def test_the_time_line_scrubs_to_the_pose_of_the_log(replay, sand_run: Path) -> None:
    run = recording.load(sand_run)
    poses = []
    _hold_at(replay, 0.0)
    for share in (0.85, 0.3):
        box = replay.page.locator("#scrub-bar").bounding_box()
        replay.page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)
        probe = replay.until(lambda p, s=share: abs(p["time"] - s * p["last"]) < 0.02 * p["last"], "the time")
        replay.page.wait_for_timeout(300)
        row = run.row(probe["time"])
        shown = replay.page.evaluate("monitor.view.robot.root.position.toArray()")
        # between two shown rows the pose is a straight line; 5 ms of walking are some tenths of a millimetre
        assert shown == pytest.approx(run.signal["true_base_pos_W_m"][row], abs=1.5e-3)
        poses.append(shown)
    assert np.linalg.norm(np.subtract(*poses)) > 0.005
    assert replay.text("#clock") == f"{replay.probe()['time']:.2f}"


@pytest.mark.slow
def test_a_finished_run_plays_holds_and_changes_speed(replay) -> None:
    _hold_at(replay, 0.0)
    replay.page.select_option("#speed", "0.25")
    replay.page.click("#play")
    first = replay.until(lambda p: p["time"] > 0.05, "the time goes on")
    replay.page.wait_for_timeout(2000)
    gone = replay.probe()["time"] - first["time"]
    assert 0.2 < gone < 0.25 * 4.5, "a quarter of the wall clock's time, give or take a slow machine"
    replay.page.click("#play")
    held = replay.probe()["time"]
    replay.page.wait_for_timeout(500)
    assert replay.probe()["time"] == held and not replay.probe()["playing"]
    replay.page.keyboard.press("End")
    assert replay.probe()["time"] == pytest.approx(replay.probe()["last"])


def test_the_soil_of_the_page_is_the_replayed_one(replay, sand_run: Path) -> None:
    """Ruts at the end, an untouched pool at the start again."""
    from hoap2 import soil_replay

    run = recording.load(sand_run)
    heights = "Array.from(monitor.source.soil.height)"
    _hold_at(replay, run.end_s)
    with soil_replay.SoilReplay(run) as pool:
        wanted = pool.surface(len(run.t_s) - 1)
        assert np.min(wanted.change_m) < -1e-3
        np.testing.assert_allclose(replay.page.evaluate(heights), wanted.height_m.ravel(), atol=3e-5)
        _hold_at(replay, 0.0)
        at_start = pool.surface(0)
        np.testing.assert_allclose(replay.page.evaluate(heights), at_start.height_m.ravel(), atol=3e-5)


@pytest.mark.slow
def test_plots_follow_the_picked_joints_and_the_stretch(replay, sand_run: Path) -> None:
    _hold_at(replay, 3.0)
    replay.page.select_option("#span", "4")
    before = replay.probe()["charts"]
    _hold_at(replay, 2.0)
    replay.until(lambda p: all(a > b for a, b in zip(p["charts"], before)), "every plot is drawn anew")
    replay.page.click('[data-joint="waist_pitch"]')
    replay.page.wait_for_timeout(500)
    legend = replay.page.locator(".chart").nth(3).inner_text()
    log = signal_log.read(sand_run / "signals.parquet")
    wanted = log.column("p.waist_pitch.true_tau_Nm")[2000]
    assert "waist pitch" in legend
    assert float(legend.split("waist pitch")[1].split()[0]) == pytest.approx(wanted, abs=0.006)


@pytest.mark.slow
def test_a_damaged_run_is_told_and_the_page_lives_on(monitor, page, sand_run: Path) -> None:
    broken = sand_run.parent / "broken"
    broken.mkdir()
    (broken / "run.toml").write_text("[scenario]\n")
    (broken / "signals.parquet").write_bytes(b"no parquet at all")
    try:
        _, address = monitor()
        page.open(address)
        page.page.click('[data-run="sand-walk-lpc/broken"]')
        page.page.wait_for_selector(".toast")
        assert "cannot read" in page.text(".toast")
        _choose(page)
    finally:
        for file in broken.iterdir():
            file.unlink()
        broken.rmdir()
    page.errors.clear()  # the browser's own line about the answer 404


def test_a_page_without_its_server_says_so_and_comes_back(monitor, start, page, sand_run: Path) -> None:
    server, address = monitor()
    page.open(address)
    page.page.wait_for_selector(".banner-waiting")
    port = address.rstrip("/").rsplit(":", 1)[1]
    server.end(signal.SIGKILL)
    page.page.wait_for_selector(".banner-gone")
    assert page.text("#state") == "NO SERVER"
    again = start("monitor", "--web", "--port", port, "--runs", sand_run.parents[1])
    again.wait_for("monitor: http")
    page.page.wait_for_selector(".banner-waiting", timeout=30_000)
    page.errors.clear()  # the browser's own lines about connections that were refused
