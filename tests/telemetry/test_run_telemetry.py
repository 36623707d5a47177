"""What a run logs and publishes: complete, in order, true to its signals, and without a trace in them."""

from __future__ import annotations

import contextlib
import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import rig
from hoap2 import master, parameters, products, scenario
from hoap2.errors import UserError
from hoap2.generate import lcm_types
from hoap2.generate.tables import MESSAGES
from hoap2.signal_log import PREFIX, SignalLog
from hoap2.telemetry import log_file, types
from sides import FakeSide, falling_plant, standing_plant, stepping_controller


def noisy(product: str, seed: int) -> FakeSide:
    """A side whose outputs are all different numbers, new ones each tick; it stands."""
    random = np.random.default_rng(seed)

    def script(side: FakeSide, tick: int) -> None:
        side.real_out[:] = 0.1 * random.standard_normal(side.real_out.size)
        side.int_out[:] = random.integers(-9, 9, side.int_out.size)
        if product == "plant":
            side.put("other_contacts", 0)

    return FakeSide(product, script)


def block(log: SignalLog, signal) -> np.ndarray:
    return log.block(PREFIX[signal.product] + signal.name)


@pytest.mark.parametrize("message", MESSAGES)
def test_every_output_of_every_tick_is_in_the_log(message: str, tmp_path: Path):
    outcome, _ = rig.run(noisy("controller", 1), noisy("plant", 2), 137, tmp_path / "a.lcm")
    table = parameters.table()
    every = 10 if message == "truth" else 1
    messages = rig.of(f"HOAP2_{message.upper()}", rig.read(tmp_path / "a.lcm"))
    assert [m.sequence for m in messages] == list(range(len(messages)))
    assert [m.tick for m in messages] == list(range(0, 138, every))
    assert all(m.time_us == 1000 * m.tick and m.run_id == rig.RUN_ID for m in messages)
    for signal in lcm_types.carried(table, message):
        sent = np.array([np.ravel(getattr(m, lcm_types.field_name(signal))) for m in messages])
        assert np.array_equal(sent, block(outcome.log, signal)[::every]), signal.name


def test_the_three_messages_carry_every_output_once():
    table = parameters.table()
    carried = [(s.product, s.name) for name in MESSAGES for s in lcm_types.carried(table, name)]
    outputs = [(p, s.name) for p in PREFIX for s in table.select(p, "output")]
    assert sorted(carried) == sorted(outputs)


def test_events_tell_the_run(tmp_path: Path):
    def push(side: FakeSide, tick: int) -> None:
        side.put("true_push_force_W_N", [0.0, 5.0 * (203 <= tick < 207), 0.0])

    controller = stepping_controller(step_ticks=100, lead_ticks=100, steps=3)
    rig.run(controller, standing_plant(push), 500, tmp_path / "a.lcm")
    log = rig.read(tmp_path / "a.lcm")
    events = [(m.tick, m.kind, m.text) for m in rig.of(types.EVENT, log)]
    assert events[0] == (0, "run_started", "scripted: A scripted run")
    assert events[-1] == (500, "run_ended", "done")
    steps = [(101, "step", "step 1, stance right"), (201, "step", "step 2, stance right"),
             (301, "step", "step 3, stance right")]  # fmt: skip
    assert [e for e in events if e[1] == "step"] == steps
    assert [e for e in events if e[1] == "push"] == [(203, "push", "push begins"), (207, "push", "push ends")]
    assert {m.kind for m in rig.of(types.EVENT, log)} <= set(types.EVENT_KINDS)
    assert [time_us for time_us, _, _ in log] == sorted(time_us for time_us, _, _ in log)


def test_a_fall_and_faults_are_told(tmp_path: Path):
    def faulty(side: FakeSide, tick: int) -> None:
        side.put("fault", (8 if tick >= 20 else 0) | (1 if 40 <= tick < 60 else 0))

    outcome, _ = rig.run(FakeSide("controller", faulty), falling_plant(100), 3000, tmp_path / "a.lcm")
    log = rig.read(tmp_path / "a.lcm")
    events = [(m.tick, m.kind, m.text) for m in rig.of(types.EVENT, log)]
    fall_tick = 100 + 393  # 45 deg at 2 rad/s
    assert (fall_tick, "fall", "fell at 0.493 s (chest tilt)") in events
    assert outcome.timing.ticks == fall_tick + 100
    times = [time_us for time_us, _, _ in log]
    assert times == sorted(times), "it stands where it was noticed, so that a player never goes back"
    assert [e for e in events if e[1] == "fault"] == [
        (20, "fault", "joint_limit"), (40, "fault", "bad_input"), (60, "fault", "cleared: bad_input")]  # fmt: skip
    assert events[-1][1:] == ("run_ended", "fell")


def test_run_messages_frame_the_log(tmp_path: Path):
    rig.run(stepping_controller(), standing_plant(), 50, tmp_path / "a.lcm")
    first, last = rig.of(types.RUN, rig.read(tmp_path / "a.lcm"))
    assert (first.state, last.state) == (first.RUNNING, first.ENDED) and (first.tick, last.tick) == (0, 50)
    for name, value in vars(rig.about()).items():
        if name != "accepts_commands":
            assert getattr(first, name) == getattr(last, name) == value
    assert first.schema_hash == lcm_types.schema_hash(parameters.table())


def test_an_error_of_a_product_leaves_a_whole_log(tmp_path: Path):
    def breaks(side: FakeSide, tick: int) -> None:
        if tick == 33:
            raise RuntimeError("it broke")

    outcome, _ = rig.run(stepping_controller(), standing_plant(breaks), 100, tmp_path / "a.lcm")
    log = rig.read(tmp_path / "a.lcm")
    assert [m.tick for m in rig.of(types.STATE, log)] == list(range(outcome.log.count)) == list(range(33))
    assert "it broke" in rig.of(types.EVENT, log)[-1].text and rig.of(types.RUN, log)[-1].state == 2


def test_live_without_pace_is_thinned_out_and_the_log_is_not(tmp_path: Path):
    """Sequence numbers count what was sent: thinning out is not loss."""
    heard, log_path = [], tmp_path / "a.lcm"

    class Ear:
        """Listens within the process, as commands would."""

        def open(self, log) -> None:
            pass

        def poll(self, tick: int) -> None:
            publisher = self.telemetry.publisher
            if tick == 0:
                publisher.subscribe(lambda channel, data: heard.append((channel, types.decode(channel, data))))
            while publisher.poll(0) > 0:
                pass

    ear = Ear()
    ear.telemetry = rig.RunTelemetry(rig.about(), log_path, "memq://")
    master.run(noisy("controller", 1), noisy("plant", 2), 4000, 0.1, master.StopRequest(),
               master.Company(telemetry=ear.telemetry, commands=ear))  # fmt: skip
    states = [m for channel, m in heard if channel == types.STATE]
    assert 1 <= len(states) < 2000 and [m.sequence for m in states] == list(
        range(states[0].sequence, states[-1].sequence + 1)
    )
    in_log = {m.tick: m for m in rig.of(types.STATE, rig.read(log_path))}
    assert len(in_log) == 4001
    for m in states:
        assert m.q_ref_rad == in_log[m.tick].q_ref_rad
    counts = ear.telemetry.counts
    assert counts["decimated"] > 4000 and counts["dropped"] == 0
    slow_and_fast = 2 * 4001 + 2 * 401 + 1  # health once more at the end
    events_and_run = len(rig.of(types.EVENT, rig.read(log_path))) + 2
    once_a_second = counts["published"] + counts["decimated"] - slow_and_fast - events_and_run
    assert 0 <= once_a_second < 60, "run_t is repeated by the wall clock"


def test_a_full_disk_ends_the_log_and_not_the_run():
    outcome, telemetry = rig.run(noisy("controller", 1), noisy("plant", 2), 1500, Path("/dev/full"))
    assert outcome.error is None and outcome.timing.ticks == 1500
    assert telemetry.notes == ["telemetry.lcm: the log ends early: No space left on device"]


def test_a_log_that_cannot_be_written_is_an_error_before_the_run(tmp_path: Path):
    with pytest.raises(UserError, match="No such file or directory"):
        rig.run(noisy("controller", 1), noisy("plant", 2), 10, tmp_path / "missing" / "a.lcm")


def test_what_a_foreign_product_does_not_have_is_nan(tmp_path: Path):
    plant = standing_plant()
    keep = [i for i, c in enumerate(plant.outputs) if c.name not in ("true_sinkage_m.r", "true_sinkage_m.l")]
    gone = len(plant.outputs) - len(keep)
    at = next(i for i, c in enumerate(plant.outputs) if c.name == "true_sinkage_m.r")
    plant.outputs = [plant.outputs[i] for i in keep]
    plant.real_out = np.delete(plant.real_out, [at, at + 1])
    rig.run(stepping_controller(), plant, 20, tmp_path / "a.lcm")
    truth = rig.of(types.TRUTH, rig.read(tmp_path / "a.lcm"))[-1]
    assert gone == 2 and all(np.isnan(truth.true_sinkage_m))
    assert list(truth.true_com_W_m) == [0.009, 0, 0.2575] and truth.true_foot_force_W_N[1][2] == 34.5


def real_run(tmp_path: Path, name: str, telemetry: bool) -> tuple[bytes, bytes, Path]:
    loaded = scenario.load("floor-walk")
    both = products.open_both(products.Choice(), loaded)
    path = tmp_path / f"{name}.lcm"
    company = master.Company(telemetry=rig.RunTelemetry(rig.about(), path, None) if telemetry else None)
    outcome = master.run(both.controller, both.plant, 2200, 1.0, master.StopRequest(), company)
    both.close()
    assert outcome.error is None and outcome.log.count == 2201
    return outcome.log.real[:2201].tobytes(), outcome.log.integer[:2201].tobytes(), path


def test_telemetry_leaves_no_trace_and_equal_runs_log_equal_messages(tmp_path: Path):
    without = real_run(tmp_path, "none", telemetry=False)
    a, b = (real_run(tmp_path, name, telemetry=True) for name in "ab")
    assert a[:2] == b[:2] == without[:2] and not without[2].exists()
    told = [
        [(t, channel, m.encode()) for t, channel, m in rig.read(path) if channel != types.HEALTH] for *_, path in (a, b)
    ]
    assert told[0] == told[1] and len(told[0]) > 2 * 2201


def test_a_run_folder_holds_its_log(hoap2_cli, tmp_path: Path):
    def run(name: str, *options: str):
        done = hoap2_cli(
            "run", "floor-stand", "--duration", "2", "--no-video", "--json", "--out", name, *options, cwd=tmp_path
        )
        assert done.returncode in (0, 1), done.stderr
        folder = Path(json.loads(done.stdout)["folder"])
        return folder, json.loads((folder / "timing.json").read_text())

    folder, timing = run("a")
    log = rig.read(folder / "telemetry.lcm")
    first = rig.of(types.RUN, log)[0]
    assert first.run_toml == (folder / "run.toml").read_text() and f"run_id = {first.run_id}" in first.run_toml
    assert first.scenario == "floor-stand" and first.folder == str(folder) and first.duration_s == 2.0
    assert timing["telemetry"]["logged"] == len(log) and len(rig.of(types.GAIT, log)) == 2001
    folder, timing = run("b", "--no-telemetry")
    assert not (folder / "telemetry.lcm").exists() and "telemetry" not in timing


def test_a_study_is_not_live(hoap2_cli, tmp_path: Path):
    done = hoap2_cli("run", "floor-stand", "--seeds", "1-2", "--realtime", cwd=tmp_path)
    assert done.returncode == 2 and "a study is not live" in done.stderr and not (tmp_path / "out").exists()


@contextlib.contextmanager
def paced_run(folder: Path):
    """A paced run that has begun to fill its log: the process, and the folder that it fills."""
    command = [sys.executable, "-m", "hoap2.cli", "run", "floor-stand", "--realtime", "--lcm", "off", "--no-video",
               "--duration", "60", "--out", "a"]  # fmt: skip
    process = subprocess.Popen(command, cwd=folder, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    part = folder / "out" / "floor-stand"
    give_up = time.monotonic() + 60
    while time.monotonic() < give_up and not any(f.stat().st_size for f in part.glob(".a.part-*/telemetry.lcm")):
        time.sleep(0.05)
    try:
        yield process, part
    finally:
        process.kill()
        process.wait(timeout=60)


def test_a_stopped_paced_run_leaves_a_whole_log(tmp_path: Path):
    with paced_run(tmp_path) as (process, part):
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=60) == 130
    log = rig.read(part / "a" / "telemetry.lcm")
    assert rig.of(types.EVENT, log)[-1].text == "stopped" and rig.of(types.RUN, log)[-1].state == 2
    states = rig.of(types.STATE, log)
    assert [m.tick for m in states] == list(range(len(states))) and 10 < len(states) < 60_000


def test_a_killed_run_leaves_a_log_that_can_be_read_up_to_there(tmp_path: Path):
    with paced_run(tmp_path) as (process, part):
        process.kill()
    (path,) = part.glob(".a.part-*/telemetry.lcm")
    signals, notes = log_file.read_signals(path)
    assert signals.count > 10 and np.isfinite(signals.column("p.l_knee.q_enc_rad")).all()
    assert notes == [] or "cut off in mid-message" in notes[0]
