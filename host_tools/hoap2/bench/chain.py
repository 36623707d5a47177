"""`bench run`: a whole run of a scenario, and where the time of its ticks goes.

Real-time factor, wall clock, memory and the durations in the loop are those of an ordinary run in a process of its own.
A second walk tells how much of the FMUs' steps is FMI: in it the FMUs and the bare libraries go side by side through
the same ticks, so that a difference between them is not one of another load. All of it is on one core.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hoap2 import master, parameters, scenario
from hoap2.bench import measure
from hoap2.bench.recording import nested
from hoap2.binding import Controller, Plant
from hoap2.errors import UserError
from hoap2.library_side import LibrarySide
from hoap2.products import Choice, open_both
from hoap2.signal_log import SignalLog

NOW = time.perf_counter_ns
PARTS = ("controller", "plant", "exchange", "log", "rest")


@dataclass
class Samples:
    """Nanoseconds a tick of each part, and whether any of the ticks walked."""

    parts: dict[str, list[int]] = field(default_factory=dict)
    walked: bool = False

    def add(self, name: str, ns: int) -> None:
        self.parts.setdefault(name, []).append(ns)

    def array(self, name: str) -> np.ndarray:
        return np.array(self.parts[name])

    def mean(self, name: str) -> float:
        return measure.mean(self.array(name))


def call_overhead_ns(controller: Controller) -> float:
    """What timing an empty call into a library costs; taken off the library's figures."""
    empty = controller._c.hoap2_state_size
    samples = np.empty(5000)
    for k in range(samples.size):
        start = NOW()
        empty()
        samples[k] = NOW() - start
    return float(np.median(samples))


def walk(loaded: scenario.Scenario, ticks: int, fmi: int) -> tuple[Samples, float]:
    """Walk `ticks` ticks with the libraries and the FMUs side by side; samples, and the overhead in each (ns)."""
    values = {product: {n: nested(product, n, v) for n, v in loaded.values[product].items()}
              for product in loaded.values}
    bare = Controller(**values["controller"]), Plant(**values["plant"])
    opened = open_both(Choice(fmi=fmi), loaded)
    try:
        samples = _walk_both(bare, (opened.controller, opened.plant), ticks)
    finally:
        opened.close()
    if not samples.walked:
        raise UserError(f"the robot did not walk within {ticks} ticks; nothing to measure", "give more --seconds")
    return samples, call_overhead_ns(bare[0])


def _walk_both(bare: tuple[Controller, Plant], fmus: tuple[master.Side, master.Side], ticks: int) -> Samples:
    sides = LibrarySide(bare[0]), LibrarySide(bare[1])
    wires = [wire for a, b in (sides, fmus) for wire in (*master.connect(b, a), *master.connect(a, b))]
    log = SignalLog(master.log_columns(*fmus), ticks + 1)
    recorder = master.Recorder(*fmus, log)
    walking = parameters.table().enums["mode"].index("walk")
    (c, p), samples = bare, Samples()
    c_step, p_step = c._c.hoap2_step, p._c.hoap2_plant_step
    for k in range(ticks):
        if k % 2:  # the outputs into a row of the log, as a run does it
            t0 = NOW()
            recorder.row()
            samples.add("get_and_log", NOW() - t0)
        t1 = NOW()
        fmus[0].get_outputs()
        fmus[1].get_outputs()
        if k % 2 == 0:  # a second reading of the same values would be a warm one
            samples.add("get", NOW() - t1)
            log.count = k + 1
        _assert_equal(sides, fmus, k)
        samples.walked |= c.outputs.mode == walking
        for into, out, index_in, index_out in wires:
            into[index_in] = out[index_out]
        t2 = NOW()
        fmus[0].set_inputs()
        fmus[1].set_inputs()
        t3 = NOW()
        c_step(c._state, c.inputs.pointer, c.outputs.pointer)
        t4 = NOW()
        p_step(p._handle, p.inputs.pointer)
        t5 = NOW()
        fmus[0].step()
        t6 = NOW()
        fmus[1].step()
        t7 = NOW()
        p._get_outputs()
        for name, ns in (("set", t3 - t2), ("controller", t4 - t3), ("plant", t5 - t4),
                         ("controller_fmu", t6 - t5), ("plant_fmu", t7 - t6)):
            samples.add(name, ns)
    return samples


def _assert_equal(sides: tuple[LibrarySide, LibrarySide], fmus: tuple[master.Side, master.Side], tick: int) -> None:
    for side, fmu in zip(sides, fmus):
        if not (np.array_equal(side.real_out, fmu.real_out, equal_nan=True)
                and np.array_equal(side.int_out, fmu.int_out)):
            raise UserError(f"FMUs and libraries differ at tick {tick}: they come from different sources",
                            "build again: ./hoap2 fmu build", 3)


def split_of(loop_us: dict[str, float], tick_us: float, samples: Samples, overhead_ns: float) -> dict[str, float]:
    """Microseconds a tick of each part: what the run's loop saw, taken apart by what the walk beside it tells.

    loop_us: means of `set`, `controller`, `plant`, `get_and_log` in the run.
    """
    calls = {product: (samples.mean(f"{product}_fmu") - samples.mean(product) + overhead_ns) / 1e3
             for product in ("controller", "plant")}
    split = {product: loop_us[product] - call for product, call in calls.items()}
    split["log"] = (samples.mean("get_and_log") - samples.mean("get")) / 1e3
    split["exchange"] = loop_us["set"] + loop_us["get_and_log"] - split["log"] + sum(calls.values())
    split["rest"] = tick_us - sum(split.values())
    return {name: split[name] for name in PARTS}


def whole_run(name: str, fmi: int, duration_s: float | None) -> dict:
    """An ordinary run without video in a process of its own, which inherits the one core."""
    with tempfile.TemporaryDirectory(prefix="hoap2-bench-") as folder:
        out, noted = Path(folder) / "run", Path(folder) / "loop.json"
        command = [sys.executable, "-m", "hoap2.bench.child", str(noted), "run", name, "--no-video", "--json",
                   "--fmi", str(fmi), "--out", str(out)]
        command += [] if duration_s is None else ["--duration", str(duration_s)]
        begin = time.monotonic()
        with open(Path(folder) / "stdout", "w+b") as output:
            child = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
            _, status, usage = os.wait4(child.pid, 0)
            end = time.monotonic()
            child.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            text = output.read()
        if child.returncode not in (0, 1) or not noted.exists():
            raise UserError(f"the run of {name} ended with {child.returncode}", f"try ./hoap2 run {name}")
        summary = json.loads(text)
        notes = json.loads(noted.read_text())
    loop_begin, loop_end = notes["begin"], notes["end"]
    return {"real_time_factor": summary["real_time_factor"], "simulated_s": summary["duration_s"],
            "wall_s": {"set_up": loop_begin - begin, "loop": loop_end - loop_begin, "report": end - loop_end,
                       "total": end - begin},
            "peak_memory_mb": usage.ru_maxrss / 1024, "loop": notes["us"], "walking": notes["walking_us"]}


def once(name: str, fmi: int, duration_s: float | None = None) -> dict:
    """One repetition: every figure."""
    result = whole_run(name, fmi, duration_s)
    loaded = scenario.load(name)
    samples, overhead = walk(loaded, round(result["simulated_s"] * 1e6 / parameters.table().tick_us), fmi)
    result["tick_us"] = parameters.table().tick_us / result["real_time_factor"]
    result["split"] = split_of(result["loop"], result["tick_us"], samples, overhead)
    return result


def run(name: str, repeat: int, fmi: int, duration_s: float | None, progress: Callable[[str], None]) -> dict:
    """All repetitions; the figures are their medians."""
    scenario.load(name)  # a wrong name is told before the machine is taken
    runs = []
    with measure.one_core() as core:
        about = measure.machine(core)
        for number in range(repeat):
            progress(f"run {number + 1} of {repeat}")
            runs.append(once(name, fmi, duration_s))
    middle = measure.medians(runs)
    # medians of parts do not add up by themselves
    middle["split"]["rest"] += middle["tick_us"] - sum(middle["split"].values())
    return {"machine": about, "fmi": fmi, "scenario": name, **middle, "runs": runs}
