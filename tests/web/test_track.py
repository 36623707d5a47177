"""What the page is told about finished runs: rows, soil, the list; no browser."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest
from hoap2 import recording, soil_replay
from hoap2.errors import UserError
from hoap2.monitor import model, track
from hoap2.monitor.runs import RunList


def unpack(block: bytes) -> tuple[dict, dict[str, np.ndarray]]:
    """A block as the page reads it."""
    (length,) = struct.unpack_from("<I", block)
    header, at, arrays = json.loads(block[4 : 4 + length]), 4 + length, {}
    for name, kind, count in header["arrays"]:
        assert at % np.dtype(kind).itemsize == 0, "a browser cannot read it otherwise"
        arrays[name] = np.frombuffer(block, kind, count, at)
        at += arrays[name].nbytes
    assert at == len(block)
    return header, arrays


def test_blocks_come_back_as_they_were() -> None:
    arrays = {"a": np.arange(3, dtype=np.uint32), "b": np.array([0.5, np.nan]), "c": np.zeros((2, 2), np.float32)}
    header, found = unpack(track.pack({"kind": "x", "text": "µ"}, arrays))
    assert header["kind"] == "x" and header["text"] == "µ"
    for name, data in arrays.items():
        np.testing.assert_array_equal(found[name], data.ravel())


def test_rows_of_a_run_are_those_of_its_log(sand_run: Path) -> None:
    header, arrays = unpack(track.of_run(sand_run))
    rows = arrays["rows"].reshape(len(arrays["t_s"]), -1)
    log = pyarrow.parquet.read_table(sand_run / "signals.parquet")
    ticks = np.round(arrays["t_s"] * 1000).astype(int)
    assert ticks[0] == 0 and ticks[-1] == log.num_rows - 1 and np.all(np.diff(ticks) <= track.PERIOD_TICKS)
    first = {entry["name"]: entry["first"] for entry in header["layout"]}
    for column, name, element in (("p.true_base_pos_W_m.z", "true_base_pos_W_m", 2), ("c.step_index", "step_index", 0),
                                  ("p.l_knee.true_tau_Nm", "true_tau_Nm", 13)):  # fmt: skip
        wanted = log[column].to_numpy()[ticks]
        np.testing.assert_allclose(rows[:, first[name] + element], wanted, rtol=1e-6, atol=1e-7)
    assert [step["number"] for step in header["steps"]] == list(range(1, len(header["steps"]) + 1))
    assert header["soil"] is True and header["duration_s"] == pytest.approx(log["t_s"][-1].as_py())


def test_signals_that_an_older_run_lacks_are_no_numbers(sand_run: Path, tmp_path: Path) -> None:
    log = pyarrow.parquet.read_table(sand_run / "signals.parquet")
    (tmp_path / "run.toml").write_bytes((sand_run / "run.toml").read_bytes())
    pyarrow.parquet.write_table(log.drop_columns(["c.roll_est_rad"]), tmp_path / "signals.parquet")
    header, arrays = unpack(track.of_run(tmp_path))
    first = next(e["first"] for e in header["layout"] if e["name"] == "roll_est_rad")
    rows = arrays["rows"].reshape(len(arrays["t_s"]), -1)
    assert np.isnan(rows[:, first]).all() and np.isfinite(rows[:, first + 1]).all()


def test_the_changes_of_the_soil_add_up_to_the_replayed_ground(sand_run: Path) -> None:
    header, arrays = unpack(track.soil_of_run(sand_run))
    run = recording.load(sand_run)
    height, ends = arrays["base"].copy(), np.cumsum(arrays["count"])
    with soil_replay.SoilReplay(run) as pool:
        for moment in (len(ends) // 2, len(ends) - 1):
            cells, heights = (arrays[name][: ends[moment]] for name in ("cells", "heights"))
            height[:] = arrays["base"]
            for cell, value in zip(cells, heights):
                height[cell] = value
            wanted = pool.surface(run.row(arrays["t_s"][moment])).height_m.ravel()
            np.testing.assert_allclose(height, wanted, atol=1.01 * track.CHANGE_M)
            assert np.ptp(height - arrays["base"]) > 1e-3, "there are ruts"
    assert header["grid"]["nx"] * header["grid"]["ny"] == len(height)


def test_a_run_on_the_floor_has_no_soil(sand_run: Path, tmp_path: Path) -> None:
    text = (sand_run / "run.toml").read_text().replace('ground = "soil"', 'ground = "rigid"')
    (tmp_path / "run.toml").write_text(text)
    (tmp_path / "signals.parquet").symlink_to(sand_run / "signals.parquet")
    with pytest.raises(UserError, match="no soil"):
        track.soil_of_run(tmp_path)


def test_the_list_holds_whole_runs_and_outlives_bad_ones(tmp_path: Path) -> None:
    def run(name: str, summary: str | None, *files: str) -> None:
        folder = tmp_path / name
        folder.mkdir(parents=True)
        for file in files:
            (folder / file).write_text("")
        if summary is not None:
            (folder / "summary.json").write_text(summary)

    whole = ("signals.parquet", "run.toml")
    run("walk/good", json.dumps({"scenario": "walk", "ok": True, "steps_taken": 36, "seed": 4}), *whole)
    run("walk/bad-summary", "{", *whole)
    run("walk/odd-summary", "[1]", *whole)
    run("walk/no-summary", None, *whole)
    run("walk/half", "{}", "run.toml")
    run("walk/.hidden.part-1", "{}", *whole)
    (tmp_path / "a file").write_text("")
    entries = {entry["name"]: entry for entry in RunList(tmp_path).entries()}
    assert set(entries) == {"good", "bad-summary", "odd-summary", "no-summary"}
    assert entries["good"]["ok"] is True and entries["good"]["seed"] == 4 and entries["no-summary"]["ok"] is None
    assert RunList(tmp_path / "nowhere").entries() == []
    for key in ("walk/half", "../walk/good", "walk", ""):
        with pytest.raises(UserError):
            RunList(tmp_path).folder(key)


def test_the_robot_of_the_page_is_that_of_the_pictures() -> None:
    """Every link has a surface, and it lies around the link's box."""
    document = model.document()
    _, arrays = unpack(model.mesh(False))
    vertex = arrays["vertex"].reshape(-1, 11)
    assert len(arrays["index"]) % 3 == 0 and arrays["index"].max() < len(vertex)
    np.testing.assert_allclose(np.linalg.norm(vertex[:, 3:6], axis=1), 1.0, atol=1e-3)
    for number, link in enumerate(document["links"]):
        own = vertex[vertex[:, 10] == number, :3]
        low, high = np.array(link["box"])
        assert len(own) > 20 and np.all(own > low - 0.035) and np.all(own < high + 0.035), link["name"]
    _, coarse = unpack(model.mesh(True))
    assert len(coarse["index"]) < 0.4 * len(arrays["index"])
