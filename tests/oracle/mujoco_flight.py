"""The whole robot in free flight: in the plant, and in MuJoCo as the reference.

The plant's tick is 1 ms and cannot be changed, but without gravity's clock it need not be: a free motion with all
rates divided by s, torques and stiffnesses by s^2 and dampings by s is the same motion, s times slower. Run for s
times as many ticks, it is the motion stepped with 1 ms / s. So the plant's own error can be halved and halved again.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np

from hoap2.binding import Plant
from hoap2.generate import tables

OFF, POSITION, TORQUE = 0, 1, 2  # drive modes
TICK_S = 1e-3
REFERENCE_STEP_S = 1e-4
DURATION_S = 1.0
LOOKS = 20  # poses compared along the way
JOINTS = [joint["name"] for joint in tables.load_robot()["joints"]]


@dataclass
class Flight:
    """A free motion. Joints that are not stiff are passive; torques act on them during the first `push_s`."""

    posture_rad: dict[str, float]
    omega_W_rad_s: tuple[float, float, float]
    gravity_m_s2: float = 0.0
    passive: tuple[str, ...] = tuple(JOINTS)
    torque_Nm: dict[str, float] = field(default_factory=dict)
    push_s: float = 0.1

    def vector(self, values: dict[str, float]) -> np.ndarray:
        return np.array([values.get(name, 0.0) for name in JOINTS])

    @property
    def stiff(self) -> np.ndarray:
        return np.array([name not in self.passive for name in JOINTS])


@dataclass
class Motion:
    """Poses at equal times: pelvis position (m) and orientation (quaternion), joint angles (rad)."""

    pos_W_m: np.ndarray
    quat_W: np.ndarray
    q_rad: np.ndarray

    def off(self, other: Motion) -> Motion:
        """Differences: position; rotation vector; joint angles."""
        turned = np.array([_rotation_between(a, b) for a, b in zip(self.quat_W, other.quat_W)])
        return Motion(self.pos_W_m - other.pos_W_m, turned, self.q_rad - other.q_rad)

    def vector(self) -> np.ndarray:
        """Of differences: everything as one row a time."""
        return np.hstack([self.pos_W_m, self.quat_W, self.q_rad])


def _rotation_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Rotation vector (rad) that takes orientation b to a."""
    turned = np.zeros(4)
    mujoco.mju_mulQuat(turned, a, b * [1.0, -1.0, -1.0, -1.0])
    vector = np.zeros(3)
    mujoco.mju_quat2Vel(vector, turned, 1.0)
    return vector


def plant_of(flight: Flight, solver: str, slower: int) -> Plant:
    """Far above the floor, without friction in the joints."""
    plant = Plant(solver=solver, sensor_preset="ideal", start_height_m=50.0, joint_friction_scale=0.0,
                  gravity_m_s2=flight.gravity_m_s2 / slower**2, start_posture_rad=flight.vector(flight.posture_rad),
                  start_omega_W_rad_s=np.array(flight.omega_W_rad_s) / slower)
    plant.inputs.q_ref_rad = plant.outputs.true_q_rad
    plant.inputs.drive_mode = np.where(flight.stiff, POSITION, TORQUE)
    plant.inputs.kp_Nm_rad = plant.inputs.kp_Nm_rad / slower**2
    plant.inputs.kd_Nms_rad = plant.inputs.kd_Nms_rad / slower
    return plant


def fly_plant(flight: Flight, solver: str, slower: int = 1) -> Motion:
    """The motion stepped with 1 ms / slower."""
    plant = plant_of(flight, solver, slower)
    between = round(DURATION_S / TICK_S * slower / LOOKS)
    push_ticks = round(flight.push_s / TICK_S * slower)
    torque = flight.vector(flight.torque_Nm) / slower**2
    poses = []
    for k in range(LOOKS * between + 1):
        if k % between == 0:
            out = plant.outputs
            poses.append((out.true_base_pos_W_m.copy(), out.true_base_quat_W.copy(), out.true_q_rad.copy()))
        plant.inputs.tau_ff_Nm = torque if k < push_ticks else 0.0
        plant.step()
    return Motion(*(np.array(column) for column in zip(*poses)))


def model_of(flight: Flight, path: str, integrator: int, step_s: float) -> mujoco.MjModel:
    """The MJCF without floor, stops and joint friction; the passive joints without drives."""
    model = mujoco.MjModel.from_xml_path(path)
    model.opt.integrator, model.opt.timestep = integrator, step_s
    model.opt.gravity[:] = (0.0, 0.0, -flight.gravity_m_s2)
    model.dof_frictionloss[:] = 0.0
    model.dof_damping[:] = 0.0
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT
    for i, stiff in enumerate(flight.stiff):
        if not stiff:
            model.actuator_gainprm[i] = model.actuator_biasprm[i] = 0.0
    return model


def fly_mujoco(flight: Flight, path: str, integrator: int, step_s: float) -> Motion:
    """The same start as the plant's, stepped by MuJoCo."""
    model = model_of(flight, path, integrator, step_s)
    data = mujoco.MjData(model)
    start = plant_of(flight, "ode", 1).outputs
    q_at = [model.joint(name).qposadr[0] for name in JOINTS]
    v_at = [model.joint(name).dofadr[0] for name in JOINTS]
    data.qpos[:3], data.qpos[3:7], data.qpos[q_at] = start.true_base_pos_W_m, start.true_base_quat_W, start.true_q_rad
    data.ctrl[:] = start.true_q_rad
    data.qvel[:3] = start.true_base_vel_W_m_s
    inverse = start.true_base_quat_W * [1.0, -1.0, -1.0, -1.0]
    mujoco.mju_rotVecQuat(data.qvel[3:6], start.true_base_omega_W_rad_s, inverse)  # a free joint spins in its own axes
    between = round(DURATION_S / step_s / LOOKS)
    push_steps = round(flight.push_s / step_s)
    poses = []
    for k in range(LOOKS * between + 1):
        if k % between == 0:
            poses.append((data.qpos[:3].copy(), data.qpos[3:7].copy(), data.qpos[q_at].copy()))
        data.qfrc_applied[v_at] = flight.vector(flight.torque_Nm) if k < push_steps else 0.0
        mujoco.mj_step(model, data)
    return Motion(*(np.array(column) for column in zip(*poses)))
