"""Where the wall-clock time of a run goes, from the command to the finished folder."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PARTS = ("set_up", "loop", "files", "pictures", "report")


def process_start_s() -> float | None:
    """When this process started, on the clock of time.perf_counter(); None where Linux does not tell."""
    try:
        fields = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
        age_s = time.clock_gettime(time.CLOCK_BOOTTIME) - int(fields[19]) / os.sysconf("SC_CLK_TCK")
    except (OSError, AttributeError, ValueError, IndexError):
        return None
    return time.perf_counter() - age_s if age_s >= 0.0 else None


class WallClock:
    """Seconds a part. Made when a run begins; a run that is all of its process began with the process."""

    def __init__(self) -> None:
        self.begun_s = time.perf_counter()
        spec = getattr(sys.modules.get("__main__"), "__spec__", None)
        if spec is not None and spec.name == "hoap2.cli":
            self.begun_s = process_start_s() or self.begun_s
        self.parts_s = dict.fromkeys(PARTS, 0.0)

    def set_up_done(self) -> None:
        """Everything so far was set-up: imports, scenario, starting the FMUs."""
        self.parts_s["set_up"] = time.perf_counter() - self.begun_s

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """What is done inside counts for this part."""
        started = time.perf_counter()
        try:
            yield
        finally:
            self.parts_s[name] += time.perf_counter() - started

    def summary(self) -> dict[str, float]:
        """Seconds of each part, and of all until now."""
        return {name: round(value, 4) for name, value in
                [*self.parts_s.items(), ("total", time.perf_counter() - self.begun_s)]}  # fmt: skip
