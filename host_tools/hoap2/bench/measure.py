"""What every benchmark needs: spreads, the machine, one core."""

from __future__ import annotations

import contextlib
import gc
import os
import platform
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SCENARIO = "floor-walk"


@dataclass
class Spread:
    """Median and 99th percentile of one duration, in microseconds."""

    median: float
    p99: float

    @classmethod
    def of(cls, ns: np.ndarray, overhead_ns: float = 0.0) -> Spread:
        return cls(float(np.median(ns) - overhead_ns) / 1e3, float(np.percentile(ns, 99) - overhead_ns) / 1e3)


def mean(ns: np.ndarray) -> float:
    """Mean without the hundredth that is longest: what the system interrupts is not the part's."""
    return float(np.sort(ns)[: max(1, round(0.99 * ns.size))].mean())


def median(values: list[float]) -> float:
    return float(np.median(values))


def medians(runs: list) -> dict | float | bool:
    """The same tree with the median over the repetitions of each number."""
    first = runs[0]
    if isinstance(first, dict):
        return {key: medians([run[key] for run in runs]) for key in first}
    if isinstance(first, bool):
        return all(runs)
    return median(runs)


def machine(core: int | None = None) -> dict:
    """What the figures belong to; `core` when they were taken on a single one."""
    model = platform.processor()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model)
    except OSError:
        pass
    return {"processor": model, "cores": os.cpu_count(), "pinned_to_core": core, "load": os.getloadavg()[0],
            "python": platform.python_version()}


def idlest(cores: set[int], watch_s: float = 0.2) -> int:
    """The core that does least in a short while; the last one where the system does not tell."""

    def busy() -> dict[int, int]:
        lines = [line.split() for line in Path("/proc/stat").read_text().splitlines() if line.startswith("cpu")]
        # user, nice, system; then idle and waiting, which do not count; then interrupts
        return {int(words[0][3:]): sum(map(int, words[1:4] + words[6:8])) for words in lines if words[0] != "cpu"}

    try:
        before = busy()
        time.sleep(watch_s)
        spent = {core: count - before[core] for core, count in busy().items() if core in cores}
    except (OSError, ValueError, KeyError):
        spent = {}
    return min(spent, key=lambda core: (spent[core], -core)) if spent else max(cores)


def busy(machine: dict) -> str:
    """A warning when other processes took more than a little of the machine before the measurement, else empty."""
    if machine["load"] < 0.75 * machine["cores"]:
        return ""
    return f"the machine was busy before (load {machine['load']:.1f} on {machine['cores']} cores)"


@contextlib.contextmanager
def one_core() -> Iterator[int | None]:
    """Keep this thread and its children on the idlest core, and the garbage collector away; gives its number.

    None where the system cannot pin.
    """
    before = os.sched_getaffinity(0) if hasattr(os, "sched_setaffinity") else None
    core = idlest(before) if before else None
    collecting = gc.isenabled()
    if core is not None:
        os.sched_setaffinity(0, {core})
    gc.disable()
    try:
        yield core
    finally:
        if collecting:
            gc.enable()
        if before:
            os.sched_setaffinity(0, before)
