"""MJCF export of hoap2.json: the plant's robot, drives and soles for MuJoCo."""

from __future__ import annotations

import math

from . import rigid
from .tables import Table

# The plant's own constants (sim/drive/drive.cpp): Coulomb friction is viscous below this rate; mechanical stops.
FRICTION_RATE_RAD_S = 0.02
STOP_STIFFNESS_NM_RAD, STOP_DAMPING_NMS_RAD = 2000.0, 5.0

ELLIPTIC_IMPRATIO = 100  # how much stiffer than its normal direction a contact is along the ground

HEADER = """\
<?xml version="1.0"?>
<!-- Generated from firmware/hoap2.json by ./hoap2 generate: do not edit.

  HOAP-2 as this project's plant has it: tree, masses, inertias, rotor inertias, stops, drives, joint friction, soles.
  SI units. In the zero posture the legs are straight and the arms stretched forward. Checked with MuJoCo 4.0.0.

  Drives. ctrl[i] is the position reference (rad) of joint i in the order of hoap2.json:
      torque = kp (ctrl - q) - kd qd, clipped at the peak torque
  A reference rate and a feed-forward torque enter as ctrl = q_ref + (kd qd_ref + tau_ff) / kp. The limit of the drives
  on the commanded rate is not modelled.

  Contact. Only the soles touch the floor. The plant has a spring and a damper at each corner, without pull, taken at
  the end of the tick (h = {h:g} s, k = {k:g} N/m, d = {d:g} Ns/m):
      f = -k (x + h v+) - d v+ = -k x - (h k + d) (v + h a)
  MuJoCo solves R f = -B v - K x - a. Both are the same for
      R = 1 / (h (h k + d)),  K = k R,  B = 1 / h
  which solref (direct format) and solimp (constant impedance) set here for the option cone="pyramidal": its four edges
  have 4 R each, so the sum that carries the sole is the plant's. Along the ground MuJoCo yields more than the plant:
  a corner that sticks creeps by 2 h R / mu^2 = {creep:.2g} m/s a newton, the plant's by 1e-6 m/s. With cone="elliptic",
  impratio="{impratio}", solref="{elliptic_k} {elliptic_b}" and solimp="{elliptic} {elliptic} 1" the normal direction is
  the plant's as well, and a corner creeps by {elliptic_creep:.2g} m/s a newton.
  Joint friction (viscous below {rate:g} rad/s) and the stops are matched in the same way.
  All this holds at the time step below, with any integrator but discrete. -->
"""


def _v(values) -> str:
    return " ".join(repr(float(v)) for v in values)


def _default(table: Table, name: str) -> tuple[float, ...]:
    """Default of a plant parameter or input."""
    return next(s for s in table.signals if s.product == "plant" and s.name == name).default


def _soft(regulariser: float, stiffness: float, h: float, diagonal: float) -> tuple[str, str]:
    """solref and solimp of a spring (direct format) whose row has the regulariser 1 / (h (h k + d)).

    MuJoCo's R is (1 - imp) / imp times its diagonal approximation; it divides both numbers of solref by imp.
    """
    imp = diagonal / (diagonal + regulariser)
    return f"{-stiffness * regulariser * imp:.6g} {-imp / h:.6g}", f"{imp:.6g} {imp:.6g} 1"


def contact_regulariser(table: Table) -> float:
    """R of a corner, 1/kg (see the file's header)."""
    h = table.tick_us * 1e-6
    k, d = _default(table, "contact_stiffness_N_m")[0], _default(table, "contact_damping_Ns_m")[0]
    return 1.0 / (h * (h * k + d))


def sole_softness(table: Table, link: str, elliptic: bool = False) -> tuple[str, str]:
    """solref and solimp of a sole's geom."""
    mu = _default(table, "friction_mu")[0]
    weight = rigid.ZeroPosture(table.robot).link_inverse_weight(link)
    # an edge of the pyramid has R = (1 - imp) / imp * 2 mu^2 * (1 + mu^2) weight; four of them share the normal force
    diagonal = weight if elliptic else 2.0 * mu * mu * (1.0 + mu * mu) * weight / 4.0
    stiffness = _default(table, "contact_stiffness_N_m")[0]
    return _soft(contact_regulariser(table), stiffness, table.tick_us * 1e-6, diagonal)


class _Writer:
    """The body tree, an element a line."""

    def __init__(self, table: Table) -> None:
        self.table, self.robot = table, table.robot
        self.links = {link["name"]: link for link in self.robot["links"]}
        self.zero = rigid.ZeroPosture(self.robot)
        self.lines: list[str] = []

    def body(self, name: str, joint: dict | None, depth: int) -> None:
        link, pad = self.links[name], "  " * depth
        origin = _v(joint["origin_parent_m"]) if joint else "0.0 0.0 0.3"
        self.lines.append(f'{pad}<body name="{name}" pos="{origin}">')
        self.lines.append(f"{pad}  {self._joint(joint)}" if joint else f'{pad}  <freejoint name="base"/>')
        tensor = (link["inertia_C_kgm2"][key] for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
        self.lines.append(f'{pad}  <inertial pos="{_v(link["com_L_m"])}" mass="{link["mass_kg"]!r}" '
                          f'fullinertia="{_v(tensor)}"/>')
        self.lines.append(f"{pad}  {self._geom(link)}")
        if name == self.robot["imu"]["link"]:
            self.lines.append(f'{pad}  <site name="imu" pos="{_v(self.robot["imu"]["position_L_m"])}"/>')
        for child in self.robot["joints"]:
            if child["parent"] == name:
                self.body(child["child"], child, depth + 1)
        self.lines.append(f"{pad}</body>")

    def _joint(self, joint: dict) -> str:
        name, h = joint["name"], self.table.tick_us * 1e-6
        weight = self.zero.joint_inverse_weight(name)
        # viscous below the friction rate: f = -(c / rate) v+, so 1 / R = h c / rate, and no spring
        friction = _soft(FRICTION_RATE_RAD_S / (h * joint["friction_coulomb_Nm"]), 1.0, h, weight)
        stop = _soft(1.0 / (h * (h * STOP_STIFFNESS_NM_RAD + STOP_DAMPING_NMS_RAD)), STOP_STIFFNESS_NM_RAD, h, weight)
        return (f'<joint name="{name}" axis="{_v(joint["axis"])}" range="{_v(joint["limit_hard_rad"])}" '
                f'armature="{joint["armature_kgm2"]!r}" damping="{joint["friction_viscous_Nms_rad"]!r}" '
                f'frictionloss="{joint["friction_coulomb_Nm"]!r}" solreffriction="{friction[0]}" '
                f'solimpfriction="{friction[1]}" solreflimit="{stop[0]}" solimplimit="{stop[1]}"/>')

    def _geom(self, link: dict) -> str:
        low, high = link["box_min_L_m"], link["box_max_L_m"]
        box = (f'type="box" pos="{_v((a + b) / 2 for a, b in zip(low, high))}" '
               f'size="{_v((b - a) / 2 for a, b in zip(low, high))}"')
        if not link["name"].endswith("_foot"):
            return f"<geom {box}/>"
        solref, solimp = sole_softness(self.table, link["name"])
        return f'<geom name="{link["name"]}" class="sole" {box} solref="{solref}" solimp="{solimp}"/>'

    def actuators(self) -> list[str]:
        gains = zip(_default(self.table, "kp_Nm_rad"), _default(self.table, "kd_Nms_rad"))
        return [f'    <position name="{j["name"]}" joint="{j["name"]}" kp="{kp!r}" kv="{kd!r}" '
                f'forcerange="{-j["torque_peak_Nm"]!r} {j["torque_peak_Nm"]!r}"/>'
                for j, (kp, kd) in zip(self.robot["joints"], gains)]

    def keyframes(self) -> list[str]:
        """Each named posture with its soles on the floor, the middle of their ankle points at the origin."""
        keys = []
        for name, degrees in self.robot["postures_deg"].items():
            q_rad = {joint: math.radians(angle) for joint, angle in degrees.items()}
            poses = rigid.link_poses(self.robot, q_rad)
            axes, right = poses["r_foot"]
            middle = [(a + b) / 2 for a, b in zip(right, poses["l_foot"][1])]
            upright = rigid.transposed(axes)  # the soles of the named postures are parallel
            place = [-c for c in rigid.times(upright, middle)]
            place[2] += self.robot["feet"]["sole_height_below_ankle_m"]
            tree = [q_rad.get(j["name"], 0.0) for j in rigid.in_tree_order(self.robot)]
            control = [q_rad.get(j["name"], 0.0) for j in self.robot["joints"]]
            keys.append(f'    <key name="{name}" qpos="{_short([*place, *rigid.quaternion(upright), *tree])}" '
                        f'ctrl="{_short(control)}"/>')
        return keys


def _short(values: list[float]) -> str:
    """Twelve digits: enough for a posture, and the same on every machine."""
    return " ".join(f"{round(v, 12) + 0.0:.12g}" for v in values)


def mjcf(table: Table) -> str:
    writer, robot, h = _Writer(table), table.robot, table.tick_us * 1e-6
    writer.body(robot["base_link"], None, 2)
    elliptic = sole_softness(table, "r_foot", elliptic=True)
    mu, regulariser = _default(table, "friction_mu")[0], contact_regulariser(table)
    header = HEADER.format(h=h, k=_default(table, "contact_stiffness_N_m")[0],
                           d=_default(table, "contact_damping_Ns_m")[0], rate=FRICTION_RATE_RAD_S,
                           creep=2.0 * h * regulariser / (mu * mu), impratio=ELLIPTIC_IMPRATIO,
                           elliptic_creep=h * regulariser / ELLIPTIC_IMPRATIO,
                           elliptic=elliptic[1].split()[0], elliptic_k=elliptic[0].split()[0],
                           elliptic_b=elliptic[0].split()[1])
    gravity = _default(table, "gravity_m_s2")[0]
    lines = [f'<mujoco model="{robot["name"]}">',
             '  <compiler angle="radian" autolimits="true" inertiafromgeom="false"/>',
             f'  <option timestep="{h!r}" gravity="0 0 {-gravity!r}" integrator="implicitfast"/>',
             "  <default>",
             '    <geom contype="0" conaffinity="0" rgba="0.75 0.75 0.78 1"/>',
             '    <default class="sole">',
             f'      <geom conaffinity="1" condim="3" friction="{mu!r} 0 0" priority="1" rgba="0.3 0.3 0.32 1"/>',
             "    </default>",
             "  </default>",
             "  <worldbody>",
             '    <light pos="0 0 3" dir="0 0 -1"/>',
             '    <geom name="floor" type="plane" size="0 0 1" contype="1" rgba="0.9 0.9 0.88 1"/>',
             *writer.lines, "  </worldbody>",
             "  <actuator>", *writer.actuators(), "  </actuator>",
             "  <keyframe>", *writer.keyframes(), "  </keyframe>", "</mujoco>"]
    return header + "\n".join(lines) + "\n"
