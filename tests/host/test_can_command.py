"""`./hoap2 can`: dump, send, log, replay and scan, over AF_UNIX channels and what goes wrong."""

from __future__ import annotations

import ctypes
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import can
import pytest

from hoap2.can import interfaces, library, messages, traffic
from hoap2.can.ends import to_frame
from hoap2.errors import UserError
from hoap2.generate import can_table


@pytest.fixture
def channel(tmp_path_factory: pytest.TempPathFactory):
    return str(tmp_path_factory.mktemp("c") / "bus")


@pytest.fixture
def bus(channel: str):
    with interfaces.open_bus("hoap2_unix", channel) as opened:
        yield opened


@pytest.fixture
def reading(channel: str, bus: can.BusABC):
    """Start `can ...` on the channel and wait until it hears; returns the process."""
    started = []

    def start(*words: str) -> subprocess.Popen:
        command = [sys.executable, "-m", "hoap2.cli", "can", *words, "-c", channel]
        started.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True))
        time.sleep(2.0)
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture(scope="module")
def table() -> messages.Messages:
    return messages.load()


def test_dump_shows_values_by_name_and_unit(reading, bus, table):
    process = reading("dump", "-n", "4")
    for _ in range(30):  # until it listens
        bus.send(table.encode("beat", {"tick": 77}))
        bus.send(table.encode("command_waist", {"waist_pitch_q_ref": 0.5}))
        bus.send(can.Message(arbitration_id=0x7FF, data=b"\xab", is_extended_id=False))
        bus.send(can.Message(arbitration_id=0x20, data=bytes(8), is_extended_id=False))
        time.sleep(0.3)
        if process.poll() is not None:
            break
    out, err = process.communicate(timeout=20)
    lines = {line.split()[2]: line for line in out.splitlines()}
    assert process.returncode == 0 and err == ""
    assert "beat" in lines["020"] and ("tick=77" in out) and "(CRC wrong)" in out
    assert "command_waist" in lines["069"] and "waist_pitch_q_ref=0.5 rad" in lines["069"]
    assert lines["7FF"].rstrip().endswith("ab")


def test_send_by_name_and_in_candumps_notation(hoap2_cli, channel: str, bus, table):
    by_name = ("-n", "2", "command_waist", "waist_pitch_q_ref=-0.25")
    assert hoap2_cli("can", "send", "-c", channel, *by_name).returncode == 0
    assert hoap2_cli("can", "send", "-c", channel, "123#DE.AD", "12345678#R4", "061##1" + 12 * "00").returncode == 0
    got = [bus.recv(5.0) for _ in range(5)]
    values = [{v.name: v.value for v in table.values(m)} for m in got[:2]]
    assert values[0]["waist_pitch_q_ref"] == pytest.approx(-0.25, abs=2e-7) and not table.fault(got[1])
    assert [m.data[1] for m in got[:2]] == [0, 1]  # our counter
    assert bytes(got[2].data) == b"\xde\xad" and got[3].is_remote_frame and got[3].dlc == 4
    assert got[4].is_fd and got[4].bitrate_switch and len(got[4].data) == 12


@pytest.mark.parametrize("name", ["beat", "command_waist", "cells_l_foot", "settings_l_leg"])
def test_the_firmware_takes_what_is_encoded_by_name(name: str, table):
    frame = to_frame(table.encode(name, {"counter": 7}))
    bus = next(f.bus for f in can_table.load().frames if f.name == name)
    message = library.Message()
    assert library.load().hoap2_can_decode(bus, ctypes.byref(frame), ctypes.byref(message)) == 0
    assert message.counter == 7


@pytest.mark.parametrize(("text", "told"), [
    ("12#00", "is not a frame"), ("123#0", "half a byte"), ("123#" + 9 * "00", "9 bytes"),
    ("123##1" + 9 * "00", "9 bytes"), ("800#00", "more than 11 bits"), ("123#R9", "at most 8"),
])  # fmt: skip
def test_what_is_no_frame_is_refused(text: str, told: str):
    with pytest.raises(UserError, match=told):
        messages.parse(text)


@pytest.mark.parametrize(("words", "told"), [
    (("beet", "tick=1"), "did you mean 'beat'"), (("beat", "tik=1"), "did you mean 'tick'"),
    (("beat", "tick"), "is not signal=value"), (("beat", "tick=1e9"), "16777215"),
])  # fmt: skip
def test_names_and_values_that_are_wrong_are_told(hoap2_cli, channel: str, words, told: str):
    done = hoap2_cli("can", "send", "-c", channel, *words)
    assert done.returncode == 2 and told in done.stderr and "Traceback" not in done.stderr


def test_a_log_goes_round_and_can_utils_read_it(reading, hoap2_cli, channel: str, bus, table, tmp_path: Path):
    file = tmp_path / "a.log"
    process = reading("log", str(file))
    sent = [table.encode("command_r_leg", {"r_knee_q_ref": 0.01 * i}) for i in range(40)]
    sent.append(can.Message(arbitration_id=0x12345678, data=b"12345678"))
    for message in sent:
        bus.send(message)
        time.sleep(0.005)
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert process.returncode == 0 and "41 frames" in err
    assert [bytes(m.data) for m in traffic.read_log(file)] == [bytes(m.data) for m in sent]
    again = hoap2_cli("can", "log", str(file), "-c", channel)
    assert again.returncode == 2 and "is there already" in again.stderr
    assert hoap2_cli("can", "replay", str(file), "-c", channel, "--speed", "0").returncode == 0
    got = [bus.recv(5.0) for _ in sent]
    assert [m.equals(s, timestamp_delta=None, check_channel=False) for m, s in zip(got, sent)] == 41 * [True]
    if shutil.which("log2asc"):
        asc = subprocess.run(["log2asc", "-I", str(file), channel], capture_output=True, text=True, timeout=20)
        assert asc.returncode == 0 and asc.stdout.count("command") == 0 and asc.stdout.count(" Rx ") >= 41


def test_replay_keeps_the_times(bus, channel: str):
    log = [can.Message(timestamp=100.0 + 0.2 * i, arbitration_id=i, is_extended_id=False) for i in range(4)]
    started = time.monotonic()
    with interfaces.open_bus("hoap2_unix", channel) as other:
        assert traffic.play(iter(log), lambda _m: other, speed=2.0) == 4
    assert 0.29 < time.monotonic() - started < 20.0
    times = [bus.recv(5.0).timestamp for _ in range(4)]
    assert times[3] - times[0] == pytest.approx(0.3, abs=0.25)


@pytest.mark.parametrize("text", ["(1.0) a 123#00\n(2.0) a 12", "(1.0) a 123#00\n(2.0) a 061##1" + 9 * "00",
                                  "(1.0) a 123#00\nrubbish and more\n"])  # fmt: skip
def test_a_log_that_is_cut_off_is_told_with_what_was_good(text: str, tmp_path: Path):
    file = tmp_path / "cut.log"
    file.write_text(text)
    seen = []
    with pytest.raises(UserError, match="what follows message 1 is not a message"):
        for message in traffic.read_log(file):
            seen.append(message)
    assert [m.arbitration_id for m in seen] == [0x123]


def test_scan_counts_and_names_what_is_sent(reading, bus, table):
    process = reading("scan", "-i", "hoap2_unix", "--duration", "4")
    for i in range(20):
        bus.send(table.encode("beat", {"tick": i}))
        bus.send(can.Message(arbitration_id=0x7AB, is_extended_id=False))
        time.sleep(0.1)
    out, _ = process.communicate(timeout=30)
    rows = {line.split()[1]: line.split() for line in out.splitlines()[1:]}
    assert rows["020"][2] == "beat" and rows["7AB"][2] == "?" and int(rows["7AB"][4]) > 3


def test_another_protocol_is_told(reading, bus, table):
    process = reading("dump", "--duration", "3")
    for _ in range(10):
        bus.send(table.encode("beat", {"protocol": table.protocol ^ 1}))
        time.sleep(0.2)
    _, err = process.communicate(timeout=20)
    assert err.count("speaks protocol") == 1


def test_dbc_files_of_two_versions_are_refused(tmp_path: Path):
    files = messages.generated_files()
    other = tmp_path / "other.dbc"
    other.write_text(files[1].read_text().replace(f"{messages.load().protocol:04X}", "0001", 1))
    with pytest.raises(UserError, match="protocol 0x0001.*of one version"):
        messages.load([files[0], other])
    with pytest.raises(UserError, match="not a DBC file"):
        messages.load([Path(__file__)])


def test_what_does_not_work_here_is_told_with_what_does(hoap2_cli, tmp_path: Path):
    here = hoap2_cli("can", "scan")
    assert here.returncode == 0 and all(name in here.stdout for name in interfaces.KNOWN)
    unknown = hoap2_cli("can", "dump", "-i", "socketcn")
    assert unknown.returncode == 2 and "did you mean 'socketcan'?" in unknown.stderr
    absent = hoap2_cli("can", "dump", "-i", "socketcan", "-c", "can77")
    assert absent.returncode == 2 and ("these work here: hoap2_unix" in absent.stderr or "can77" in absent.stderr)
    nowhere = hoap2_cli("can", "dump", "-c", str(tmp_path / "none" / "bus"))
    assert nowhere.returncode == 2 and "folder of the channel" in nowhere.stderr
    serial = hoap2_cli("can", "dump", "-i", "slcan")
    assert serial.returncode == 2 and "needs --channel" in serial.stderr


def test_a_virtual_bus_carries_the_frames(table):
    with interfaces.open_bus("virtual", "v") as a, interfaces.open_bus("virtual", "v") as b:
        traffic.send(a, table.encode("beat", {"tick": 9}))
        assert "tick=9" in map(str, table.values(b.recv(5.0)))
