"""`bench telemetry`: what logging and publishing cost a tick, and what a run loses by its log.

The signals of floor-walk are recorded once and then handed to the publisher in batches of ten ticks, as the master does
it, into each sink by itself. The publisher sends from a thread of its own; its processor time is told beside the time
of the calls, which is what a run waits for. Over udpm this is done in a network namespace, without and with a listener.
Whole loops with and without the log take turns.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
import time
from array import array
from collections.abc import Callable
from pathlib import Path

from hoap2 import master, parameters, scenario, signal_log
from hoap2.bench import measure
from hoap2.bench.measure import SCENARIO
from hoap2.errors import UserError
from hoap2.products import Choice, open_both
from hoap2.signal_log import SignalLog
from hoap2.telemetry.run_telemetry import About, RunTelemetry

BATCH = master.HOUSEKEEPING_TICKS
URL = "udpm://239.255.76.67:7667?ttl=0"
DRAIN_S = 10.0
LISTENER = "from hoap2.telemetry.listen import Listener\nlistener = Listener()\nprint('ready', flush=True)\n" \
           "while True: listener.poll(0.1)"  # fmt: skip


class _FullRate:
    """Stands for a pace: every message goes out."""

    lag_us, overruns = 0.0, 0


def about() -> About:
    return About(1, SCENARIO, "bench", 0, "hoap2", 0.0, "", "")


def one_loop(loaded: scenario.Scenario, ticks: int, log_path: Path | None) -> tuple[master.Outcome, float]:
    """A whole run without the rest of a run, and the processor time that it took in ms."""
    both = open_both(Choice(), loaded)
    try:
        company = master.Company(telemetry=None if log_path is None else RunTelemetry(about(), log_path, None))
        begin = time.thread_time()
        outcome = master.run(both.controller, both.plant, ticks, 1.0, master.StopRequest(), company)
        return outcome, 1e3 * (time.thread_time() - begin)
    finally:
        both.close()


def loops(loaded: scenario.Scenario, ticks: int, pairs: int, folder: Path, progress: Callable[[str], None]) -> dict:
    """Loops without and with the log in turns: ms of wall clock and of processor, and the ratios of the pairs."""
    ms: dict[str, list[float]] = {name: [] for name in ("without", "with_log", "without_cpu", "with_log_cpu")}
    equal = True
    for number in range(pairs):
        progress(f"loops {number + 1} of {pairs}, without and with the log")
        outcomes = {}
        for name in ("without", "with_log")[:: 1 if number % 2 else -1]:
            outcome, cpu_ms = one_loop(loaded, ticks, folder / "loop.lcm" if name == "with_log" else None)
            outcomes[name] = outcome.log
            ms[name].append(outcome.timing.loop_s * 1e3)
            ms[f"{name}_cpu"].append(cpu_ms)
        a, b = outcomes["without"], outcomes["with_log"]
        equal &= a.count == b.count and a.real[: a.count].tobytes() == b.real[: b.count].tobytes()
        equal &= a.integer[: a.count].tobytes() == b.integer[: b.count].tobytes()
    ratios = [b / a for a, b in zip(ms["without"], ms["with_log"])]
    cpu_ratios = [b / a for a, b in zip(ms["without_cpu"], ms["with_log_cpu"])]
    return {**{f"{name}_ms": measure.median(values) for name, values in ms.items()}, "ratio": measure.median(ratios),
            "cpu_ratio": measure.median(cpu_ratios), "ratios": ratios, "cpu_ratios": cpu_ratios,
            "equal": equal}  # fmt: skip


def sink(signals: SignalLog, path: Path | None, url: str | None) -> dict:
    """Microseconds a tick of the calls (wall clock; processor) and of the thread that sends; where messages went."""
    ticks = signals.count
    ns = array("q", [5000] * ticks)
    telemetry = RunTelemetry(about(), path, url, _FullRate() if url else None)
    telemetry.open(signals, ns, ns)
    publisher, spent, used = telemetry.publisher, 0, 0
    now, cpu = time.perf_counter_ns, time.thread_time_ns
    for end in [*range(BATCH, ticks, BATCH), ticks]:
        signals.count = end
        begin, cpu_begin = now(), cpu()
        telemetry.rows()
        used += cpu() - cpu_begin
        spent += now() - begin
        if url:  # the next batch comes when this one is out, as in a paced run
            _drain(publisher)
    telemetry.close("done")
    counts = telemetry.counts
    return {"us": spent / 1e3 / ticks, "cpu_us": used / 1e3 / ticks, "sender_us": counts["sender_ns"] / 1e3 / ticks,
            **{name: counts[name] for name in ("logged", "published", "dropped")}}  # fmt: skip


def _drain(publisher) -> None:
    give_up = time.monotonic() + DRAIN_S
    while time.monotonic() < give_up:
        counts = publisher.counts()
        if counts["waiting"] == 0:
            return
        time.sleep(0)


def sinks_here(signals_path: Path) -> dict:
    """The sinks that need no network."""
    signals = signal_log.read(signals_path)
    with tempfile.TemporaryDirectory(prefix="hoap2-bench-") as folder:
        return {"log": sink(signals, Path(folder) / "a.lcm", None), "memq": sink(signals, None, "memq://")}


def sinks_udpm(signals_path: Path) -> dict:
    """Multicast, without and with a listener; to be called in a network of its own."""
    signals = signal_log.read(signals_path)
    found = {"udpm": sink(signals, None, URL)}
    listener = subprocess.Popen([sys.executable, "-c", LISTENER], stdout=subprocess.PIPE, text=True)
    try:
        listener.stdout.readline()
        found["udpm, a listener"] = sink(signals, None, URL)
    finally:
        listener.kill()
        listener.wait()
    return found


def in_own_network(signals_path: Path) -> dict:
    """sinks_udpm in a process in a network namespace; {} where there are none."""
    tools = ["unshare", "--map-root-user", "--net", "bash", "-c",
             'ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec "$@"', "bash"]  # fmt: skip
    if not (shutil.which("unshare") and shutil.which("ip")):
        return {}
    done = subprocess.run([*tools, sys.executable, "-m", "hoap2.bench.telemetry", str(signals_path)],
                          capture_output=True, text=True, check=False)  # fmt: skip
    return json.loads(done.stdout) if done.returncode == 0 else {}


def run(repeat: int, seconds: float | None, progress: Callable[[str], None]) -> dict:
    """Everything; figures are medians over the repetitions."""
    loaded = scenario.load(SCENARIO)
    ticks = round((seconds or loaded.duration_s) * 1e6 / parameters.table().tick_us)
    about_machine = measure.machine()
    with tempfile.TemporaryDirectory(prefix="hoap2-bench-") as name:
        folder = Path(name)
        recorded, _ = one_loop(loaded, ticks, None)
        if recorded.error:
            raise UserError(f"the run of {SCENARIO} ended: {recorded.error}")
        recorded.log.write(folder / "signals.parquet")
        loop = loops(loaded, ticks, max(3, 4 * repeat + 1), folder, progress)
        runs = []
        for number in range(repeat):
            progress(f"sinks {number + 1} of {repeat}")
            runs.append(sinks_here(folder / "signals.parquet") | in_own_network(folder / "signals.parquet"))
    return {"machine": about_machine, "scenario": SCENARIO, "ticks": ticks, "loop": loop,
            "sinks": measure.medians(runs), "runs": runs}  # fmt: skip


if __name__ == "__main__":
    print(json.dumps(sinks_udpm(Path(sys.argv[1]))))
