"""The python-can interface on AF_UNIX sockets: frames between nodes, the hub, python-can's own tools, the C node."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import can
import pytest

from hoap2.can import install, interfaces, unix_bus


@pytest.fixture
def channel(tmp_path_factory: pytest.TempPathFactory):
    """A channel of its own; the path is short, as sockets want it."""
    return str(tmp_path_factory.mktemp("c") / "bus")


@pytest.fixture
def node(channel: str):
    """Opens nodes on the channel, and closes them."""
    opened = []

    def join(**options) -> can.BusABC:
        opened.append(interfaces.open_bus("hoap2_unix", channel, options))
        return opened[-1]

    yield join
    for bus in opened:
        bus.shutdown()


def frame(identifier: int, data: bytes = b"", **options) -> can.Message:
    return can.Message(**{"arbitration_id": identifier, "data": data, "is_extended_id": False, **options})


FRAMES = {
    "classic": frame(0x123, b"12345678"), "empty": frame(0), "extended": frame(0x1FFFFFFF, b"x", is_extended_id=True),
    "remote": frame(0x7FF, is_remote_frame=True, dlc=8), "fd": frame(0x61, bytes(64), is_fd=True, bitrate_switch=True),
    "fd_slow": frame(0x61, bytes(12), is_fd=True, error_state_indicator=True),
    "error": can.Message(is_error_frame=True, arbitration_id=0x88, data=bytes(8), is_extended_id=False),
}  # fmt: skip


@pytest.mark.parametrize("name", FRAMES)
def test_a_frame_arrives_as_it_was_sent(name: str, node, channel: str):
    a, b = node(), node()
    a.send(FRAMES[name])
    got = b.recv(5.0)
    assert got.equals(FRAMES[name], timestamp_delta=None, check_channel=False) and got.is_rx
    assert abs(got.timestamp - time.time()) < 60.0 and got.channel == channel
    assert a.recv(0.0) is None


def test_own_frames_come_back_only_when_asked_for(node):
    echo, plain = node(receive_own_messages=True), node()
    echo.send(frame(1))
    plain.send(frame(2))
    got = [echo.recv(5.0), echo.recv(5.0)]
    assert [(m.arbitration_id, m.is_rx) for m in got] == [(1, False), (2, True)]
    assert plain.recv(5.0).arbitration_id == 1 and plain.recv(0.05) is None


def test_all_nodes_see_all_frames_in_one_order(node):
    senders, watchers = [node() for _ in range(3)], [node(), node()]
    count = 2000

    def work(k: int) -> None:
        for i in range(count):
            senders[k].send(frame(k, i.to_bytes(4, "little")))

    threads = [threading.Thread(target=work, args=(k,)) for k in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    seen = [[(m.arbitration_id, bytes(m.data)) for m in (w.recv(10.0) for _ in range(3 * count))] for w in watchers]
    assert seen[0] == seen[1]
    for k in range(3):
        assert [d for i, d in seen[0] if i == k] == [i.to_bytes(4, "little") for i in range(count)]


def test_filters_pass_what_they_name(node):
    a = node()
    b = node(can_filters=[{"can_id": 0x100, "can_mask": 0x700, "extended": False}])
    for identifier in (0x0FF, 0x123, 0x200, 0x1FF):
        a.send(frame(identifier))
    assert [b.recv(5.0).arbitration_id for _ in range(2)] == [0x123, 0x1FF]
    assert b.recv(0.05) is None


def test_waiting_ends_after_the_time_out(node):
    started = time.monotonic()
    assert node().recv(0.2) is None
    assert 0.15 < time.monotonic() - started < 20.0


def test_a_node_that_dies_leaves_the_others_alone(node, channel: str):
    a, b = node(), node()
    code = ("import sys; from hoap2.can import interfaces; b = interfaces.open_bus('hoap2_unix', sys.argv[1], "
            "{'name': 'doomed'}); print('in', flush=True); b.recv(60)")  # fmt: skip
    child = subprocess.Popen([sys.executable, "-c", code, channel], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "in\n"
    child.send_signal(signal.SIGKILL)
    child.wait(10)
    child.stdout.close()
    for i in range(1000):
        a.send(frame(i))
    assert [b.recv(5.0).arbitration_id for _ in range(1000)] == list(range(1000))
    node(name="doomed")  # its name is free again


def test_two_nodes_of_one_name_are_refused(node):
    node(name="controller")
    with pytest.raises(Exception, match="a node named 'controller' is on the channel"):
        node(name="controller")
    node(name="plant")


def test_a_channel_that_is_not_there(node, channel: str, tmp_path: Path):
    with pytest.raises(can.CanInitializationError, match="no hub at .*hoap2 can hub"):
        unix_bus.UnixBus(channel, with_hub=False)
    with pytest.raises(can.CanInitializationError, match="folder of the channel is not there"):
        unix_bus.UnixBus(str(tmp_path / "none" / "bus"))
    with pytest.raises(can.CanInitializationError, match="107 bytes"):
        unix_bus.UnixBus("/" + 120 * "x")


def test_a_file_in_the_place_of_the_socket_is_kept(channel: str):
    Path(channel).write_text("precious")
    with pytest.raises(can.CanInitializationError):
        unix_bus.UnixBus(channel)
    assert Path(channel).read_text() == "precious"


def test_a_socket_that_a_dead_hub_left_is_taken_over(node, channel: str):
    left = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    left.bind(channel)
    left.close()
    a, b = node(), node()
    a.send(frame(5))
    assert b.recv(5.0).arbitration_id == 5


def test_a_hub_that_goes_is_an_error_for_its_nodes_and_a_new_one_can_be_joined(channel: str, build_dir: Path):
    hub = subprocess.Popen([build_dir / "host_tools/can/hoap2_can_hub", channel])
    while not os.path.exists(channel):
        time.sleep(0.01)
    bus = unix_bus.UnixBus(channel)
    hub.terminate()
    hub.wait(10)
    with pytest.raises(can.CanOperationError, match="has gone"):
        bus.recv(5.0)
    with pytest.raises(can.CanOperationError, match="has gone"):
        bus.send(frame(1))
    bus.shutdown()
    with pytest.raises(can.CanOperationError, match="shut down"):
        bus.send(frame(1))
    unix_bus.UnixBus(channel).shutdown()


def test_a_node_that_does_not_read_loses_frames_and_is_told_others_do_not(node):
    fast, lazy, keen = node(), node(), node()
    total = 80_000  # the hub keeps 65536 for each node
    got = []
    reader = threading.Thread(target=lambda: got.extend(keen.recv(30.0).arbitration_id for _ in range(total)))
    reader.start()
    message = frame(0)
    for i in range(total):
        message.arbitration_id = i % 2048
        fast.send(message)
    reader.join()
    assert got == [i % 2048 for i in range(total)]
    late = []
    while (message := lazy.recv(2.0)) is not None:
        late.append(message)
    *frames, told = late
    assert told.is_error_frame and (told.arbitration_id, told.data[1]) == unix_bus.RX_OVERFLOW
    assert [m.arbitration_id for m in frames] == [i % 2048 for i in range(len(frames))] and 65536 <= len(frames) < total


@pytest.mark.parametrize("bad", [b"", b"\x00" * 15, b"\xff" * 200, b"\x00" * 12 + b"\x09\x00\x00\x00" + b"x" * 9])
def test_a_node_that_sends_no_frames_is_put_out(bad: bytes, node, channel: str):
    a, b = node(), node()
    stranger = unix_bus.join(channel, "", False, with_hub=False)
    stranger.setblocking(True)
    stranger.settimeout(10.0)
    stranger.send(bad or b"\x01")
    assert stranger.recv(10) == b""
    stranger.close()
    a.send(frame(3))
    assert b.recv(5.0).arbitration_id == 3


def test_a_stranger_that_says_the_wrong_hello_is_told(node, channel: str):
    node()
    stranger = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    stranger.settimeout(10.0)
    stranger.connect(channel)
    stranger.send(b"GET / HTTP/1.1\r\n")
    assert stranger.recv(100)[4:] == (3).to_bytes(4, sys.byteorder)
    stranger.close()


def test_the_hub_ends_when_it_is_alone(channel: str):
    unix_bus.UnixBus(channel).shutdown()
    assert os.path.exists(channel)
    end = time.monotonic() + 30.0
    while os.path.exists(channel) and time.monotonic() < end:
        time.sleep(0.1)
    assert not os.path.exists(channel)


@pytest.fixture
def with_entry_point(tmp_path: Path) -> dict[str, str]:
    """An environment in which python-can finds the interface as an installed one."""
    site = tmp_path / "site"
    assert install.install(site) and not install.install(site)
    return {**os.environ, "PYTHONPATH": f"{site}{os.pathsep}{os.environ['PYTHONPATH']}"}


def test_python_cans_own_tools_work_on_it(node, channel: str, tmp_path: Path, with_entry_point):
    options = ["-i", "hoap2_unix", "-c", channel]
    logged = tmp_path / "a.log"
    logger = subprocess.Popen([sys.executable, "-m", "can.logger", *options, "-f", str(logged)], env=with_entry_point,
                              stdout=subprocess.PIPE, text=True)  # fmt: skip
    assert "Connected to" in logger.stdout.readline()
    bus = node()
    sent = [frame(i, bytes(8)) for i in range(50)] + [frame(9, bytes(32), is_fd=True, bitrate_switch=True)]
    for message in sent:
        bus.send(message)
    time.sleep(1.0)
    logger.send_signal(signal.SIGINT)
    logger.communicate(timeout=20)
    read = list(can.LogReader(str(logged)))
    assert [(m.arbitration_id, bytes(m.data)) for m in read] == [(m.arbitration_id, bytes(m.data)) for m in sent]
    player = subprocess.run([sys.executable, "-m", "can.player", *options, "-g", "0", str(logged)],
                            env=with_entry_point, timeout=60, capture_output=True, text=True)  # fmt: skip
    assert player.returncode == 0, player.stderr
    assert [bus.recv(5.0).arbitration_id for _ in sent] == [m.arbitration_id for m in sent]
    viewer = subprocess.run([sys.executable, "-m", "can.viewer", "--help"], env=with_entry_point, timeout=60,
                            capture_output=True, text=True)  # fmt: skip
    assert viewer.returncode == 0 and "hoap2_unix" in viewer.stdout


def test_the_c_node_speaks_with_python(node, channel: str, build_dir: Path):
    bus = node()
    ping = build_dir / "host_tools" / "can" / "hoap2_can_ping"
    child = subprocess.Popen([ping, channel, "ping", "200"], stdout=subprocess.PIPE, text=True)
    for i in range(200):
        got = bus.recv(10.0)
        assert got.is_fd and got.bitrate_switch and len(got.data) == 32 and got.data[0] == i % 256
        bus.send(frame(0x7F1, bytes(got.data), is_fd=True, bitrate_switch=True))
    out, _ = child.communicate(timeout=20)
    assert child.returncode == 0 and float(out) > 0
    missing = subprocess.run([ping, channel + "x", "ping", "1"], capture_output=True, text=True, timeout=20)
    assert missing.returncode == 1 and "No such file" in missing.stderr
