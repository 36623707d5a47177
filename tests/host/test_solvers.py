"""The plant's two solvers in closed loop with the firmware: the same walk."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from hoap2 import Controller, Plant, exchange, scenario
from hoap2.errors import UserError

STEPS = 10
LOADED_N = 1.0  # a foot that carries this is on the ground
SWING_TICKS = 50  # shorter gaps of load are bounces of one touchdown


@dataclass
class Walk:
    """What both solvers must agree on, a row a tick."""

    joints_rad: np.ndarray  # (ticks, 25) true joint angles
    feet_N: np.ndarray  # (ticks, 2) vertical force on each foot
    com_W_m: np.ndarray  # (ticks, 3)
    steps_done: int

    def touchdowns(self, foot: int) -> list[int]:
        """Ticks at which a foot that has swung is loaded again."""
        loaded = np.flatnonzero(self.feet_N[:, foot] > LOADED_N)
        return [int(loaded[i + 1]) for i in np.flatnonzero(np.diff(loaded) > SWING_TICKS)]


def walk(steps: int = STEPS, **plant_values) -> Walk:
    """floor-walk's first steps with this plant."""
    loaded = scenario.load("floor-walk")
    controller = Controller(**{**loaded.values["controller"], "calibrate_s": 0.2})
    plant = Plant(**{**loaded.values["plant"], **plant_values})
    joints, feet, com = [], [], []
    while controller.outputs.steps_done < steps:
        assert len(joints) < 8000, "the walk does not get on"
        exchange(controller, plant)
        controller.step()
        plant.step()
        joints.append(plant.outputs.true_q_rad.copy())
        feet.append(plant.outputs.true_foot_force_W_N[:, 2].copy())
        com.append(plant.outputs.true_com_W_m.copy())
    return Walk(np.array(joints), np.array(feet), np.array(com), controller.outputs.steps_done)


@pytest.mark.slow
@pytest.mark.parametrize(("sensors", "joint_bound_rad", "touchdown_ticks"), [
    ("ideal", 1e-6, 0),
    ("hoap2", 1e-3, 1),  # an encoder count may tip
])  # fmt: skip
def test_both_solvers_walk_the_same_steps(sensors, joint_bound_rad, touchdown_ticks):
    articulated = walk(solver="articulated", friction_law="pyramid", sensor_preset=sensors)
    ode = walk(solver="ode", sensor_preset=sensors)
    assert articulated.steps_done == ode.steps_done == STEPS
    assert np.ptp(articulated.com_W_m[:, 0]) > 0.1 and np.ptp(articulated.com_W_m[:, 1]) > 0.01, "it walked"
    ticks = min(len(articulated.joints_rad), len(ode.joints_rad))
    assert np.abs(articulated.joints_rad[:ticks] - ode.joints_rad[:ticks]).max() < joint_bound_rad
    count = 0
    for foot in (0, 1):
        ours, theirs = articulated.touchdowns(foot), ode.touchdowns(foot)
        assert len(ours) == len(theirs)
        assert all(abs(a - b) <= touchdown_ticks for a, b in zip(ours, theirs)), (ours, theirs)
        count += len(ours)
    assert count >= STEPS - 1, "every step ends with a touchdown, the last one perhaps in the tick after"


def test_both_solvers_walk_the_same_first_steps():
    articulated = walk(2, solver="articulated", friction_law="pyramid", sensor_preset="ideal")
    ode = walk(2, solver="ode", sensor_preset="ideal")
    assert len(articulated.joints_rad) == len(ode.joints_rad)
    assert np.abs(articulated.joints_rad - ode.joints_rad).max() < 1e-6
    assert [articulated.touchdowns(foot) for foot in (0, 1)] == [ode.touchdowns(foot) for foot in (0, 1)]
    assert np.ptp(articulated.com_W_m[:, 1]) > 0.01, "it walked"


def test_a_walk_hardly_feels_the_corners_of_the_pyramid():
    """Feet that stick know no friction law: cone and pyramid part only where a landing sole slides."""
    cone = walk(4, solver="articulated", friction_law="cone", sensor_preset="ideal")
    pyramid = walk(4, solver="articulated", friction_law="pyramid", sensor_preset="ideal")
    ticks = min(len(cone.joints_rad), len(pyramid.joints_rad))
    apart_rad = np.abs(cone.joints_rad[:ticks] - pyramid.joints_rad[:ticks]).max()
    assert 0.0 < apart_rad < 2e-3


def test_a_state_moves_between_solvers():
    """A block of one solver goes on in an instance that ran the other, bit for bit."""
    first, second = Plant(solver="articulated", seed=3), Plant(solver="ode", seed=4)
    for plant in (first, second):
        plant.step(100)
    blocks = first.save(), second.save()
    first.step(50)
    second.step(50)
    ends = first.save(), second.save()
    for plant, block, end in ((second, blocks[0], ends[0]), (first, blocks[1], ends[1])):
        plant.restore(block)
        plant.step(50)
        assert plant.save() == end


def test_ode_refuses_the_cone():
    with pytest.raises(UserError, match="friction_law.*pyramid.*solver = articulated"):
        Plant(solver="ode", friction_law="cone")
