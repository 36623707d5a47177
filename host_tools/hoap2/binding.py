"""Controller and plant in Python without FMI: thin ctypes over their C interfaces.

    from hoap2 import Controller, Plant, exchange

    controller = Controller(step_length_m=0.02)
    plant = Plant(seed=3, sensor_preset="ideal")
    for _ in range(2000):            # 2 s
        exchange(controller, plant)  # each gets the other's outputs (Jacobi)
        controller.step()
        plant.step()
    print(plant.outputs.true_com_W_m, controller.outputs.mode)

Signals are attributes named as in docs/generated/signals.md (SI units, angles in rad). An array is a numpy view
of the C struct, so it can be written in place and changes with the next step: copy it to keep it.
"""

from __future__ import annotations

import ctypes
import math
from functools import lru_cache
from pathlib import Path

import numpy as np

from hoap2 import parameters, paths
from hoap2.errors import UserError, nearest
from hoap2.generate.tables import Signal

GUARD_BYTES = 4096  # behind each struct: a library of another table would write there, not into Python's memory
GUARD = 0xA5


class Signals:
    """One C struct of signals: each row of the table is an attribute.

    A scalar reads as a float or an int, an array as a numpy view of its shape; both can be assigned.
    """

    def __init__(self, rows: list[Signal]) -> None:
        reals = sum(s.count for s in rows if s.kind == "real")
        ints = sum(s.count for s in rows if s.kind == "int")
        # doubles first, then int32: the C struct has no gaps, only a tail up to the alignment of double
        size = 8 * reals + 8 * math.ceil(ints / 2)
        block = np.full(size + GUARD_BYTES, GUARD, dtype=np.uint8)
        block[:size] = 0
        views, offset = {}, 0
        for s in rows:
            dtype = np.dtype(np.float64 if s.kind == "real" else np.int32)
            end = offset + s.count * dtype.itemsize
            views[s.name] = block[offset:end].view(dtype).reshape(s.shape)
            views[s.name][...] = np.reshape(np.array(s.default, dtype=dtype), s.shape)
            offset = end
        object.__setattr__(self, "_rows", {s.name: s for s in rows})
        object.__setattr__(self, "_views", views)
        object.__setattr__(self, "_block", block)
        object.__setattr__(self, "_guard", block[size:])
        object.__setattr__(self, "_flat", (block[: 8 * reals].view(np.float64),
                                           block[8 * reals : 8 * reals + 4 * ints].view(np.int32)))
        object.__setattr__(self, "pointer", ctypes.c_void_p(block.ctypes.data))

    def view(self, name: str) -> np.ndarray:
        """The numpy view of a signal (a scalar has shape ())."""
        if name not in self._views:
            raise AttributeError(f"no signal {name!r} here; {nearest(name, self._views) or 'see dir()'}")
        return self._views[name]

    def flat(self) -> tuple[np.ndarray, np.ndarray]:
        """All reals and all ints as two flat views, in the order of the table."""
        return self._flat

    def __getattr__(self, name: str):
        if name.startswith("_"):
            raise AttributeError(name)
        view = self.view(name)
        return view if view.shape else view.item()

    def __setattr__(self, name: str, value) -> None:
        self.view(name)[...] = value

    def __dir__(self):
        return [*self._views, "describe", "flat", "to_dict", "view"]

    def __iter__(self):
        return iter(self._views)

    def __repr__(self) -> str:
        return "\n".join(f"{name} = {getattr(self, name)}" for name in self._views)

    def describe(self, name: str) -> str:
        """Shape, unit and meaning of a signal."""
        self.view(name)
        s = self._rows[name]
        return f"{name} {list(s.shape) or ''} [{s.unit}]: {s.text}".replace("  ", " ")

    def to_dict(self) -> dict[str, np.ndarray | float | int]:
        """A copy of every signal by name."""
        return {name: view.copy() if view.shape else view.item() for name, view in self._views.items()}

    def check_guard(self, library: Path) -> None:
        """Raise when the library wrote beyond the struct that this table describes."""
        if not (self._guard == GUARD).all():
            raise UserError(f"{library} was built from another signals.toml", "build again: ./hoap2 fmu build", 3)


@lru_cache(maxsize=8)
def _load(path: str) -> ctypes.CDLL:
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise UserError(f"cannot load the library: {error}", "build again: ./hoap2 fmu build", 3) from None
    size_t, pointer, int32 = ctypes.c_size_t, ctypes.c_void_p, ctypes.c_int32
    signatures = {
        "hoap2_state_size": (size_t, []), "hoap2_init": (int32, [pointer, pointer]),
        "hoap2_tune": (int32, [pointer, pointer]), "hoap2_step": (None, [pointer, pointer, pointer]),
        "hoap2_get_outputs": (None, [pointer, pointer]),
        "hoap2_plant_create": (pointer, []), "hoap2_plant_destroy": (None, [pointer]),
        "hoap2_plant_init": (ctypes.c_int, [pointer, pointer]), "hoap2_plant_step": (ctypes.c_int, [pointer, pointer]),
        "hoap2_plant_get_outputs": (None, [pointer, pointer]), "hoap2_plant_state_size": (size_t, [pointer]),
        "hoap2_plant_get_state": (None, [pointer, pointer]),
        "hoap2_plant_set_state": (ctypes.c_int, [pointer, pointer, size_t]),
        "hoap2_plant_error": (ctypes.c_char_p, [pointer]),
    }
    for name, (result, arguments) in signatures.items():
        if hasattr(library, name):
            getattr(library, name).restype, getattr(library, name).argtypes = result, arguments
    return library


class _Product:
    """What controller and plant have in common: the three structs and the parameters."""

    _product = ""

    def __init__(self, library: Path, values: dict) -> None:
        select = parameters.table().select
        self.library = library
        self._c = _load(str(library))
        self.inputs = Signals(select(self._product, "input"))
        self.outputs = Signals(select(self._product, "output"))
        self.parameters = Signals(select(self._product, "parameter"))
        self._set(self.parameters, values)

    def _set(self, block: Signals, values: dict) -> None:
        for name, value in values.items():
            value = value.tolist() if isinstance(value, np.ndarray | np.generic) else value
            flat = parameters.check(self._product, name, list(value) if isinstance(value, tuple) else value)
            view = block.view(name)
            view[...] = np.reshape(flat, view.shape)


class Controller(_Product):
    """The firmware: `step()` is one tick of 1 ms.

    Controller(step_length_m=0.02, behaviour="walk_cp"): any controller parameter of docs/generated/signals.md; the
    others keep their defaults. `inputs` and `outputs` are the signals, `parameters` what it was started with.
    """

    _product = "controller"

    def __init__(self, *, library: Path | None = None, **values) -> None:
        super().__init__(library or paths.controller_library(), values)
        self._state = ctypes.create_string_buffer(self._c.hoap2_state_size())
        self.reset()

    def reset(self) -> None:
        """Start again from `parameters`."""
        fault = self._c.hoap2_init(self._state, self.parameters.pointer)
        self._c.hoap2_get_outputs(self._state, self.outputs.pointer)
        self.outputs.check_guard(self.library)
        if fault:
            table = parameters.table()
            said = [f"{table.fault_texts[name]} (fault {name})" for name, bit in table.faults.items() if fault & bit]
            raise UserError(f"the controller refuses these parameters: {'; '.join(said)}")

    def step(self, ticks: int = 1) -> None:
        """Do ticks of 1 ms with the inputs held."""
        for _ in range(ticks):
            self._c.hoap2_step(self._state, self.inputs.pointer, self.outputs.pointer)

    def tune(self, **values) -> None:
        """Change tunable parameters between ticks."""
        fixed = [n for n in values if n in self.parameters and not parameters.known("controller")[n].tunable]
        if fixed:
            raise UserError(f"{', '.join(fixed)} cannot change after the start", "make a new Controller")
        before = self.parameters._block.copy()
        self._set(self.parameters, values)
        if self._c.hoap2_tune(self._state, self.parameters.pointer):
            self.parameters._block[...] = before
            raise UserError("the controller refuses these values; nothing changed")

    def save(self) -> bytes:
        """The whole state; `restore` continues from it bit for bit."""
        return self._state.raw

    def restore(self, state: bytes) -> None:
        """Go back to a saved state; the outputs are those of that moment."""
        if len(state) != len(self._state):
            raise UserError(f"not a state of this controller: {len(state)} bytes, not {len(self._state)}")
        self._state.raw = state
        self._c.hoap2_get_outputs(self._state, self.outputs.pointer)

    @property
    def time_s(self) -> float:
        """Ticks done since the start, in seconds."""
        return self.outputs.tick * 1e-3


class Plant(_Product):
    """The robot, its drives and sensors, terrain and pushes in ODE: `step()` is one tick of 1 ms.

    Plant(seed=3, friction_mu=0.5): any plant parameter of docs/generated/signals.md.
    """

    _product = "plant"

    def __init__(self, *, library: Path | None = None, **values) -> None:
        super().__init__(library or paths.plant_library(), values)
        self._handle = self._c.hoap2_plant_create()
        if not self._handle:
            raise MemoryError("no memory for a plant")
        self.reset()

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self._c.hoap2_plant_destroy(self._handle)
            self._handle = None

    def _check(self, result: int) -> None:
        if result:
            raise UserError(f"plant: {self._c.hoap2_plant_error(self._handle).decode() or 'failed'}")

    def _get_outputs(self) -> None:
        self._c.hoap2_plant_get_outputs(self._handle, self.outputs.pointer)

    def reset(self) -> None:
        """Start again from `parameters`."""
        self._check(self._c.hoap2_plant_init(self._handle, self.parameters.pointer))
        self._get_outputs()
        self.outputs.check_guard(self.library)

    def step(self, ticks: int = 1) -> None:
        """Do ticks of 1 ms with the inputs held."""
        for _ in range(ticks):
            self._check(self._c.hoap2_plant_step(self._handle, self.inputs.pointer))
        self._get_outputs()

    def save(self) -> bytes:
        """The whole state; `restore` continues from it bit for bit."""
        state = ctypes.create_string_buffer(self._c.hoap2_plant_state_size(self._handle))
        self._c.hoap2_plant_get_state(self._handle, state)
        return state.raw

    def restore(self, state: bytes) -> None:
        """Go back to a saved state; the outputs are those of that moment."""
        self._check(self._c.hoap2_plant_set_state(self._handle, state, len(state)))
        self._get_outputs()

    @property
    def time_s(self) -> float:
        """Ticks done since the start, in seconds."""
        return self.outputs.plant_tick * 1e-3


@lru_cache(maxsize=1)
def _shared_names() -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Signals that carry one name on both sides: plant to controller, controller to plant."""
    names = {(p, g): {s.name for s in parameters.table().select(p, g)}
             for p in ("controller", "plant") for g in ("input", "output")}
    return (tuple(sorted(names["plant", "output"] & names["controller", "input"])),
            tuple(sorted(names["controller", "output"] & names["plant", "input"])))


def exchange(controller: Controller, plant: Plant) -> None:
    """Give each the present outputs of the other; both may then step in any order (Jacobi)."""
    to_controller, to_plant = _shared_names()
    for name in to_controller:
        controller.inputs.view(name)[...] = plant.outputs.view(name)
    for name in to_plant:
        plant.inputs.view(name)[...] = controller.outputs.view(name)
