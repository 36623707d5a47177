"""Whole runs on the built FMUs, mostly through the command line."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest

from hoap2 import binding, cli, master, parameters, paths, products, recording, scenario, seeds
from sides import LibrarySide

FILES = {"run.toml", "signals.parquet", "summary.json", "timing.json", "report.html"}


@pytest.fixture
def run_here(tmp_path, monkeypatch):
    """`run` in this process, which spares the imports."""

    def call(*arguments) -> int:
        monkeypatch.chdir(tmp_path)
        return cli.main(["run", *map(str, arguments)])

    return call


@pytest.fixture(autouse=True)
def built():
    missing = [p for p in ("controller", "plant") if not (paths.build_dir() / f"fmu/hoap2_{p}_fmi3.fmu").exists()]
    if missing:
        pytest.fail(f"no FMUs in {paths.build_dir()}: ./hoap2 fmu build")


def signals(folder: Path):
    return pyarrow.parquet.read_table(folder / "signals.parquet")


def last_line(text: str) -> str:
    return text.strip().splitlines()[-1]


def test_a_short_run_leaves_a_whole_folder(hoap2_cli, tmp_path):
    done = hoap2_cli("run", "floor-stand", "--duration", "2", "--no-video", "--out", "a", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "out" / "floor-stand" / "a"
    assert FILES <= set(os.listdir(folder)) and os.listdir(folder.parent) == ["a"]
    summary, printed = json.loads((folder / "summary.json").read_text()), json.loads(done.stdout)
    assert summary["ok"] is True and summary["interrupted"] is False and summary["error"] is None
    assert summary["duration_s"] == 2.0 and printed["bounds"] == summary["bounds"]
    assert 0 < summary["peak_memory_mb"] < 500 and summary["controller_us"]["median"] > 0
    assert signals(folder).num_rows == 2001
    timing, wall_s = json.loads((folder / "timing.json").read_text()), summary["wall_s"]
    assert timing["wall_s"] == wall_s and list(wall_s) == ["set_up", "loop", "files", "pictures", "report", "total"]
    assert all(value > 0 for value in wall_s.values()), "the process's own start counts as set-up"
    assert sum(wall_s.values()) - wall_s["total"] <= wall_s["total"] + 0.001
    assert wall_s["loop"] >= timing["loop_s"] - 0.001 and summary["set_us"] == timing["set_us"]
    record = tomllib.loads((folder / "run.toml").read_text())["record"]
    assert len(record["controller_sha256"]) == len(record["plant_sha256"]) == 64

    again = hoap2_cli("run", "floor-stand", "--duration", "2", "--no-video", "--out", "a", cwd=tmp_path)
    assert again.returncode == 2 and "there already; nothing was overwritten" in again.stderr
    assert json.loads((folder / "summary.json").read_text()) == summary


def test_the_report_needs_nothing_else(hoap2_cli, tmp_path):
    hoap2_cli("run", "floor-walk", "--duration", "3", "--no-video", "--out", "a", cwd=tmp_path)
    text = (tmp_path / "out" / "floor-walk" / "a" / "report.html").read_text()
    assert "<script" not in text and "<link" not in text
    outside = [word for word in text.split('"') if word.startswith(("http:", "https:", "//"))]
    assert all("www.w3.org" in word for word in outside), "only the names of SVG's own XML spaces"
    assert text.count("<figure>") == 8 and "#123456" not in text
    assert "<code>steps_taken</code>" in text and "missed" in text
    ids = [part.split('"')[0] for part in text.split(' id="')[1:]]
    assert len(ids) == len(set(ids)), "the figures' ids do not collide"


def test_one_seed_gives_one_run_and_run_toml_repeats_it(run_here, tmp_path):
    run = ("--duration", "2.2", "--no-video", "--out")
    for name, arguments in {
        "a": ("floor-walk", "--seed", "5"),
        "b": ("floor-walk", "--seed", "5"),
        "c": ("floor-walk", "--seed", "6"),
        "d": ("floor-walk", "--seed", "5", "--fmi", "2"),
    }.items():
        run_here(*arguments, *run, name)
    out = tmp_path / "out" / "floor-walk"
    run_here(out / "a" / "run.toml", "--no-video", "--out", "e")
    first = signals(out / "a")
    assert signals(out / "b").equals(first)
    assert not signals(out / "c").equals(first)
    assert signals(out / "d").equals(first), "FMI 2 and FMI 3 are one product"
    assert signals(out / "e").equals(first)
    assert json.loads((out / "e" / "summary.json").read_text())["seed"] == 5


def test_fmus_and_libraries_give_the_same_bits():
    loaded = scenario.load("floor-walk")
    seeds.apply(loaded, 2)
    both = products.open_both(products.Choice(), loaded)
    libraries = []
    for product, kind in (("controller", binding.Controller), ("plant", binding.Plant)):
        known = parameters.known(product)
        values = {n: list(v) if known[n].shape else v[0] for n, v in loaded.values[product].items()}
        libraries.append(LibrarySide(kind(**values)))
    stop = master.StopRequest()
    fmus = master.run(both.controller, both.plant, 2500, 1.0, stop)
    direct = master.run(*libraries, 2500, 1.0, stop)
    both.close()
    assert fmus.error is None and direct.error is None and fmus.log.count == direct.log.count == 2501
    assert fmus.log.real.tobytes() == direct.log.real.tobytes()
    assert fmus.log.integer.tobytes() == direct.log.integer.tobytes()


def test_pictures_are_drawn_from_what_the_folder_holds(run_here, tmp_path, monkeypatch):
    """The run in memory and the folder read back are one recording."""
    drawn = []

    def strip(run, _times, path, **_):
        drawn.append(run)
        path.write_bytes(b"")
        return path

    monkeypatch.setattr("hoap2.pictures.strip", strip)
    run_here("floor-walk", "--duration", "3", "--no-video", "--out", "a", "--seed", "3",
             "--set", "controller.start_up_s=0.3", "--set", "controller.calibrate_s=0.2")  # fmt: skip
    read, (memory,) = recording.load(tmp_path / "out" / "floor-walk" / "a"), drawn
    assert memory.folder.resolve() == read.folder.resolve() and memory.name == read.name
    assert memory.t_s.tobytes() == read.t_s.tobytes() and memory.signal.keys() == read.signal.keys()
    assert all(np.array_equal(memory.signal[n], read.signal[n], equal_nan=True) for n in read.signal)
    assert memory.steps == read.steps and len(read.steps) >= 2
    assert memory.plant == read.plant and memory.controller == read.controller


def test_a_missed_bound_is_exit_code_1(hoap2_cli, tmp_path):
    done = hoap2_cli("run", "floor-stand", "--duration", "1.5", "--no-video", "--set", "bounds.end_speed_m_s.min=1",
                     "--set", "bounds.end_speed_m_s.max=2", cwd=tmp_path)  # fmt: skip
    assert done.returncode == 1 and "missed" in done.stdout and "not ok" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["flor-walk"], ["unknown scenario 'flor-walk'", "did you mean 'floor-walk'"]),
        (["floor-walk", "--set", "controller.step_lenght_m=0.02"], ["did you mean 'step_length_m'"]),
        (["floor-walk", "--set", "controller.step_length_m=1"], ["out of range [-0.08, 0.08] m"]),
        (["floor-walk", "--sensors", "perfect"], ["unknown value of plant.sensor_preset 'perfect'"]),
        (["floor-walk", "--seeds", "5-1"], ["runs backwards"]),
        (["floor-walk", "--seed", "1", "--seeds", "1-2"], ["either --seed or --seeds"]),
        (["floor-walk", "--controller", "absent.fmu"], ["no FMU file absent.fmu"]),
        (["floor-walk", "--controller", "corrupt.fmu"], ["corrupt.fmu", "cannot be read"]),
        (["floor-walk", "--plant", "cut.fmu"], ["cut.fmu", "cannot be read"]),
        (["floor-walk", "--plant", "CONTROLLER"], ["hoap2_controller_fmi3.fmu", "causality"]),
        (["floor-walk", "--out", "file/run"], ["cannot write to file", "--out"]),
    ],
)
def test_bad_input_says_what_to_do_and_leaves_nothing(hoap2_cli, tmp_path, arguments, words):
    good = paths.fmu("plant", 3).read_bytes()
    (tmp_path / "corrupt.fmu").write_bytes(b"this is no zip file")
    (tmp_path / "cut.fmu").write_bytes(good[: len(good) // 2])
    (tmp_path / "file").write_text("")
    arguments = [str(paths.fmu("controller", 3)) if a == "CONTROLLER" else a for a in arguments]
    done = hoap2_cli("run", *arguments, "--no-video", cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert all(word in done.stderr for word in words), done.stderr
    assert "Traceback" not in done.stderr
    left = [p for p in (tmp_path / "out").rglob("*") if p.is_file()] if (tmp_path / "out").exists() else []
    assert left == [] and not list(tmp_path.rglob("*.part*"))


def test_either_side_can_be_swapped(run_here, tmp_path):
    for product in ("controller", "plant"):
        shutil.copy(paths.fmu(product, 2), tmp_path / f"my_{product}.fmu")
    for name, arguments in {
        "a": [],
        "b": ["--controller", "my_controller.fmu"],
        "c": ["--plant", "my_plant.fmu"],
    }.items():
        run_here("floor-stand", "--duration", "1.2", "--no-video", "--out", name,
                 *[tmp_path / a if a.endswith(".fmu") else a for a in arguments])  # fmt: skip
    out = tmp_path / "out" / "floor-stand"
    assert signals(out / "a").equals(signals(out / "b")) and signals(out / "a").equals(signals(out / "c"))
    record = tomllib.loads((out / "b" / "run.toml").read_text())["record"]
    assert record["controller_file"] == "my_controller.fmu" and record["plant_file"] == "hoap2_plant_fmi3.fmu"


def start(arguments: list[str], cwd: Path) -> subprocess.Popen:
    return subprocess.Popen([sys.executable, "-m", "hoap2.cli", *arguments], cwd=cwd, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)  # fmt: skip


def wait_for(condition, process: subprocess.Popen, timeout_s: float = 60.0) -> None:
    end = time.monotonic() + timeout_s
    while not condition():
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.mark.parametrize(("number", "delay_s"), [(signal.SIGINT, 0.0), (signal.SIGTERM, 2.0)])
def test_an_interrupted_run_leaves_a_marked_whole_folder(tmp_path, number, delay_s):
    """While the FMUs are opened, and in mid-run."""
    process = start(["run", "floor-stand", "--duration", "300", "--out", "a"], tmp_path)
    out = tmp_path / "out" / "floor-stand"
    wait_for(lambda: out.exists() and os.listdir(out), process)
    time.sleep(delay_s)
    process.send_signal(number)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    assert os.listdir(out) == ["a"] and FILES <= set(os.listdir(out / "a"))
    summary = json.loads((out / "a" / "summary.json").read_text())
    assert summary["interrupted"] is True and summary["ok"] is False
    rows = signals(out / "a").num_rows
    assert rows == round(summary["duration_s"] * 1000) + 1 and summary["duration_s"] < 300
    assert "interrupted" in (out / "a" / "report.html").read_text()


def test_a_study_judges_every_seed(hoap2_cli, tmp_path):
    done = hoap2_cli("run", "floor-stand", "--duration", "1.5", "--no-video", "--seeds", "1-3", "--jobs", "2",
                     "--out", "s", cwd=tmp_path)  # fmt: skip
    folder = tmp_path / "out" / "floor-stand" / "s"
    document = json.loads((folder / "study.json").read_text())
    assert [run["seed"] for run in document["runs"]] == [1, 2, 3]
    assert document["runs_ok"]["of"] == 3 and len(document["runs_ok"]["wilson_95"]) == 2
    assert done.returncode == (0 if document["ok"] else 1), done.stderr
    assert {"seed-001", "seed-002", "seed-003", "study.json", "study.csv"} == set(os.listdir(folder))
    assert FILES <= set(os.listdir(folder / "seed-002"))
    assert len((folder / "study.csv").read_text().splitlines()) == 4
    values = [run["roll_deg"]["max"] for run in document["runs"]]
    assert document["bounds"]["roll_deg.max"]["largest"] == max(values)
    again = hoap2_cli("run", "floor-stand", "--seeds", "1-3", "--out", "s", cwd=tmp_path)
    assert again.returncode == 2 and "nothing was overwritten" in again.stderr


def test_a_study_with_a_missed_bound_is_exit_code_1(hoap2_cli, tmp_path):
    done = hoap2_cli("run", "floor-stand", "--duration", "1.2", "--no-video", "--seeds", "4", "--set",
                     "bounds.steps_taken.min=1", "--set", "bounds.steps_taken.max=2", cwd=tmp_path)  # fmt: skip
    assert done.returncode == 1 and "ok: 0 of 1 runs" in done.stdout


@pytest.mark.slow
def test_a_stopped_study_keeps_what_is_done(tmp_path):
    process = start(["run", "floor-stand", "--duration", "4", "--no-video", "--seeds", "1-50", "--jobs", "1", "--out",
                     "s"], tmp_path)  # fmt: skip
    folder = tmp_path / "out" / "floor-stand" / "s"
    wait_for(lambda: (folder / "seed-001").exists(), process)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=90)
    assert process.returncode == 130, err
    document = json.loads((folder / "study.json").read_text())
    assert document["interrupted"] is True and document["ok"] is False
    assert 1 <= len(document["runs"]) < 50 and (folder / "seed-001" / "summary.json").exists()
    assert not [name for name in os.listdir(folder) if "part" in name]


def test_list(hoap2_cli):
    rows = json.loads(hoap2_cli("list", "--json").stdout)
    assert {"floor-walk", "floor-stand", "floor-turn", "floor-sideways"} <= {row["name"] for row in rows}
    assert all(row["section"] and row["title"] and row["text"] for row in rows)
    assert "floor-walk-cps" in hoap2_cli("list").stdout
