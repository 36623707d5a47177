"""What every benchmark needs: spreads, the machine, one core."""

from __future__ import annotations

import contextlib
import gc
import os
import platform
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


@contextlib.contextmanager
def one_core() -> Iterator[int | None]:
    """Keep this thread and its children on one core, and the garbage collector away; gives the core's number.

    None where the system cannot pin.
    """
    before = os.sched_getaffinity(0) if hasattr(os, "sched_setaffinity") else None
    core = max(before) if before else None
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
