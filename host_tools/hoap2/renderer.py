"""The robot as a picture: ctypes over libhoap2_render.so (sim/include/hoap2_render/render.h)."""

from __future__ import annotations

import ctypes
import os
from functools import lru_cache
from pathlib import Path
from typing import Self

import numpy as np

from hoap2 import paths
from hoap2.errors import UserError

MAX_FOOTPRINTS, MAX_BLOCKS, JOINTS, LINKS = 128, 16, 25, 26
FOV_Y_RAD = 0.5
SHOW_COM, SHOW_COP, SHOW_CP, SHOW_FOOTPRINTS, SHOW_PUSH, SHOW_SHADOW, SHOW_SINKAGE = 1, 2, 4, 8, 16, 32, 64
SHOW_ALL = 127

_REALS = [
    ("base_pos_W_m", (3,)), ("base_quat_W", (4,)), ("q_rad", (JOINTS,)), ("com_W_m", (3,)), ("cop_W_m", (2,)),
    ("cp_W_m", (2,)), ("footprint_W_m_rad", (MAX_FOOTPRINTS, 3)), ("floor_tilt_rad", (2,)),
    ("floor_origin_W_m", (3,)), ("block_centre_W_m", (MAX_BLOCKS, 3)), ("block_size_m", (MAX_BLOCKS, 3)),
    ("block_yaw_W_rad", (MAX_BLOCKS,)), ("push_force_W_N", (3,)), ("push_point_W_m", (3,)),
    ("camera_target_W_m", (3,)), ("camera_distance_m", ()), ("camera_azimuth_rad", ()),
    ("camera_elevation_rad", ()),
]  # fmt: skip
_INTS = [("footprint_left", (MAX_FOOTPRINTS,)), ("footprint_count", ()), ("block_count", ()), ("show", ())]
SCENE_DTYPE = np.dtype(
    [(name, np.float64, shape) for name, shape in _REALS] + [(name, np.int32, shape) for name, shape in _INTS],
    align=True,
)

# hoap2_soil_grid_t: place and size of a pool of soil.
GRID_DTYPE = np.dtype(
    [("origin_W_m", np.float64, (3,)), ("axes_W", np.float64, (3, 3)), ("low_x_m", np.float64),
     ("low_y_m", np.float64), ("cell_m", np.float64), ("depth_m", np.float64), ("nx", np.int32), ("ny", np.int32)],
    align=True,
)  # fmt: skip

# hoap2_mesh_vertex_t of sim/include/hoap2_render/robot_mesh.h.
VERTEX_DTYPE = np.dtype(
    [("pos_L_m", np.float32, (3,)), ("normal_L", np.float32, (3,)), ("albedo", np.float32, (3,)),
     ("gloss", np.float32), ("link", np.float32)]
)  # fmt: skip


class Scene:
    """What is to be drawn. Every field of hoap2_scene_t is an attribute (numbers and numpy views)."""

    def __init__(self) -> None:
        object.__setattr__(self, "_data", np.zeros((), dtype=SCENE_DTYPE))
        self.base_quat_W = [1.0, 0.0, 0.0, 0.0]
        self.com_W_m = self.cop_W_m = self.cp_W_m = np.nan
        self.camera_target_W_m = [0.0, 0.0, 0.22]
        self.camera_distance_m, self.camera_azimuth_rad, self.camera_elevation_rad = 1.6, 0.7, 0.2
        self.show = SHOW_ALL

    def __getattr__(self, name: str):
        if name.startswith("_") or name not in SCENE_DTYPE.names:
            raise AttributeError(f"a scene has no {name!r}; it has {', '.join(SCENE_DTYPE.names)}")
        view = self._data[name]
        return view if view.shape else view.item()

    def __setattr__(self, name: str, value) -> None:
        self.__getattr__(name)
        self._data[name] = value

    def copy(self) -> Scene:
        """An independent scene with the same content."""
        other = Scene()
        object.__setattr__(other, "_data", self._data.copy())
        return other

    def add_footprint(self, x_W_m: float, y_W_m: float, yaw_W_rad: float, left: bool) -> None:
        """One more sole outline; the oldest is dropped when there is no room."""
        if self.footprint_count == MAX_FOOTPRINTS:
            self.footprint_W_m_rad[:-1] = self.footprint_W_m_rad[1:].copy()
            self.footprint_left[:-1] = self.footprint_left[1:].copy()
            self.footprint_count = MAX_FOOTPRINTS - 1
        n = self.footprint_count
        self.footprint_W_m_rad[n] = (x_W_m, y_W_m, yaw_W_rad)
        self.footprint_left[n] = int(left)
        self.footprint_count = n + 1

    def link_pose(self, link: int) -> np.ndarray:
        """Pose of a link as it is drawn: 3x4, [R | p], world frame."""
        pose = np.zeros((3, 4))
        if library().hoap2_render_link_pose(self.pointer, link, pose.ctypes.data_as(ctypes.c_void_p)) != 0:
            raise ValueError(f"no link {link}: 0 to {LINKS - 1}")
        return pose

    @property
    def pointer(self) -> ctypes.c_void_p:
        """For the C interface."""
        return ctypes.c_void_p(self._data.ctypes.data)


def library_path() -> Path:
    """HOAP2_RENDER_LIBRARY, or the library of this build."""
    override = os.environ.get("HOAP2_RENDER_LIBRARY")
    return Path(override) if override else paths.built("sim/render/libhoap2_render.so")


@lru_cache(maxsize=1)
def library() -> ctypes.CDLL:
    """The loaded library, its layout checked against this module."""
    path = library_path()
    try:
        lib = ctypes.CDLL(str(path))
    except OSError as error:
        raise UserError(f"cannot load {path}: {error}", "is libosmesa6 installed? ./hoap2 setup installs it",
                        exit_code=3) from None  # fmt: skip
    pointer, real = ctypes.c_void_p, ctypes.c_int32
    lib.hoap2_render_create.restype, lib.hoap2_render_create.argtypes = pointer, [real, real, real]
    lib.hoap2_render_destroy.restype, lib.hoap2_render_destroy.argtypes = None, [pointer]
    lib.hoap2_render_draw.argtypes = [pointer, pointer, pointer]
    lib.hoap2_render_project.argtypes = [pointer, pointer, pointer, pointer]
    lib.hoap2_render_link_pose.argtypes = [pointer, real, pointer]
    lib.hoap2_render_error.restype, lib.hoap2_render_error.argtypes = ctypes.c_char_p, [pointer]
    lib.hoap2_render_set_soil.argtypes = [pointer, pointer, pointer, pointer, ctypes.c_double]
    lib.hoap2_render_scene_size.restype = ctypes.c_size_t
    lib.hoap2_render_robot_mesh_size.argtypes = [real, ctypes.POINTER(real), ctypes.POINTER(real)]
    lib.hoap2_render_robot_mesh.argtypes = [real, pointer, pointer]
    _declare_replay(lib)
    sizes = (lib.hoap2_render_scene_size(), lib.hoap2_soil_replay_grid_size())
    if sizes != (SCENE_DTYPE.itemsize, GRID_DTYPE.itemsize):
        raise UserError(f"{path} is of another version than these tools", "build it again: ./hoap2 fmu build",
                        exit_code=3)  # fmt: skip
    return lib


def _declare_replay(lib: ctypes.CDLL) -> None:
    """Types of sim/include/hoap2_render/soil_replay.h."""
    pointer = ctypes.c_void_p
    lib.hoap2_soil_replay_create.restype, lib.hoap2_soil_replay_create.argtypes = pointer, [pointer]
    lib.hoap2_soil_replay_destroy.restype, lib.hoap2_soil_replay_destroy.argtypes = None, [pointer]
    lib.hoap2_soil_replay_restart.restype, lib.hoap2_soil_replay_restart.argtypes = None, [pointer]
    lib.hoap2_soil_replay_advance.argtypes = [pointer, ctypes.c_int64, pointer, pointer, pointer]
    lib.hoap2_soil_replay_grid.restype, lib.hoap2_soil_replay_grid.argtypes = None, [pointer, pointer]
    lib.hoap2_soil_replay_surface.restype, lib.hoap2_soil_replay_surface.argtypes = None, [pointer] * 3
    lib.hoap2_soil_replay_error.restype, lib.hoap2_soil_replay_error.argtypes = ctypes.c_char_p, [pointer]
    lib.hoap2_soil_replay_params_size.restype = lib.hoap2_soil_replay_grid_size.restype = ctypes.c_size_t


def robot_mesh(coarse: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """The robot's surface in link coordinates: vertices (VERTEX_DTYPE) and triangles (n, 3).

    coarse: fewer triangles and no small parts.
    """
    vertices, indices = ctypes.c_int32(), ctypes.c_int32()
    failed = library().hoap2_render_robot_mesh_size(coarse, ctypes.byref(vertices), ctypes.byref(indices))
    vertex, index = np.empty(vertices.value, dtype=VERTEX_DTYPE), np.empty((indices.value // 3, 3), dtype=np.uint32)
    if failed or library().hoap2_render_robot_mesh(coarse, vertex.ctypes.data, index.ctypes.data) != 0:
        raise UserError("no robot to draw: out of memory")
    return vertex, index


class Renderer:
    """Draws scenes of one size. samples: 4 smooths edges, 1 is faster."""

    def __init__(self, width: int, height: int, samples: int = 4) -> None:
        self._handle = None
        self.width, self.height = width, height
        self._lib = library()
        self._handle = self._lib.hoap2_render_create(width, height, samples)
        if not self._handle:
            raise UserError(f"no picture: {self._lib.hoap2_render_error(None).decode()}")

    def draw(self, scene: Scene, out: np.ndarray | None = None) -> np.ndarray:
        """The picture, (height, width, 3) uint8, top row first."""
        shape = (self.height, self.width, 3)
        rgb = np.empty(shape, dtype=np.uint8) if out is None else out
        if rgb.shape != shape or rgb.dtype != np.uint8 or not rgb.flags.c_contiguous:
            raise ValueError(f"out must be a contiguous uint8 array of shape {shape}")
        if self._lib.hoap2_render_draw(self._open(), scene.pointer, rgb.ctypes.data_as(ctypes.c_void_p)) != 0:
            raise UserError(f"no picture: {self._lib.hoap2_render_error(self._handle).decode()}")
        return rgb

    def set_soil(self, grid: np.ndarray | None, height_m=None, change_m=None, full_scale_m: float = 0.01) -> None:
        """The soil of the next pictures (see hoap2_render_set_soil); None: none."""
        if grid is None:
            self._lib.hoap2_render_set_soil(self._open(), None, None, None, 1.0)
            return
        fields = [np.ascontiguousarray(field, dtype=np.float32) for field in (height_m, change_m)]
        if any(field.shape != (int(grid["ny"]), int(grid["nx"])) for field in fields):
            raise ValueError(f"height_m and change_m must have {grid['ny']} rows of {grid['nx']} cells")
        if self._lib.hoap2_render_set_soil(self._open(), grid.ctypes.data, fields[0].ctypes.data,
                                           fields[1].ctypes.data, full_scale_m) != 0:  # fmt: skip
            raise UserError(f"no picture: {self._lib.hoap2_render_error(self._handle).decode()}")

    def project(self, scene: Scene, point_W_m) -> tuple[float, float, float] | None:
        """Column and row (pixels from the top left) and depth (m) of a point; None behind the camera."""
        point, answer = np.array(point_W_m, dtype=np.float64), np.zeros(3)
        failed = self._lib.hoap2_render_project(self._open(), scene.pointer, point.ctypes.data_as(ctypes.c_void_p),
                                                answer.ctypes.data_as(ctypes.c_void_p))  # fmt: skip
        return None if failed else (float(answer[0]), float(answer[1]), float(answer[2]))

    def _open(self) -> int:
        if not self._handle:
            raise ValueError("this renderer is closed")
        return self._handle

    def close(self) -> None:
        """Free the context; drawing is over."""
        if self._handle:
            self._lib.hoap2_render_destroy(self._handle)
            self._handle = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()
