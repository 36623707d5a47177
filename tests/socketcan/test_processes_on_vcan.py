"""Controller and plant as processes on vcan0 and vcan1, candump watching."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from hoap2 import signal_log
from hoap2.can import messages, traffic

pytestmark = pytest.mark.socketcan
DEVICES = ("vcan0", "vcan1")
TICKS = 300


def start(side: str, out: Path) -> subprocess.Popen:
    devices = [word for device in DEVICES for word in ("-c", device)]
    return subprocess.Popen([sys.executable, "-m", "hoap2.cli", "can", side, "floor-stand", "-i", "socketcan", *devices,
                             "--duration", f"{TICKS / 1000}", "--wait", "200", "--timeout", "60", "--out", str(out)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)  # fmt: skip


def test_they_stand_in_lockstep_and_candump_sees_every_frame(tmp_path: Path):
    logs = [tmp_path / f"{device}.log" for device in DEVICES]
    watchers = [subprocess.Popen(["candump", "-L", device], stdout=log.open("w")) for device, log in zip(DEVICES, logs)]
    sides = {name: start(name, tmp_path / f"{name}.parquet") for name in ("plant", "controller")}
    for name, process in sides.items():
        out, err = process.communicate(timeout=300)
        print(out)
        assert process.returncode == 0 and f"{name}: done" in out, out + err
        assert "refused: none" in out
    time.sleep(1.0)
    for watcher in watchers:
        watcher.send_signal(signal.SIGINT)
        watcher.wait(20)
    table, seen = messages.load(), Counter()
    for log in logs:
        for message in traffic.read_log(log):
            seen[table.name(message)] += 1
            assert table.fault(message) == ""
    # four ticks of the boot, and those of the run
    for name in ("command_r_leg", "command_l_leg", "status_r_leg", "status_l_leg"):
        assert TICKS <= seen[name] <= TICKS + 4
    assert seen["beat"] == 2 * (TICKS + 4) and seen["stop_controller"] == 0
    plant, controller = (signal_log.read(tmp_path / f"{name}.parquet") for name in ("plant", "controller"))
    assert plant.count == controller.count == TICKS + 1
    assert np.ptp(plant.block("p.true_com_W_m"), axis=0).max() < 0.002
