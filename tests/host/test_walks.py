"""Whole walks: every scenario to its end on the built FMUs, and what must hold in closed loop with the plant."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from hoap2 import parameters, scenario, seeds
from hoap2.binding import Controller, Plant, exchange

SAFE = parameters.table().enums["mode"].index("safe")
FAULTS = parameters.table().faults
# What floor-walk promises on stiff joints: its bounds must not be looser.
PROMISED = {
    "steps_taken": (36, 36), "stands_at_end": (1, 1), "roll_deg.max": (None, 1.5), "pitch_deg.max": (None, 1.0),
    "pitch_est_error_deg.rms": (None, 0.3), "final_error_m": (None, 0.02), "torque_limit_max_s": (None, 0.02),
}  # fmt: skip


def test_floor_walk_judges_all_that_it_promises():
    bounds = scenario.load("floor-walk").bounds
    for name, (low, high) in PROMISED.items():
        assert bounds[name].high <= high, name
        assert low is None or bounds[name].low >= low, name


@pytest.mark.slow
@pytest.mark.parametrize("name", scenario.names())
def test_every_scenario_keeps_its_bounds(hoap2_cli, tmp_path, name):
    done = hoap2_cli("run", name, "--no-video", "--out", "whole", "--json", cwd=tmp_path, timeout=300)
    summary = json.loads(done.stdout)
    missed = {n: b for n, b in summary["bounds"].items() if not b["ok"]}
    assert done.returncode == 0 and summary["ok"] and not missed, (missed, done.stderr)


@pytest.mark.slow
def test_floor_walk_keeps_its_bounds_whatever_the_seed_draws(hoap2_cli, tmp_path):
    done = hoap2_cli("run", "floor-walk", "--seeds", "1-20", "--no-video", "--out", "many", "--json", cwd=tmp_path,
                     timeout=1500)  # fmt: skip
    study = json.loads(done.stdout)
    assert len(study["seeds"]) == 20 and study["runs_fallen"]["count"] == 0
    assert done.returncode == 0 and study["runs_ok"]["count"] == 20, done.stderr


class Loop:
    """Controller and plant of floor-walk without FMI."""

    def __init__(self, seed: int = 0, **values) -> None:
        loaded = scenario.load("floor-walk")
        if seed:
            seeds.apply(loaded, seed)
        rows = {product: dict(loaded.values[product]) for product in ("controller", "plant")}
        for key, value in values.items():
            for product, known in rows.items():
                if key in known:
                    rows[product][key] = value
        self.controller, self.plant = Controller(**rows["controller"]), Plant(**rows["plant"])
        self.largest_tilt_deg, self.other_contacts = 0.0, 0

    def tick(self, spoil=None) -> None:
        exchange(self.controller, self.plant)
        if spoil:
            spoil(self.controller.inputs)
        self.controller.step()
        self.plant.step()
        outputs = self.plant.outputs
        self.largest_tilt_deg = max(self.largest_tilt_deg, math.degrees(max(map(abs, outputs.true_chest_rpy_rad[:2]))))
        self.other_contacts += outputs.other_contacts


def in_start_frame(points_W_m: np.ndarray, pos_W_m, yaw_W_rad: float) -> np.ndarray:
    c, s = math.cos(yaw_W_rad), math.sin(yaw_W_rad)
    x, y = (points_W_m[:, :2] - np.asarray(pos_W_m)).T
    return np.column_stack([c * x + s * y, -s * x + c * y, points_W_m[:, 2]])


def test_the_walk_is_the_same_a_kilometre_away():
    """The same path to 0.1 mm in the robot's own frame: ten steps from (1000 m, -500 m), turned by 130 deg."""
    pos_W_m, yaw_W_rad = (1000.0, -500.0), math.radians(130.0)
    paths = []
    for values in ({}, {"start_pos_W_m": pos_W_m, "start_yaw_W_rad": yaw_W_rad}):
        loop = Loop(sensor_preset="ideal", **values)
        path = []
        for _ in range(6000):
            loop.tick()
            path.append(loop.plant.outputs.true_com_W_m.copy())
        assert loop.controller.outputs.step_index >= 10
        paths.append(np.array(path))
    away = in_start_frame(paths[1], pos_W_m, yaw_W_rad)
    assert np.ptp(paths[0][:, 0]) > 0.1, "it walked"
    assert np.abs(away - paths[0]).max() < 1e-4


def spoil_nan(inputs) -> None:
    inputs.q_enc_rad[3] = math.nan


def spoil_stale(inputs) -> None:
    inputs.sensor_tick = 1


@pytest.mark.parametrize(("spoil", "fault", "at_tick"), [
    (spoil_nan, "bad_input", 300), (spoil_nan, "bad_input", 3000), (spoil_stale, "stale_input", 3130),
    (spoil_nan, "bad_input", 3200), (spoil_stale, "stale_input", 3300),
])  # fmt: skip
def test_without_sensors_the_robot_crouches_and_stays_up(spoil, fault, at_tick):
    loop = Loop(seed=101)
    for _ in range(at_tick):
        loop.tick()
    for _ in range(3800):
        loop.tick(spoil)
    assert loop.controller.outputs.mode == SAFE and loop.controller.outputs.fault & FAULTS[fault]
    assert loop.other_contacts == 0 and loop.largest_tilt_deg < 3.0
    assert loop.plant.outputs.true_com_W_m[2] < 0.252, "lower than in walking"


def test_single_bad_frames_are_bridged():
    loop = Loop(seed=101)
    for tick in range(5000):
        loop.tick(spoil_nan if tick % 7 == 0 else None)
    assert loop.controller.outputs.fault == 0 and loop.controller.outputs.steps_done >= 7
    assert loop.other_contacts == 0
