"""Where the links are, from base and joint angles: the kinematic tree of hoap2.json over many ticks at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hoap2 import parameters
from hoap2.signal_log import SignalLog

NEEDED = ("p.true_base_pos_W_m", "p.true_base_quat_W", "p.true_q_rad")


@dataclass(frozen=True)
class LinkPoses:
    """A link over time in W: position (n, 3) in m, quaternion (n, 4) w x y z; and its box in its frame, m."""

    name: str
    pos_W_m: np.ndarray
    quat_W: np.ndarray
    box_min_L_m: np.ndarray
    box_max_L_m: np.ndarray


def multiply(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Products of quaternions (n, 4), w x y z."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack([aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw], -1)  # fmt: skip


def rotate(quat: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) or (3,) turned by unit quaternions (n, 4)."""
    w, u = quat[..., :1], quat[..., 1:]
    return vector + 2.0 * np.cross(u, np.cross(u, vector) + w * vector)


def of_run(log: SignalLog, rows: np.ndarray) -> list[LinkPoses]:
    """Every link at these rows; [] when the run does not tell where the robot is."""
    blocks = [log.block(name) for name in NEEDED]
    if any(block is None for block in blocks):
        return []
    pos, quat, q = (block[rows] for block in blocks)
    robot = parameters.table().robot
    poses = {robot["base_link"]: (pos, quat)}
    joints = list(enumerate(robot["joints"]))
    while joints:
        rest = []
        for i, joint in joints:
            if joint["parent"] not in poses:
                rest.append((i, joint))
                continue
            parent_pos, parent_quat = poses[joint["parent"]]
            half = 0.5 * q[:, i : i + 1]
            turn = np.concatenate([np.cos(half), np.sin(half) * np.array(joint["axis"], dtype=float)], axis=1)
            poses[joint["child"]] = (parent_pos + rotate(parent_quat, np.array(joint["origin_parent_m"])),
                                     multiply(parent_quat, turn))  # fmt: skip
        joints = rest
    return [LinkPoses(link["name"], *poses[link["name"]], np.array(link["box_min_L_m"]), np.array(link["box_max_L_m"]))
            for link in robot["links"]]  # fmt: skip
