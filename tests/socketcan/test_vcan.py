"""Linux's own CAN sockets: python-can, can-utils and `./hoap2 can` beside each other on vcan0, with CAN FD frames."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import can
import pytest

from hoap2.can import interfaces, messages, traffic
from hoap2.errors import UserError

pytestmark = pytest.mark.socketcan
DEVICE = "vcan0"
START_S = 60.0  # a Python program needs its time in the emulated machine


@pytest.fixture
def bus():
    with interfaces.open_bus("socketcan", DEVICE) as opened:
        yield opened


@pytest.fixture(scope="module")
def table() -> messages.Messages:
    return messages.load()


def equal(got: can.Message, sent: can.Message) -> bool:
    # Linux tells every frame of this machine as one that was sent
    return got.equals(sent, timestamp_delta=None, check_channel=False, check_direction=False)


def hoap2_can(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "hoap2.cli", "can", *words], capture_output=True, text=True,
                          timeout=START_S)  # fmt: skip


def test_frames_of_the_protocol_pass_between_two_sockets(bus, table):
    with interfaces.open_bus("socketcan", DEVICE) as other:
        sent = [table.encode("command_r_leg", {"r_knee_q_ref": 0.001 * i}) for i in range(200)]
        for message in sent:
            bus.send(message)
        got = [other.recv(10.0) for _ in sent]
    assert [equal(m, s) for m, s in zip(got, sent)] == 200 * [True]
    assert all(m.is_fd and m.bitrate_switch and len(m.data) == 32 for m in got)


def test_candump_sees_what_is_sent_by_name_and_cansend_is_decoded(bus, table):
    candump = subprocess.Popen(["candump", "-L", "-n", "2", DEVICE], stdout=subprocess.PIPE, text=True)
    time.sleep(1.0)
    done = hoap2_can("send", "-i", "socketcan", "-c", DEVICE, "-n", "2", "beat", "tick=5")
    assert done.returncode == 0, done.stderr
    out, _ = candump.communicate(timeout=30)
    expected = table.encode("beat", {"tick": 5})
    flags = "5"  # fast data, and the kernel's mark of CAN FD
    assert f"020##{flags}{bytes(expected.data).hex().upper()}" in out.splitlines()[0].upper()
    assert [bus.recv(10.0).arbitration_id for _ in range(2)] == [0x20, 0x20]
    subprocess.run(["cansend", DEVICE, f"020##1{bytes(expected.data).hex()}"], check=True, timeout=30)
    assert "tick=5" in map(str, table.values(bus.recv(10.0)))


def test_a_log_is_read_by_can_utils_and_played_by_canplayer(bus, table, tmp_path: Path):
    file = tmp_path / "a.log"
    log = subprocess.Popen([sys.executable, "-m", "hoap2.cli", "can", "log", str(file), "-i", "socketcan", "-c", DEVICE,
                            "-n", "20"], stderr=subprocess.PIPE, text=True)  # fmt: skip
    sent = [table.encode("cells_r_foot", {"force_0": 0.5 * i}) for i in range(20)]
    end = time.monotonic() + START_S
    while not file.exists() and time.monotonic() < end:
        time.sleep(0.1)
    time.sleep(0.5)
    for message in sent:
        bus.send(message)
    _, err = log.communicate(timeout=START_S)
    assert log.returncode == 0 and "20 frames" in err
    asc = subprocess.run(["log2asc", "-I", str(file), DEVICE], capture_output=True, text=True, timeout=30)
    assert asc.returncode == 0 and asc.stdout.count("CANFD") == 20
    with interfaces.open_bus("socketcan", DEVICE) as other:
        played = subprocess.run(["canplayer", "-I", str(file)], capture_output=True, text=True, timeout=30)
        assert played.returncode == 0, played.stderr
        assert [bytes(other.recv(10.0).data) for _ in sent] == [bytes(m.data) for m in sent]
    assert [equal(m, s) for m, s in zip(traffic.read_log(file), sent)] == 20 * [True]


def test_candumps_log_is_replayed(bus, table, tmp_path: Path):
    file = tmp_path / "b.log"
    with file.open("w") as out:
        candump = subprocess.Popen(["candump", "-L", DEVICE], stdout=out)
        time.sleep(1.0)
        sent = [table.encode("imu_posture", {"gyro_0": 0.1 * i}) for i in range(10)]
        for message in sent:
            bus.send(message)
        time.sleep(1.0)
        candump.send_signal(signal.SIGINT)
        candump.wait(10)
    done = hoap2_can("replay", str(file), "-i", "socketcan", "-c", DEVICE, "--speed", "0")
    assert done.returncode == 0 and "10 frames" in done.stderr
    assert [bytes(bus.recv(10.0).data) for _ in sent] == [bytes(m.data) for m in sent]


def test_own_frames_and_filters_are_as_on_the_other_interfaces(bus):
    options = {"receive_own_messages": True, "can_filters": [{"can_id": 0x100, "can_mask": 0x700, "extended": False}]}
    with interfaces.open_bus("socketcan", DEVICE, options) as other:
        other.send(can.Message(arbitration_id=0x123, is_extended_id=False))
        bus.send(can.Message(arbitration_id=0x223, is_extended_id=False))
        bus.send(can.Message(arbitration_id=0x1FF, is_extended_id=False))
        got = [other.recv(10.0), other.recv(10.0)]
        assert [m.arbitration_id for m in got] == [0x123, 0x1FF] and not got[0].is_rx
        assert other.recv(0.2) is None


def test_a_device_that_is_not_there_is_told_with_those_that_are():
    with pytest.raises(UserError, match="vcan7.*CAN devices: vcan0, vcan1"):
        interfaces.open_bus("socketcan", "vcan7")
    assert interfaces.available()["socketcan"] == ""
