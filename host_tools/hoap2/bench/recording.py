"""The drive commands of a walk, tick by tick, for simulators that are all to do the same."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hoap2 import parameters, scenario
from hoap2.bench.measure import SCENARIO
from hoap2.binding import Controller, Plant, exchange
from hoap2.errors import UserError

POSITION = 1  # drive mode


@dataclass
class Recording:
    """Commands of floor-walk: start-up, standing and stepping, under ideal sensors.

    rows: the plant's input struct at each tick, as bytes. q_ref_rad: what a position servo without a rate command
    needs to do the same, (ticks, joints). walking: the controller is in mode `walk`.
    """

    rows: np.ndarray
    q_ref_rad: np.ndarray
    walking: np.ndarray
    plant_values: dict[str, object]

    @property
    def ticks(self) -> int:
        return len(self.rows)


def nested(product: str, name: str, flat: tuple[float, ...]) -> list[float] | float:
    """A parameter's value as the binding takes it."""
    return list(flat) if parameters.known(product)[name].shape else flat[0]


def pair(overrides: list[str] | None = None) -> tuple[Controller, Plant, dict[str, object]]:
    """Controller and plant of the scenario with ideal sensors, and the plant's parameters."""
    loaded = scenario.load(SCENARIO, overrides or [], "ideal")
    values = {product: {name: nested(product, name, flat) for name, flat in loaded.values[product].items()}
              for product in loaded.values}
    return Controller(**values["controller"]), Plant(**values["plant"]), values["plant"]


def record(ticks: int, progress: Callable[[int], None] = lambda _: None) -> Recording:
    """Walk the closed loop once and keep what the drives were told."""
    controller, plant, values = pair()
    reals, ints = plant.inputs.flat()
    rows = np.zeros((ticks, 8 * reals.size + 8 * math.ceil(ints.size / 2)), dtype=np.uint8)
    q_ref = np.zeros((ticks, plant.inputs.q_ref_rad.size))
    walking = np.zeros(ticks, dtype=bool)
    walk = parameters.table().enums["mode"].index("walk")
    for k in range(ticks):
        exchange(controller, plant)
        rows[k, : 8 * reals.size] = reals.view(np.uint8)
        rows[k, 8 * reals.size : 8 * reals.size + 4 * ints.size] = ints.view(np.uint8)
        q_ref[k] = as_position(plant)
        walking[k] = controller.outputs.mode == walk
        controller.step()
        plant.step()
        progress(k)
    if not walking.any():
        raise UserError(f"the robot did not walk within {ticks} ticks; nothing to measure", "give more --seconds")
    return Recording(rows, q_ref, walking, values)


def as_position(plant: Plant) -> np.ndarray:
    """The command as one position reference a joint: kp (ref - q) - kd qd is the same torque."""
    inputs = plant.inputs
    defaults = {s.name: np.array(s.default) for s in parameters.table().select("plant", "input")}
    same = all(np.array_equal(inputs.view(name), defaults[name]) for name in ("kp_Nm_rad", "kd_Nms_rad"))
    if not same or (inputs.drive_mode != POSITION).any():
        raise UserError("the walk does not use its drives as position servos with the maker's gains",
                        "bench plant needs such a walk: the MuJoCo model has these servos")
    return inputs.q_ref_rad + (inputs.kd_Nms_rad * inputs.qd_ref_rad_s + inputs.tau_ff_Nm) / inputs.kp_Nm_rad
