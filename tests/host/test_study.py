"""Studies: what is counted, what is kept, what is refused."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from hoap2 import cli, parallel, scenario, statistics
from hoap2.errors import UserError
from hoap2.master import StopRequest
from hoap2.products import Choice
from hoap2.studies import collection, groups, light, own_value, parameter_map, sand, shown, sweep, tables

FILES = {"study.json", "runs.csv", "table.csv", "study.png", "study.svg", "plan.json", "runs.jsonl"}
QUIET = Console(file=io.StringIO())


def row(fell: bool = False, step: int | None = None, way: str = "backward", pitch: float = 1.0, roll: float = 0.3,
        **more) -> dict:  # fmt: skip
    """A summary as far as groups read it."""
    return {
        "error": None, "interrupted": False, "fell": fell, "fell_backward": fell and way == "backward",
        "survived": not fell, "fall_step": step, "fall_direction": way if fell else None,
        "pitch_deg": {"max": pitch, "rms": pitch / 3}, "roll_deg": {"max": 2 * roll, "rms": roll},
    } | more  # fmt: skip


def test_fractions_medians_and_directions():
    rows = [row(True, 17), row(True, 19), row(True, 24, "left"), row(pitch=3.0)]
    block = groups.describe(rows)
    assert block["runs"] == 4 and block["errors"] == 0
    assert (block["fell_fraction"], block["fell_backward_fraction"], block["survived_fraction"]) == (0.75, 0.5, 0.25)
    assert block["wilson_95"]["fell_fraction"] == list(statistics.wilson_95(3, 4))
    assert block["fall_steps"] == [17, 19, 24] and block["median_fall_step"] == 19.0
    assert block["fall_directions"] == {"backward": 2, "left": 1}
    assert block["median_max_pitch_deg"] == 1.0 and block["largest_max_pitch_deg"] == 3.0


def test_an_error_counts_for_nothing_unless_the_robot_lay_already():
    rows = [row(), row(error="left the pool"), row(True, 9, error="left the pool")]
    block = groups.describe(rows, errors=2)
    assert (block["runs"], block["errors"]) == (2, 3)
    assert block["survived_fraction"] == 0.5 and block["fell_fraction"] == 0.5


def test_a_group_without_runs():
    block = groups.describe([], errors=1)
    assert block["survived_fraction"] is None and block["median_fall_step"] is None and block["runs"] == 0


def test_paired_difference():
    from scipy import stats

    rng = np.random.default_rng(5)
    base = {seed: row(roll=float(rng.uniform(0.3, 0.5))) for seed in range(1, 13)}
    mine = {seed: row(roll=base[seed]["roll_deg"]["rms"] - float(rng.uniform(0, 0.02))) for seed in range(1, 13)}
    base[3] = row(True, 20)  # a fallen run's roll says nothing
    del mine[4]
    found = groups.paired_difference(mine, base, "roll_deg.rms")
    values = list(found["differences"].values())
    assert found["pairs"] == 10 and set(found["differences"]) == {str(s) for s in (1, 2, *range(5, 13))}
    interval = stats.ttest_1samp(values, 0.0).confidence_interval(0.95)
    assert found["mean_95"] == pytest.approx([interval.low, interval.high], rel=1e-9)
    assert found["mean"] == pytest.approx(np.mean(values)) and found["mean"] < 0


@pytest.mark.parametrize("freedom", [1, 2, 3, 8, 49, 200])
def test_students_t(freedom):
    from scipy import stats

    assert statistics.student_975(freedom) == pytest.approx(stats.t.ppf(0.975, freedom), rel=1e-9)
    assert statistics.mean_95([1.0]) is None


# --- what is kept -----------------------------------------------------------------------------------------------


@pytest.fixture
def runs(monkeypatch):
    """Runs are counted instead of made, in this process."""
    made: list[tuple[str, int]] = []

    def execute(loaded: scenario.Scenario, _choice) -> dict:
        made.append((loaded.name, loaded.seed))
        if loaded.seed == 13:
            raise UserError("no luck")
        return row() | {"scenario": loaded.name, "seed": loaded.seed}

    def run_all(function, tasks, jobs, stop, finished, beat):
        for key, arguments in tasks.items():
            try:
                finished(key, function(*arguments), None)
            except UserError as error:
                finished(key, None, str(error))
            beat()

    monkeypatch.setattr(light, "product_hashes", lambda choice: {"controller": "c", "plant": "p"})
    monkeypatch.setattr(parallel, "run_all", run_all)
    monkeypatch.setattr(collection.collect, "__defaults__", (execute,))
    return made


def tasks_of(*overrides: str, seeds=(1, 2)) -> dict:
    loaded = scenario.load("floor-walk", list(overrides))
    return {seed: light.with_seed(loaded, seed) for seed in seeds}


def collect(folder: Path, tasks: dict) -> collection.Found:
    return collection.collect(folder, tasks, Choice(), 1, QUIET, "test")


def test_finished_runs_are_kept_and_a_parameter_change_invalidates(runs, tmp_path):
    first = collect(tmp_path, tasks_of())
    assert len(runs) == 2 and first.kept == 0 and set(first.summaries) == {1, 2}
    again = collect(tmp_path, tasks_of(seeds=(1, 2, 3)))
    assert len(runs) == 3 and runs[-1][1] == 3 and again.kept == 2, "only the new seed"
    collect(tmp_path, tasks_of("controller.step_time_s=0.41"))
    assert len(runs) == 5, "other parameters are other runs"
    collect(tmp_path, tasks_of())
    assert len(runs) == 5, "and the old ones are still there"


def test_another_build_invalidates(runs, tmp_path, monkeypatch):
    collect(tmp_path, tasks_of())
    monkeypatch.setattr(light, "product_hashes", lambda choice: {"controller": "c", "plant": "other"})
    assert collect(tmp_path, tasks_of()).kept == 0 and len(runs) == 4


def test_bounds_judge_what_is_kept_anew(runs, tmp_path):
    pitch = ("bounds.pitch_deg.max.min=0", "bounds.pitch_deg.max.max=%g")
    tight, wide = ([p % v if "%" in p else p for p in pitch] for v in (0.5, 2.0))
    one = collect(tmp_path, tasks_of(*tight)).summaries[1]
    two = collect(tmp_path, tasks_of(*wide)).summaries[1]
    assert len(runs) == 2
    assert not one["bounds"]["pitch_deg.max"]["ok"] and two["bounds"]["pitch_deg.max"]["ok"]


def test_a_line_cut_off_by_a_crash_is_no_run(runs, tmp_path):
    collect(tmp_path, tasks_of())
    file = tmp_path / collection.RUNS
    file.write_text(file.read_text()[:-40])
    found = collect(tmp_path, tasks_of())
    assert found.kept == 1 and len(runs) == 3 and set(found.summaries) == {1, 2}
    assert collect(tmp_path, tasks_of()).kept == 2


def test_equal_runs_are_made_once_and_errors_are_told_apart(runs, tmp_path):
    tasks = tasks_of(seeds=(1, 13))
    tasks |= {f"again {seed}": task for seed, task in tasks.items()}
    found = collect(tmp_path, tasks)
    assert len(runs) == 2 and set(found.summaries) == {1, "again 1"}
    assert found.errors == {13: "no luck", "again 13": "no luck"}
    assert collect(tmp_path, tasks).kept == 1 and len(runs) == 3, "what failed is tried again"


def double(value: int) -> int:
    if value == 3:
        raise UserError("not three")
    if value == 4:
        raise ZeroDivisionError("four")
    return 2 * value


def test_workers_hand_back_results_and_errors():
    got, beats = {}, []
    with StopRequest() as stop:
        tasks = {f"k{i}": (i,) for i in range(1, 6)}
        finished = lambda key, *outcome: got.update({key: outcome})  # noqa: E731
        parallel.run_all(double, tasks, 2, stop, finished, lambda: beats.append(1))
    assert got["k2"] == (4, None) and got["k5"] == (10, None) and beats
    assert got["k3"] == (None, "not three") and got["k4"] == (None, "ZeroDivisionError: four")


# --- the sand study -----------------------------------------------------------------------------------------------


def test_the_four_walks_are_one_parameter_set():
    """They differ in the ground and in landing position control, and in nothing else that acts."""
    loaded = {name: scenario.load(name) for name in sand.SCENARIOS}
    base = loaded["floor-walk"].values
    allowed = {"sand-walk": {"ground"}, "sand-walk-lpc": {"ground", "landing_control"},
               "floor-walk": set(), "floor-walk-lpc": {"landing_control"}}  # fmt: skip
    for name, each in loaded.items():
        differ = {n for p in base for n, v in each.values[p].items() if v != base[p][n] and not n.startswith("soil_")}
        assert differ == allowed[name], name
        assert each.duration_s == loaded["floor-walk"].duration_s
        differ = {n for n, v in each.options.items() if v != loaded["floor-walk"].options[n]}
        assert differ == ({"stand_speed_m_s"} if name.startswith("sand") else set()), name
    soil = {n: v for n, v in loaded["sand-walk"].values["plant"].items() if n.startswith("soil_")}
    assert soil == {n: v for n, v in loaded["sand-walk-lpc"].values["plant"].items() if n.startswith("soil_")}


def found_of(seeds=range(101, 121)) -> collection.Found:
    found = collection.Found()
    for seed in seeds:
        found.summaries["sand-walk", seed] = row(True, 16 + seed % 5, pitch=80.0)
        found.summaries["sand-walk-lpc", seed] = row(pitch=1.0 + 0.01 * seed)
        found.summaries["floor-walk", seed] = row(roll=0.30 + 0.001 * (seed % 7))
        found.summaries["floor-walk-lpc", seed] = row(roll=0.29 + 0.001 * (seed % 3))
    for (name, seed), entry in found.summaries.items():
        entry |= {"scenario": name, "seed": seed, "bounds": {}, "ok": True}
    return found


def sand_document(found: collection.Found) -> dict:
    loaded = {name: scenario.load(name) for name in sand.SCENARIOS}
    return sand.describe(loaded, list(range(101, 121)), found) | {"folder": "there"}


def test_study_json_has_its_keys():
    document = json.loads(json.dumps(sand_document(found_of())))
    walk, controlled = document["sand_walk"], document["sand_walk_lpc"]
    assert walk["fell_backward_fraction"] == 1.0 and walk["median_fall_step"] == 18.0
    assert controlled["survived_fraction"] == 1.0 and controlled["median_max_pitch_deg"] == pytest.approx(2.105)
    for block in (walk, controlled, document["floor_walk"], document["floor_walk_lpc"]):
        fractions = {name for name in block if name.endswith("_fraction")}
        assert fractions == set(block["wilson_95"]) and all(len(ends) == 2 for ends in block["wilson_95"].values())
    assert document["floor_roll_rms_difference_deg"]["pairs"] == 20
    assert document["ok"] is True and document["runs_done"] == document["runs_planned"] == 80


def test_a_study_that_was_stopped_or_has_errors_is_not_ok():
    found = found_of()
    found.stopped = True
    assert sand_document(found)["ok"] is False and sand.exit_code(sand_document(found)) == 130
    found = found_of()
    del found.summaries["sand-walk", 101]
    found.errors["sand-walk", 101] = "no start"
    document = sand_document(found)
    assert document["errors"] == {"sand-walk seed 101": "no start"} and document["sand_walk"]["errors"] == 1
    assert sand.exit_code(document) == 1


def test_tables_of_a_study():
    found = found_of()
    document = sand_document(found)
    runs_csv = list(csv.DictReader(io.StringIO(tables.runs_csv(list(found.summaries.values())))))
    assert len(runs_csv) == 80 and runs_csv[0]["fall_step"] == "17" and runs_csv[0]["roll_deg.rms"] == "0.3"
    entries = [({"scenario": n}, document[sand.key_of(n)]) for n in sand.SCENARIOS]
    groups_csv = list(csv.DictReader(io.StringIO(tables.groups_csv(entries))))
    assert [r["scenario"] for r in groups_csv] == list(sand.SCENARIOS)
    assert float(groups_csv[0]["fell_backward_fraction_low_95"]) == pytest.approx(statistics.wilson_95(20, 20)[0])
    text = io.StringIO()
    shown.sand(document, Console(file=text, width=160))
    for word in ("20 of 20 (84-100 %)", "backward 20", "18 (16-20)", "20 pairs"):
        assert word in text.getvalue(), text.getvalue()


# --- maps ---------------------------------------------------------------------------------------------------------


def test_values_of_an_axis():
    assert sweep.parse("plant.soil_n=0.9:1.3:5").values == ("0.9", "1", "1.1", "1.2", "1.3")
    assert sweep.parse("plant.soil_kphi_N_m_n2=4.8e6:7.2e6:3").values == ("4800000", "6000000", "7200000")
    assert sweep.parse("plant.soil_n=x0.9:x1.1:3").values == ("x0.9", "x1", "x1.1")
    assert sweep.parse("scenario.sensors=ideal, hoap2") == sweep.Axis("scenario.sensors", ("ideal", "hoap2"))
    assert sweep.parse("controller.lpc_gain=[0.3, 0.4],[0.5, 0.6]").values == ("[0.3, 0.4]", "[0.5, 0.6]")
    two = sweep.given(["a.b=1,2", "c.d=x,y"])
    assert two.cells() == [("1", "x"), ("1", "y"), ("2", "x"), ("2", "y")]
    assert two.overrides(("2", "x")) == ["a.b=2", "c.d=x"]


@pytest.mark.parametrize("text", ["a=1", "a.b", "a.b=", "a.b=1:2", "a.b=1:2:1", "a.b=1:1:3", "a.b=1:x:3", "a.b=1,1",
                                  "a.b=1:2:3:4", "a.b=1,,2", "a.b=0:1:1000"])  # fmt: skip
def test_bad_axes(text):
    with pytest.raises(UserError, match="--vary"):
        sweep.parse(text)


def test_three_parameters_or_one_twice_are_too_many():
    for texts in (["a.b=1,2", "c.d=1,2", "e.f=1,2"], ["a.b=1,2", "a.b=3,4"]):
        with pytest.raises(UserError):
            sweep.given(texts)


def test_the_predefined_sweeps_load():
    for each in sweep.PREDEFINED:
        found = own_value.resolve(each, "sand-walk", [])
        for cell in found.cells():
            for name in parameter_map.SCENARIOS:
                scenario.load(name, found.overrides(cell))
        for axis in found.axes:
            assert own_value.find(axis, found, "sand-walk", []), f"{each.name}: not the scenario's own {axis.name}"


def test_factors_of_the_own_value():
    own = scenario.load("floor-walk").values["controller"]
    assert own["step_time_s"] == (0.4,) and len(set(own["lpc_threshold_m"])) == 2
    texts = ["controller.step_time_s=x0.5,x1,0.7", "controller.lpc_threshold_m=x1,x2"]
    found = own_value.resolve(sweep.given(texts), "floor-walk", ["controller.step_time_s=0.5"])
    assert found.axes[0].values == ("0.25", "0.5", "0.7")
    assert found.axes[1].values == ("[0.002, 0.006]", "[0.004, 0.012]")
    assert own_value.find(found.axes[1], found, "floor-walk", []) == "[0.002, 0.006]"
    with pytest.raises(UserError, match="needs a number to multiply"):
        own_value.resolve(sweep.given(["scenario.sensors=x1,x2"]), "floor-walk", [])


def test_a_map_counts_each_cell(runs, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    wish = parameter_map.Wish(vary=("controller.step_time_s=0.4,0.5", "scenario.sensors=ideal,hoap2"), seeds="1-3",
                              scenarios=("floor-walk",), out="m")  # fmt: skip
    document, code = parameter_map.run(wish, QUIET, show=False)
    assert code == 0 and document["runs_done"] == 12 and len(runs) == 12
    [found] = document["sweeps"]
    assert [axis["own"] for axis in found["axes"]] == ["0.4", "hoap2"]
    assert found["axes"][0]["unit"] == "s" and found["cells"][1]["floor_walk"]["survived_fraction"] == 1.0
    folder = tmp_path / "out" / "study-map" / "m"
    assert set(os.listdir(folder)) == FILES
    more = parameter_map.Wish(resume=folder, seeds="1-4")
    document, _ = parameter_map.run(more, QUIET, show=False)
    assert document["runs_done"] == 16 and document["runs_kept_from_before"] == 12 and len(runs) == 16


@pytest.mark.parametrize(("arguments", "message"), [
    (["sand", "--seeds", "9-3"], "runs backwards"),
    (["sand", "--resume", "nowhere"], "no folder of a study"),
    (["sand", "--set", "plant.soil_nn=1"], "did you mean 'soil_n'?"),
    (["map", "--vary", "plant.soil_n=1:2"], "low:high:count"),
    (["map", "--sweep", "soilk"], "did you mean 'soil-k'?"),
    (["map", "--vary", "plant.soil_n=1,2", "--sweep", "soil-k"], "not both"),
    (["map", "--vary", "plant.soil_n=1,99"], "out of range"),
    (["map", "--scenario", "sand-wlk"], "did you mean 'sand-walk"),
])  # fmt: skip
def test_bad_input_makes_no_folder(arguments, message, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["study", *arguments]) == 2
    assert message in capsys.readouterr().err
    assert os.listdir(tmp_path) == []


# --- whole studies on the built FMUs ------------------------------------------------------------------------------

SHORT = ["--set", "scenario.duration_s=2.2"]


def start(arguments: list[str], cwd: Path) -> subprocess.Popen:
    return subprocess.Popen([sys.executable, "-m", "hoap2.cli", "study", *arguments], cwd=cwd, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)  # fmt: skip


def test_a_whole_short_study(hoap2_cli, tmp_path):
    done = hoap2_cli("study", "sand", "--seeds", "1-2", *SHORT, "--out", "s", "--json", cwd=tmp_path, timeout=300)
    document = json.loads(done.stdout)
    assert done.returncode == 0, done.stderr
    assert document["runs_done"] == 8 and document["sand_walk"]["survived_fraction"] == 0.0
    folder = tmp_path / "out" / "study-sand" / "s"
    assert set(os.listdir(folder)) == FILES
    again = hoap2_cli("study", "sand", "--resume", str(folder), cwd=tmp_path, timeout=300)
    assert again.returncode == 0 and "8 runs were there already" in again.stdout, again.stdout + again.stderr


def test_a_light_run_has_the_numbers_of_the_whole_run(hoap2_cli, tmp_path):
    """The study's machinery leaves out files, not ticks."""
    hoap2_cli("run", "floor-walk", "--duration", "3", "--seed", "5", "--no-video", "--out", "a", cwd=tmp_path)
    whole = json.loads((tmp_path / "out" / "floor-walk" / "a" / "summary.json").read_text())
    light_one = light.execute(light.with_seed(scenario.load("floor-walk", duration_s=3.0), 5), Choice())
    for name in ("roll_deg", "pitch_deg", "com_tracking_m", "steps_taken", "bounds", "ok", "foot_force_max_N"):
        assert light_one[name] == whole[name], name


@pytest.mark.slow
def test_a_stopped_study_goes_on(tmp_path, hoap2_cli):
    process = start(["sand", "--seeds", "1-40", "--jobs", "1", *SHORT, "--out", "s"], tmp_path)
    folder = tmp_path / "out" / "study-sand" / "s"
    end = time.monotonic() + 60
    while not (folder / "runs.jsonl").exists() or not (folder / "runs.jsonl").read_text():
        assert process.poll() is None and time.monotonic() < end, process.communicate()
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=90)
    assert process.returncode == 130 and f"--resume {folder}" in out.replace("\n", " "), out + err
    document = json.loads((folder / "study.json").read_text())
    assert document["interrupted"] is True and 1 <= document["runs_done"] < 160
    again = hoap2_cli("study", "sand", "--resume", str(folder), "--seeds", "1", cwd=tmp_path, timeout=300)
    assert again.returncode == 0 and "were there already" in again.stdout, again.stdout + again.stderr
