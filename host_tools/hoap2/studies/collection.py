"""The runs of a study in a file that grows by a line a run, so that a stopped study goes on where it was."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console

from hoap2 import bounds, parallel, products, runfolder
from hoap2.errors import UserError
from hoap2.master import StopRequest
from hoap2.progress import PartProgress
from hoap2.scenario import Scenario
from hoap2.studies import groups, light

RUNS, PLAN = "runs.jsonl", "plan.json"
Execute = Callable[[Scenario, products.Choice], dict]


@dataclass
class Found:
    """What a collection has after it ran: by task, the summaries and the errors."""

    summaries: dict[Hashable, dict] = field(default_factory=dict)
    errors: dict[Hashable, str] = field(default_factory=dict)
    kept: int = 0
    stopped: bool = False


def make_folder(group: str, out: str | None, plan: dict) -> Path:
    """A new study folder that holds its plan."""
    folder = runfolder.target(group, out)
    probe = runfolder.RunFolder(folder)  # the same checks and messages as for a run
    probe.discard()
    folder.mkdir()
    write(folder, PLAN, json.dumps(plan, indent=2) + "\n")
    return folder


def resume_folder(folder: Path, study: str) -> dict:
    """The plan in the folder of a study that is to go on."""
    try:
        plan = json.loads((folder / PLAN).read_text(encoding="utf-8"))
        planned = plan["study"]
    except (OSError, ValueError, KeyError, TypeError):
        raise UserError(
            f"{folder} is no folder of a study", "--resume takes what `study` printed as its folder"
        ) from None
    if planned != study:
        raise UserError(f"{folder} holds a study '{planned}'", f"go on with: ./hoap2 study {planned} --resume {folder}")
    return plan


def write(folder: Path, name: str, content: str) -> Path:
    """A text file, there whole or not at all."""
    part = folder / f".{name}.part-{os.getpid()}"
    part.write_text(content, encoding="utf-8")
    return part.rename(folder / name)


def read(folder: Path) -> dict[str, dict]:
    """Fingerprint -> summary of the runs that are done; a line cut off by a crash is no run."""
    runs = {}
    try:
        lines = (folder / RUNS).read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        return {}
    for line in lines:
        try:
            entry = json.loads(line)
            runs[entry["fingerprint"]] = entry["summary"]
        except (ValueError, KeyError, TypeError):
            continue
    return runs


def collect(folder: Path, tasks: Mapping[Hashable, Scenario], choice: products.Choice, jobs: int, console: Console,
            title: str, execute: Execute = light.execute) -> Found:  # fmt: skip
    """Run the tasks that the folder does not have yet; equal ones once. Every run's line is written as it ends."""
    hashes = light.product_hashes(choice)
    prints = {key: light.fingerprint(scenario, hashes) for key, scenario in tasks.items()}
    runs, failed = read(folder), {}
    missing = {name: tasks[key] for key, name in prints.items() if name not in runs}
    kept = len(set(prints.values())) - len(missing)
    progress = PartProgress(title, console)
    began = time.perf_counter()
    with (folder / RUNS).open("a", encoding="utf-8") as file, StopRequest() as stop:
        file.write("\n" if runs else "")  # after a line that was cut off

        def finished(name: str, summary: dict | None, error: str | None) -> None:
            if error is not None:
                failed[name] = error
            elif not summary["interrupted"]:
                runs[name] = summary
                file.write(json.dumps({"fingerprint": name, "summary": summary}) + "\n")
                file.flush()

        def beat() -> None:
            done = sum(name in runs or name in failed for name in missing)
            left_s = (time.perf_counter() - began) / done * (len(missing) - done) if done else None
            rest = f", about {left_s:.0f} s left" if left_s is not None else ""
            progress(done + kept, len(missing) + kept, f"{done + kept} of {len(missing) + kept} runs{rest}")

        try:
            arguments = {name: (scenario, choice) for name, scenario in missing.items()}
            parallel.run_all(execute, arguments, jobs, stop, finished, beat)
        finally:
            progress.close()
    return _by_task(prints, tasks, runs, failed, kept, stop.signal is not None)


def _by_task(prints: dict[Hashable, str], tasks: Mapping[Hashable, Scenario], runs: dict[str, dict],
             failed: dict[str, str], kept: int, stopped: bool) -> Found:  # fmt: skip
    """Summaries under the tasks' own names, judged by the bounds as they are now."""
    found = Found(kept=kept, stopped=stopped)
    for key, name in prints.items():
        if name in failed:
            found.errors[key] = failed[name]
        elif name in runs:
            verdict = bounds.judge(tasks[key].bounds, runs[name])
            ok = groups.counts(runs[name]) and all(entry["ok"] for entry in verdict.values())
            own = {"scenario": tasks[key].name, "seed": tasks[key].seed, "bounds": verdict, "ok": ok}
            found.summaries[key] = runs[name] | own
    return found
