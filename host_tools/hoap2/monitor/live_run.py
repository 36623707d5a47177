"""What the monitor knows of a run that it follows."""

from __future__ import annotations

import tomllib
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from hoap2.monitor import track
from hoap2.monitor.live_soil import LiveSoil

BACKLOG_ROWS = 3000  # at 100 Hz half a minute
EVENTS = 300
ANSWERS = 60
STEPS = 2000


@dataclass
class LiveRun:
    """What is known of the run that is followed."""

    run_id: int
    key: str  # what the pages call it: another one each time it is played
    document: dict | None = None  # of its run_t
    rows: deque = field(default_factory=lambda: deque(maxlen=BACKLOG_ROWS))
    events: deque = field(default_factory=lambda: deque(maxlen=EVENTS))
    steps: deque = field(default_factory=lambda: deque(maxlen=STEPS))
    step: dict | None = None  # under way
    start_feet: list[dict] = field(default_factory=list)
    answers: deque = field(default_factory=lambda: deque(maxlen=ANSWERS))
    soil: LiveSoil | None = None
    ended: bool = False

    def note_step(self, t_s: float, gait) -> dict | None:
        """Follow the steps; a step that has just been finished, with where it landed."""
        step, index, finished = self.step, gait.step_index, None
        if step is not None and step["number"] != index:
            self.steps.append(step)
            finished, self.step, step = step, None, None
        if index > 0:
            step = step or {"number": index, "first_s": t_s, "left": False}
            if gait.stance_foot in (0, 1):
                step["left"] = gait.stance_foot == 0
            x, y, yaw = gait.footprint_W_m_rad
            self.step = step | {"last_s": t_s, "x": x, "y": y, "yaw": yaw}
        return finished


def rows_block(rows: list[tuple[float, np.ndarray]], key: str) -> bytes:
    return track.pack({"kind": "rows", "run_id": key},
                      {"t_s": np.array([t for t, _ in rows]), "rows": np.array([row for _, row in rows])})  # fmt: skip


def feet(message) -> list[dict]:
    return [{"x": p[0], "y": p[1], "yaw": yaw, "left": bool(foot)}
            for foot, (p, yaw) in enumerate(zip(message.true_foot_pos_W_m, message.true_foot_yaw_W_rad))]  # fmt: skip


def toml(text: str) -> dict:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return {}
