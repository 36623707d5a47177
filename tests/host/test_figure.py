"""The book's figures: what they measure, which runs they take, and that their text can be read."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from hoap2 import cli, scenario
from hoap2.errors import UserError
from hoap2.figures import book, draw, make, measured, reported, snapshots, style, walk_data
from hoap2.figures.walk_data import Walk
from hoap2.studies import groups, map_plot, sand, sand_plot, sweep
from fake_walks import BEGIN_TICK, DEG, STEP_TICKS, fall_in_step, log_of_walk, run_folder, summary_of


def step_begin(step: int) -> int:
    return BEGIN_TICK + (step - 1) * STEP_TICKS


def walk_of(name: str, change=None, seed: int = 0) -> Walk:
    """A fabricated walk of a scenario; change(log) before it is judged."""
    loaded = scenario.load(name)
    loaded.seed = seed
    log = log_of_walk(loaded)
    if change is not None:
        change(log)
    return Walk(Path("made") / name, log, loaded, summary_of(loaded, log))


def falling(log) -> None:
    """Pitch grows backward, linearly, to 3 deg at the end of step 17; a fall in step 18."""
    ramp = np.clip((np.arange(log.count) - step_begin(1)) / (17 * STEP_TICKS), 0.0, 1.0)
    log.block("p.true_chest_rpy_rad")[:, 1] = -3.0 * DEG * ramp
    log.block("p.true_sinkage_m")[:] = 0.006
    fall_in_step(log, 18)


def shifting(log) -> None:
    """Landings shifted back by 8 mm and in by 3 mm from step 5 on."""
    log.block("c.landing_shift_W_m")[step_begin(5) :] = [-0.008, 0.003]
    log.block("p.true_chest_rpy_rad")[:, 0] = 0.4 * DEG * np.sin(np.arange(log.count) / 60)


@pytest.fixture
def grey_pictures(monkeypatch):
    """Panel A without the renderer."""
    grey = np.full((8, 6, 3), 200, np.uint8)
    monkeypatch.setattr(snapshots, "take", lambda walk, times, size, view: [grey] * len(times))


# --- what is measured ---------------------------------------------------------------------------------------------


def test_growth_of_the_pitch_and_the_fall():
    walk = walk_of("sand-walk", falling)
    # 3 deg over 17 steps: step 10 lies between 9/17 and 10/17 of it, 2 deg is passed in step 12
    assert measured.pitch_at_step_deg(walk, 10) == pytest.approx(-3.0 * 9.5 / 17, abs=0.01)
    step, t_s = measured.pitch_grown(walk)
    assert step == 12 and t_s == pytest.approx((step_begin(1) + 2 / 3 * 17 * STEP_TICKS) * 1e-3, abs=0.002)
    assert measured.outcome(walk).startswith("fell backward, step 18, 7.1 s into the walk")
    assert measured.sinkage_mm(walk) == pytest.approx(6.0)
    text = {row[0]: row[2] for row in reported.rows("7.11", walk, None)}
    assert "beyond 2 deg backward for good from step 12 on" in text["pitch"] and "6.0 mm" in text["sinkage, mid stance"]


def test_a_pitch_that_came_back_has_not_grown():
    def swing(log):
        log.block("p.true_chest_rpy_rad")[step_begin(5) : step_begin(6), 1] = -4 * DEG

    assert measured.pitch_grown(walk_of("floor-walk", swing)) is None


def test_shifts_and_landings():
    walk = walk_of("sand-walk-lpc", shifting)
    steps, shifts = walk.shifts_mm
    assert list(steps) == list(range(1, 37)) and shifts[3].tolist() == [0.0, 0.0]
    assert shifts[4] == pytest.approx([-8.0, 3.0])
    assert len(walk.landed) == 36
    step, foot, x, y, _ = walk.landed[9]
    assert (step, foot) == (10, 1) and (x, y) == pytest.approx((150.0, 39.0))


def test_a_turned_start_turns_shifts_and_positions():
    def turned(log):
        log.block("c.landing_shift_W_m")[:] = [0.0, 0.01]  # world y: ahead of a robot that looks to +y
        log.block("p.true_com_W_m")[:, :2] = [-0.02, 0.3]

    loaded = scenario.load("floor-walk-lpc", ["plant.start_yaw_W_rad=1.5707963267948966"])
    log = log_of_walk(loaded)
    turned(log)
    walk = Walk(Path("x"), log, loaded, summary_of(loaded, log))
    assert walk.shifts_mm[1][0] == pytest.approx([10.0, 0.0], abs=1e-9)
    assert walk.mm("p.true_com_W_m")[0] == pytest.approx([300.0, 20.0])


def test_the_floor_without_control_is_the_measure_for_the_floor_with_it():
    def roll(scale):
        return lambda log: log.block("p.true_chest_rpy_rad").__setitem__((slice(None), 0), scale * DEG)

    rows = reported.rows("7.13", walk_of("floor-walk-lpc", roll(0.2)), walk_of("floor-walk", roll(0.3)))
    assert {r[0]: r[2] for r in rows}["roll"] == "rms 0.200 deg; same run without control 0.300 deg"


def test_reference_cop_keeps_its_distance_from_the_edge():
    def cop(log):
        for step in range(1, 37):
            side = 1 if step % 2 else -1  # the left foot stands first
            rows = slice(step_begin(step), step_begin(step) + STEP_TICKS)
            x = 0.009 + 0.015 * max(0, min(step, 28) - 1)
            log.block("c.cop_ref_W_m")[rows] = [x, side * (0.039 + 0.0315 - 0.005)]

    assert measured.cop_margin_mm(walk_of("floor-walk", cop)) == pytest.approx(5.0)


# --- which runs ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("number", "name", "message"), [
    ("7.11", "floor-walk", "the run in made/floor-walk is one on the rigid floor"),
    ("7.10", "sand-walk", "figure 7.10 shows a walk on the rigid floor"),
    ("7.12", "sand-walk", "the run in made/sand-walk is one without landing position control"),
    ("7.10", "floor-walk-lpc", "without landing position control"),
])  # fmt: skip
def test_a_figure_of_another_run_is_refused(number, name, message):
    with pytest.raises(UserError) as error:
        book.check(book.find(number), walk_of(name))
    assert message in str(error.value)


def test_a_run_without_steps_is_refused():
    with pytest.raises(UserError, match="holds no step"):
        book.check(book.find("7.10"), walk_of("floor-walk", lambda log: log.column("c.step_index").fill(0)))


def test_every_figure_takes_the_run_of_its_scenario():
    for each in book.FIGURES.values():
        book.check(each, walk_of(each.scenario))


def test_list_unknown_number_and_bad_folders(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["figure"]) == 0
    listed = capsys.readouterr().out
    assert all(f"{number} " in listed for number in ("7.8", "7.10", "7.11", "7.12", "7.13"))
    for arguments, message in (
        (["7.9"], "known: 7.8, 7.10, 7.11, 7.12, 7.13"),
        (["7.10", "--run", "nowhere"], "there is no run folder nowhere"),
        (["7.10", "--run", "."], "run.toml is missing"),
        (["7.10", "--run", ".", "--seed", "3"], "either --run or --seed"),
    ):
        assert cli.main(["figure", *arguments]) == 2
        assert message in capsys.readouterr().err.replace("\n", " ")


def test_fig_and_its_number_in_any_manner():
    assert book.find("Fig.7.11") is book.find("7.11")


# --- drawing ------------------------------------------------------------------------------------------------------


def drawn(monkeypatch) -> list:
    """The figures that are saved from now on, with their text laid out."""
    found = []

    def save(figure, base):
        figure.draw_without_rendering()
        found.append(figure)
        return []

    monkeypatch.setattr(style, "save", save)
    return found


def texts(figure) -> list:
    """What is drawn of text: ticks beyond the limits exist and are not."""
    from matplotlib.axis import Axis, Tick
    from matplotlib.text import Text

    hidden = {label for tick in figure.findobj(Tick) for label in (tick.label1, tick.label2)}
    for axis in figure.findobj(Axis):
        if axis.get_visible() and axis.axes.axison:
            hidden -= {label for tick in axis._update_ticks() for label in (tick.label1, tick.label2)}
    return [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip() and t not in hidden]


def check_text(figure) -> None:
    """No label runs over another one or off the page, and none is too small to read at page width."""
    page, boxes = figure.bbox, []
    for text in texts(figure):
        box = text.get_window_extent()
        assert text.get_fontsize() >= 6.5, text.get_text()
        assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0 and box.y1 <= page.y1, text.get_text()
        boxes.append((text.get_text(), box))
    for (a, first), (b, second) in itertools.combinations(boxes, 2):
        x = min(first.x1, second.x1) - max(first.x0, second.x0)
        y = min(first.y1, second.y1) - max(first.y0, second.y0)
        assert min(x, y) < 1.5, f"{a!r} lies over {b!r}"


@pytest.mark.parametrize(("number", "change"), [("7.8", None), ("7.10", None), ("7.11", falling), ("7.12", shifting),
                                                ("7.12", falling), ("7.13", shifting)])  # fmt: skip
def test_text_of_the_figures(number, change, monkeypatch, grey_pictures, tmp_path):
    figures, each = drawn(monkeypatch), book.find(number)
    walk = walk_of(each.scenario, change, seed=107)
    draw.write(each, walk, walk_of("floor-walk") if walk.controls_landing else None, tmp_path / "f")
    [figure] = figures
    check_text(figure)
    shown = " ".join(t.get_text() for t in texts(figure))
    for word in (f"Fig. {number}", "seed 107", "the book reports", "measured here"):
        assert word in shown
    assert ("fell, step 18" in shown) == (change is falling)


def test_text_of_the_studies(monkeypatch, tmp_path):
    figures = drawn(monkeypatch)

    def row(name: str, seed: int) -> dict:
        fell = name == "sand-walk" or (name == "sand-walk-lpc" and seed % 10 == 0)
        way = "left" if seed % 9 == 0 else "backward"
        return {
            "error": None, "fell": fell, "fell_backward": fell and way == "backward", "survived": not fell,
            "fall_step": 14 + seed % 9 if fell else None, "fall_direction": way if fell else None,
            "pitch_deg": {"max": 88.0 if fell else 1.0 + seed % 7 / 5}, "roll_deg": {"rms": 0.3 + seed % 5 / 100},
        }  # fmt: skip

    rows = {name: [row(name, seed) for seed in range(101, 151)] for name in sand.SCENARIOS}
    document = {sand.key_of(name): groups.describe(found) for name, found in rows.items()}
    by_seed = [dict(zip(range(50), rows[name])) for name in ("floor-walk-lpc", "floor-walk")]
    document["floor_roll_rms_difference_deg"] = groups.paired_difference(*by_seed, "roll_deg.rms")
    sand_plot.write(tmp_path / "s", document, rows)
    for sweeps in (sweep.PREDEFINED, [sweep.given(["plant.soil_n=1:1.2:5", "controller.cp_offset_x_m=0.007:0.011:5"])]):
        described = [
            {"name": s.name, "title": s.title, "cells": [{"values": {}, "sand_walk": document["sand_walk"],
                                          "sand_walk_lpc": document["sand_walk_lpc"]} for _ in s.cells()],
             "axes": [{"name": a.name, "unit": "m" if a.name.endswith("_m") else "", "values": list(a.values),
                       "own": a.values[1]} for a in s.axes]}
            for s in sweeps
        ]  # fmt: skip
        map_plot.write(tmp_path / "m", {"sweeps": described, "scenarios": ["sand-walk", "sand-walk-lpc"]})
    assert len(figures) == 4  # the study, all lines, the map among them, the map alone
    for figure in figures:
        check_text(figure)


def test_files_are_whole_and_text_stays_text(grey_pictures, tmp_path):
    each = book.find("7.11")
    walk = walk_of("sand-walk", falling)
    folder = run_folder(tmp_path / "run", walk.scenario, walk.log)
    paths = make.figure(each, folder, 0, None, False, Console())
    assert [p.name for p in paths] == ["figure_7_11.png", "figure_7_11.svg"] and all(p.parent == folder for p in paths)
    svg = paths[1].read_text()
    assert "fell, step 18" in svg and "the book reports" in svg
    assert "Verdana" in svg and len(re.findall("<text", svg)) > 60
    with pytest.raises(UserError, match="nothing was overwritten"):
        make.figure(each, folder, 0, None, False, Console())
    before = paths[1].read_bytes()
    make.figure(each, folder, 0, None, True, Console())
    assert paths[1].read_bytes() == before, "the same run gives the same file"
    assert make.figure(each, folder, 0, tmp_path / "new", False, Console())[0].parent == tmp_path / "new"


@pytest.mark.parametrize("missing", ["run.toml", "summary.json", "signals.parquet"])
def test_what_is_no_run_is_named(missing, tmp_path):
    walk = walk_of("floor-walk")
    folder = run_folder(tmp_path / "run", walk.scenario, walk.log)
    assert walk_data.load(folder).summary["steps_taken"] == 36
    (folder / missing).unlink()
    with pytest.raises(UserError, match=f"{missing} is missing"):
        walk_data.load(folder)


def test_snapshots_show_the_fall_coming_and_done():
    walk = walk_of("sand-walk", falling)
    times = snapshots.moments(walk)
    assert len(times) == 6 and times[0] == pytest.approx(1.8)
    assert times[-2] < walk.fall_s < times[-1] and times == sorted(times)


@pytest.mark.slow
def test_a_figure_from_its_own_run(hoap2_cli, tmp_path):
    done = hoap2_cli("figure", "7.13", "--seed", "3", "--out", "f", cwd=tmp_path, timeout=300)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["f/figure_7_13.png", "f/figure_7_13.svg"]
    assert len(list((tmp_path / "out" / "floor-walk-lpc").iterdir())) == 1
    assert "seed 3" in (tmp_path / "f" / "figure_7_13.svg").read_text()
