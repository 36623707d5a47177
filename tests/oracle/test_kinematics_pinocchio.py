"""The firmware's kinematics against pinocchio on the generated URDF, and against the data sheet's postures."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pinocchio
import pytest
from kinematics_probe import JOINTS, KinematicsProbe, build_probe

TOLERANCE = 1e-10
POSTURES = 200


@pytest.fixture(scope="module")
def probe(repo_root: Path) -> KinematicsProbe:
    return KinematicsProbe(build_probe(repo_root))


@pytest.fixture(scope="module")
def robot_data(repo_root: Path) -> dict:
    return json.loads((repo_root / "firmware" / "hoap2.json").read_text())


class Oracle:
    """Pinocchio's model with a free base; its joints are found by name."""

    def __init__(self, urdf: Path, robot_data: dict) -> None:
        self.model = pinocchio.buildModelFromUrdf(str(urdf), pinocchio.JointModelFreeFlyer())
        self.data = self.model.createData()
        joints = [self.model.joints[self.model.getJointId(joint["name"])] for joint in robot_data["joints"]]
        self.q_index = [joint.idx_q for joint in joints]
        self.v_index = [joint.idx_v for joint in joints]
        body = pinocchio.FrameType.BODY  # a joint may bear the name of its link
        self.frames = [self.model.getFrameId(link["name"], body) for link in robot_data["links"]]
        self.q = pinocchio.neutral(self.model)

    def place(self, q_rad: np.ndarray, base: pinocchio.SE3) -> None:
        """Compute everything for a posture with the pelvis at `base`."""
        self.base = base
        self.q[:7] = pinocchio.SE3ToXYZQUAT(base)
        self.q[self.q_index] = q_rad
        pinocchio.computeJointJacobians(self.model, self.data, self.q)
        pinocchio.updateFramePlacements(self.model, self.data)
        pinocchio.jacobianCenterOfMass(self.model, self.data, self.q)

    def com_B(self) -> np.ndarray:
        return self.base.actInv(self.data.com[0])

    def com_jacobian_B(self) -> np.ndarray:
        return self.base.rotation.T @ self.data.Jcom[:, self.v_index]

    def link_pose_B(self, link: int) -> pinocchio.SE3:
        return self.base.actInv(self.data.oMf[self.frames[link]])

    def point_jacobian_B(self, link: int, point_L: np.ndarray) -> np.ndarray:
        frame = self.frames[link]
        jacobian = pinocchio.getFrameJacobian(self.model, self.data, frame,
                                              pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED)[:, self.v_index]
        lever_W = self.data.oMf[frame].rotation @ point_L
        linear = jacobian[:3] - pinocchio.skew(lever_W) @ jacobian[3:]
        return np.vstack([self.base.rotation.T @ linear, self.base.rotation.T @ jacobian[3:]])


@pytest.fixture(scope="module")
def oracle(repo_root: Path, robot_data: dict) -> Oracle:
    return Oracle(repo_root / "sim" / "model" / "hoap2.urdf", robot_data)


@pytest.fixture(scope="module")
def random_postures(robot_data: dict) -> list[tuple[np.ndarray, pinocchio.SE3, np.random.Generator]]:
    """Joint angles within the hard limits and a pelvis anywhere near the origin."""
    random = np.random.default_rng(5)
    limits = np.array([joint["limit_hard_rad"] for joint in robot_data["joints"]])
    assert limits.shape == (JOINTS, 2)
    postures = []
    for _ in range(POSTURES):
        quaternion = random.normal(size=4)
        base = pinocchio.XYZQUATToSE3(np.concatenate([random.uniform(-1, 1, 3),
                                                      quaternion / np.linalg.norm(quaternion)]))
        postures.append((random.uniform(limits[:, 0], limits[:, 1]), base))
    return postures


def test_names_and_total_mass(oracle: Oracle, robot_data: dict) -> None:
    assert oracle.model.nv == 6 + JOINTS
    assert sorted(oracle.v_index) == list(range(6, 6 + JOINTS))
    mass = sum(link["mass_kg"] for link in robot_data["links"])
    assert pinocchio.computeTotalMass(oracle.model) == pytest.approx(mass, rel=1e-12)
    assert mass == pytest.approx(robot_data["total_mass_kg"], rel=1e-6)


def test_link_poses_and_com(probe: KinematicsProbe, oracle: Oracle, robot_data: dict, random_postures: list) -> None:
    for q_rad, base in random_postures:
        oracle.place(q_rad, base)
        rotations, positions, com = probe.link_poses(q_rad)
        np.testing.assert_allclose(com, oracle.com_B(), rtol=0, atol=TOLERANCE)
        for link, data in enumerate(robot_data["links"]):
            pose = oracle.link_pose_B(link)
            np.testing.assert_allclose(rotations[link], pose.rotation, rtol=0, atol=TOLERANCE, err_msg=data["name"])
            np.testing.assert_allclose(positions[link], pose.translation, rtol=0, atol=TOLERANCE,
                                       err_msg=data["name"])


def test_com_jacobian(probe: KinematicsProbe, oracle: Oracle, random_postures: list) -> None:
    for q_rad, base in random_postures:
        oracle.place(q_rad, base)
        np.testing.assert_allclose(probe.com_jacobian(q_rad), oracle.com_jacobian_B(), rtol=0, atol=TOLERANCE)


def test_point_jacobians_of_every_link(probe: KinematicsProbe, oracle: Oracle, robot_data: dict,
                                       random_postures: list) -> None:
    random = np.random.default_rng(6)
    for q_rad, base in random_postures[:40]:
        oracle.place(q_rad, base)
        for link, data in enumerate(robot_data["links"]):
            point_L = random.uniform(-0.2, 0.2, 3)
            np.testing.assert_allclose(probe.point_jacobian(q_rad, link, point_L),
                                       oracle.point_jacobian_B(link, point_L), rtol=0, atol=TOLERANCE,
                                       err_msg=data["name"])


def test_data_sheet_postures(probe: KinematicsProbe, robot_data: dict) -> None:
    """CoM, hip height and head top of the named postures, to the printed digits."""
    head = [link["name"] for link in robot_data["links"]].index("head")
    validation = robot_data["validation"]["postures"]
    assert set(validation) >= {"zero", "stand_straight", "bent_knee", "walk_ready"}
    for name, expected in validation.items():
        posture_deg = robot_data["postures_deg"][name]
        q_rad = np.array([np.deg2rad(posture_deg.get(joint["name"], 0.0)) for joint in robot_data["joints"]])
        rotations, positions, com_B = probe.link_poses(q_rad)
        soles = [probe.sole_pose(q_rad, foot) for foot in (0, 1)]
        # floor frame: midway between the soles, parallel to them (a posture may lean the pelvis)
        np.testing.assert_allclose(soles[0][0], soles[1][0], rtol=0, atol=1e-12)
        to_floor = soles[0][0].T
        origin_B = (soles[0][1] + soles[1][1]) / 2
        np.testing.assert_allclose(to_floor @ (com_B - origin_B), expected["com"], rtol=0, atol=6e-7, err_msg=name)
        assert (to_floor @ -origin_B)[2] == pytest.approx(expected["hip_height"], abs=6e-7)
        head_top_B = positions[head] + rotations[head] @ np.array(robot_data["head_top_L_m"])
        assert (to_floor @ (head_top_B - origin_B))[2] == pytest.approx(expected["head_top_height"], abs=6e-7)
