"""Reading LCM logs: cut off, damaged, with strangers in them; and the signals rebuilt from one."""

from __future__ import annotations

from pathlib import Path

import lcm
import numpy as np
import pytest

import rig
from hoap2.errors import UserError
from hoap2.telemetry import log_file, types
from hoap2.telemetry.log_file import LogFile
from sides import standing_plant, stepping_controller


@pytest.fixture(scope="module")
def good(tmp_path_factory) -> tuple[Path, rig.master.Outcome]:
    path = tmp_path_factory.mktemp("log") / "a.lcm"
    outcome, _ = rig.run(stepping_controller(step_ticks=50, lead_ticks=20, steps=2), standing_plant(), 130, path)
    return path, outcome


def starts(path: Path) -> list[int]:
    """Where each event of a log begins."""
    log, at, found = lcm.EventLog(str(path)), 0, []
    while log.read_next_event() is not None:
        found.append(at)
        at = log.tell()
    return found


def test_a_whole_log_has_no_problems(good):
    log = LogFile(good[0])
    assert len(list(log)) == log.messages == len(starts(good[0])) and log.problems() == []


def test_cut_anywhere_it_is_read_up_to_there_and_says_so(good, tmp_path: Path):
    data, begins = good[0].read_bytes(), starts(good[0])
    cut = tmp_path / "cut.lcm"
    middle = begins[40]
    for at in [*range(middle, begins[41], 37), len(data) - 1, 3, 27]:
        cut.write_bytes(data[:at])
        log = LogFile(cut)
        whole = sum(b <= at for b in begins) - 1
        assert len(list(log)) == whole, at
        left = at - begins[whole]
        assert log.cut_bytes == left
        if left == 0:
            assert log.problems() == []
        else:
            (said,) = log.problems()
            assert (
                f"cut off in mid-message: read up to {log.last_us / 1e6:.3f} s ({whole} messages), {left} bytes" in said
            )


def test_a_cut_log_still_gives_its_signals(good, tmp_path: Path):
    data, begins = good[0].read_bytes(), starts(good[0])
    cut = tmp_path / "cut.lcm"
    cut.write_bytes(data[: begins[200] + 100])
    signals, notes = log_file.read_signals(cut)
    assert 50 < signals.count < 131 and "cut off" in notes[0]
    assert np.array_equal(signals.column("c.step_index"), good[1].log.column("c.step_index")[: signals.count])


@pytest.mark.parametrize("damage", [b"\0" * 40, b"\xff" * 3, bytes(range(256)) * 4])
def test_damage_between_messages_is_passed_over(good, tmp_path: Path, damage: bytes):
    data, begins = good[0].read_bytes(), starts(good[0])
    path = tmp_path / "damaged.lcm"
    path.write_bytes(data[: begins[9]] + damage + data[begins[9] :])
    log = LogFile(path)
    assert len(list(log)) == len(begins) and log.damaged_bytes == len(damage)
    assert log.problems() == [f"{path}: {len(damage)} damaged bytes between messages were passed over"]


def test_lengths_that_lie_do_not_bring_it_down(good, tmp_path: Path):
    data, begins = good[0].read_bytes(), starts(good[0])
    path = tmp_path / "lies.lcm"
    for at in (20, 24):  # length of the channel's name, of the data
        for lie in (-1, -(2**31), 2**31 - 1, 10**6, 0):
            place = begins[9] + at
            path.write_bytes(data[:place] + lie.to_bytes(4, "big", signed=True) + data[place + 4 :])
            log = LogFile(path)
            assert len(list(log)) >= 9
            assert log.problems(), (at, lie)


def test_strangers_and_damaged_messages_are_counted(good, tmp_path: Path):
    path = tmp_path / "mixed.lcm"
    out = lcm.EventLog(str(path), "w")
    out.write_event(0, "LCM_SELF_TEST", b"lcm self test")  # every logger's
    out.write_event(0, "SOMETHING", b"else")
    for event in lcm.EventLog(str(good[0])):
        out.write_event(event.timestamp, event.channel, event.data)
    out.write_event(5, types.STATE, types.type_of(types.STATE)().encode()[:-1])
    out.write_event(6, types.GAIT, types.type_of(types.STATE)().encode())
    out.close()
    log = LogFile(path)
    assert len(list(log)) == len(starts(good[0]))
    assert log.foreign == {"SOMETHING": 1, types.GAIT: 1} and log.malformed == {types.STATE: 1}
    assert [line.split(": ")[1][:2] for line in log.problems()] == ["1 ", "2 "]


def test_a_run_of_another_schema_is_told(good, tmp_path: Path):
    """The layout of the messages is the same, or they would be foreign; what their numbers mean may not be."""
    path, out_type = tmp_path / "other.lcm", types.type_of(types.RUN)
    out = lcm.EventLog(str(path), "w")
    for schema in (out_type.SCHEMA_HASH, out_type.SCHEMA_HASH + 1):
        message = out_type()
        message.schema_hash = schema
        out.write_event(0, types.RUN, message.encode())
    out.close()
    log = LogFile(path)
    assert len(list(log)) == 2 and log.problems() == [
        f"{path} is of a run with another table of signals: enums and faults may have other names"
    ]


@pytest.mark.parametrize("content", [b"PAR1 and so on", b"\x7fELF", b"a,b\n1,2\n"])
def test_what_is_no_log_is_named(tmp_path: Path, content: bytes):
    path = tmp_path / "other.lcm"
    path.write_bytes(content)
    with pytest.raises(UserError, match="is not an LCM log"):
        LogFile(path)
    with pytest.raises(UserError, match="No such file"):
        LogFile(tmp_path / "none.lcm")
    (tmp_path / "empty.lcm").touch()
    with pytest.raises(UserError, match="holds no signals"):
        log_file.read_signals(tmp_path / "empty.lcm")


def test_signals_from_a_log_are_those_of_the_run(good):
    signals, notes = log_file.read_signals(good[0])
    log, sparse = good[1].log, log_file.sparse_columns()
    assert notes == [] and signals.count == log.count == 131
    assert {c.name for c in (*signals.reals, *signals.ints)} == {c.name for c in (*log.reals, *log.ints)}
    for column in (*log.reals, *log.ints):
        step = 10 if column.name in sparse else 1
        a, b = signals.column(column.name)[::step], log.column(column.name)[::step]
        assert np.array_equal(a, b, equal_nan=True), column.name
    assert np.isnan(signals.column("p.true_com_W_m.x")[1]), "what is not in the log is not made up"


def test_of_two_runs_in_a_log_the_last_one_counts(good, tmp_path: Path):
    path = tmp_path / "two.lcm"
    rig.run(stepping_controller(), standing_plant(), 40, tmp_path / "b.lcm")
    second = (tmp_path / "b.lcm").read_bytes().replace(rig.RUN_ID.to_bytes(8, "big"), (78).to_bytes(8, "big"))
    path.write_bytes(good[0].read_bytes() + second)
    assert log_file.read_signals(path)[0].count == 41
