"""The robot for the page: tree and limits of hoap2.json, the surface that the pictures draw, tunable parameters."""

from __future__ import annotations

import numpy as np

from hoap2 import parameters, renderer
from hoap2.generate.tables import PRODUCTS
from hoap2.monitor import track

# What the command `step` can set, and the parameter whose range it has.
STEP_VALUES = {"length_m": "step_length_m", "sideways_m": "step_sideways_m", "turn_rad": "step_turn_rad"}


def document() -> dict:
    """Everything about robot, signals and commands that does not change while the monitor runs."""
    table = parameters.table()
    robot = table.robot
    links = [link["name"] for link in robot["links"]]
    return {
        "robot": robot["name"],
        "mass_kg": robot["total_mass_kg"],
        "base_link": links.index(robot["base_link"]),
        "chest": links.index(robot["imu"]["link"]),
        "links": [
            {"name": link["name"], "com_L_m": link["com_L_m"], "box": [link["box_min_L_m"], link["box_max_L_m"]]}
            for link in robot["links"]
        ],
        "joints": [_joint(joint, links) for joint in robot["joints"]],
        "feet": robot["feet"],
        "layout": track.layout_json(),
        "enums": table.enums,
        "faults": [{"name": n, "bit": bit, "text": table.fault_texts[n]} for n, bit in table.faults.items()],
        "tunable": [_parameter(product, signal) for product in PRODUCTS
                    for signal in parameters.known(product).values() if signal.tunable],
        "step": {name: _parameter("controller", parameters.known("controller")[source])
                 for name, source in STEP_VALUES.items()},
    }  # fmt: skip


def _joint(joint: dict, links: list[str]) -> dict:
    return {
        "name": joint["name"], "parent": links.index(joint["parent"]), "child": links.index(joint["child"]),
        "axis": joint["axis"], "origin_parent_m": joint["origin_parent_m"], "limit_rad": joint["limit_soft_rad"],
        "velocity_limit_rad_s": joint["velocity_limit_rad_s"], "torque_peak_Nm": joint["torque_peak_Nm"],
        "torque_continuous_Nm": joint["torque_continuous_Nm"],
    }  # fmt: skip


def _parameter(product: str, signal) -> dict:
    return {
        "product": product, "name": signal.name, "unit": signal.unit, "low": signal.low, "high": signal.high,
        "count": signal.count, "default": list(signal.default), "text": signal.text,
    }  # fmt: skip


def mesh(coarse: bool) -> bytes:
    """The robot's surface; `vertex` rows are position, normal, albedo (linear), gloss, link."""
    vertex, index = renderer.robot_mesh(coarse)
    flat = np.frombuffer(vertex.tobytes(), dtype=np.float32)
    return track.pack({"kind": "mesh", "stride": len(flat) // len(vertex)}, {"vertex": flat, "index": index.ravel()})
