"""Walking on request in the plant: whatever is asked for, the robot stays on its feet."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hoap2 import Controller, Plant, exchange, parameters

STOP, WALK = (parameters.table().enums["walk_request"].index(word) for word in ("stop", "walk"))
LIMITED = parameters.table().enums["request_state"].index("limited")
CALIBRATED_S = 1.6


def random_requests(seed: int, end_s: float) -> dict[int, tuple]:
    """tick -> walk request and step; two in three within what the legs can do, stops among them."""
    rng = np.random.default_rng(seed)
    found, t_s = {}, CALIBRATED_S
    while t_s < end_s:
        step = rng.choice([0.5, 1.0, 2.0]) * rng.uniform(-1, 1, 3) * (0.02, 0.008, 0.1)
        found[round(1000 * t_s)] = (WALK if rng.random() < 0.85 else STOP, *map(float, step))
        t_s += rng.uniform(0.4, 3.0)
    return found


def play(requests: dict[int, tuple], ticks: int, seed: int) -> tuple[Controller, Plant, float, set[int]]:
    """The robot at the end, its largest tilt, and what became of the requests."""
    controller, plant = Controller(behaviour="stand"), Plant(seed=seed, sensor_preset="hoap2")
    worst_rad, states = 0.0, set()
    names = ("walk_request", "step_length_request_m", "step_sideways_request_m", "step_turn_request_rad")
    for tick in range(ticks):
        exchange(controller, plant)
        for name, value in zip(names, requests.get(tick, ())):
            setattr(controller.inputs, name, value)
        controller.step()
        plant.step()
        if tick % 20 == 0:
            worst_rad = max(worst_rad, *map(abs, plant.outputs.true_chest_rpy_rad[:2]))
            states.add(controller.outputs.request_state)
            assert plant.outputs.other_contacts == 0 and worst_rad < 0.2, f"fell at {tick * 1e-3} s"
    return controller, plant, worst_rad, states


@pytest.mark.parametrize("seed", [1, 2])
def test_requests_at_random_do_not_make_it_fall(seed: int):
    requests = random_requests(seed, 20.0) | {20_000: (STOP, 0.0, 0.0, 0.0)}
    controller, plant, worst_rad, states = play(requests, 23_000, seed)
    assert controller.outputs.fault == 0 and controller.outputs.walk_done == 1 and worst_rad < math.radians(5.0)
    assert LIMITED in states
    assert np.linalg.norm(plant.outputs.true_base_vel_W_m_s) < 0.02


def test_it_goes_where_it_is_told():
    """Ahead, then back, then to the left: stops between them, the feet where they were asked to be."""
    requests = {1600: (WALK, 0.02, 0.0, 0.0), 6000: (STOP, 0.0, 0.0, 0.0), 8000: (WALK, -0.01, 0.01, 0.0),
                12000: (STOP, 0.0, 0.0, 0.0)}  # fmt: skip
    controller, plant, worst_rad, _ = play(requests, 14_500, 3)
    wanted, got = controller.outputs.foot_ref_W_m, plant.outputs.true_foot_pos_W_m
    assert wanted[:, 0].mean() > 0.08 and wanted[:, 1].mean() > 0.05
    np.testing.assert_allclose(got[:, :2], wanted[:, :2], atol=0.01)
    assert worst_rad < math.radians(1.0)
