"""A live run on the page, in a browser."""

from __future__ import annotations

import signal
from pathlib import Path

import numpy as np
import pytest
from hoap2 import signal_log

PACED = ("--realtime", "--no-video", "--accept-commands")


def _rows_follow(page, seconds: float = 1.0) -> dict:
    first = page.until(lambda p: p["state"] == "live" and p["rows"] > 0, "rows of the run")
    return page.until(lambda p: p["last"] > first["last"] + seconds, "more rows")


def test_a_live_run_moves_view_and_plots(monitor, start, page) -> None:
    _, address = monitor()
    page.open(address)
    page.page.wait_for_selector(".banner-waiting")
    assert "no run yet" in page.text("#run-live")
    run = start("run", "floor-walk", "--duration", "60", *PACED)
    before = page.until(lambda p: p["state"] == "live" and p["rows"] > 20, "the run is live")
    assert page.text("#state") == "LIVE" and "floor-walk" in page.text("#run-live")
    after = _rows_follow(page)
    assert all(a > b for a, b in zip(after["charts"], before["charts"])) and after["pictures"] > before["pictures"]
    assert after["plane"] > before["plane"]
    # held: the run goes on, the page stays
    page.page.click("#play")
    held = page.probe()["time"]
    later = page.until(lambda p: p["last"] > held + 1.0, "rows while held")
    assert later["time"] == held
    page.page.click("#go-live")
    page.until(lambda p: p["time"] > held + 0.5, "the newest again")
    # a run that stands still is told, and one that goes on again
    run.process.send_signal(signal.SIGSTOP)
    page.page.wait_for_selector(".banner-silent")
    run.process.send_signal(signal.SIGCONT)
    page.until(lambda p: p["state"] == "live", "the run is live again")
    run.end(signal.SIGINT)
    page.until(lambda p: p["state"] == "ended", "the end is told")


def test_the_push_button_pushes_the_robot(monitor, start, page, tmp_path: Path) -> None:
    _, address = monitor()
    page.open(address)
    run = start("run", "floor-walk", "--duration", "60", "--out", tmp_path / "pushed", *PACED)
    _rows_follow(page)
    page.page.fill("#push-force", "6")
    page.page.fill("#push-duration", "0.3")
    page.page.click('[data-push="left"]')
    page.page.wait_for_selector(".answer")
    assert page.page.locator(".answer.accepted").count() == 1, page.text("#answers")
    page.until(lambda p: any("push" in e for e in [page.text("#events")]), "the push is told")
    # one that the run refuses is shown with its reason
    page.page.evaluate("monitor.connection.send({command: 'push', name: 'chest', value: [1e6, 0, 0, 0.1]})")
    page.page.wait_for_selector(".answer.refused p")
    assert page.page.locator(".answer.refused p").first.inner_text().strip()
    # a slider and a button; what the run took is what the slider shows
    gain = '[data-parameter="tpcc_kp_1_s2"]'
    page.page.eval_on_selector(gain, "n => { n.value = 31; n.dispatchEvent(new Event('change')); }")
    page.until(lambda p: "set tpcc_kp_1_s2 31" in page.text("#answers"), "the answer to the slider")
    assert page.page.input_value(gain) == "31"
    page.page.click("#walk-stop")
    page.until(lambda p: "walk stop" in page.text("#answers"), "the answer to the button")
    assert page.page.locator(".answer.accepted").count() == 3
    run.end(signal.SIGINT)
    force = signal_log.read(tmp_path / "pushed" / "signals.parquet").block("p.true_push_force_W_N")
    assert np.max(force[:, 1]) > 5.9 and np.max(np.abs(force[:, 1])) < 6.1
    assert 250 <= np.count_nonzero(np.abs(force[:, 1]) > 0.1) <= 301
    assert np.max(np.abs(force[:, [0, 2]])) < 0.5, "to the left of the robot's heading"


@pytest.mark.slow
def test_the_trunk_is_pushed_by_the_mouse(monitor, start, page, tmp_path: Path) -> None:
    _, address = monitor()
    page.open(address)
    run = start("run", "floor-walk", "--duration", "60", "--out", tmp_path / "dragged", *PACED)
    _rows_follow(page)
    page.page.click('[data-view="side"]')
    page.page.wait_for_timeout(700)
    x, y = page.page.evaluate("""() => {
        const box = monitor.view.canvas.getBoundingClientRect();
        const at = monitor.view.robot.grip.getWorldPosition(monitor.view.hips.clone());
        at.z += 0.06;
        at.x -= 0.03;
        at.project(monitor.view.camera.camera);
        return [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height];
    }""")
    page.page.mouse.move(x, y)
    page.page.mouse.down()
    page.page.mouse.move(x + 20, y - 20, steps=2)
    page.page.mouse.move(x + 50, y - 50, steps=2)
    page.page.mouse.up()
    page.page.wait_for_selector(".answer.accepted")
    run.end(signal.SIGINT)
    force = signal_log.read(tmp_path / "dragged" / "signals.parquet").block("p.true_push_force_W_N")
    # seen from its right side: to the right is ahead, up is away from the eye, to the robot's left
    assert 4.0 < np.max(force[:, 0]) < 8.0 and 4.0 < np.max(force[:, 1]) < 8.0
    assert np.max(np.abs(force[:, 2])) == 0.0


def test_a_run_without_accept_commands_is_only_watched(monitor, start, page) -> None:
    _, address = monitor()
    page.open(address)
    start("run", "floor-walk", "--duration", "60", "--realtime", "--no-video")
    _rows_follow(page, 0.3)
    page.page.wait_for_selector("#commands-why:not([hidden])")
    assert "--accept-commands" in page.text("#commands-why")
    assert page.page.locator('[data-push="left"]').is_disabled()


@pytest.mark.slow
def test_monitors_that_die_hang_or_come_late_change_nothing(monitor, start, page, tmp_path: Path) -> None:
    """The signals of a run with three such monitors are those of a run alone, bit for bit."""
    dies, _ = monitor()
    hangs, _ = monitor()
    run = start("run", "floor-walk", "--duration", "6", "--realtime", "--no-video", "--out", tmp_path / "watched")
    run.wait_for("")
    page.page.wait_for_timeout(1500)
    dies.end(signal.SIGKILL)
    hangs.process.send_signal(signal.SIGSTOP)
    _, address = monitor()  # late
    page.open(address)
    page.until(lambda p: p["state"] == "live" and p["rows"] > 0, "the late one shows the run")
    run.process.wait(60)
    alone = start("run", "floor-walk", "--duration", "6", "--no-video", "--out", tmp_path / "alone")
    alone.process.wait(60)
    logs = [signal_log.read(tmp_path / name / "signals.parquet") for name in ("watched", "alone")]
    assert logs[0].count == logs[1].count == 6001
    np.testing.assert_array_equal(logs[0].real.view(np.int64), logs[1].real.view(np.int64))
    np.testing.assert_array_equal(logs[0].integer, logs[1].integer)
