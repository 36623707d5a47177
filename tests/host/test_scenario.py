"""Scenario files: what is taken, what is refused and how the refusal reads."""

from __future__ import annotations

import tomllib

import pytest

from hoap2 import parameters, scenario
from hoap2.errors import UserError

HEAD = '[scenario]\ntitle = "Try"\n'


@pytest.fixture
def file(tmp_path):
    """Write a scenario of one's own and give its path."""

    def write(text: str, name: str = "mine.toml") -> str:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return str(path)

    return write


def refusal(*arguments, **options) -> str:
    with pytest.raises(UserError) as caught:
        scenario.load(*arguments, **options)
    return str(caught.value)


@pytest.mark.parametrize("name", scenario.names())
def test_every_scenario_of_the_project_loads(name):
    loaded = scenario.load(name)
    assert loaded.title and loaded.section and loaded.text
    assert len(loaded.bounds) > 2, "a scenario judges something"
    walk_s = sum(loaded.values["controller"][n][0] for n in ("start_up_s", "calibrate_s", "start_shift_s"))
    walk_s += loaded.steps_planned * loaded.values["controller"]["step_time_s"][0]
    assert loaded.duration_s >= (walk_s + 2.0 if loaded.steps_planned else 1.0) - 1e-9


def test_values_are_resolved_with_defaults_and_overrides(file):
    path = file(HEAD + "[controller]\nstep_length_m = 0.02\ncp_controller = 'cpt'\n[plant]\ncell_gain = 0.9\n")
    loaded = scenario.load(path, ["controller.lift_m=0.02", "plant.floor_tilt_rad=[0.01, -0.02]"], duration_s=3.0)
    controller, plant = loaded.values["controller"], loaded.values["plant"]
    assert controller["step_length_m"] == (0.02,) and controller["cp_controller"] == (2.0,)
    assert controller["lift_m"] == (0.02,) and plant["floor_tilt_rad"] == (0.01, -0.02)
    assert plant["cell_gain"] == (0.9,) * 8
    assert controller["step_time_s"] == parameters.known("controller")["step_time_s"].default
    assert loaded.duration_s == 3.0 and loaded.name == "mine"
    assert loaded.forced == {"controller.lift_m", "plant.floor_tilt_rad"}


def test_the_duration_follows_the_walk_unless_given(file):
    short = scenario.load(file(HEAD), ["controller.steps_forward=2", "controller.steps_in_place=1"])
    long = scenario.load(file(HEAD), ["controller.steps_forward=12", "controller.steps_in_place=1"])
    assert long.duration_s - short.duration_s == pytest.approx(10 * 0.4)
    stands = scenario.load(file(HEAD), ["controller.behaviour=stand"])
    assert stands.duration_s == pytest.approx(3.5) and stands.steps_planned == 0
    slow = scenario.load(file(HEAD), ["controller.behaviour=stand", "controller.start_up_s=4"])
    assert slow.duration_s == pytest.approx(7.0)


@pytest.mark.parametrize("name", ["../evil", ".hidden", "", "a/b"])
def test_a_name_that_leaves_the_folder_of_runs_is_refused(file, name):
    assert "cannot name a folder" in refusal(file(HEAD + f'name = "{name}"\n'))


def test_sensor_presets(file):
    assert scenario.load(file(HEAD)).sensors == "hoap2"
    assert scenario.load(file(HEAD + 'sensors = "ideal"\n')).sensors == "ideal"
    assert scenario.load(file(HEAD + 'sensors = "ideal"\n'), sensors="hoap2").sensors == "hoap2"
    assert "did you mean 'ideal'" in refusal(file(HEAD), sensors="idael")


def test_start_pose_and_posture_hold_for_both_products(file):
    loaded = scenario.load(file(HEAD + "[plant]\nstart_pos_W_m = [1000, -500]\nstart_yaw_W_rad = 2.2\n"))
    for product in ("controller", "plant"):
        assert loaded.values[product]["start_pos_W_m"] == (1000.0, -500.0)
        assert loaded.values[product]["start_yaw_W_rad"] == (2.2,)
    apart = scenario.load(file(HEAD), ["controller.start_yaw_W_rad=1", "plant.start_yaw_W_rad=2"])
    assert apart.values["controller"]["start_yaw_W_rad"] == (1.0,)
    bent = scenario.load(file(HEAD), ["controller.posture_rad=0.01"])
    assert bent.values["plant"]["start_posture_rad"] == (0.01,) * 25


def test_pushes_and_blocks_become_plant_parameters(file):
    text = HEAD + (
        "[[push]]\nlink = 'l_foot'\nforce_W_N = [1, 2, 3]\npoint_L_m = [0.1, 0, 0]\nstart_s = 2\nduration_s = 0.5\n"
        "[[push]]\nforce_W_N = [0, 5, 0]\nstart_s = 4\nduration_s = 0.1\nramp_s = 0.02\n"
        "[[block]]\ncentre_W_m = [1, 0, 0.01]\nsize_m = [0.2, 1, 0.02]\n"
    )
    plant = scenario.load(file(text), ["push.2.start_s=5"]).values["plant"]
    links = [link["name"] for link in parameters.table().robot["links"]]
    assert plant["push_link"][:2] == (links.index("l_foot"), links.index("chest"))
    assert plant["push_force_W_N"][:6] == (1, 2, 3, 0, 5, 0) and not any(plant["push_force_W_N"][6:])
    assert plant["push_start_s"][:2] == (2, 5) and plant["push_duration_s"] == (0.5, 0.1, 0, 0, 0, 0, 0, 0)
    assert plant["block_count"] == (1,) and plant["block_size_m"][:3] == (0.2, 1, 0.02)
    assert plant["block_size_m"][3:6] == parameters.known("plant")["block_size_m"].default[3:6]


@pytest.mark.parametrize(
    ("text", "overrides", "words"),
    [
        (HEAD + "[controller]\nstep_lenght_m = 0.02\n", [], ["step_lenght_m", "did you mean 'step_length_m'"]),
        (HEAD + "[plant]\nfriction = 1\n", [], ["friction", "did you mean 'friction_mu'"]),
        (HEAD + "[contoller]\n", [], ["contoller", "did you mean 'controller'"]),
        (HEAD + "duration = 3\n", [], ["duration", "did you mean 'duration_s'"]),
        (HEAD + "[run]\nsettle = 3\n", [], ["did you mean 'settle_s'"]),
        (HEAD + "[controller]\nstep_length_m = 0.5\n", [], ["0.5", "out of range [-0.08, 0.08] m"]),
        (HEAD + "[controller]\nsteps_forward = 2.5\n", [], ["steps_forward", "whole number"]),
        (HEAD + "[controller]\nsteps_forward = true\n", [], ["steps_forward", "needs a number"]),
        (HEAD + "[controller]\nlift_m = 'high'\n", [], ["lift_m", "needs a number", "high"]),
        (HEAD + "[controller]\nlift_m = nan\n", [], ["lift_m", "out of range"]),
        (HEAD + "[controller]\ncp_controller = 'cptt'\n", [], ["did you mean 'cpt'"]),
        (HEAD + "[plant]\ncell_gain = [1, 2]\n", [], ["8 elements", "not 2"]),
        (HEAD + "[plant]\nblock_size_m = [[1, 2]]\n", [], ["shape 16 x 3"]),
        (HEAD + "duration_s = 1e9\n", [], ["duration_s", "out of range"]),
        (HEAD + "duration_s = 'long'\n", [], ["duration_s", "needs a number"]),
        (HEAD + "sensors = 3\n", [], ["sensors", "needs a text"]),
        ("[controller]\n", [], ["needs a title"]),
        ("title = ", [], ["mine.toml", "Invalid value"]),
        (HEAD + "[bounds]\nrol_deg.max = {min=0, max=1}\n", [], ["rol_deg"]),
        (HEAD + '[bounds]\n"rol_deg.max" = {min=0, max=1}\n', [], ["did you mean 'roll_deg.max'"]),
        (HEAD + '[bounds]\n"roll_deg.max" = {max=1}\n', [], ["both sides"]),
        (HEAD + '[bounds]\n"roll_deg.max" = {min=2, max=1}\n', [], ["min 2 is above max 1"]),
        (HEAD + '[bounds]\n"roll_deg.max" = {min="a", max=1}\n', [], ["needs a number"]),
        (HEAD + "[[push]]\nforce_W_N = [1, 2, 3]\nstart_s = 1\n", [], ["[[push]] 1 needs duration_s"]),
        (HEAD + "[[push]]\nforce_W_N = [1, 2]\nstart_s = 1\nduration_s = 1\n", [], ["force_W_N needs 3 numbers"]),
        (HEAD + "[[push]]\nlink = 'chets'\n", [], ["did you mean 'chest'"]),
        (HEAD + "[[push]]\nforce = [1, 2, 3]\n", [], ["did you mean 'force_W_N'"]),
        (HEAD + "[push]\nforce_W_N = [1, 2, 3]\n", [], ["[[push]]"]),
        (HEAD + "[[push]]\nforce_W_N=[1,2,3]\nstart_s=1\nduration_s=1\n" * 9, [], ["at most 8"]),
        (HEAD, ["controller.step_lenght_m=0.02"], ["did you mean 'step_length_m'"]),
        (HEAD, ["controler.lift_m=0.02"], ["did you mean 'controller'"]),
        (HEAD, ["lift_m=0.02"], ["table.name=value"]),
        (HEAD, ["controller.lift_m"], ["table.name=value"]),
        (HEAD, ["controller.lift_m=0.5"], ["out of range"]),
        (HEAD, ["push.1.start_s=3"], ["0 of [[push]]"]),
        (HEAD, ["bounds.fell=3"], ["bounds.<metric>.min"]),
        (HEAD, ["record.seed=3"], ["unknown table"]),
    ],
)
def test_what_is_wrong_is_named(file, text, overrides, words):
    message = refusal(file(text), overrides)
    assert all(word in message for word in words), message


def test_unknown_scenario_names_the_nearest():
    assert "did you mean 'floor-walk'" in refusal("flor-walk")
    assert "no scenario file" in refusal("nowhere/at-all.toml")


def test_bounds_can_be_overridden(file):
    loaded = scenario.load(file(HEAD), ["bounds.roll_deg.max.max=2", "bounds.roll_deg.max.min=0", "bounds.fell.min=1",
                                        "bounds.fell.max=1"])  # fmt: skip
    assert (loaded.bounds["roll_deg.max"].low, loaded.bounds["roll_deg.max"].high) == (0.0, 2.0)
    assert loaded.bounds["fell"].low == 1.0, "a scenario that shows a fall asks for it"


def test_a_resolved_run_is_a_scenario_again(tmp_path):
    from hoap2 import runner, seeds

    first = scenario.load("floor-walk-pushed", ["controller.step_length_m=0.0123456789012345"], sensors="ideal")
    seeds.apply(first, 7)
    fmu = tmp_path / "x.fmu"
    fmu.write_bytes(b"anything")
    path = tmp_path / "run.toml"
    path.write_text(runner.resolved_toml(first, {"controller": fmu}), encoding="utf-8")
    again = scenario.load(str(path))
    assert again.values == first.values and again.bounds == first.bounds
    assert (again.name, again.seed, again.duration_s) == (first.name, 7, first.duration_s)
    assert again.draws == first.draws and again.options == first.options
    with pytest.raises(UserError, match="already holds the draws of seed 7"):
        seeds.apply(again, 3)
    assert tomllib.loads(path.read_text())["record"]["controller_sha256"].startswith("ee0874170b7f6f32")
