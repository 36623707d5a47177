"""The whole robot in free flight against MuJoCo with RK4 at 0.1 ms, to the accuracy of the plant's integrator.

The reference knows nothing of this project's dynamics but the generated MJCF. The plant is of first order: at 1 ms it
may be off by about what MuJoCo's own Euler is off at 1 ms. What is left when the step goes to nothing must be nothing:
that is judged by stepping the plant with 1, 1/2 and 1/4 ms (see mujoco_flight) and extrapolating.
"""

from __future__ import annotations

import functools
import math
from pathlib import Path

import mujoco
import numpy as np
import pytest
from mujoco_flight import DURATION_S, JOINTS, REFERENCE_STEP_S, TICK_S, Flight, Motion, fly_mujoco, fly_plant

from hoap2.generate import tables

EULER, RK4 = mujoco.mjtIntegrator.mjINT_EULER, mujoco.mjtIntegrator.mjINT_RK4
SOLVERS = ("articulated", "ode")


def _rad(**degrees: float) -> dict[str, float]:
    return {name: math.radians(angle) for name, angle in degrees.items()}


BENT = _rad(waist_pitch=40, head_tilt=20, r_elbow=-60, l_elbow=-50, r_knee=60, l_knee=50, r_hip_pitch=-40,
            l_hip_pitch=-30, r_hip_yaw=-20, l_hip_yaw=20, r_shoulder_roll=-50, l_shoulder_roll=50, r_shoulder_pitch=20,
            l_shoulder_pitch=40)
FLIGHTS = {
    # every joint is passive; the limbs are thrown outwards
    "tumble": Flight(BENT, (1.0, -2.0, 1.5)),
    "falling tumble": Flight(BENT, (1.0, -2.0, 1.5), gravity_m_s2=9.81),
    # a double pendulum on a free base: shoulder and elbow are passive and thrown, all other joints are held by
    # their drives. The plant has no base that could be nailed down.
    "double pendulum": Flight(_rad(l_shoulder_pitch=-20, l_elbow=-60, r_knee=60, l_knee=50), (0.0, 0.5, 0.3),
                              passive=("l_shoulder_pitch", "l_elbow"),
                              torque_Nm={"l_shoulder_pitch": 0.5, "l_elbow": -0.1}),
}
# What the plant's 1 ms may be off over 1 s: position (m) after the fall, orientation (rad), joint angles (rad).
# Falling, every first-order scheme is off by g h T / 2 = 4.9 mm.
AT_1_MS = {"tumble": (1e-5, 2e-4, 1e-4), "falling tumble": (1e-5, 2e-4, 1e-4), "double pendulum": (2e-5, 4e-4, 2e-3)}


@pytest.fixture(scope="module")
def fly(repo_root: Path):
    """Motions, each computed once."""
    path = str(repo_root / "sim" / "model" / "hoap2_mjcf.xml")

    @functools.cache
    def reference(name: str, integrator: int = RK4, step_s: float = REFERENCE_STEP_S) -> Motion:
        return fly_mujoco(FLIGHTS[name], path, integrator, step_s)

    @functools.cache
    def plant(name: str, solver: str, slower: int = 1) -> Motion:
        return fly_plant(FLIGHTS[name], solver, slower)

    return reference, plant


def _largest(off: Motion, fall_m: float = 0.0) -> tuple[float, float, float]:
    along = np.linspace(0.0, 1.0, len(off.pos_W_m))[:, None] * [0.0, 0.0, fall_m]
    return (float(np.abs(off.pos_W_m - along).max()), float(np.abs(off.quat_W).max()), float(np.abs(off.q_rad).max()))


@pytest.mark.parametrize("name", FLIGHTS)
def test_the_reference_moves_and_touches_no_stop(fly, name: str) -> None:
    reference, _ = fly
    motion = reference(name)
    limits = np.array([joint["limit_hard_rad"] for joint in tables.load_robot()["joints"]])
    assert (motion.q_rad > limits[:, 0] + 0.01).all() and (motion.q_rad < limits[:, 1] - 0.01).all()
    swing = dict(zip(JOINTS, np.ptp(motion.q_rad, axis=0)))
    if name == "double pendulum":
        assert swing["l_shoulder_pitch"] > 1.5 and swing["l_elbow"] > 0.4
        assert max(value for joint, value in swing.items() if joint not in FLIGHTS[name].passive) < 0.01
    else:
        assert sorted(swing.values())[-8] > 0.15 and max(swing.values()) > 0.6
    coarse = reference(name, RK4, 2.0 * REFERENCE_STEP_S)
    assert np.abs(motion.off(coarse).vector()).max() < 1e-10  # the reference's own error


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", FLIGHTS)
def test_at_1_ms(fly, name: str, solver: str) -> None:
    """Off by the integrator's error: no more than the bounds, and no more than a little above MuJoCo's Euler."""
    reference, plant = fly
    fall_m = -FLIGHTS[name].gravity_m_s2 * TICK_S * DURATION_S / 2.0
    off = _largest(plant(name, solver).off(reference(name)), fall_m)
    euler = _largest(reference(name, EULER, TICK_S).off(reference(name)), fall_m)
    assert all(a < bound for a, bound in zip(off, AT_1_MS[name])), off
    assert all(a < 1.5 * b for a, b in zip(off[1:], euler[1:])), (off, euler)
    assert off[2] > 1e-7  # a comparison with itself would be nothing


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", FLIGHTS)
def test_error_goes_with_the_step_to_nothing(fly, name: str, solver: str) -> None:
    """Smaller with each halving; extrapolated from three steps it vanishes (joint angles: 5e-8 rad of up to 2 rad)."""
    reference, plant = fly
    whole, half, quarter = (plant(name, solver, slower).off(reference(name)).vector() for slower in (1, 2, 4))
    sizes = [np.abs(off).max() for off in (whole, half, quarter)]
    assert sizes[0] > 1.6 * sizes[1] > 1.6 * 1.6 * sizes[2]
    first, second = 2.0 * half - whole, 2.0 * quarter - half  # without the first order
    assert np.abs((4.0 * second - first) / 3.0).max() < 3e-7  # without the second


def test_another_rotor_inertia_would_be_seen(fly, repo_root: Path, tmp_path: Path) -> None:
    """The bounds tell a robot whose rotor in one elbow is 2 % heavier."""
    reference, _ = fly
    text = (repo_root / "sim" / "model" / "hoap2_mjcf.xml").read_text()
    elbow = text.index('name="l_elbow"')
    changed = tmp_path / "heavier.xml"
    changed.write_text(text[:elbow] + text[elbow:].replace('armature="0.0187"', 'armature="0.019074"', 1))
    off = fly_mujoco(FLIGHTS["tumble"], str(changed), RK4, REFERENCE_STEP_S).off(reference("tumble"))
    assert _largest(off)[2] > AT_1_MS["tumble"][2]
