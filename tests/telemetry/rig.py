"""Runs of scripted products with telemetry, and their logs read back."""

from __future__ import annotations

from pathlib import Path

import lcm

from hoap2 import master
from hoap2.pace import Pace
from hoap2.telemetry import types
from hoap2.telemetry.run_telemetry import About, RunTelemetry

RUN_ID = 77


def about(**changes) -> About:
    given = {"run_id": RUN_ID, "scenario": "scripted", "title": "A scripted run", "seed": 3, "sensors": "ideal",
             "duration_s": 1.0, "run_toml": "a = 1\n", "folder": "/nowhere"}  # fmt: skip
    return About(**(given | changes))


def run(controller, plant, ticks: int, log_path: Path | None, url: str | None = None, pace: Pace | None = None,
        **company) -> tuple[master.Outcome, RunTelemetry]:  # fmt: skip
    """The master's own loop; falls are followed for 0.1 s."""
    telemetry = RunTelemetry(about(), log_path, url, pace)
    outcome = master.run(controller, plant, ticks, 0.1, master.StopRequest(),
                         master.Company(telemetry=telemetry, pace=pace, **company))  # fmt: skip
    return outcome, telemetry


def read(path: Path) -> list[tuple[int, str, object]]:
    """(time_us, channel, message) of a whole log."""
    return [
        (event.timestamp, event.channel, types.decode(event.channel, event.data)) for event in lcm.EventLog(str(path))
    ]


def of(channel: str, log: list[tuple[int, str, object]]) -> list:
    """The messages of one channel."""
    return [message for _, name, message in log if name == channel]
