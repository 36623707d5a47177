"""A rerun recording: the robot in 3D with CoM, CoP and capture point, and the signals as time series."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from hoap2 import parameters, signal_names
from hoap2.export import PICTURE_HZ, Order, missing_package, poses

TRUTH_TICKS = 10
MARKS = {  # entity -> (signal, colour); what lies on the ground is drawn there
    "com": ("p.true_com_W_m", (230, 159, 0)),
    "cop": ("c.cop_est_W_m", (0, 158, 115)),
    "capture_point": ("c.cp_est_W_m", (204, 121, 167)),
}


def write(wanted: Order, path: Path, _form: str) -> None:
    """One timeline, `t`, of simulated time."""
    try:
        import rerun
        import rerun.blueprint as blueprint
    except ImportError:
        raise missing_package("rerun-sdk", "rrd") from None
    plots = [blueprint.TimeSeriesView(name=name, origin=f"signals/{name}") for name in
             ("roll_est_rad", "pitch_est_rad", "cp_est_W_m", "true_tau_Nm")]  # fmt: skip
    layout = blueprint.Blueprint(blueprint.Horizontal(blueprint.Spatial3DView(origin="world"),
                                                      blueprint.Vertical(*plots), column_shares=[3, 2]))  # fmt: skip
    with rerun.RecordingStream("hoap2", recording_id=wanted.source.name) as stream:
        stream.save(path, default_blueprint=layout)
        _robot(wanted, rerun, stream)
        _marks(wanted, rerun, stream)
        _signals(wanted, rerun, stream)
        stream.flush()
        stream.disconnect()


def _picture_rows(wanted: Order) -> np.ndarray:
    tick_s = parameters.table().tick_us / 1e6
    return np.arange(0, wanted.source.log.count, math.lcm(round(1.0 / PICTURE_HZ / tick_s), TRUTH_TICKS))


def _times(wanted: Order, rerun, rows: np.ndarray) -> list:
    return [rerun.TimeColumn("t", duration=wanted.source.log.t_s[rows])]


def _robot(wanted: Order, rerun, stream) -> None:
    rows = _picture_rows(wanted)
    stream.log("world", rerun.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for link in poses.of_run(wanted.source.log, rows):
        entity = f"world/robot/{link.name}"
        stream.log(entity, rerun.Boxes3D(mins=[link.box_min_L_m], sizes=[link.box_max_L_m - link.box_min_L_m],
                                         colors=[(190, 198, 210)], fill_mode="solid"), static=True)  # fmt: skip
        columns = rerun.Transform3D.columns(translation=link.pos_W_m, quaternion=np.roll(link.quat_W, -1, axis=1))
        stream.send_columns(entity, indexes=_times(wanted, rerun, rows), columns=columns)


def _marks(wanted: Order, rerun, stream) -> None:
    rows = _picture_rows(wanted)
    for name, (signal, colour) in MARKS.items():
        block = wanted.source.log.block(signal)
        if block is None:
            continue
        points = np.zeros((len(rows), 3))
        points[:, : block.shape[1]] = block[rows]
        stream.log(f"world/{name}", rerun.Points3D.from_fields(colors=[colour], radii=[0.006]), static=True)
        stream.send_columns(f"world/{name}", indexes=_times(wanted, rerun, rows),
                            columns=rerun.Points3D.columns(positions=points))  # fmt: skip


def _signals(wanted: Order, rerun, stream) -> None:
    """Each column where it can be found: signals/<signal>/<element>."""
    for i, name in enumerate(wanted.columns):
        values, rows = wanted.source.log.column(name), wanted.rows
        known = rows[np.isfinite(values[rows])]
        whole = signal_names.whole(name)
        element = "/".join(part for part in name.split(".")[1:] if part != whole)
        entity = f"signals/{whole}/{element}" if element else f"signals/{whole}"
        stream.send_columns(entity, indexes=_times(wanted, rerun, known),
                            columns=rerun.Scalars.columns(scalars=values[known].astype(float)))  # fmt: skip
        wanted.progress(i + 1, len(wanted.columns))
