"""The plant's walk against MuJoCo's: the same drive commands, contact and friction laws matched in the MJCF.

Both walk open loop, so nothing brings them together again once they differ.
"""

from __future__ import annotations

import numpy as np
import pytest

from hoap2.bench import recording
from hoap2.bench.simulators import MujocoSettings, MujocoSimulator, PlantSimulator
from hoap2.binding import Plant

TICKS, CHUNK = 4000, 50  # 1.5 s of standing, then 6 steps
TICK_S = 1e-3
NEAR_M = np.array([1e-4, 6e-5, 4e-6])  # CoM forward, sideways, up


@pytest.fixture(scope="module")
def walk() -> recording.Recording:
    return recording.record(TICKS)


def _com_path(simulator: PlantSimulator | MujocoSimulator) -> np.ndarray:
    """CoM (m) after each chunk."""
    ns, path = np.zeros(CHUNK, dtype=np.int64), []
    for first in range(0, TICKS, CHUNK):
        simulator.chunk(first, ns)
        path.append(simulator.look().com_W_m)
    return np.array(path)


def _mujoco_path(walk: recording.Recording, elliptic: bool) -> np.ndarray:
    settings = MujocoSettings("implicitfast", elliptic=elliptic)
    mujoco = MujocoSimulator("mujoco", settings, walk, False, Plant(**walk.plant_values))
    # the plant takes the position error at the end of the tick: kp (e - h w+) - kd w+
    mujoco.model.actuator_biasprm[:, 2] -= TICK_S * mujoco.model.actuator_gainprm[:, 0]
    return _com_path(mujoco)


@pytest.fixture(scope="module")
def elliptic_path(walk: recording.Recording) -> np.ndarray:
    return _mujoco_path(walk, elliptic=True)


@pytest.mark.parametrize("solver", ("articulated", "ode"))
def test_com_of_the_walk(walk: recording.Recording, elliptic_path: np.ndarray, solver: str) -> None:
    plant = _com_path(PlantSimulator("plant", walk, False, solver=solver))
    # it walks: forward, and from side to side
    assert plant[-1, 0] - plant[0, 0] > 0.06 and np.ptp(plant[:, 1]) > 0.03 and np.ptp(plant[:, 2]) > 1.5e-3
    off = np.abs(plant - elliptic_path).max(axis=0)
    assert (off < NEAR_M).all(), off
    assert off[1] > 1e-7  # a comparison with itself would be nothing


def test_the_pyramid_yields_along_the_ground(walk: recording.Recording, elliptic_path: np.ndarray) -> None:
    """As the MJCF says of it: the walk is the same one, but the soles creep."""
    off = np.abs(_mujoco_path(walk, elliptic=False) - elliptic_path).max(axis=0)
    assert (off < [2e-3, 2e-3, 1e-4]).all() and off[0] > NEAR_M[0] and off[1] > NEAR_M[1], off


@pytest.mark.parametrize("change", ({"contact_stiffness_N_m": 4.5e5}, {"contact_damping_Ns_m": 1200.0},
                                    {"joint_friction_scale": 0.5}, {"chest_com_shift_L_m": [5e-4, 0.0, 0.0]}), ids=str)
def test_another_plant_would_be_seen(walk: recording.Recording, elliptic_path: np.ndarray, change: dict) -> None:
    off = np.abs(_com_path(PlantSimulator("plant", walk, False, **change)) - elliptic_path).max(axis=0)
    assert (off > NEAR_M).any(), off
