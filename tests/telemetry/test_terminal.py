"""The monitor in the terminal: pictures of any size, of any state of the run."""

from __future__ import annotations

import io
import math
import os
import pty
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest
from rich.console import Console

from hoap2 import parameters
from hoap2.monitor import terminal
from hoap2.monitor.terminal_drawing import GROUND, SKY, Canvas, bar, horizon
from hoap2.monitor.terminal_view import View
from hoap2.telemetry import types

ROOT = Path(__file__).resolve().parents[2]
ROWS = {s.name: s for s in parameters.table().signals if s.group == "output"}


class Sender:
    """A view, and whoever publishes to it within this process."""

    def __init__(self) -> None:
        self.view = View("memq://")
        self.sequence: dict[tuple[str, int], int] = {}

    def send(self, channel: str, run_id: int = 1, skip: int = 0, **fields) -> None:
        message = types.type_of(channel)()
        number = self.sequence.get((channel, run_id), 0) + skip
        self.sequence[channel, run_id] = number + 1
        for name, value in ({"run_id": run_id, "sequence": number} | fields).items():
            assert hasattr(message, name), name
            setattr(message, name, value)
        self.view.listener.publish(channel, message)
        self.view.poll(0.0)

    def everything(self, run_id: int = 1, **gait) -> None:
        self.send(types.RUN, run_id, scenario="floor-walk", sensors="hoap2", duration_s=18.3, state=0,
                  schema_hash=types.type_of(types.RUN).SCHEMA_HASH)  # fmt: skip
        self.send(types.STATE, run_id)
        standing = {"foot_ref_W_m": [[0.0, -0.039, 0.0], [0.0, 0.039, 0.0]], "foot_force_est_N": [34.0, 34.0], "mode": 3,
                    "cop_est_W_m": [0.02, -0.039]}  # fmt: skip
        self.send(types.GAIT, run_id, **(standing | gait))
        self.send(types.TRUTH, run_id)
        self.send(types.HEALTH, run_id, time_us=1_500_000, real_time_factor=1.0)

    def shown(self, width: int = 170, height: int = 48) -> str:
        console = Console(width=width, height=height, file=io.StringIO(), force_terminal=True, color_system=None)
        console.print(terminal.frame(self.view, width, height), height=height)
        return console.file.getvalue()


@pytest.fixture
def sender():
    made = Sender()
    yield made
    made.view.close()


@pytest.mark.parametrize("size", [(250, 70), (170, 48), (140, 45), (132, 30), (100, 40), (95, 24), (80, 24), (60, 20), (30, 8)])
def test_a_picture_fits_any_terminal(sender, size):
    sender.everything()
    for i in range(40):
        sender.send(types.EVENT, kind="note", text=f"event {i} " + "x" * 200)
    lines = sender.shown(*size).splitlines()
    assert len(lines) <= size[1] and all(len(line) <= size[0] for line in lines)
    text = "\n".join(lines)
    assert "floor-walk" in text and "gait" in text and "mode" in text and "Layout" not in text
    if size[0] >= 80:
        assert "event 39" in text and "roll" in text
    if size[0] >= 140:
        assert "r_knee" in text and "l_hand" in text and "feet from above" in text


def test_without_a_run_it_says_how_to_start_one(sender):
    text = sender.shown(80, 24)
    assert "No run is heard on memq://" in text and "./hoap2 run floor-walk --realtime" in text


def test_faults_are_named_and_explained(sender):
    faults = parameters.table().faults
    sender.everything(fault=faults["bad_input"] | faults["joint_limit"], mode=4)
    text = sender.shown(250, 60)
    assert "bad_input" in text and "joint_limit" in text and "hold" in text and "not finite" in text


def test_numbers_come_with_their_units_and_nonsense_does_not_hurt(sender):
    sender.everything(step_index=7, step_advance_m_rad=[0.02, -0.005, math.radians(3.0)], request_state=3,
                      roll_est_rad=math.radians(-1.25), com_deviation_W_m=[0.0012, -0.0034])  # fmt: skip
    text = sender.shown()
    for words in ("+20.0 mm, -5.0 mm left, +3.0 deg", "limited", "-1.25 deg", "+1.2   -3.4 mm", "1.50 of 18.30 s"):
        assert words in text, words
    nan = [math.nan] * 3
    sender.everything(mode=99, phase=-1, stance_foot=9, request_state=77, roll_est_rad=math.nan, cop_est_W_m=nan[:2],
                      foot_ref_W_m=[nan, nan], step_advance_m_rad=nan, foot_ref_yaw_W_rad=nan[:2])  # fmt: skip
    sender.send(types.STATE, q_enc_rad=[math.nan] * 25, q_ref_rad=[math.inf] * 25)
    sender.send(types.TRUTH, true_tau_Nm=[math.nan] * 25, true_chest_rpy_rad=nan)
    for size in ((170, 48), (80, 60)):
        assert "99" in sender.shown(*size)


def test_lost_and_repeated_messages_are_counted(sender):
    sender.everything()
    sender.send(types.TRUTH, skip=41)
    sender.sequence[types.TRUTH, 1] = 5
    sender.send(types.TRUTH)
    row = next(line for line in sender.shown().splitlines() if " truth " in line)
    assert row.split("truth")[1].split()[1:3] == ["41", "1"]


def test_an_end_a_silence_and_a_new_run_are_told(sender, monkeypatch):
    sender.everything()
    sender.send(types.EVENT, kind="run_started", text="the first")
    assert "running" in sender.shown()
    now = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now + 7.0)
    assert "silent for 7 s" in sender.shown()
    monkeypatch.undo()
    sender.send(types.EVENT, kind="run_ended", text="fell")
    sender.send(types.RUN, scenario="floor-walk", state=types.type_of(types.RUN).ENDED)
    assert "ended: fell" in sender.shown()
    sender.everything(run_id=2)
    text = sender.shown()
    assert "running" in text and "the first" not in text
    sender.send(types.RUN, run_id=1, skip=1, state=types.type_of(types.RUN).ENDED)
    assert "running" in sender.shown()


def test_of_two_runs_the_first_is_followed_to_its_end(sender):
    sender.everything(step_index=11)
    sender.shown()
    for _ in range(3):
        sender.everything(run_id=2, step_index=22)
        sender.send(types.EVENT, run_id=2, kind="note", text="of the other one")
        text = sender.shown()
        assert "11, 0 done" in text and "22, 0 done" not in text and "other one" not in text
        sender.everything(step_index=11)
    sender.send(types.EVENT, kind="run_ended", text="done")
    sender.everything(run_id=2, step_index=22)
    assert "22, 0 done" in sender.shown()


def test_steps_do_not_drive_other_events_away(sender):
    sender.everything()
    sender.send(types.EVENT, kind="command_refused", text="push chest: too hard", time_us=1_000_000)
    for i in range(60):
        sender.send(types.EVENT, kind="step", text=f"step {i}, stance left", time_us=2_000_000 + i)
    text = sender.shown()
    assert "too hard" in text and "step 59" in text and "step 2," not in text


def test_texts_from_outside_cannot_touch_the_terminal(sender):
    sender.everything()
    sender.send(types.EVENT, kind="note", text="\x1b[2J[red]gone[/] \x07 hello")
    text = sender.shown()
    assert "[red]gone[/]" in text and "\x1b[2J" not in text and "\x07" not in text


def halves(text) -> list[tuple[str, str]]:
    """Upper and lower colour of each character of a horizon."""
    styles = [(span.style.color.name if span.style.color else "", span.style.bgcolor.name) for span in text.spans]
    return [(c, b) for (c, b), character in zip(styles, text.plain.replace("\n", "")) if character == "▀"]


def test_the_horizon_is_where_a_pilot_sees_it():
    level = [colour for pair in halves(horizon(0.0, 0.0, 21, 10, 1.0)) for colour in pair]
    assert abs(level.count(SKY) - level.count(GROUND)) <= 21
    down = [colour for pair in halves(horizon(0.0, math.radians(5.0), 21, 10, 1.0)) for colour in pair]
    assert down.count(GROUND) > level.count(GROUND) + 4 * 21
    tilted = horizon(math.radians(30.0), 0.0, 21, 10, 1.0)  # the right side down: the ground is seen higher on the right
    row = halves(tilted)[3 * 21 : 4 * 21]
    assert row[0][0] == SKY and row[-1][0] == GROUND


def test_the_cop_is_drawn_in_its_sole(sender):
    """Its character stands between the edges of the right sole, ahead of the ankle."""
    sender.everything(com_est_W_m=[0.009, 0.0, 0.25])
    lines = [line[:50] for line in sender.shown().splitlines()]
    first = next(i for i, line in enumerate(lines) if "feet from above" in line)
    ankle = next((i, line.index("R")) for i, line in enumerate(lines[first:]) if " R " in line)
    cop = next((i, line.index("●")) for i, line in enumerate(lines[first:]) if "●" in line)
    com = next((i, line.index("◆")) for i, line in enumerate(lines[first:]) if "◆" in line)
    left = next(line.index("L") for line in lines[first:] if " L " in line)
    assert cop[1] == ankle[1] and 1 <= ankle[0] - cop[0] <= 4
    assert left < com[1] < ankle[1] and com[0] <= ankle[0]


def test_bars_and_dots_stay_where_they_belong():
    assert bar(0.0, -1.0, 1.0, 11, "").plain.index("■") == 5
    assert bar(9.0, -1.0, 1.0, 11, "").plain.index("■") == 10 and bar(-9.0, -1.0, 1.0, 11, "").plain.index("■") == 0
    assert bar(0.5, -1.0, 1.0, 20, "", -0.5).plain.index("│") == 5
    canvas = Canvas(4, 3, (0.0, 0.0), 0.01)
    canvas.line((-1.0, 0.0), (1.0, 0.0), "")
    canvas.mark((5.0, 5.0), "x", "")
    assert "x" not in canvas.text().plain and canvas.text().plain.count("\n") == 2
    assert all(0x2800 < ord(c) < 0x2900 for c in canvas.text().plain.split("\n")[1])


def heard(leader: int) -> bytes:
    """What the terminal was given within a tenth of a second; nothing once its program is gone."""
    try:
        return os.read(leader, 65536) if select.select([leader], [], [], 0.1)[0] else b""
    except OSError:
        return b""


def test_q_leaves_the_terminal_as_it_was(network_command):
    """Started without a run, in a terminal of its own."""
    leader, follower = pty.openpty()
    command = network_command([sys.executable, "-m", "hoap2.cli", "monitor"])
    environment = os.environ | {"PYTHONPATH": str(ROOT / "host_tools"), "TERM": "xterm-256color", "COLUMNS": "90",
                                "LINES": "30"}  # fmt: skip
    child = subprocess.Popen(command, stdin=follower, stdout=follower, stderr=follower, env=environment, cwd=ROOT)
    os.close(follower)
    said, end, asked = b"", time.monotonic() + 60.0, False
    try:
        while time.monotonic() < end and child.poll() is None:
            said += heard(leader)
            if not asked and b"No run is heard" in said:
                os.write(leader, b"q")
                asked = True
        assert child.wait(10) == 0 and asked
        said += heard(leader)
    finally:
        child.kill()
        os.close(leader)
    assert b"\x1b[?1049h" in said and b"\x1b[?1049l" in said and b"Traceback" not in said
