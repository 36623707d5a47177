"""The generated MJCF as MuJoCo compiles it: mechanics against pinocchio's, laws against those of the plant."""

from __future__ import annotations

import json
import math
from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import pytest
from kinematics_probe import KinematicsProbe, build_probe

from hoap2.generate import rigid, tables

TICK_S = 1e-3
STIFFNESS_N_M, DAMPING_NS_M = 5e5, 1500.0  # of a corner, the plant's defaults


@pytest.fixture(scope="module")
def robot(repo_root: Path) -> dict:
    return json.loads((repo_root / "firmware" / "hoap2.json").read_text())


@pytest.fixture
def model(repo_root: Path) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(repo_root / "sim" / "model" / "hoap2_mjcf.xml"))


def _places(model: mujoco.MjModel, robot: dict) -> tuple[list[int], list[int]]:
    """Where the joints of hoap2.json are in qpos and qvel."""
    joints = [model.joint(joint["name"]) for joint in robot["joints"]]
    return [joint.qposadr[0] for joint in joints], [joint.dofadr[0] for joint in joints]


def _random_postures(robot: dict, count: int) -> np.ndarray:
    limits = np.array([joint["limit_hard_rad"] for joint in robot["joints"]])
    return np.random.default_rng(11).uniform(limits[:, 0], limits[:, 1], (count, len(limits)))


def test_size_mass_and_order(model: mujoco.MjModel, robot: dict) -> None:
    assert (model.nv, model.nu, model.opt.timestep) == (31, 25, TICK_S)
    assert [model.actuator(i).name for i in range(25)] == [joint["name"] for joint in robot["joints"]]
    assert model.body_mass.sum() == pytest.approx(robot["total_mass_kg"], rel=1e-6)


def test_com(model: mujoco.MjModel, robot: dict, repo_root: Path) -> None:
    """In random postures with the pelvis at the origin, against the firmware's kinematics."""
    probe, data = KinematicsProbe(build_probe(repo_root)), mujoco.MjData(model)
    q_at, _ = _places(model, robot)
    for q_rad in _random_postures(robot, 50):
        data.qpos[:7] = (0, 0, 0, 1, 0, 0, 0)
        data.qpos[q_at] = q_rad
        mujoco.mj_fwdPosition(model, data)
        np.testing.assert_allclose(data.subtree_com[0], probe.link_poses(q_rad)[2], rtol=0, atol=1e-12)


def test_mass_matrix_and_gravity(model: mujoco.MjModel, robot: dict, repo_root: Path) -> None:
    """Against pinocchio on the URDF; the rotors' inertia is on the diagonal of both."""
    file = str(repo_root / "sim" / "model" / "hoap2.urdf")
    urdf = pinocchio.buildModelFromUrdf(file, pinocchio.JointModelFreeFlyer())
    known, data = urdf.createData(), mujoco.MjData(model)
    joints = [urdf.joints[urdf.getJointId(joint["name"])] for joint in robot["joints"]]
    urdf.armature[[joint.idx_v for joint in joints]] = [joint["armature_kgm2"] for joint in robot["joints"]]
    q_at, v_at = _places(model, robot)
    order = [*range(6), *v_at]
    known_order = [*range(6), *(joint.idx_v for joint in joints)]
    for q_rad in _random_postures(robot, 20):
        data.qpos[:7], data.qpos[q_at] = (0, 0, 0, 1, 0, 0, 0), q_rad  # at the origin both have the same base rates
        q = pinocchio.neutral(urdf)
        q[[joint.idx_q for joint in joints]] = q_rad
        mujoco.mj_forward(model, data)
        full = np.zeros((31, 31))
        mujoco.mj_fullM(model, data, full)
        expected = pinocchio.crba(urdf, known, q)
        expected = np.triu(expected) + np.triu(expected, 1).T
        np.testing.assert_allclose(full[np.ix_(order, order)], expected[np.ix_(known_order, known_order)], rtol=0,
                                   atol=1e-12)
        gravity = pinocchio.computeGeneralizedGravity(urdf, known, q)
        np.testing.assert_allclose(data.qfrc_bias[order], gravity[known_order], rtol=0, atol=1e-10)


def test_inverse_weights_of_the_generator(model: mujoco.MjModel, robot: dict) -> None:
    """What solimp was worked out from is what MuJoCo works out."""
    zero = rigid.ZeroPosture(robot)
    for name in ("r_foot", "l_foot", "head"):
        assert zero.link_inverse_weight(name) == pytest.approx(model.body(name).invweight0[0], rel=1e-9)
    for joint in robot["joints"]:
        index = model.joint(joint["name"]).dofadr[0]
        assert zero.joint_inverse_weight(joint["name"]) == pytest.approx(model.dof_invweight0[index], rel=1e-9)


def test_keyframes_stand_on_their_soles(model: mujoco.MjModel, robot: dict) -> None:
    data = mujoco.MjData(model)
    postures = robot["validation"]["postures"]
    for k in range(model.nkey):
        mujoco.mj_resetDataKeyframe(model, data, k)
        mujoco.mj_forward(model, data)
        for foot in ("r_foot", "l_foot"):
            sole = data.body(foot).xpos[2] - robot["feet"]["sole_height_below_ankle_m"]
            assert sole == pytest.approx(0.0, abs=1e-11) and data.body(foot).xmat[8] == pytest.approx(1.0, abs=1e-11)
        if model.key(k).name in postures:
            np.testing.assert_allclose(data.subtree_com[0], postures[model.key(k).name]["com"], rtol=0, atol=6e-7)
    mujoco.mj_resetDataKeyframe(model, data, model.key("walk_upright").id)
    height_m = data.qpos[2]
    for _ in range(2000):
        mujoco.mj_step(model, data)
    assert data.qpos[2] == pytest.approx(height_m, abs=1e-3) and data.xmat[1][8] > 0.9999 and data.ncon == 8


def test_servo_law(model: mujoco.MjModel, robot: dict) -> None:
    """kp (ctrl - q) - kd qd, clipped at the peak: gains and peaks as the plant has them."""
    plant = {s.name: np.array(s.default) for s in tables.load().select("plant", "input")}
    peak = np.array([joint["torque_peak_Nm"] for joint in robot["joints"]])
    data, random = mujoco.MjData(model), np.random.default_rng(12)
    q_at, v_at = _places(model, robot)
    clipped = 0
    for size in (1e-4, 1e-2):
        data.qpos[q_at], data.qvel[v_at] = random.normal(0, 0.1, 25), random.normal(0, 100 * size, 25)
        data.ctrl[:] = data.qpos[q_at] + random.normal(0, size, 25)
        mujoco.mj_forward(model, data)
        wanted = plant["kp_Nm_rad"] * (data.ctrl - data.qpos[q_at]) - plant["kd_Nms_rad"] * data.qvel[v_at]
        clipped += int((np.abs(wanted) > peak).sum())
        np.testing.assert_allclose(data.actuator_force, np.clip(wanted, -peak, peak), rtol=0, atol=1e-10)
    assert 0 < clipped < 50


@pytest.mark.parametrize("elliptic", (False, True))
def test_contact_law(model: mujoco.MjModel, elliptic: bool) -> None:
    """A sole that moves straight down: f = -k x - (h k + d) (v + h a) at each corner."""
    if elliptic:
        from hoap2.bench.simulators import make_elliptic

        make_elliptic(model)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("walk_upright").id)
    data.qpos[2] -= 5e-5
    data.qvel[2] = -0.02
    mujoco.mj_forward(model, data)
    assert data.ncon == 8
    jacobian, force = data.efc_J.reshape(-1, model.nv), np.zeros(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        rows = slice(contact.efc_address, contact.efc_address + (3 if elliptic else 4))
        # the edges lean to all sides: their mean is the normal direction
        normal = jacobian[rows.start] if elliptic else jacobian[rows].mean(axis=0)
        mujoco.mj_contactForce(model, data, i, force)
        row_Ns_m = TICK_S * STIFFNESS_N_M + DAMPING_NS_M
        expected = -STIFFNESS_N_M * contact.dist - row_Ns_m * (normal @ data.qvel + TICK_S * (normal @ data.qacc))
        assert expected > 5.0
        assert force[0] == pytest.approx(expected, rel=1e-4)


def _one_joint(model: mujoco.MjModel, name: str) -> tuple[mujoco.MjData, int, int]:
    """Floating without weight and drives, everything else at rest."""
    model.opt.gravity[:] = 0.0
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION | mujoco.mjtDisableBit.mjDSBL_CONTACT
    joint = model.joint(name)
    return mujoco.MjData(model), joint.qposadr[0], joint.dofadr[0]


def test_joint_friction(model: mujoco.MjModel, robot: dict) -> None:
    """Half the Coulomb torque: creeps at half of 0.02 rad/s. Twice of it: the rest of the torque accelerates."""
    joint = next(j for j in robot["joints"] if j["name"] == "l_knee")
    coulomb, viscous = joint["friction_coulomb_Nm"], joint["friction_viscous_Nms_rad"]
    data, q_at, v_at = _one_joint(model, "l_knee")
    data.qpos[q_at] = 1.0
    data.qfrc_applied[v_at] = 0.5 * coulomb
    for _ in range(60):
        mujoco.mj_step(model, data)
    assert data.qvel[v_at] == pytest.approx(0.5 * coulomb / (coulomb / 0.02 + viscous), rel=1e-3)
    data.qfrc_applied[v_at] = 2.0 * coulomb
    data.qvel[:] = 0.0
    data.qvel[v_at] = 1.0
    mujoco.mj_forward(model, data)
    assert data.qfrc_constraint[v_at] == pytest.approx(-coulomb, rel=1e-9)
    assert data.qfrc_passive[v_at] == pytest.approx(-viscous, rel=1e-9)


def test_joint_stop(model: mujoco.MjModel, robot: dict) -> None:
    """Beyond a hard limit: 2000 Nm/rad and 5 Nms/rad, taken at the end of the tick."""
    high = next(j for j in robot["joints"] if j["name"] == "l_knee")["limit_hard_rad"][1]
    model.dof_frictionloss[:] = 0.0
    data, q_at, v_at = _one_joint(model, "l_knee")
    data.qpos[q_at], data.qvel[v_at] = high + 1e-3, 0.3
    mujoco.mj_forward(model, data)
    after = data.qvel[v_at] + TICK_S * data.qacc[v_at]
    expected = -2000.0 * (1e-3 + TICK_S * after) - 5.0 * after
    assert expected < -1.0 and math.isclose(data.qfrc_constraint[v_at], expected, rel_tol=1e-4)
