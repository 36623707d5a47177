"""A paced run with listeners beside it, in a network of its own: `paced_run.py FOLDER SECONDS`, results as JSON.

Debian's lcm-logger records; a listener counts; with --trouble others come late, hang and die meanwhile. With --first the
run too goes before everything else on the machine, as on a robot.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path

from hoap2.telemetry import transport, types
from hoap2.telemetry.listen import Listener
from hoap2.telemetry.log_file import LogFile

URL = "udpm://239.255.76.67:7667?ttl=0"
STEP_S, START_S = 0.4, 3.0  # a step; what comes before and after them
ORDINARY = ["chrt", "--other", "0"]  # what is started does not inherit our place before everything else
LISTEN = "from hoap2.telemetry.listen import Listener\nlistener = Listener()\nwhile True: listener.poll(0.1)"


def first() -> list[str]:
    """Puts a program before everything else on this machine, where that is allowed.

    lcm-logger keeps 30 messages, 15 ms of a run, and no more: on a busy machine it would lose some.
    """
    before = ["chrt", "--rr", "1"]
    return before if subprocess.run([*before, "true"], capture_output=True).returncode == 0 else []


def run_command(folder: Path, seconds: float) -> list[str]:
    """A walk in place for as long as is wanted."""
    steps = max(2, round((seconds - START_S) / STEP_S))
    forward = min(1000, steps // 2)
    sets = {"controller.steps_forward": forward, "controller.steps_in_place": min(1000, steps - forward),
            "controller.step_length_m": 0.0}  # fmt: skip
    options = [word for name, value in sets.items() for word in ("--set", f"{name}={value}")]
    return [*ORDINARY, sys.executable, "-m", "hoap2.cli", "run", "floor-walk", "--realtime", "--no-video", "--json",
            "--duration", str(seconds), "--out", str(folder / "run"), *options]  # fmt: skip


def listen_until_end(seconds: float) -> Listener:
    """Count everything until run_t says that the run has ended."""
    listener = Listener(URL)
    give_up = time.monotonic() + seconds + 120.0
    while time.monotonic() < give_up:
        listener.poll(0.2)
        if types.RUN in listener.latest and listener.latest[types.RUN].state == listener.latest[types.RUN].ENDED:
            listener.poll(0.5)
            break
    return listener


def trouble(started: list[subprocess.Popen], seconds: float) -> None:
    """One that listens and is killed, one that hangs, one that comes late."""
    for _ in range(2):
        started.append(subprocess.Popen([*ORDINARY, sys.executable, "-c", LISTEN]))
    time.sleep(0.3 * seconds)
    started[0].kill()
    os.kill(started[1].pid, signal.SIGSTOP)
    started.append(subprocess.Popen([*ORDINARY, sys.executable, "-c", LISTEN]))


def compare(logger_file: Path, run_file: Path) -> dict:
    """Messages of the run's log that the logger's has, byte by byte (run_t is repeated live)."""
    logs = LogFile(logger_file), LogFile(run_file)
    recorded, logged = ([(e.channel, e.data) for e in log if e.channel != types.RUN] for log in logs)
    missing, added = Counter(logged) - Counter(recorded), Counter(recorded) - Counter(logged)
    named = [[(channel, types.header(data)[1]) for channel, data in some] for some in (missing, added)]
    return {"recorded": len(recorded), "logged": len(logged), "missing": named[0], "added": named[1],
            "problems": [p for log in logs for p in log.problems()]}  # fmt: skip


def main(folder: Path, seconds: float, with_trouble: bool, run_first: bool) -> None:
    os.environ["LCM_DEFAULT_URL"] = URL
    recorded = folder / "recorded.lcm"
    before = first()
    if before:
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
    logger = subprocess.Popen(
        [*before, "/usr/bin/lcm-logger", "-q", f"--lcm-url={transport.with_room(URL)}", str(recorded)]
    )
    time.sleep(1.0)
    others: list[subprocess.Popen] = []
    try:
        with (folder / "errors").open("w") as errors:
            command = run_command(folder, seconds)[len(ORDINARY) if run_first else 0 :]
            run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, text=True)
            if with_trouble:
                threading.Thread(target=trouble, args=(others, seconds), daemon=True).start()
            listener = listen_until_end(seconds)
            summary = json.loads(run.communicate(timeout=300)[0])
    finally:
        for other in others:
            other.kill()
        logger.terminate()
        logger.wait(timeout=20)
    timing = json.loads((Path(summary["folder"]) / "timing.json").read_text())
    counters = {channel: {k: v for k, v in vars(c).items() if k[0] != "_"} for channel, c in listener.counters.items()}
    print(json.dumps({"timing": timing, "counters": counters, "steps_taken": summary["steps_taken"],
                      "duration_s": summary["duration_s"], "logger_first": bool(before),
                      **compare(recorded, Path(summary["folder"]) / "telemetry.lcm")}))  # fmt: skip


if __name__ == "__main__":
    main(Path(sys.argv[1]), float(sys.argv[2]), "--trouble" in sys.argv, "--first" in sys.argv)
