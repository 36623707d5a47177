"""What the parts of a run cost on this machine.

Every figure of a repetition comes from one process and one trajectory: the FMUs and the bare libraries walk side
by side through the same ticks, so that a difference between them is the cost of FMI and not of another load.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hoap2 import master, parameters, scenario
from hoap2.binding import Controller, Plant
from hoap2.errors import UserError
from hoap2.library_side import LibrarySide
from hoap2.products import Choice, open_both
from hoap2.signal_log import SignalLog

SCENARIO = "floor-walk"
NOW = time.perf_counter_ns


@dataclass
class Spread:
    """Median and 99th percentile of one duration, in microseconds."""

    median: float
    p99: float

    @classmethod
    def of(cls, ns: np.ndarray, overhead_ns: float = 0.0) -> Spread:
        return cls(float(np.median(ns) - overhead_ns) / 1e3, float(np.percentile(ns, 99) - overhead_ns) / 1e3)


@dataclass
class Samples:
    """Nanoseconds a tick of each part, while the robot walks."""

    parts: dict[str, list[int]] = field(default_factory=dict)

    def add(self, name: str, ns: int) -> None:
        self.parts.setdefault(name, []).append(ns)

    def array(self, name: str) -> np.ndarray:
        return np.array(self.parts[name])


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
    """Walk `ticks` ticks with the libraries and the FMUs side by side; samples are taken in mode WALK only."""
    values = {product: {n: _nested(product, n, v) for n, v in loaded.values[product].items()}
              for product in loaded.values}
    bare = Controller(**values["controller"]), Plant(**values["plant"])
    opened = open_both(Choice(fmi=fmi), loaded)
    try:
        kept = _walk_both(bare, (opened.controller, opened.plant), ticks)
    finally:
        opened.close()
    if "controller" not in kept.parts:
        raise UserError(f"the robot did not walk within {ticks} ticks; nothing to measure", "give more --seconds")
    return kept, call_overhead_ns(bare[0])


def _walk_both(bare: tuple[Controller, Plant], fmus: tuple[master.Side, master.Side], ticks: int) -> Samples:
    sides = LibrarySide(bare[0]), LibrarySide(bare[1])
    wires = [wire for a, b in (sides, fmus) for wire in (*master.connect(b, a), *master.connect(a, b))]
    recorder = master.Recorder(*fmus, SignalLog(master.log_columns(*fmus), ticks + 1))
    walking = parameters.table().enums["mode"].index("walk")
    (c, p), thrown, kept = bare, Samples(), Samples()
    c_step, p_step = c._c.hoap2_step, p._c.hoap2_plant_step
    for k in range(ticks + 1):
        samples = kept if c.outputs.mode == walking else thrown
        t0 = NOW()
        fmus[0].get_outputs()
        fmus[1].get_outputs()
        t1 = NOW()
        recorder.row()
        samples.add("log", NOW() - t1)
        for side, fmu in zip(sides, fmus):
            if not (np.array_equal(side.real_out, fmu.real_out, equal_nan=True)
                    and np.array_equal(side.int_out, fmu.int_out)):
                raise UserError(f"FMUs and libraries differ at tick {k}: they come from different sources",
                                "build again: ./hoap2 fmu build", 3)
        if k == ticks:
            return kept
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
        for name, ns in (("get_set", t1 - t0 + t3 - t2), ("controller", t4 - t3), ("plant", t5 - t4),
                         ("controller_fmu", t6 - t5), ("plant_fmu", t7 - t6)):
            samples.add(name, ns)
    return kept


def _nested(product: str, name: str, flat: tuple[float, ...]):
    return list(flat) if parameters.known(product)[name].shape else flat[0]


def chain(fmi: int) -> dict:
    """A whole run in a process of its own: real-time factor and peak memory."""
    with tempfile.TemporaryDirectory(prefix="hoap2-bench-") as folder:
        command = [sys.executable, "-m", "hoap2.cli", "run", SCENARIO, "--no-video", "--fmi", str(fmi), "--json",
                   "--out", str(Path(folder) / "run")]
        start = time.perf_counter()
        with open(Path(folder) / "stdout", "w+b") as output:
            child = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            text = output.read()
    if child.returncode not in (0, 1):
        raise UserError(f"the run of {SCENARIO} ended with {child.returncode}", f"try ./hoap2 run {SCENARIO}")
    summary = json.loads(text)
    return {"real_time_factor": summary["real_time_factor"], "run_wall_s": time.perf_counter() - start,
            "simulated_s": summary["duration_s"], "peak_memory_mb": usage.ru_maxrss / 1024}


def once(seconds: float, fmi: int) -> dict:
    """One repetition: every figure, microseconds a tick unless the name says otherwise."""
    loaded = scenario.load(SCENARIO)
    samples, overhead = walk(loaded, round(seconds * 1000), fmi)
    controller, plant = samples.array("controller") - overhead, samples.array("plant") - overhead
    result = {name: vars(Spread.of(ns)) for name, ns in (
        ("controller_us", controller), ("plant_us", plant), ("log_us", samples.array("log")))}
    # of medians: a difference of two noisy durations has no 99th percentile worth showing
    model = float(np.median(controller) + np.median(plant))
    exchange = float(np.median(samples.array("get_set")) + np.median(samples.array("controller_fmu"))
                     + np.median(samples.array("plant_fmu"))) - model
    result["fmu_exchange_us"] = {"median": exchange / 1e3, "p99": None}
    result["fmu_exchange_share"] = exchange / (model + exchange)
    result["controller_share_of_tick"] = float(np.median(controller) / (parameters.table().tick_us * 1e3))
    result["ticks_measured"] = int(controller.size)
    return result | chain(fmi)


def machine() -> dict:
    """What the figures belong to."""
    model = platform.processor()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model)
    except OSError:
        pass
    return {"processor": model, "cores": os.cpu_count(), "load": os.getloadavg()[0],
            "python": platform.python_version()}
