"""The simulators of `bench plant`, all driven by the same recorded commands through loops in C."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from hoap2 import paths
from hoap2.bench.recording import Recording
from hoap2.binding import Plant
from hoap2.errors import UserError
from hoap2.generate import mjcf, tables

MODEL = paths.ROOT / "sim" / "model" / "hoap2_mjcf.xml"
AIR_M = 50.0  # soles above the floor
POINTER = ctypes.c_void_p


@lru_cache(maxsize=1)
def loops() -> ctypes.CDLL:
    """The step loops in C (sim/bench)."""
    library = ctypes.CDLL(str(paths.built("sim/bench/libhoap2_step_loops.so")))
    library.bench_plant.argtypes = [POINTER, POINTER, POINTER, ctypes.c_size_t, ctypes.c_int32, POINTER]
    library.bench_plant.restype = ctypes.c_int
    library.bench_mujoco.argtypes = [POINTER] * 5 + [ctypes.c_int32] * 2 + [POINTER]
    library.bench_mujoco.restype = None
    library.bench_call.argtypes = [POINTER] * 3 + [ctypes.c_int32, POINTER]
    library.bench_call.restype = None
    library.bench_clock_ns.argtypes = [ctypes.c_int32, POINTER]
    library.bench_clock_ns.restype = None
    return library


def clock_us(calls: int = 10000) -> float:
    """What timing costs in each duration."""
    ns = np.zeros(calls, dtype=np.int64)
    loops().bench_clock_ns(calls, ns.ctypes.data)
    return float(np.median(ns)) / 1e3


def import_mujoco():
    """The wheel, or how to get it."""
    try:
        import mujoco
    except ImportError as error:
        raise UserError(f"MuJoCo is not installed: {error}",
                        "./hoap2 bench plant installs it (host_tools/requirements/mujoco.txt)", 3) from None
    return mujoco


@dataclass
class Look:
    """Where a simulated robot is: CoM (m), cosine of the pelvis' tilt."""

    com_W_m: np.ndarray
    upright: float


class PlantSimulator:
    """This project's plant with one of its solvers."""

    def __init__(self, name: str, recording: Recording, air: bool, **values) -> None:
        self.name, self._recording = name, recording
        floating = {"gravity_m_s2": 0.0, "start_height_m": AIR_M} if air else {}
        self.plant = Plant(**(recording.plant_values | values | floating))
        self._step = ctypes.cast(self.plant._c.hoap2_plant_step, POINTER)

    def chunk(self, first: int, ns: np.ndarray) -> None:
        """Do ns.size ticks from `first` on; their durations."""
        rows = self._recording.rows
        if loops().bench_plant(self._step, self.plant._handle, rows[first:].ctypes.data, rows.shape[1], ns.size,
                               ns.ctypes.data):
            raise UserError(f"{self.name}: {self.plant._c.hoap2_plant_error(self.plant._handle).decode()}")

    def look(self) -> Look:
        self.plant.step(0)  # no tick: the outputs are read
        _, x, y, _ = self.plant.outputs.true_base_quat_W
        return Look(self.plant.outputs.true_com_W_m.copy(), float(1.0 - 2.0 * (x * x + y * y)))

    def outputs_us(self, calls: int = 2000) -> float:
        """What filling the output struct costs; it is a call of its own, after the step."""
        ns = np.zeros(calls, dtype=np.int64)
        function = ctypes.cast(self.plant._c.hoap2_plant_get_outputs, POINTER)
        loops().bench_call(function, self.plant._handle, self.plant.outputs.pointer, calls, ns.ctypes.data)
        return float(np.median(ns)) / 1e3


@dataclass(frozen=True)
class MujocoSettings:
    """What differs between MuJoCo's rows; all else is the model file, or MuJoCo's default (Newton, warm start)."""

    integrator: str
    elliptic: bool = False
    frictionloss: bool = True


class MujocoSimulator:
    """MuJoCo stepping sim/model/hoap2_mjcf.xml."""

    def __init__(self, name: str, settings: MujocoSettings, recording: Recording, air: bool, start: Plant) -> None:
        self.name, self._recording = name, recording
        self._mujoco = import_mujoco()
        self.model = load(settings, gravity=not air)
        self.data = self._mujoco.MjData(self.model)
        set_pose(self.model, self.data, start)
        library = next(Path(self._mujoco.__file__).parent.glob("libmujoco.so*"))
        self._step = ctypes.cast(ctypes.CDLL(str(library)).mj_step, POINTER)
        self.contacts: list[int] = []

    def chunk(self, first: int, ns: np.ndarray) -> None:
        """Do ns.size ticks from `first` on; their durations."""
        rows, data = self._recording.q_ref_rad, self.data
        loops().bench_mujoco(self._step, self.model._address, data._address, data.ctrl.ctypes.data,
                             rows[first:].ctypes.data, self.model.nu, ns.size, ns.ctypes.data)
        self.contacts.append(int(data.ncon))

    def look(self) -> Look:
        # mj_step leaves what it derives from the state a step behind it
        self._mujoco.mj_kinematics(self.model, self.data)
        self._mujoco.mj_comPos(self.model, self.data)
        return Look(self.data.subtree_com[0].copy(), float(self.data.xmat[1][8]))


def load(settings: MujocoSettings, gravity: bool = True):
    """The model as the benchmark steps it: without the boxes that are only for looking at."""
    mujoco = import_mujoco()
    spec = mujoco.MjSpec.from_file(str(MODEL))
    spec.compiler.discardvisual = True
    model = spec.compile()
    model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{settings.integrator.upper()}")
    if not gravity:
        model.opt.gravity[:] = 0.0
    if settings.elliptic:
        make_elliptic(model)
    if not settings.frictionloss:
        model.dof_frictionloss[:] = 0.0
    return model


def make_elliptic(model) -> None:
    """The elliptic cone as the model file's header gives it."""
    mujoco = import_mujoco()
    model.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    model.opt.impratio = mjcf.ELLIPTIC_IMPRATIO
    table = tables.load()
    for foot in ("r_foot", "l_foot"):
        solref, solimp = mjcf.sole_softness(table, foot, elliptic=True)
        index = model.geom(foot).id
        model.geom_solref[index] = [float(word) for word in solref.split()]
        model.geom_solimp[index, :3] = [float(word) for word in solimp.split()]


def set_pose(model, data, start: Plant) -> None:
    """The pose of a plant at rest."""
    data.qpos[:3] = start.outputs.true_base_pos_W_m
    data.qpos[3:7] = start.outputs.true_base_quat_W
    for joint, angle in zip(tables.load_robot()["joints"], start.outputs.true_q_rad):
        data.qpos[model.joint(joint["name"]).qposadr[0]] = angle
