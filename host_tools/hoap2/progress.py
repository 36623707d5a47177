"""What a run shows while it goes on: a bar on a terminal, sparse plain lines elsewhere."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from hoap2 import parameters
from hoap2.signal_log import SignalLog

PLAIN_PERIOD_S = 10.0


def robot_state(log: SignalLog, steps_planned: int) -> str:
    """`walk, single support, step 12 of 36`, with the fault word's names if any."""

    def word(name: str, enum: str) -> str:
        if f"c.{name}" not in log:
            return ""
        entries = parameters.table().enums[enum]
        index = int(log.column(f"c.{name}")[-1])
        return entries[index].replace("_", " ") if 0 <= index < len(entries) else str(index)

    mode = word("mode", "mode")
    parts = [mode]
    if mode == "walk":
        parts.append(word("phase", "phase"))
    if "c.step_index" in log and log.column("c.step_index")[-1] > 0:
        of_all = f" of {steps_planned}" if steps_planned else ""
        parts.append(f"step {log.column('c.step_index')[-1]}{of_all}")
    if "c.fault" in log and log.column("c.fault")[-1]:
        fault = int(log.column("c.fault")[-1])
        parts.append("FAULT " + "+".join(n for n, bit in parameters.table().faults.items() if fault & bit))
    return ", ".join(part for part in parts if part)


class RunProgress:
    """Simulated time, real-time factor and the robot's state of one run."""

    def __init__(self, title: str, duration_s: float, steps_planned: int, console: Console) -> None:
        self.duration_s, self.steps_planned, self.title = duration_s, steps_planned, title
        self.console = console
        self.started = time.perf_counter()
        self.bar: Progress | None = None
        self.next_line_s = PLAIN_PERIOD_S
        if console.is_terminal:
            columns = (TextColumn("{task.description}"), BarColumn(bar_width=24), TextColumn("{task.fields[text]}"))
            self.bar = Progress(*columns, console=console, auto_refresh=False, transient=True)
            self.task = self.bar.add_task(title, total=duration_s, text="")
            self.bar.start()

    def __call__(self, log: SignalLog) -> None:
        elapsed_s = time.perf_counter() - self.started
        t_s = (log.count - 1) * parameters.table().tick_us / 1e6
        factor = t_s / elapsed_s if elapsed_s > 0 else 0.0
        state = robot_state(log, self.steps_planned)
        text = f"{t_s:6.2f} / {self.duration_s:.2f} s  {factor:4.2f} x real time  {state}"
        if self.bar is not None:
            self.bar.update(self.task, completed=t_s, text=text)
            self.bar.refresh()
        elif elapsed_s >= self.next_line_s:
            self.next_line_s = elapsed_s + PLAIN_PERIOD_S
            print(f"{self.title}: {text}", file=sys.stderr, flush=True)

    def close(self) -> None:
        if self.bar is not None:
            self.bar.stop()


class PartProgress:
    """A bar for work that is counted in parts (pictures of a video, runs of a study)."""

    def __init__(self, title: str, console: Console) -> None:
        self.title, self.console, self.bar, self.next_s = title, console, None, time.perf_counter() + PLAIN_PERIOD_S
        if console.is_terminal:
            columns = (TextColumn("{task.description}"), BarColumn(bar_width=24), TextColumn("{task.fields[text]}"))
            self.bar = Progress(*columns, console=console, auto_refresh=False, transient=True)
            self.task = self.bar.add_task(title, total=None, text="")
            self.bar.start()
        self._shown = 0.0

    def __call__(self, done: int, total: int, text: str = "") -> None:
        now = time.perf_counter()
        if self.bar is not None and (now - self._shown > 0.1 or done == total):
            self._shown = now
            self.bar.update(self.task, completed=done, total=total, text=text or f"{done} of {total}")
            self.bar.refresh()
        elif self.bar is None and now >= self.next_s:
            self.next_s = now + PLAIN_PERIOD_S
            print(f"{self.title}: {text or f'{done} of {total}'}", file=sys.stderr, flush=True)

    def close(self) -> None:
        if self.bar is not None:
            self.bar.stop()


PartCallback = Callable[[int, int], None]
