"""The benchmarks measure what they say (their figures themselves are never judged)."""

from __future__ import annotations

import json
import os
from pathlib import Path

import numpy as np
import pytest

from hoap2 import scenario
from hoap2.bench import chain, measure, plant, plant_shown, recording, simulators
from hoap2.bench.measure import Spread
from hoap2.binding import Plant
from hoap2.errors import UserError

WALKS_AFTER = 1600  # ticks of floor-walk: start-up and standing


def test_spread():
    spread = Spread.of(np.array([1000, 2000, 3000]), overhead_ns=500)
    assert spread.median == pytest.approx(1.5) and 2.4 < spread.p99 <= 2.5


def test_medians_of_a_tree():
    runs = [{"a": {"b": value, "ok": ok}} for value, ok in ((1.0, True), (5.0, True), (2.0, False))]
    assert measure.medians(runs) == {"a": {"b": 2.0, "ok": False}}


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="this system cannot pin")
def test_one_core_is_one_core_and_is_given_back():
    before = os.sched_getaffinity(0)
    with measure.one_core() as core:
        assert os.sched_getaffinity(0) == {core} and core in before
    assert os.sched_getaffinity(0) == before


def test_the_idlest_core_is_one_of_those_allowed():
    assert measure.idlest({0}, 0.01) == 0
    assert measure.idlest({10**6}, 0.01) == 10**6  # not told of: the last one allowed


def test_a_busy_machine_is_told():
    assert "busy" in measure.busy({"load": 2.5, "cores": 2}) and measure.busy({"load": 0.3, "cores": 2}) == ""


# bench run


def test_fmus_and_libraries_walk_side_by_side():
    loaded = scenario.load("floor-walk", ["controller.calibrate_s=0.2"])
    samples, overhead = chain.walk(loaded, 1500, fmi=2)
    assert samples.walked and overhead > 0
    assert samples.array("controller").size == 1500 and (samples.array("plant") > 0).all()
    assert samples.array("get").size == samples.array("get_and_log").size == 750


def test_no_walk_is_an_error():
    loaded = scenario.load("floor-walk")
    with pytest.raises(UserError, match="did not walk"):
        chain.walk(loaded, 50, fmi=3)


def test_parts_add_up():
    samples = chain.Samples()
    for name, ns in (("controller", 3000), ("plant", 9000), ("controller_fmu", 3500), ("plant_fmu", 9700),
                     ("get", 2000), ("get_and_log", 2600)):
        samples.add(name, ns)
    loop_us = {"set": 1.0, "controller": 5.0, "plant": 12.0, "get_and_log": 3.0}
    split = chain.split_of(loop_us, 25.0, samples, overhead_ns=100.0)
    # FMI's step calls take 0.5 + 0.1 and 0.7 + 0.1 us, the log 0.6
    assert split == pytest.approx({"controller": 4.4, "plant": 11.2, "exchange": 1.0 + 3.0 - 0.6 + 1.4, "log": 0.6,
                                   "rest": 4.0})


def test_mean_leaves_interruptions_out():
    assert measure.mean(np.array([10] * 99 + [10**6])) == 10.0


# bench plant


@pytest.fixture(scope="module")
def walk() -> recording.Recording:
    return recording.record(WALKS_AFTER)


def test_recorded_rows_are_the_plants_inputs(walk: recording.Recording):
    assert 0 < walk.walking.sum() < WALKS_AFTER
    robot = Plant(**walk.plant_values)
    reals, ints = robot.inputs.flat()
    count = reals.size
    assert walk.rows.shape == (WALKS_AFTER, 8 * count + 8 * ((ints.size + 1) // 2))
    reals[:] = walk.rows[-1, : 8 * count].view(np.float64)
    ints[:] = walk.rows[-1, 8 * count :].view(np.int32)[: ints.size]
    np.testing.assert_array_equal(robot.inputs.q_ref_rad, walk.q_ref_rad[-1])
    assert (robot.inputs.drive_mode == recording.POSITION).all()


def test_no_walk_in_the_recording_is_an_error():
    with pytest.raises(UserError, match="did not walk"):
        recording.record(20)


def test_only_position_servos_are_compared():
    robot = Plant()
    robot.inputs.qd_ref_rad_s = 0.5
    robot.inputs.tau_ff_Nm = 0.1
    expected = robot.inputs.q_ref_rad + (robot.inputs.kd_Nms_rad * 0.5 + 0.1) / robot.inputs.kp_Nm_rad
    np.testing.assert_allclose(recording.as_position(robot), expected)
    robot.inputs.drive_mode = 2
    with pytest.raises(UserError, match="position servos"):
        recording.as_position(robot)


@pytest.fixture(scope="module")
def cases(walk: recording.Recording) -> dict[str, plant.Case]:
    return {case: plant.measure_case(walk, air=case == "air") for case in plant.CASES}


def test_every_simulator_does_every_tick(cases: dict[str, plant.Case], walk: recording.Recording):
    for case in cases.values():
        assert set(case.ns) == {*plant.OURS, *plant.MUJOCO}
        assert all(ns.size == WALKS_AFTER and (ns > 0).all() for ns in case.ns.values())


def test_all_robots_stand_and_step_alike(cases: dict[str, plant.Case]):
    for name, seen in cases["floor"].robots.items():
        assert seen["stays_upright"], name
        assert seen["com_off_dworldstep_max_m"] < 1e-3, name
    assert cases["floor"].robots["mujoco_implicitfast"]["contacts_max"] == 8
    assert cases["air"].robots["mujoco_implicitfast"]["contacts_max"] == 0


def test_the_loops_in_c_do_what_the_binding_does(walk: recording.Recording):
    looped, stepped = (simulators.PlantSimulator("plant", walk, False).plant for _ in range(2))
    simulator = simulators.PlantSimulator("plant", walk, False)
    simulator.chunk(0, np.zeros(300, dtype=np.int64))
    simulator.look()
    for k in range(300):
        stepped.inputs.q_ref_rad = walk.q_ref_rad[k]
        stepped.step()
    assert np.array_equal(simulator.plant.outputs.true_q_rad, stepped.outputs.true_q_rad)
    assert not np.array_equal(simulator.plant.outputs.true_q_rad, looped.outputs.true_q_rad)


def test_a_failing_plant_is_told(walk: recording.Recording):
    simulator = simulators.PlantSimulator("plant", walk, False)
    simulator._recording = recording.Recording(np.full_like(walk.rows, 0xFF), walk.q_ref_rad, walk.walking,
                                               walk.plant_values)
    with pytest.raises(UserError, match="plant: "):
        simulator.chunk(0, np.zeros(10, dtype=np.int64))


def test_one_solver_under_two_names_is_an_error():
    track = plant._Track(["articulated", "dworldstep"])
    track._com = {"articulated": [np.ones(3)], "dworldstep": [np.ones(3)]}
    with pytest.raises(UserError, match="same bits"):
        plant._assert_two_solvers(track)
    track._com["dworldstep"] = [np.nextafter(np.ones(3), 2.0)]
    plant._assert_two_solvers(track)


def test_ratio_is_the_median_over_chunks():
    ns = {"a": np.array([10, 10, 10, 90, 10, 10]), "b": np.array([20, 20, 5, 45, 20, 20])}
    case = plant.Case(ns, {}, [slice(0, 2), slice(2, 4), slice(4, 6)])
    assert case.ratio("a", "b") == 0.5  # 0.5, 2, 0.5
    case.chunks.pop(1)
    assert case.ratio_of_means("a", "b") == 0.5 and case.us()["b"]["median"] == 0.02  # only what counts


def test_the_first_ticks_of_a_turn_do_not_count(cases: dict[str, plant.Case]):
    for case in cases.values():
        assert case.chunks[0].start == plant.WARM_UP + plant.COLD
        assert {chunk.start % plant.CHUNK for chunk in case.chunks} == {plant.COLD}
        assert case.counted("articulated").size == (WALKS_AFTER - plant.WARM_UP) // plant.CHUNK * (
            plant.CHUNK - plant.COLD)


def test_table_and_picture(cases: dict[str, plant.Case], tmp_path: Path, capsys):
    run = plant.summarise(cases)
    document = {"machine": measure.machine(1), "mujoco": {"version": "0.0", "model": "m.xml"}, "runs": [run],
                "settings": {"seconds": 1.6, "repeat": 1, "chunk_ticks": plant.CHUNK}, **run}
    picture = tmp_path / "new folder" / "plant.png"
    plant_shown.draw(document, [cases], picture)
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 20_000
    plant_shown.show(document, picture)
    text = capsys.readouterr().out
    for name in plant_shown.NAMES.values():
        assert name in text
    assert "stays on its feet" in text and str(picture) in text and "<= 0.7" in text
    document["robots"]["mujoco_euler"]["floor"]["stays_upright"] = False
    plant_shown.show(document, picture)
    assert "has fallen (MuJoCo Euler)" in capsys.readouterr().out


# the command


def test_bench_alone_shows_both(hoap2_cli):
    done = hoap2_cli("bench")
    assert "run" in done.stdout and "plant" in done.stdout and "whole run" in done.stdout


@pytest.mark.slow
def test_json_of_a_run_holds_every_figure(hoap2_cli):
    done = hoap2_cli("bench", "run", "--json", "--repeat", "1", "--seconds", "4", timeout=300)
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert set(document["split"]) == set(chain.PARTS) and sum(document["split"].values()) == pytest.approx(
        document["tick_us"])
    assert document["real_time_factor"] == pytest.approx(1000.0 / document["tick_us"])
    wall = document["wall_s"]
    assert wall["total"] == pytest.approx(wall["set_up"] + wall["loop"] + wall["report"], rel=1e-6)
    assert wall["loop"] == pytest.approx(4.0 / document["real_time_factor"], rel=0.2)
    assert 50 < document["peak_memory_mb"] < 5000 and document["walking"]["controller"]["median"] > 0
    in_loop = sum(document["split"].values()) - document["split"]["rest"]
    assert in_loop == pytest.approx(sum(document["loop"].values()))


@pytest.mark.slow
def test_json_of_the_plant_holds_every_figure(hoap2_cli, tmp_path: Path):
    done = hoap2_cli("bench", "plant", "--json", "--repeat", "2", "--seconds", "2", "--out", str(tmp_path / "p.png"),
                     timeout=300)
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert set(document["us"]) == {*plant.OURS, *plant.MUJOCO} and len(document["runs"]) == 2
    for other in ("dworldstep", "mujoco_implicitfast", "mujoco_euler"):
        assert set(document["ratio"][f"articulated_to_{other}"]) == {"floor", "air"}
    assert Path(document["picture"]).exists()


# bench can


def test_bench_can_times_the_frames_of_a_tick_and_the_link(hoap2_cli):
    done = hoap2_cli("bench", "can", "--json", "--repeat", "1")
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert document["frames"] == 17 and 300 < document["bytes"] < 400
    codec = document["codec"]
    assert 0.0 < codec["encode_us"]["median"] < codec["both_us"]["median"]
    assert 0.0 < codec["decode_us"]["median"] < codec["both_us"]["median"] < document["link_us"]["median"]
