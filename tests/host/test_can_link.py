"""Runs over CAN: timing, scenario keys, losses, cuts, what a run folder tells of them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hoap2 import master, products, runner, scenario
from hoap2.can import dbc, library, summary
from hoap2.can.link import CanLink
from hoap2.can.parameters import defaults
from hoap2.errors import UserError
from hoap2.library_side import LibrarySide
from hoap2.studies import light
from hoap2.wiring import DirectLink
from sides import FakeSide, standing_plant

GAIN = 0.01


def echo(name_in: str, name_out: str):
    """A script whose output is what the input was in the step, plus a little."""

    def script(side: FakeSide, tick: int) -> None:
        index = [c.name for c in side.inputs if c.kind == "real"].index(name_in)
        side.put(name_out, side.real_in[index] + GAIN)
        if any(c.name == "sensor_tick" for c in side.outputs):
            side.put("sensor_tick", tick)

    return script


def round_trip(link) -> tuple[np.ndarray, np.ndarray]:
    """Torque and gyro of two sides that hand each other's value on."""
    controller = FakeSide("controller", echo("gyro_S_rad_s.x", "tau_ff_Nm"))
    controller.put("drive_mode", 2)
    plant = standing_plant(echo("r_hip_yaw.tau_ff_Nm", "gyro_S_rad_s"))
    outcome = master.run(controller, plant, 60, 1.0, master.StopRequest(), link=link)
    assert outcome.error is None
    return outcome.log.column("c.r_hip_yaw.tau_ff_Nm").copy(), outcome.log.column("p.gyro_S_rad_s.x").copy()


def test_a_command_takes_one_tick_more_than_directly_a_measurement_none():
    tau, gyro = round_trip(DirectLink())
    np.testing.assert_allclose(tau[1:], gyro[:-1] + GAIN, rtol=0, atol=1e-12)
    np.testing.assert_allclose(gyro[1:], tau[:-1] + GAIN, rtol=0, atol=1e-12)
    tau, gyro = round_trip(CanLink(defaults(), 0))
    np.testing.assert_allclose(tau[1:], gyro[:-1] + GAIN, rtol=0, atol=2e-6)
    np.testing.assert_allclose(gyro[2:], tau[:-2] + GAIN, rtol=0, atol=1.1e-4)
    # sensor to torque and back: 2 ticks directly, 3 over CAN, so the values grow in that proportion
    assert tau[-1] == pytest.approx(60 * GAIN * 2 / 3, abs=3 * GAIN)


def short(*overrides: str, duration_s: float = 2.6) -> master.Outcome:
    loaded = scenario.load("floor-walk", list(overrides), None, duration_s)
    both = products.open_both(products.Choice(), loaded)
    try:
        return master.run(both.controller, both.plant, runner.ticks_of(loaded), 1.0, master.StopRequest(), link=both.link)
    finally:
        both.close()


def test_direct_and_can_differ_by_quantisation_and_one_tick():
    direct, can = short().log, short("scenario.link=can").log
    reference, over_can = direct.block("c.q_ref_rad"), can.block("c.q_ref_rad")
    assert np.abs(np.diff(reference, axis=0)).max() > 1e-3, "it walks"
    assert np.abs(reference - over_can).max() < 4e-3
    true, late = direct.block("p.true_q_rad")[1:-1], can.block("p.true_q_rad")[2:]
    assert np.abs(true - late).max() < 4e-3
    # nearer to itself a tick later than to itself at the same tick
    assert np.abs(true - late).mean() < 0.6 * np.abs(true - can.block("p.true_q_rad")[1:-1]).mean()


def test_runs_repeat_and_disturbances_follow_their_seed():
    options = ("scenario.link=can", "can.loss=0.02", "can.corrupt=0.02", "can.delay=0.02")
    first, again, other = short(*options), short(*options), short(*options, "can.seed=2")
    assert first.log.real.tobytes() == again.log.real.tobytes()
    assert first.link.ticks.tobytes() == again.link.ticks.tobytes()
    assert first.link.ticks.tobytes() != other.link.ticks.tobytes()
    lost = first.link.counts()
    assert sum(lost.lost[0]) > 50 and sum(lost.lost[1]) > 50
    for bus in range(2):
        assert lost.queued[bus] == lost.delivered[bus] + lost.pending[bus] + sum(lost.lost[bus])


def test_a_saved_link_goes_on_the_same():
    link = CanLink(defaults() | {"loss": 0.1, "delay": 0.1}, 5)
    link.asked.integer[:] = 1

    def play(ticks: int) -> bytes:
        seen = []
        for _ in range(ticks):
            link.measured.integer[0] += 1
            link.measured.real[:] = 0.1
            link.exchange()
            seen.append(link.to_controller.real.tobytes() + link.to_plant.real.tobytes())
        return b"".join(seen)

    play(100)
    saved, tick = link.save(), int(link.measured.integer[0])
    first = play(100)
    link.restore(saved)
    link.measured.integer[0] = tick
    assert play(100) == first
    with pytest.raises(UserError, match="not a state"):
        link.restore(saved[:-1])


@pytest.mark.parametrize(("overrides", "words"), [
    (["scenario.link=canbus"], ["unknown link", "did you mean 'can'"]),
    (["scenario.link=can", "can.los=0.1"], ["unknown parameter of the CAN link", "loss"]),
    (["scenario.link=can", "can.loss=1.5"], ["out of range", "[0, 1]"]),
    (["scenario.link=can", "can.loss=much"], ["needs a number"]),
    (["scenario.link=can", "can.drop_node=1.5"], ["whole number"]),
    (["scenario.link=can", "can.cut_bus=middle"], ["unknown value of can.cut_bus"]),
    (["can.loss=0.1"], ["[can] is for runs over CAN", "--link can"]),
])  # fmt: skip
def test_bad_values_are_errors_that_say_what_to_do(overrides: list[str], words: list[str]):
    with pytest.raises(UserError) as caught:
        scenario.load("floor-walk", overrides)
    said = f"{caught.value.message} {caught.value.hint}"
    assert all(word in said for word in words), said


def test_the_watchdog_gives_up_in_the_fifth_tick_unless_told_otherwise():
    assert scenario.load("floor-walk", ["scenario.link=can"]).values["controller"]["stale_limit_ticks"] == (4.0,)
    told = scenario.load("floor-walk", ["scenario.link=can", "controller.stale_limit_ticks=7"])
    assert told.values["controller"]["stale_limit_ticks"] == (7.0,)
    assert scenario.load("floor-walk").values["controller"]["stale_limit_ticks"] == (5.0,)


def test_a_controller_without_the_signals_is_refused():
    controller, plant = FakeSide("controller"), standing_plant()
    controller.outputs = [c for c in controller.outputs if not c.name.endswith(".tau_ff_Nm")]
    log_rows = (np.zeros((2, 500)), np.zeros((2, 500), np.int32))
    with pytest.raises(UserError, match="has no r_hip_yaw.tau_ff_Nm"):
        CanLink(defaults(), 0).writers(controller, plant, log_rows, log_rows)


def test_floor_walk_over_can_takes_all_steps():
    done = light.execute(scenario.load("floor-walk", ["scenario.link=can"]), products.Choice())
    assert done["ok"] and done["steps_taken"] == 36
    can = done["can"]
    assert can["lost_percent"] == 0.0 and can["holds"] == 0 and can["clipped"] == 0
    assert not can["refused_by_boards"] and not can["refused_by_controller"]
    for bus in can["buses"].values():
        assert 40.0 < bus["load_percent"] <= 70.0 and bus["busiest_tick_us"] < 1000.0
    assert can["latency"]["beat"]["max_us"] < 60.0


@pytest.mark.slow
def test_floor_walk_with_one_percent_of_the_frames_lost():
    done = light.execute(scenario.load("floor-walk", ["scenario.link=can", "can.loss=0.01"]), products.Choice())
    assert done["ok"] and 0.8 < done["can"]["lost_percent"] < 1.2


def test_a_cut_of_50_ms_ends_in_the_crouch_and_nobody_falls():
    outcome = short("scenario.link=can", "can.cut_start_s=2.3", "can.cut_s=0.05", duration_s=4.5)
    log = outcome.log
    fault = log.column("c.fault")
    assert int(np.argmax(fault > 0)) - 2300 <= library.can_table.load().raw["alive_limit_ticks"] + 1
    assert fault[-1] == 2 and log.column("c.mode")[-1] in (5, 6)
    assert np.abs(log.column("p.true_chest_rpy_rad.x")).max() < 0.3 and not log.column("p.other_contacts").any()
    ticks = outcome.link.ticks
    holding = ticks[:, library.TICK_FIELDS.index("holding")]
    assert holding[:2305].max() == 0 and holding[2306:2350].min() == 9 and holding[-1] == 0


@pytest.mark.parametrize(("overrides", "state", "words"), [
    (["can.second_start_s=1.0"], "doubled", "another controller"),
    (["can.second_start_s=1.0", "can.second_late_s=0.0"], "run", "bus-off"),
    (["can.stop_start_s=1.0"], "stopped", "emergency stop"),
])  # fmt: skip
def test_a_second_controller_and_the_stop_button_are_told(overrides: list[str], state: str, words: str):
    outcome = short("scenario.link=can", *overrides, duration_s=1.3)
    can = summary.summarise(outcome.link)
    assert can["controller_state"] == state and any(words in note for note in summary.notes(can))
    assert outcome.log.column("c.fault")[-1] == 2, "the controller knows, and goes to its safe mode"
    assert outcome.link.ticks[-1, library.TICK_FIELDS.index("holding")] == 9


def test_the_run_folder_tells_of_the_link(tmp_path: Path, hoap2_cli):
    folder = tmp_path / "run"
    done = hoap2_cli("run", "floor-stand", "--link", "can", "--set", "can.loss=0.01", "--duration", "2", "--no-video",
                     "--no-telemetry", "--out", str(folder))  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    assert "CAN: load right 5" in done.stdout and "% of the frames lost" in done.stdout
    told = json.loads((folder / "summary.json").read_text())
    assert told["link"] == "can" and told["can"]["lost_percent"] == pytest.approx(1.0, abs=0.3)
    report = (folder / "report.html").read_text()
    assert "<h2>CAN</h2>" in report and "Bus load and losses" in report and "on the way" in report
    assert "over CAN" in report
    import pyarrow.parquet

    table = pyarrow.parquet.read_table(folder / "can.parquet")
    assert table.num_rows == 2000 and table.column_names == ["t_s", *library.TICK_FIELDS]
    again = scenario.load(str(folder / "run.toml"))
    assert again.link == "can" and again.can["loss"] == 0.01


def test_dbc_files_fit_the_firmware_and_others_are_refused(tmp_path: Path):
    assert dbc.load("right").get_message_by_name("beat").frame_id == 0x20
    text = dbc.path_of("left").read_text()
    protocol = library.load().hoap2_can_protocol()
    other = tmp_path / "other.dbc"
    other.write_text(text.replace(f'BA_ "Protocol" {protocol};', f'BA_ "Protocol" {protocol ^ 1};'))
    with pytest.raises(UserError, match="is of protocol 0x"):
        dbc.load("left", other)
    other.write_text(text.replace(f'BA_ "Protocol" {protocol};', ""))
    with pytest.raises(UserError, match="is of protocol none"):
        dbc.load("left", other)
    other.write_text("not a DBC {")
    with pytest.raises(UserError, match="cannot read"):
        dbc.load("left", other)
    with pytest.raises(UserError, match="no bus 'middle'"):
        dbc.load("middle")
    with pytest.raises(UserError, match="cannot read"):
        dbc.load("left", tmp_path / "missing.dbc")


def test_library_sides_take_the_link_too():
    from hoap2 import Controller, Plant

    loaded = scenario.load("floor-walk", ["scenario.link=can"], None, 0.3)
    sides = LibrarySide(Controller(stale_limit_ticks=4)), LibrarySide(Plant())
    outcome = master.run(*sides, 300, 1.0, master.StopRequest(), link=CanLink(loaded.can, 0))
    fmus = short("scenario.link=can", duration_s=0.3)
    assert outcome.error is None
    assert outcome.log.block("p.true_q_rad").tobytes() == fmus.log.block("p.true_q_rad").tobytes()


CLANG = shutil.which("clang") or shutil.which("clang-14")


@pytest.mark.skipif(CLANG is None, reason="libFuzzer comes with clang, which is not installed")
@pytest.mark.parametrize(("harness", "runs"), [("codec", 200_000), ("nodes", 2_000)])
def test_no_bytes_break_the_codec_or_the_nodes(harness: str, runs: int, repo_root: Path, tmp_path: Path):
    folder, program, corpus = repo_root / "tests" / "can" / "fuzz", tmp_path / harness, tmp_path / "corpus"
    built = subprocess.run([folder / "build.sh", harness, program], capture_output=True, text=True,
                           env=os.environ | {"CLANG": CLANG})  # fmt: skip
    if built.returncode and "libclang_rt" in built.stderr:
        pytest.skip("clang is here without its libFuzzer (libclang-rt-dev)")
    assert built.returncode == 0, built.stderr
    shutil.copytree(folder / "corpus" / harness, corpus)
    done = subprocess.run([program, f"-runs={runs}", "-seed=1", "-max_len=600", corpus], capture_output=True, text=True,
                          cwd=tmp_path)  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    assert f"Done {runs}" in done.stderr
