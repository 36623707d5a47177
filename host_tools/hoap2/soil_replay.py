"""The soil of a run, worked out again from the motion in its log (sim/include/hoap2_render/soil_replay.h)."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Self

import numpy as np

from hoap2 import binding, parameters
from hoap2.errors import UserError
from hoap2.recording import Recording
from hoap2.renderer import GRID_DTYPE, Renderer, library

FULL_SCALES_m = (0.002, 0.005, 0.010, 0.020, 0.050, 0.100, 0.200)
_MOTION = ("true_base_pos_W_m", "true_base_quat_W", "true_q_rad")


@dataclass(frozen=True)
class Surface:
    """The ground at one moment, in the frame of the pool: rows along y, columns along x."""

    grid: np.ndarray  # one GRID_DTYPE: place and size
    height_m: np.ndarray  # without load, above the floor
    change_m: np.ndarray  # against the untouched surface


class Pool:
    """A fresh pool of soil through which the links are moved, a row of 1 ms at a time.

    plant: the resolved plant values of a run.
    """

    def __init__(self, plant: dict) -> None:
        self._handle = None
        self._lib = library()
        self._params = _parameters(plant)
        if self._lib.hoap2_soil_replay_params_size() != _size(self._params):
            raise UserError("the pictures were built from another signals.toml", "build again: ./hoap2 fmu build", 3)
        self._handle = self._lib.hoap2_soil_replay_create(self._params.pointer)
        if not self._handle:
            raise UserError(f"no soil: {self._lib.hoap2_soil_replay_error(None).decode()}")
        self.grid = np.zeros((), dtype=GRID_DTYPE)
        self._lib.hoap2_soil_replay_grid(self._handle, self.grid.ctypes.data)
        shape = (int(self.grid["ny"]), int(self.grid["nx"]))
        self._surface = Surface(self.grid, np.zeros(shape, np.float32), np.zeros(shape, np.float32))

    def restart(self) -> None:
        """Back to the fresh pool."""
        self._lib.hoap2_soil_replay_restart(self._handle)

    def advance(self, *motion: np.ndarray) -> None:
        """The next rows: true_base_pos_W_m (n, 3), true_base_quat_W (n, 4), true_q_rad (n, 25), contiguous.

        Where the run could not have gone on (a foot left the pool) the ground stays as it was.
        """
        self._lib.hoap2_soil_replay_advance(self._handle, len(motion[0]), *(part.ctypes.data for part in motion))

    def look(self) -> Surface:
        """The ground now; the same arrays each time."""
        self._lib.hoap2_soil_replay_surface(self._handle, self._surface.height_m.ctypes.data,
                                            self._surface.change_m.ctypes.data)  # fmt: skip
        return self._surface

    @property
    def note(self) -> str:
        """Why the replay stands still, or nothing."""
        return self._lib.hoap2_soil_replay_error(self._handle).decode()

    def close(self) -> None:
        """Free it."""
        if self._handle:
            self._lib.hoap2_soil_replay_destroy(self._handle)
            self._handle = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()


class SoilReplay(Pool):
    """Moves the links through a fresh pool, forward through the rows of a run."""

    def __init__(self, run: Recording) -> None:
        super().__init__(run.plant)
        self._motion = [np.ascontiguousarray(run.signal[name], dtype=np.float64) for name in _MOTION]
        self._done = 0  # rows that were replayed
        self.full_scale_m = full_scale_m(run)

    def surface(self, row: int) -> Surface:
        """The ground at a row of the run; the same arrays each time. Going forward costs only the rows between."""
        if not 0 <= row < len(self._motion[0]):
            raise IndexError(f"row {row} of {len(self._motion[0])}")
        if row + 1 < self._done:
            self.restart()
            self._done = 0
        self.advance(*(block[self._done : row + 1] for block in self._motion))
        self._done = row + 1
        return self.look()

    def show(self, camera: Renderer, row: int) -> None:
        """The ground at a row in the camera's next pictures."""
        surface = self.surface(row)
        camera.set_soil(surface.grid, surface.height_m, surface.change_m, self.full_scale_m)


def of_run(run: Recording) -> SoilReplay | None:
    """The replay of a run on soil; None on the rigid floor."""
    return SoilReplay(run) if run.on_soil else None


def _parameters(values: dict) -> binding.Signals:
    """hoap2_plant_params_t of a run's plant values."""
    block = binding.Signals(parameters.table().select("plant", "parameter"))
    for name in block:
        if name in values:
            view = block.view(name)
            view[...] = np.reshape(parameters.check("plant", name, values[name]), view.shape)
    return block


def _size(block: binding.Signals) -> int:
    reals, ints = block.flat()
    return reals.nbytes + 8 * -(-ints.nbytes // 8)


def full_scale_m(run: Recording) -> float:
    """End of the colour scale: a round depth that the soles' mean sinkage stays within."""
    depth_m = run.signal.get("true_sinkage_m")
    deepest_m = float(np.nanmax(depth_m)) if depth_m is not None and np.isfinite(depth_m).any() else 0.0
    fitting = [scale for scale in FULL_SCALES_m if scale >= deepest_m]
    return fitting[0] if deepest_m > 0.0 and fitting else (FULL_SCALES_m[-1] if deepest_m > 0.0 else 0.010)
