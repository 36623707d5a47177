"""Fabricated walks: signal logs, run folders and summaries whose answers are known."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np

from hoap2 import bounds, metrics, parameters, runner, scenario, walk_plan
from hoap2.signal_log import SignalLog, columns_of

BEGIN_TICK, STEP_TICKS, STEPS = 1800, 400, 36
DEG = math.pi / 180.0


def log_of_walk(loaded: scenario.Scenario, ticks: int = 18000) -> SignalLog:
    """A faultless walk: the feet where the plan has them, single support in the middle 80 % of each step."""
    log = SignalLog(columns_of("controller") + columns_of("plant"), ticks)
    log.count = ticks
    log.real[:], log.integer[:] = 0.0, 0
    tick = np.arange(ticks)
    index = np.clip((tick - BEGIN_TICK) // STEP_TICKS + 1, 0, STEPS)
    walking = (tick >= BEGIN_TICK) & (tick < BEGIN_TICK + STEPS * STEP_TICKS)
    within = (tick - BEGIN_TICK) % STEP_TICKS / STEP_TICKS
    enums = parameters.table().enums
    single = walking & (within >= 0.1) & (within < 0.9)
    log.column("c.step_index")[:] = index
    log.column("c.steps_done")[:] = np.clip((tick - BEGIN_TICK) // STEP_TICKS, 0, STEPS)
    log.column("c.mode")[:] = np.where(walking, enums["mode"].index("walk"), enums["mode"].index("stand"))
    log.column("c.phase")[:] = np.where(single, enums["phase"].index("single_support"), 0)
    log.column("c.stance_foot")[:] = np.where(single, index % 2, 2)  # the right foot swings first
    prints = walk_plan.footprints(loaded.values["controller"], STEPS)
    feet = log.block("p.true_foot_pos_W_m")
    for foot in (0, 1):
        feet[:, 3 * foot], feet[:, 3 * foot + 1] = prints[foot].x_m, prints[foot].y_m
    for step in range(1, STEPS + 1):
        landed = BEGIN_TICK + step * STEP_TICKS - 50
        feet[landed:, 3 * prints[step + 1].foot] = prints[step + 1].x_m
    log.block("p.true_base_quat_W")[:, 0] = 1.0
    com = log.block("p.true_com_W_m")
    com[:, 0], com[:, 2] = 0.009 + 0.5 * (feet[:, 0] + feet[:, 3]), 0.2575
    log.block("p.true_base_pos_W_m")[:] = com - [0.009, 0.0, 0.03]
    log.block("p.true_foot_force_W_N")[:, [2, 5]] = 34.5
    return log


def fall_in_step(log: SignalLog, step: int, axis: int = 1, sign: float = -1.0) -> int:
    """Tilt from the middle of a step on, 45 deg within that step; returns the tick of the fall."""
    start = BEGIN_TICK + (step - 1) * STEP_TICKS + STEP_TICKS // 2
    ramp = np.clip(np.arange(log.count) - start, 0, 290) * 0.3 * DEG
    log.block("p.true_chest_rpy_rad")[:, axis] += sign * ramp
    return start + 151  # the first tick beyond 45 deg at 0.3 deg a tick


def summary_of(loaded: scenario.Scenario, log: SignalLog) -> dict:
    """summary.json of a run with this log."""
    numbers = metrics.compute(log, loaded)
    verdict = bounds.judge(loaded.bounds, numbers)
    return {
        "scenario": loaded.name, "title": loaded.title, "section": loaded.section, "seed": loaded.seed,
        "ok": all(entry["ok"] for entry in verdict.values()), "interrupted": False, "error": None,
        "sense": loaded.sensors, "duration_s": (log.count - 1) * 1e-3, **numbers, "bounds": verdict,
    }  # fmt: skip


def run_folder(folder: Path, loaded: scenario.Scenario, log: SignalLog) -> Path:
    """A run folder with this log, without pictures."""
    folder.mkdir(parents=True)
    (folder / "run.toml").write_text(runner.resolved_toml(loaded, {}), encoding="utf-8")
    (folder / "summary.json").write_text(json.dumps(summary_of(loaded, log)), encoding="utf-8")
    log.write(folder / "signals.parquet")
    return folder
