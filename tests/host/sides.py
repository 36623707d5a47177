"""Sides of a run without FMUs: scripted fakes, and the libraries behind the Python binding."""

from __future__ import annotations

import math

import numpy as np

from hoap2 import parameters
from hoap2.signal_log import Column


def _columns(product: str, group: str) -> list[Column]:
    table = parameters.table()
    return [Column(e, s.unit, s.kind) for s in table.select(product, group) for e in table.element_names(s)]


class FakeSide:
    """A product whose outputs a function writes: script(side, tick) is called once a tick."""

    def __init__(self, product: str, script=None) -> None:
        self.outputs, self.inputs = _columns(product, "output"), _columns(product, "input")
        self.script = script or (lambda side, tick: None)
        self.tick = 0
        places = [(group, kind) for group in ("inputs", "outputs") for kind in ("real", "int")]
        sizes = {(g, k): sum(c.kind == k for c in getattr(self, g)) for g, k in places}
        self.real_out, self.int_out = np.zeros(sizes["outputs", "real"]), np.zeros(sizes["outputs", "int"], np.int32)
        self.real_in, self.int_in = np.zeros(sizes["inputs", "real"]), np.zeros(sizes["inputs", "int"], np.int32)
        self._where = {}
        for kind, data in (("real", self.real_out), ("int", self.int_out)):
            for i, column in enumerate([c for c in self.outputs if c.kind == kind]):
                self._where[column.name] = (data, i)

    def put(self, name: str, value) -> None:
        """Write a whole output of the table."""
        product_rows = {s.name: s for p in ("controller", "plant") for s in parameters.table().select(p, "output")}
        elements = parameters.table().element_names(product_rows[name])
        for element, number in zip(elements, np.broadcast_to(np.ravel(value), (len(elements),))):
            data, index = self._where[element]
            data[index] = number

    def get_outputs(self) -> None:
        pass

    def set_inputs(self) -> None:
        pass

    def step(self) -> None:
        self.tick += 1
        self.script(self, self.tick)


def standing_plant(script=None) -> FakeSide:
    """A plant that stands still on two soles at its start."""
    side = FakeSide("plant", script)
    side.put("true_foot_pos_W_m", [0, -0.039, 0, 0, 0.039, 0])
    side.put("true_foot_force_W_N", [0, 0, 34.5, 0, 0, 34.5])
    side.put("true_com_W_m", [0.009, 0, 0.2575])
    side.put("true_base_quat_W", [1, 0, 0, 0])
    return side


def falling_plant(start_tick: int, rate_rad_s: float = 2.0, axis: int = 1, sign: float = 1.0) -> FakeSide:
    """Tilts about one axis from a tick on."""

    def script(side: FakeSide, tick: int) -> None:
        rpy = [0.0, 0.0, 0.0]
        rpy[axis] = sign * max(0, tick - start_tick) * 1e-3 * rate_rad_s
        side.put("true_chest_rpy_rad", rpy)

    return standing_plant(script)


def stepping_controller(step_ticks: int = 400, lead_ticks: int = 1400, steps: int = 36) -> FakeSide:
    """Counts steps as the walk would."""

    def script(side: FakeSide, tick: int) -> None:
        index = min(steps, max(0, math.ceil((tick - lead_ticks) / step_ticks)))
        walking = lead_ticks < tick <= lead_ticks + steps * step_ticks
        done = min(steps, max(0, (tick - lead_ticks) // step_ticks))
        modes, phases = parameters.table().enums["mode"], parameters.table().enums["phase"]
        side.put("mode", modes.index("walk" if walking else "calibrate" if tick < 1000 else "stand"))
        side.put("phase", phases.index("single_support" if walking else "stand"))
        side.put("step_index", index)
        side.put("steps_done", done)
        side.put("walk_done", int(done == steps))

    return FakeSide("controller", script)


class LibrarySide:
    """A product through the binding: the same numbers as its FMU, without FMI."""

    def __init__(self, instance) -> None:
        self.instance = instance
        product = type(instance).__name__.lower()
        self.outputs, self.inputs = _columns(product, "output"), _columns(product, "input")
        self.real_out, self.int_out = self._split(instance.outputs._block, self.outputs)
        self.real_in, self.int_in = self._split(instance.inputs._block, self.inputs)
        self.get_outputs = self.set_inputs = lambda: None
        self.step = instance.step

    @staticmethod
    def _split(block: np.ndarray, columns: list[Column]) -> tuple[np.ndarray, np.ndarray]:
        reals = sum(c.kind == "real" for c in columns)
        ints = len(columns) - reals
        return block[: 8 * reals].view(np.float64), block[8 * reals : 8 * reals + 4 * ints].view(np.int32)
