"""Poses and inertia of the robot of hoap2.json in the standard library: what the MJCF export needs of mechanics."""

from __future__ import annotations

import math

Vector = list[float]
Matrix = list[list[float]]


def cross(a: Vector, b: Vector) -> Vector:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a: Vector, b: Vector) -> float:
    return sum(x * y for x, y in zip(a, b))


def times(m: Matrix, v: Vector) -> Vector:
    return [dot(row, v) for row in m]


def transposed(m: Matrix) -> Matrix:
    return [list(column) for column in zip(*m)]


def product(a: Matrix, b: Matrix) -> Matrix:
    return [[dot(row, column) for column in zip(*b)] for row in a]


def turn(axis: Vector, angle_rad: float) -> Matrix:
    """Rotation about a unit axis (Rodrigues)."""
    s, c = math.sin(angle_rad), math.cos(angle_rad)
    x, y, z = axis
    skew = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    return [[(1.0 if i == j else 0.0) * c + s * skew[i][j] + (1.0 - c) * axis[i] * axis[j] for j in range(3)]
            for i in range(3)]


def quaternion(m: Matrix) -> Vector:
    """Of a rotation by less than 180 degrees: w, x, y, z."""
    w = 0.5 * math.sqrt(1.0 + m[0][0] + m[1][1] + m[2][2])
    return [w, (m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w), (m[1][0] - m[0][1]) / (4 * w)]


def link_poses(robot: dict, q_rad: dict[str, float]) -> dict[str, tuple[Matrix, Vector]]:
    """Axes and origin of each link in the pelvis frame, for joint angles by name."""
    poses = {robot["base_link"]: ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 0.0, 0.0])}
    for joint in in_tree_order(robot):
        axes, origin = poses[joint["parent"]]
        moved = [o + d for o, d in zip(origin, times(axes, joint["origin_parent_m"]))]
        poses[joint["child"]] = (product(axes, turn(joint["axis"], q_rad.get(joint["name"], 0.0))), moved)
    return poses


def in_tree_order(robot: dict) -> list[dict]:
    """The joints depth first, siblings in the order of hoap2.json: the order of an MJCF's degrees of freedom."""
    children: dict[str, list[dict]] = {}
    for joint in robot["joints"]:
        children.setdefault(joint["parent"], []).append(joint)

    def below(link: str) -> list[dict]:
        return [found for joint in children.get(link, []) for found in (joint, *below(joint["child"]))]

    return below(robot["base_link"])


class ZeroPosture:
    """Mass matrix in the zero posture, where all link frames are parallel, and what follows from its inverse.

    Degrees of freedom: 3 translations and 3 rotations of the pelvis, then the joints in tree order.
    """

    def __init__(self, robot: dict) -> None:
        self._robot = robot
        self._poses = link_poses(robot, {})
        self._joints = in_tree_order(robot)
        self._above = {robot["base_link"]: []}  # link -> joints on the way to the pelvis
        for joint in self._joints:
            self._above[joint["child"]] = [*self._above[joint["parent"]], joint["name"]]
        self._inverse = inverse(self._mass_matrix())

    def _jacobian(self, link: dict) -> tuple[Matrix, Matrix]:
        """Columns, linear at the link's CoM and angular."""
        com = [o + c for o, c in zip(self._poses[link["name"]][1], link["com_L_m"])]
        unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        linear, angular = [*unit, *(cross(e, com) for e in unit)], [[0.0] * 3] * 3 + unit
        for joint in self._joints:
            moves = joint["name"] in self._above[link["name"]]
            axis = [float(a) for a in joint["axis"]] if moves else [0.0] * 3
            arm = [c - o for c, o in zip(com, self._poses[joint["child"]][1])]
            linear.append(cross(axis, arm))
            angular.append(axis)
        return linear, angular

    def _mass_matrix(self) -> Matrix:
        size = 6 + len(self._joints)
        total = [[0.0] * size for _ in range(size)]
        for link in self._robot["links"]:
            linear, angular = self._jacobian(link)
            i = link["inertia_C_kgm2"]
            inertia = [[i["ixx"], i["ixy"], i["ixz"]], [i["ixy"], i["iyy"], i["iyz"]], [i["ixz"], i["iyz"], i["izz"]]]
            spun = [times(inertia, column) for column in angular]
            for a in range(size):
                for b in range(size):
                    total[a][b] += link["mass_kg"] * dot(linear[a], linear[b]) + dot(angular[a], spun[b])
        for k, joint in enumerate(self._joints):
            total[6 + k][6 + k] += joint["armature_kgm2"]
        return total

    def joint_inverse_weight(self, name: str) -> float:
        """Acceleration of a joint by a unit torque on it (1/(kg m2)); MuJoCo's dof_invweight0."""
        index = 6 + [joint["name"] for joint in self._joints].index(name)
        return self._inverse[index][index]

    def link_inverse_weight(self, name: str) -> float:
        """Mean acceleration of a link's CoM by a unit force on it (1/kg); MuJoCo's body_invweight0."""
        linear, _ = self._jacobian(next(link for link in self._robot["links"] if link["name"] == name))
        rows = transposed(linear)
        return sum(dot(row, times(self._inverse, row)) for row in rows) / 3.0


def inverse(matrix: Matrix) -> Matrix:
    """Of a symmetric positive definite matrix (Gauss and Jordan, no pivots needed)."""
    size = len(matrix)
    rows = [[*row, *(1.0 if i == j else 0.0 for j in range(size))] for i, row in enumerate(matrix)]
    for k in range(size):
        pivot = rows[k][k]
        rows[k] = [value / pivot for value in rows[k]]
        for i in range(size):
            if i != k and rows[i][k] != 0.0:
                factor = rows[i][k]
                rows[i] = [value - factor * known for value, known in zip(rows[i], rows[k])]
    return [row[size:] for row in rows]
