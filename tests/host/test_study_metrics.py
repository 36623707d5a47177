"""The numbers that the sand walks are judged by, on signals whose answer is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from rich.console import Console

from hoap2 import metrics, parameters, scenario, seeds, soil_presets, tables_shown
from hoap2.errors import UserError
from fake_walks import BEGIN_TICK, DEG, STEP_TICKS, fall_in_step, log_of_walk, summary_of


@pytest.fixture
def walk() -> scenario.Scenario:
    return scenario.load("floor-walk")


@pytest.fixture
def log(walk):
    return log_of_walk(walk)


def test_a_faultless_walk_is_survived(log, walk):
    result = metrics.compute(log, walk)
    assert result["survived"] is True and result["fell_backward"] is False
    assert result["sinkage_mid_stance_m"] == 0.0 and result["landing_shift_m"] == {"max": 0.0, "rms": 0.0}


@pytest.mark.parametrize(("way_m", "survived"), [(0.351, True), (0.349, False), (-0.42, False)])
def test_marking_time_is_not_surviving(log, walk, way_m, survived):
    log.block("p.true_foot_pos_W_m")[-1, [0, 3]] = way_m
    assert metrics.compute(log, walk)["survived"] is survived


def test_a_walk_backward_is_survived_backward(log, walk):
    walk.values["controller"]["step_length_m"] = (-0.015,)
    feet = log.block("p.true_foot_pos_W_m")
    assert metrics.compute(log, walk)["survived"] is False
    feet[:, [0, 3]] *= -1
    assert metrics.compute(log, walk)["survived"] is True


def test_not_all_steps_or_not_standing_is_not_survived(log, walk):
    steps = log.column("c.steps_done").copy()
    log.column("c.steps_done")[:] = np.minimum(steps, 35)
    assert metrics.compute(log, walk)["survived"] is False
    log.column("c.steps_done")[:] = steps
    log.block("p.true_base_vel_W_m_s")[-10:, 0] = 0.05
    assert metrics.compute(log, walk)["survived"] is False


@pytest.mark.parametrize("yaw_deg", [0.0, 100.0, -170.0])
@pytest.mark.parametrize(("axis", "sign", "word"), [(1, 1, "forward"), (1, -1, "backward"), (0, 1, "right"),
                                                    (0, -1, "left")])  # fmt: skip
def test_the_fall_as_the_robot_sees_it(log, walk, axis, sign, word, yaw_deg):
    log.block("p.true_chest_rpy_rad")[:, 2] = yaw_deg * DEG
    tick = fall_in_step(log, 18, axis, sign)
    result = metrics.compute(log, walk)
    assert result["fall_direction"] == word and result["fall_time_s"] == pytest.approx(tick * 1e-3)
    assert result["fall_step"] == 18 and result["survived"] is False
    assert result["fell_backward"] is (word == "backward")


def test_a_fall_over_the_back_does_not_count_by_the_angles_of_a_lying_robot(log, walk):
    """Caught while upright by a contact; past 90 deg of pitch, roll and yaw turn over."""
    rpy, tick = log.block("p.true_chest_rpy_rad"), 6000
    log.column("p.other_contacts")[tick:] = 1
    rpy[tick : tick + 300, 1] = -np.linspace(0, 80, 300) * DEG
    rpy[tick + 300 :] = [math.pi, -60 * DEG, math.pi]
    assert metrics.fall_tick(log) == tick and metrics.fall_direction(log, tick) == "backward"


def test_signed_pitch_ends_at_the_fall(log, walk):
    rpy = log.block("p.true_chest_rpy_rad")
    rpy[3000, 1], rpy[4000, 1] = -2.0 * DEG, 1.0 * DEG
    tick = fall_in_step(log, 18)
    rpy[tick + 100, 1] = 89.0 * DEG
    signed = metrics.compute(log, walk)["pitch_signed_deg"]
    assert signed["max"] == pytest.approx(1.0) and -45.0 <= signed["min"] < -44.0


def test_sinkage_is_that_of_the_stance_sole_in_mid_support(log, walk):
    depth = log.block("p.true_sinkage_m")
    depth[:] = 0.001
    for step in range(1, 37):
        middle = BEGIN_TICK + (step - 1) * STEP_TICKS + STEP_TICKS // 2
        depth[middle - 5 : middle + 5, step % 2] = 0.005 if step <= 10 else 0.007
    assert metrics.compute(log, walk)["sinkage_mid_stance_m"] == pytest.approx((10 * 0.005 + 26 * 0.007) / 36)
    fall_in_step(log, 11)  # shortly after the middle of step 11, which so does not count
    assert metrics.compute(log, walk)["sinkage_mid_stance_m"] == pytest.approx(0.005)


def test_landing_shifts_count_once_a_step(log, walk):
    shift = log.block("c.landing_shift_W_m")
    for step, value in ((3, 0.004), (4, 0.003)):
        begin = BEGIN_TICK + (step - 1) * STEP_TICKS
        shift[begin : begin + STEP_TICKS] = [value, 0.0]
    found = metrics.compute(log, walk)["landing_shift_m"]
    assert found["max"] == pytest.approx(0.004) and found["rms"] == pytest.approx(0.005 / 6)


PRESETS = """
[soft]
title = "Soft"
source = "here"
soil_kphi_N_m_n2 = 2e6
soil_n = 1.2
[wrong]
title = "Wrong"
source = "here"
soil_nn = 1
"""


@pytest.fixture
def presets(tmp_path, monkeypatch):
    path = tmp_path / "presets.toml"
    path.write_text(PRESETS)
    monkeypatch.setattr(soil_presets, "FILE", path)

    def write(extra: str) -> str:
        file = tmp_path / "mine.toml"
        file.write_text(f'[scenario]\ntitle = "t"\n{extra}')
        return str(file)

    return write


def test_a_preset_gives_parameters_and_explicit_ones_win(presets):
    path = presets('[plant]\nground = "soil"\nsoil_n = 0.9\n[soil]\npreset = "soft"\n')
    loaded = scenario.load(path, ["plant.soil_shear_m=0.01"])
    plant = loaded.values["plant"]
    assert plant["soil_kphi_N_m_n2"] == (2e6,) and plant["soil_n"] == (0.9,) and plant["soil_shear_m"] == (0.01,)
    assert "plant.soil_kphi_N_m_n2" not in loaded.explicit


def test_bad_presets(presets):
    path = presets('[plant]\nground = "soil"\n')
    for text, message in (("soil.preset=sofd", "unknown soil preset 'sofd'"), ("soil.preset=wrong", "soil_nn"),
                          ("soil.kind=soft", "key of \\[soil\\]")):  # fmt: skip
        with pytest.raises(UserError, match=message):
            scenario.load(path, [text])
    with pytest.raises(UserError) as error:
        scenario.load(path, ["soil.preset=sofd"])
    assert error.value.hint == "did you mean 'soft'? known: soft, wrong"
    with pytest.raises(UserError, match="no effect on the rigid floor"):
        scenario.load("floor-walk", ["soil.preset=soft"])


def test_seeds_draw_roughness_on_soil_only():
    ground = parameters.table().enums["ground"]
    floor = scenario.load("floor-walk")
    seeds.apply(floor, 7)
    assert floor.values["plant"]["soil_seed"] == (0.0,) and "soil_roughness_m" not in floor.draws
    soil = scenario.load("floor-walk", ["plant.ground=soil"])
    assert soil.values["plant"]["ground"] == (float(ground.index("soil")),)
    seeds.apply(soil, 7)
    assert soil.values["plant"]["soil_roughness_m"] == (0.0005,) and soil.values["plant"]["soil_seed"][0] > 0
    assert {k: v for k, v in soil.draws.items() if not k.startswith("soil_")} == floor.draws, "the rest stays as it was"
    given = scenario.load("floor-walk", ["plant.ground=soil", "plant.soil_roughness_m=0.001"])
    seeds.apply(given, 7)
    assert given.values["plant"]["soil_roughness_m"] == (0.001,)


def test_a_fall_that_the_scenario_shows_is_ok_and_says_so(capsys):
    loaded = scenario.load("sand-walk")
    log = log_of_walk(loaded)
    log.block("p.true_sinkage_m")[:] = 0.006
    fall_in_step(log, 18)
    summary = summary_of(loaded, log)
    assert summary["ok"], {n: e for n, e in summary["bounds"].items() if not e["ok"]}
    shown = summary | {"real_time_factor": None, "notes": [], "folder": "there"}
    tables_shown.show_summary(shown, Console(width=160))
    assert "sand-walk: ok; as the chapter: fell backward at 8.95 s, step 18" in capsys.readouterr().out
    log.block("p.true_chest_rpy_rad")[:] = 0.0
    assert not summary_of(loaded, log)["ok"], "a walk that comes to its end is not what the chapter reports"


def test_every_preset_that_comes_with_the_project_loads():
    presets = soil_presets.load()
    assert "chapter" in presets and len(presets) > 1
    for name, content in presets.items():
        assert content["title"] and content["source"], name
        plant = scenario.load("sand-walk", [f"soil.preset={name}"]).values["plant"]
        wanted = {key: value for key, value in content.items() if key not in soil_presets.WORDS}
        assert all(tuple(plant[key]) == tuple(parameters.check("plant", key, value)) for key, value in wanted.items())
