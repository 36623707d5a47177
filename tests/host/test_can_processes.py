"""Controller and plant as processes over CAN channels: the same run as in one process, and what they do alone."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import can
import numpy as np
import pytest

from hoap2 import signal_log
from hoap2.can import interfaces, messages
from hoap2.can.process import MARK

CONTROLLER_SAFE = "faults: stale_input"


@pytest.fixture
def channels(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    folder = tmp_path_factory.mktemp("c")
    return ["-c", str(folder / "right"), "-c", str(folder / "left")]


@pytest.fixture
def start(channels: list[str]):
    """Start `can controller` or `can plant` on the channels."""
    started = []

    def run(*words: str) -> subprocess.Popen:
        started.append(subprocess.Popen([sys.executable, "-m", "hoap2.cli", "can", *words, *channels], text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE))  # fmt: skip
        return started[-1]

    yield run
    for process in started:
        process.kill()
        process.communicate()


def test_two_processes_in_lockstep_are_the_run_over_the_modelled_link(start, hoap2_cli, tmp_path: Path):
    common = ["floor-walk", "--seed", "3", "--duration", "1.5"]
    plant = start("plant", *common, "--out", str(tmp_path / "p.parquet"))
    controller = start("controller", *common, "--out", str(tmp_path / "c.parquet"))
    for process in (controller, plant):
        out, err = process.communicate(timeout=120)
        assert process.returncode == 0, out + err
    one = hoap2_cli("run", *common, "--link", "can", "--no-video", "--no-telemetry", "--out", str(tmp_path / "run"))
    assert "run folder" in one.stdout + one.stderr
    whole = signal_log.read(tmp_path / "run" / "signals.parquet")
    for name in ("c", "p"):
        part = signal_log.read(tmp_path / f"{name}.parquet")
        assert part.count == whole.count == 1501
        names = [column.name for column in part.reals + part.ints]
        assert [n for n in names if not np.array_equal(part.column(n), whole.column(n))] == []


def _until_it_runs(channel: str, who: str) -> can.BusABC:
    """A watcher of the channel, once a good number of ticks are done."""
    bus = interfaces.open_bus("hoap2_unix", channel)
    end = time.monotonic() + 60.0
    while time.monotonic() < end:
        message = bus.recv(1.0)
        if message and message.arbitration_id == MARK[who] and int.from_bytes(message.data, "little") > 300:
            return bus
    raise AssertionError("it never ran")


def test_without_the_controller_the_boards_hold(start, channels):
    plant, controller = start("plant", "floor-stand", "--duration", "60"), start("controller", "floor-stand")
    bus = _until_it_runs(channels[1], "controller")
    controller.send_signal(signal.SIGKILL)
    out, err = plant.communicate(timeout=60)
    bus.shutdown()
    assert plant.returncode == 1, out + err
    assert "the controller fell silent" in out and "9 of 9 boards in a safe mode" in out and "stands" in out


def test_without_the_plant_the_controller_reports_stale_inputs(start, channels):
    plant, controller = start("plant", "floor-stand", "--duration", "60"), start("controller", "floor-stand",
                                                                                 "--duration", "60")  # fmt: skip
    bus = _until_it_runs(channels[1], "plant")
    plant.send_signal(signal.SIGKILL)
    out, err = controller.communicate(timeout=60)
    bus.shutdown()
    assert controller.returncode == 1, out + err
    assert "the plant fell silent" in out and CONTROLLER_SAFE in out


def test_by_the_clock_each_side_takes_what_has_come(start):
    plant = start("plant", "floor-stand", "--duration", "1", "--pace", "0.1")
    controller = start("controller", "floor-stand", "--duration", "1", "--pace", "0.1")
    out, err = plant.communicate(timeout=90)
    assert plant.returncode == 0, out + err
    assert "plant: done" in out and "stands" in out
    out, err = controller.communicate(timeout=60)
    assert controller.returncode == 0, out + err


def test_a_side_that_was_to_be_shorter_ends_the_other_in_its_safe_mode(start):
    plant = start("plant", "floor-stand", "--duration", "5", "--timeout", "60")
    controller = start("controller", "floor-stand", "--duration", "0.5")
    out, err = plant.communicate(timeout=90)
    assert plant.returncode == 1 and "the controller ended at 0.500 s" in out, out + err
    assert controller.wait(30) == 0


def test_ctrl_c_ends_one_side_with_its_signals_kept_and_the_other_sees_it(start, channels, tmp_path: Path):
    plant = start("plant", "floor-stand", "--duration", "60", "--out", str(tmp_path / "p.parquet"))
    controller = start("controller", "floor-stand", "--duration", "60")
    bus = _until_it_runs(channels[1], "plant")
    plant.send_signal(signal.SIGINT)
    plant.communicate(timeout=60)
    controller.communicate(timeout=60)
    bus.shutdown()
    assert plant.returncode == 130 and controller.returncode == 1
    assert signal_log.read(tmp_path / "p.parquet").count > 250


def test_a_second_controller_silences_the_first(start, channels):
    start("plant", "floor-stand", "--duration", "60")
    controller = start("controller", "floor-stand", "--duration", "60")
    bus, table = _until_it_runs(channels[1], "controller"), messages.load()
    threading.Thread(target=lambda: [bus.send(table.encode("beat", {"counter": i})) for i in range(10)]).start()
    out, _ = controller.communicate(timeout=60)
    bus.shutdown()
    assert controller.returncode == 1 and "another controller is on the bus" in out and "controller: doubled" in out


def test_a_second_controller_of_the_same_channel_is_refused(start, channels, hoap2_cli):
    first = start("controller", "floor-stand", "--wait", "60")
    assert "waits for the plant" in first.stderr.readline()
    done = hoap2_cli("can", "controller", "floor-stand", *channels)
    assert done.returncode == 2 and "a node named 'controller' is on the channel" in done.stderr


@pytest.mark.parametrize(("words", "code", "told"), [
    (("plant", "floor-stand", "--wait", "0.3"), 1, "no controller on hoap2_unix"),
    (("controller", "floor-stand", "-i", "slcan"), 2, "8 bytes a frame"),
    (("controller", "floor-stand", "-i", "virtual"), 2, "does not leave the process"),
    (("controller", "floor-stand", "-i", "udp_multicast"), 2, "is not GROUP:PORT"),
    (("plant", "floor-stnd"), 2, "did you mean 'floor-stand'"),
    (("plant", "floor-stand", "--out", "/nowhere/p.parquet"), 2, "no folder /nowhere"),
])  # fmt: skip
def test_what_cannot_work_is_told(words, code: int, told: str, channels, hoap2_cli):
    extra = ["-c", "239.74.163.2:x", "-c", "239.74.163.2:y"] if "udp_multicast" in words else channels
    done = hoap2_cli("can", *words, *extra)
    assert done.returncode == code and told in done.stderr, done.stderr
    assert "Traceback" not in done.stderr


def test_the_robot_has_two_buses(hoap2_cli):
    done = hoap2_cli("can", "plant", "floor-stand", "-c", "a")
    assert done.returncode == 2 and "the robot has 2 buses" in done.stderr
    same = hoap2_cli("can", "plant", "floor-stand", "-i", "udp_multicast", "-c", "239.1.1.1", "-c", "239.1.1.2")
    assert same.returncode == 2 and "a port of its own" in same.stderr
