"""The robot for the page: tree and limits of hoap2.json, the surface that the pictures draw, tunable parameters."""

from __future__ import annotations

import numpy as np

from hoap2 import parameters, renderer
from hoap2.generate.tables import Signal
from hoap2.monitor import track
from hoap2.telemetry import command_kinds

# What the command `step` can set, and the parameter that a run starts with.
STEP_STARTS = {"length_m": "step_length_m", "sideways_m": "step_sideways_m", "turn_rad": "step_turn_rad"}


def document() -> dict:
    """Everything about robot, signals and commands that does not change while the monitor runs."""
    table = parameters.table()
    robot = table.robot
    links = [link["name"] for link in robot["links"]]
    start = parameters.known("controller")
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
        "rest": {"hip_height_m": start["hip_height_m"].default[0], "q_rad": list(start["posture_rad"].default)},
        "layout": track.layout_json(),
        "enums": table.enums,
        "faults": [{"name": n, "bit": bit, "text": table.fault_texts[n]} for n, bit in table.faults.items()],
        "tunable": [range_ for signal in command_kinds.tunables().values() for range_ in _elements(signal)],
        "step": {name: _range(STEP_STARTS[name], parameters.known("controller")[STEP_STARTS[name]].default[0], signal)
                 for name, signal in command_kinds.step_ranges().items()},
        "push": {"most_N": command_kinds.most_push_N(), "longest_s": command_kinds.LONGEST_PUSH_S},
    }  # fmt: skip


def _joint(joint: dict, links: list[str]) -> dict:
    return {
        "name": joint["name"], "parent": links.index(joint["parent"]), "child": links.index(joint["child"]),
        "axis": joint["axis"], "origin_parent_m": joint["origin_parent_m"], "limit_rad": joint["limit_soft_rad"],
        "velocity_limit_rad_s": joint["velocity_limit_rad_s"], "torque_peak_Nm": joint["torque_peak_Nm"],
        "torque_continuous_Nm": joint["torque_continuous_Nm"],
    }  # fmt: skip


def _elements(signal: Signal) -> list[dict]:
    """Each number of a parameter by itself: `lpc_gain.x`."""
    names = parameters.table().element_names(signal)
    return [_range(name, default, signal) for name, default in zip(names, signal.default)]


def _range(name: str, default: float, signal: Signal) -> dict:
    return {"name": name, "unit": signal.unit, "low": signal.low, "high": signal.high, "default": default,
            "text": signal.text}  # fmt: skip


def mesh(coarse: bool) -> bytes:
    """The robot's surface; `vertex` rows are position, normal, albedo (linear), gloss, link."""
    vertex, index = renderer.robot_mesh(coarse)
    flat = np.frombuffer(vertex.tobytes(), dtype=np.float32)
    return track.pack({"kind": "mesh", "stride": len(flat) // len(vertex)}, {"vertex": flat, "index": index.ravel()})
