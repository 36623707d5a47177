"""export, plot and diff: what they write is what the run was; what they are asked wrongly they say."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest

import rig
from hoap2 import diff_runs, export, plot_signals, run_source, signal_names
from hoap2.errors import UserError
from hoap2.export import poses
from sides import FakeSide, standing_plant, stepping_controller

TICKS = 230


def record(folder: Path, push_at: int | None = None, ticks: int = TICKS) -> Path:
    """A scripted run's folder: signals, and the LCM log."""

    def moves(side: FakeSide, tick: int) -> None:
        side.put("true_q_rad", 0.01 * np.sin(np.arange(25) + 0.01 * tick))
        if push_at is not None and tick >= push_at:
            side.put("true_com_W_m", [0.009 + 1e-6 * (tick - push_at + 1), 0.0, 0.2575])

    folder.mkdir(parents=True)
    outcome, _ = rig.run(stepping_controller(step_ticks=50, lead_ticks=20, steps=3), standing_plant(moves), ticks,
                         folder / "telemetry.lcm")  # fmt: skip
    outcome.log.write(folder / "signals.parquet")
    (folder / "run.toml").write_text(f"[plant]\nfriction_mu = {0.7 if push_at is None else 0.6}\n[record]\nseed = 1\n")
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return record(tmp_path_factory.mktemp("out") / "scripted" / "a")


def exported(folder: Path, form: str, path: Path, signals: list[str], every: int = 1) -> Path:
    wanted = export.order(run_source.load(str(folder)), signals, every, lambda done, total: None)
    return export.run(form, wanted, path, force=False)


def test_names_are_found_as_people_write_them(folder: Path):
    log = run_source.load(str(folder)).log
    assert (
        signal_names.find(log, "p.r_knee.true_tau_Nm")
        == signal_names.find(log, "r_knee.true_tau_Nm")
        == ["p.r_knee.true_tau_Nm"]
    )
    assert (
        signal_names.find(log, "cp_est_W_m")
        == signal_names.find(log, "c.cp_est_W_m")
        == ["c.cp_est_W_m.x", "c.cp_est_W_m.y"]
    )
    assert len(signal_names.find(log, "foot_ref_W_m")) == 6 and len(signal_names.find(log, "q_ref_rad")) == 25
    assert signal_names.find(log, "*knee.q_*") == [
        "c.r_knee.q_ref_rad",
        "c.l_knee.q_ref_rad",
        "p.r_knee.q_enc_rad",
        "p.l_knee.q_enc_rad",
    ]
    with pytest.raises(UserError, match="no signal 'cp_est_Wm'.*did you mean 'cp_est_W_m'"):
        signal_names.find(log, "cp_est_Wm")


def test_tables_hold_the_signals(folder: Path, tmp_path: Path):
    log = run_source.load(str(folder)).log
    path = exported(folder, "csv", tmp_path / "a.csv", [])
    with path.open() as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["t_s", *(c.name for c in (*log.reals, *log.ints))] and len(rows) == 1 + log.count
    for k in (0, 137, log.count - 1):
        assert [float(cell) for cell in rows[1 + k][1:]] == [*log.real[k], *log.integer[k]]
    table = pyarrow.parquet.read_table(
        exported(folder, "parquet", tmp_path / "a.parquet", ["step_index", "true_q_rad"], 7)
    )
    assert table.num_columns == 27 and table.num_rows == len(range(0, log.count, 7))
    assert table["c.step_index"].to_pylist() == log.column("c.step_index")[::7].tolist()
    assert table.schema.field("p.r_knee.true_q_rad").metadata == {b"unit": b"rad"}


def test_a_log_file_exports_without_its_folder(folder: Path, tmp_path: Path):
    path = tmp_path / "b.parquet"
    exported(folder / "telemetry.lcm", "parquet", path, ["true_com_W_m", "step_index"])
    table = pyarrow.parquet.read_table(path)
    known = [value is not None for value in table["p.true_com_W_m.z"].to_pylist()]
    assert known == [k % 10 == 0 for k in range(TICKS + 1)], "what the log does not hold is empty, not made up"
    assert table["c.step_index"].null_count == 0


def test_mcap_holds_signals_events_and_the_robot(folder: Path, tmp_path: Path):
    from mcap.reader import make_reader

    path, log = exported(folder, "mcap", tmp_path / "a.mcap", []), run_source.load(str(folder)).log
    topics: dict[str, list] = {}
    with path.open("rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            topics.setdefault(channel.topic, []).append((message.log_time, json.loads(message.data)))
            assert channel.message_encoding == "json" and schema.encoding == "jsonschema"
    assert sorted(topics) == ["/event", "/gait", "/scene", "/state", "/tf", "/truth"]
    assert [t for t, _ in topics["/state"]] == [1_000_000 * k for k in range(log.count)]
    assert [t for t, _ in topics["/truth"]] == [10_000_000 * k for k in range(TICKS // 10 + 1)]
    assert [m["step_index"] for _, m in topics["/gait"]] == log.column("c.step_index").tolist()
    assert topics["/truth"][3][1]["true_q_rad"]["r_knee"] == log.column("p.r_knee.true_q_rad")[30]
    assert [m["text"] for _, m in topics["/event"] if m["kind"] == "step"] == [
        f"step {i}, stance right" for i in (1, 2, 3)
    ]
    links = {entity["id"] for entity in topics["/scene"][0][1]["entities"]}
    assert links == {t["child_frame_id"] for t in topics["/tf"][0][1]["transforms"]} and len(links) == 26
    assert len(topics["/tf"]) == TICKS // 20 + 1


def test_rerun_files_can_be_read_again(folder: Path, tmp_path: Path):
    pytest.importorskip("rerun", reason="rerun-sdk is installed on need")
    import subprocess

    path = exported(folder, "rrd", tmp_path / "a.rrd", ["true_q_rad", "step_index"])
    tool = Path(sys.executable).parent / "rerun"
    done = subprocess.run([tool, "rrd", "verify", path], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("form, package, list_name", [("mcap", "mcap", "mcap"), ("rrd", "rerun-sdk", "rrd")])
def test_a_package_that_is_missing_is_named(folder, tmp_path, monkeypatch, form, package, list_name):
    monkeypatch.setitem(sys.modules, package.removesuffix("-sdk"), None)
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    with pytest.raises(UserError, match=f"{package} is not installed.*./hoap2 export --{form} installs it") as raised:
        exported(folder, form, tmp_path / "x", [])
    assert f"requirements/{list_name}.txt" in raised.value.hint and list(tmp_path.iterdir()) == []
    assert (Path(__file__).parents[2] / "host_tools" / "requirements" / f"{list_name}.txt").is_file()


def test_nothing_is_overwritten_unasked(folder: Path, tmp_path: Path):
    exported(folder, "csv", tmp_path / "a.csv", ["mode"])
    with pytest.raises(UserError, match="there already; nothing was overwritten"):
        exported(folder, "csv", tmp_path / "a.csv", ["phase"])
    assert "mode" in (tmp_path / "a.csv").read_text()


def test_link_poses_are_those_of_the_plant():
    """The soles of the tree's feet against the plant's own truth, in a real walk."""
    from hoap2 import master, parameters, products, scenario

    loaded = scenario.load("floor-walk")
    both = products.open_both(products.Choice(), loaded)
    outcome = master.run(both.controller, both.plant, 2600, 1.0, master.StopRequest())
    both.close()
    rows = np.arange(0, outcome.log.count, 50)
    links = {link.name: link for link in poses.of_run(outcome.log, rows)}
    truth = outcome.log.block("p.true_foot_pos_W_m")[rows]
    down = np.array([0.0, 0.0, -parameters.table().robot["feet"]["sole_height_below_ankle_m"]])
    for k, name in enumerate(("r_foot", "l_foot")):
        sole = links[name].pos_W_m + poses.rotate(links[name].quat_W, down)
        assert np.abs(sole - truth[:, 3 * k : 3 * k + 3]).max() < 1e-5  # the hinges of the plant give by some um
    assert np.ptp(links["r_foot"].pos_W_m[:, 2]) > 0.01, "it stepped"


def test_plots_are_pictures_and_their_mistakes_are_named(folder: Path, tmp_path: Path):
    source = run_source.load(str(folder))
    path = plot_signals.draw(source, ["cp_est_W_m", "mode", "*knee.q_*"], 0.0, 0.2, tmp_path / "a.png")
    assert path.read_bytes()[:4] == b"\x89PNG" and path.stat().st_size > 20_000
    for wanted, span, name, said in [
        (["q_ref_rad,true_tau_Nm"], (0, 1), "b.png", "50 signals, too many"),
        (["roll_est_rad,step_index"], (0, 1), "b.png", "mixes units: 1, rad"),
        (["mode"], (5, 6), "b.png", "nothing between 5 and 6 s"),
        (["mode"], (0, 1), "b.txt", "a picture ends in"),
        (["mode"] * 13, (0, 1), "b.png", "too many for one picture"),
    ]:
        with pytest.raises(UserError, match=said):
            plot_signals.draw(source, wanted, *span, tmp_path / name)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.png"]


def test_diff_says_where_two_runs_part(folder: Path, tmp_path: Path):
    other, longer = record(tmp_path / "b", push_at=101), record(tmp_path / "c", ticks=TICKS + 20)
    a, b, c, of_log = (run_source.load(str(p)) for p in (folder, other, longer, folder / "telemetry.lcm"))
    found = diff_runs.document(a, b, 0.0)
    assert not found["equal"] and (found["first_tick"], found["first_s"]) == (101, 0.101)
    (signal,) = found["signals"]
    assert (signal["name"], signal["tick"], signal["largest_tick"]) == ("p.true_com_W_m.x", 101, TICKS)
    assert signal["largest"] == pytest.approx(130e-6, rel=1e-9)
    assert found["parameters"] == [{"parameter": "plant.friction_mu", "a": 0.7, "b": 0.6}]
    assert diff_runs.document(a, b, 50.5e-6)["first_tick"] == 151 and diff_runs.document(a, b, 1e-3)["equal"]
    assert diff_runs.document(a, a, 0.0)["equal"] and diff_runs.document(a, of_log, 0.0)["equal"]
    found = diff_runs.document(a, c, 0.0)
    assert not found["equal"] and found["signals"] == [] and found["first_tick"] == TICKS + 1


def test_the_commands(hoap2_cli, folder: Path, tmp_path: Path):
    other = record(tmp_path / "b", push_at=101)
    done = hoap2_cli("diff", folder, other)
    assert done.returncode == 1 and "part at 0.101 s (tick 101), in true_com_W_m" in done.stdout
    assert hoap2_cli("diff", folder, folder).stdout == f"equal: {TICKS + 1} ticks, every signal\n"
    done = hoap2_cli("export", folder, "--csv", "--parquet", "--out", tmp_path / "x")
    assert done.returncode == 2 and "--out names one file" in done.stderr
    done = hoap2_cli("export", other, "--csv", "--signal", "mode", "--every", "100")
    assert done.returncode == 0 and (other / "signals.csv").read_text().count("\n") == 4
    done = hoap2_cli("plot", other, "true_com_W_m.x")
    assert done.returncode == 0 and Path(done.stdout.strip()) == other / "plot_true_com_W_m.x.png"
    (other / "telemetry.lcm").unlink()
    done = hoap2_cli("replay", other, "--lcm", "memq://")
    assert done.returncode == 2 and "holds no telemetry.lcm" in done.stderr
    done = hoap2_cli("replay", folder, "--lcm", "memq://", "--speed", "0")
    assert done.returncode == 2 and "--speed 0 is outside 0.01 to 100" in done.stderr
