"""What the page shows over time: rows of chosen signals, the same from a run's folder as from LCM.

A block of bytes for the page is a JSON header (its length first, 4 bytes, little endian, padded to 8 bytes in all),
then arrays as the header's `arrays` lists them.
"""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from hoap2 import parameters, recording, soil_replay
from hoap2.errors import UserError
from hoap2.recording import Recording

PERIOD_TICKS = 5  # between the rows of a finished run
MAX_ROWS = 12000
SOIL_PERIOD_S = 0.1
CHANGE_M = 2e-5  # a cell that changed less is not told again

# product -> outputs that the page draws. A signal that a run does not have is NaN in its rows.
SHOWN = {
    "plant": (
        "true_base_pos_W_m", "true_base_quat_W", "true_q_rad", "true_tau_Nm", "true_com_W_m", "true_cop_W_m",
        "true_chest_rpy_rad", "true_foot_pos_W_m", "true_foot_yaw_W_rad", "true_foot_force_W_N", "true_sinkage_m",
        "true_push_force_W_N", "other_contacts", "q_enc_rad", "gyro_S_rad_s", "cell_force_N",
    ),
    "controller": (
        "mode", "fault", "phase", "step_index", "stance_foot", "steps_done", "walk_done", "roll_est_rad",
        "pitch_est_rad", "com_ref_W_m", "com_est_W_m", "cop_ref_W_m", "cop_est_W_m", "cp_ref_W_m", "cp_est_W_m",
        "tpcc_shift_W_m", "landing_shift_W_m", "footprint_W_m_rad", "foot_force_est_N", "q_ref_rad",
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """One signal of a row: its columns first..first + count - 1."""

    product: str
    name: str
    unit: str
    first: int
    count: int
    text: str


@lru_cache(maxsize=1)
def layout() -> tuple[Entry, ...]:
    """The signals of a row, in order."""
    entries, first = [], 0
    for product, names in SHOWN.items():
        rows = {s.name: s for s in parameters.table().select(product, "output")}
        for name in names:
            signal = rows[name]
            entries.append(Entry(product, name, signal.unit, first, signal.count, signal.text))
            first += signal.count
    return tuple(entries)


def width() -> int:
    """Columns of a row."""
    last = layout()[-1]
    return last.first + last.count


def layout_json() -> list[dict]:
    """The layout for the page."""
    return [
        {"name": e.name, "product": e.product, "unit": e.unit, "first": e.first, "count": e.count, "text": e.text}
        for e in layout()
    ]


def pack(header: dict, arrays: dict[str, np.ndarray]) -> bytes:
    """A block of bytes for the page; kinds are float32, float64, uint32 and int32."""
    kept = {name: np.ascontiguousarray(data) for name, data in arrays.items()}
    ordered = sorted(kept, key=lambda name: -kept[name].itemsize)  # so that each array is aligned
    header = header | {"arrays": [[n, str(kept[n].dtype), int(kept[n].size)] for n in ordered]}
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-(len(text) + 4) % 8)
    return struct.pack("<I", len(text)) + text + b"".join(kept[n].tobytes() for n in ordered)


def of_run(folder: Path) -> bytes:
    """The track of a finished run: header, t_s and rows."""
    run = recording.load(folder)
    stride = max(PERIOD_TICKS, -(-len(run.t_s) // MAX_ROWS))
    index = np.unique(np.r_[np.arange(0, len(run.t_s), stride), len(run.t_s) - 1])
    header = {
        "kind": "track", "name": run.name, "duration_s": run.end_s, "layout": layout_json(),
        "steps": _steps(run), "start_feet": _start_feet(run), "terrain": terrain(run.plant),
        "pushes": pushes(run.plant), "soil": run.on_soil, "summary": _summary(folder), "controller": run.controller,
    }  # fmt: skip
    return pack(header, {"t_s": run.t_s[index], "rows": _rows(folder / "signals.parquet", index)})


def _rows(path: Path, index: np.ndarray) -> np.ndarray:
    """The rows of the log at these places, (n, width) float32."""
    table = parameters.table()
    by_name = {(p, s.name): s for p in SHOWN for s in table.select(p, "output")}
    columns: list[str] = []
    for entry in layout():
        signal = by_name[entry.product, entry.name]
        columns += [entry.product[0] + "." + element for element in table.element_names(signal)]
    try:
        have = set(pyarrow.parquet.read_schema(path).names)
        found = [c for c in columns if c in have]
        data = pyarrow.parquet.read_table(path, columns=found)
    except (OSError, pyarrow.ArrowInvalid) as error:
        raise UserError(f"cannot read {path}: {error}") from None
    rows = np.full((len(index), len(columns)), np.nan, dtype=np.float32)
    for k, name in enumerate(columns):
        if name in have:
            rows[:, k] = data[name].to_numpy()[index]
    return rows


def _steps(run: Recording) -> list[dict]:
    """Each step: when it was under way, the foot, where it landed."""
    found = []
    for step in run.steps:
        x, y, yaw = (float(v) for v in run.signal["footprint_W_m_rad"][step.last])
        found.append({"number": step.number, "first_s": float(run.t_s[step.first]),
                      "last_s": float(run.t_s[step.last]), "left": step.left, "x": x, "y": y, "yaw": yaw})  # fmt: skip
    return found


def _start_feet(run: Recording) -> list[dict]:
    feet, yaw = run.signal["true_foot_pos_W_m"][0], run.signal["true_foot_yaw_W_rad"][0]
    return [{"x": float(feet[3 * f]), "y": float(feet[3 * f + 1]), "yaw": float(yaw[f]), "left": f == recording.LEFT}
            for f in (recording.RIGHT, recording.LEFT)]  # fmt: skip


def terrain(plant: dict) -> dict:
    """Tilt and blocks of a run's plant values."""
    count = int(plant.get("block_count", 0))
    blocks = zip(np.reshape(plant.get("block_centre_W_m", []), (-1, 3)).tolist(),
                 np.reshape(plant.get("block_size_m", []), (-1, 3)).tolist(),
                 np.ravel(plant.get("block_yaw_W_rad", [])).tolist())  # fmt: skip
    return {
        "tilt_rad": list(plant.get("floor_tilt_rad", [0.0, 0.0])),
        "start_W_m": list(plant.get("start_pos_W_m", [0.0, 0.0])),
        "start_yaw_W_rad": float(plant.get("start_yaw_W_rad", 0.0)),
        "blocks": [{"centre": c, "size": s, "yaw": y} for c, s, y in list(blocks)[:count]],
    }


def pushes(plant: dict) -> list[dict]:
    """The planned pushes of a run's plant values."""
    found = []
    for k, duration_s in enumerate(np.ravel(plant.get("push_duration_s", []))):
        if duration_s > 0.0:
            found.append({
                "link": int(np.ravel(plant["push_link"])[k]), "start_s": float(np.ravel(plant["push_start_s"])[k]),
                "duration_s": float(duration_s),
                "point_L_m": np.reshape(plant["push_point_L_m"], (-1, 3))[k].tolist(),
                "force_W_N": np.reshape(plant["push_force_W_N"], (-1, 3))[k].tolist(),
            })  # fmt: skip
    return found


def _summary(folder: Path) -> dict:
    """summary.json, or nothing where a run has none."""
    try:
        return json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


class SoilTeller:
    """Tells the page a pool of soil: the whole surface once, then the cells that changed."""

    def __init__(self, grid: np.ndarray, full_scale_m: float, base_m: np.ndarray) -> None:
        self.grid, self.full_scale_m = grid, full_scale_m
        self.base_m = base_m.astype(np.float32).ravel()
        self._told = self.base_m.copy()

    def header(self) -> dict:
        """Place, size and colour scale."""
        grid = self.grid
        return {
            "origin_W_m": grid["origin_W_m"].tolist(), "axes_W": np.ravel(grid["axes_W"]).tolist(),
            "low_x_m": float(grid["low_x_m"]), "low_y_m": float(grid["low_y_m"]), "cell_m": float(grid["cell_m"]),
            "depth_m": float(grid["depth_m"]), "nx": int(grid["nx"]), "ny": int(grid["ny"]),
            "full_scale_m": self.full_scale_m,
        }  # fmt: skip

    def changes(self, height_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Cells (row * nx + column) that differ from what was told last, and their heights."""
        height = height_m.ravel()
        cells = np.flatnonzero(np.abs(height - self._told) > CHANGE_M).astype(np.uint32)
        self._told[cells] = height[cells]
        return cells, self._told[cells]

    def whole(self) -> np.ndarray:
        """The surface as told so far."""
        return self._told.copy()


def soil_of_run(folder: Path) -> bytes:
    """The soil of a finished run: the untouched surface, and the changes in steps of SOIL_PERIOD_S."""
    run = recording.load(folder)
    replay = soil_replay.of_run(run)
    if replay is None:
        raise UserError(f"{folder} is a run on the rigid floor: it has no soil")
    with replay:
        surface = replay.surface(0)
        teller = SoilTeller(replay.grid, replay.full_scale_m, surface.height_m - surface.change_m)
        stride = max(1, round(SOIL_PERIOD_S / max(1e-6, run.end_s / max(1, len(run.t_s) - 1))))
        rows = np.unique(np.r_[np.arange(0, len(run.t_s), stride), len(run.t_s) - 1])
        told = [teller.changes(replay.surface(int(row)).height_m) for row in rows]
        note = replay.note
    return pack(
        {"kind": "soil", "grid": teller.header(), "note": note},
        {
            "t_s": run.t_s[rows], "base": teller.base_m,
            "count": np.array([len(cells) for cells, _ in told], dtype=np.uint32),
            "cells": np.concatenate([cells for cells, _ in told]),
            "heights": np.concatenate([heights for _, heights in told]),
        },
    )  # fmt: skip
