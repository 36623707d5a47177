"""One run from a resolved scenario to a finished run folder."""

from __future__ import annotations

import atexit
import gc
import hashlib
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from hoap2 import __version__, bounds, master, metrics, parameters, runfolder, toml_out
from hoap2.can import parameters as can_parameters
from hoap2.can import summary as can_summary
from hoap2.generate.tables import PRODUCTS, ROOT
from hoap2.pace import Pace
from hoap2.products import Products
from hoap2.progress import PartProgress, RunProgress
from hoap2.runfolder import RunFolder
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog
from hoap2.telemetry import command_desk, options, run_telemetry

EXIT_OK, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130

atexit.register(gc.freeze)  # to look for garbage in a process that ends takes 0.2 s, for nothing


def ticks_of(scenario: Scenario) -> int:
    return round(scenario.duration_s * 1e6 / parameters.table().tick_us)


def git_describe() -> str:
    """The checkout's state, or an empty text outside a repository."""
    try:
        done = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--tags"],
                              capture_output=True, text=True, timeout=10, check=False)  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def peak_memory_mb() -> float | None:
    """The largest resident size of this process so far (Linux)."""
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM")), None)


def resolved_toml(scenario: Scenario, files: dict[str, Path], run_id: int | None = None) -> str:
    """Everything that decides the run; `./hoap2 run <this file>` repeats it. run_id: which of the equal runs it was."""
    document: dict[str, dict] = {
        "scenario": {
            "name": scenario.name, "title": scenario.title, "section": scenario.section, "text": scenario.text,
            "duration_s": scenario.duration_s,
        },
        "run": dict(scenario.options),
    }  # fmt: skip
    for product in PRODUCTS:
        known = parameters.known(product)
        document[product] = {n: parameters.plain(known[n], v) for n, v in scenario.values[product].items()}
    if scenario.link != "direct":
        document["scenario"]["link"] = scenario.link
    if scenario.link == "can":
        document["can"] = can_parameters.plain(scenario.can)
    document["bounds"] = {n: {"min": b.low, "max": b.high} for n, b in scenario.bounds.items()}
    record: dict = {"seed": scenario.seed, "version": __version__, "git": git_describe()}
    if run_id is not None:
        record["run_id"] = run_id
    for product, path in files.items():
        record[f"{product}_file"] = path.name
        record[f"{product}_sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
    if scenario.draws:
        record["draws"] = scenario.draws
    document["record"] = record
    return toml_out.dumps(document, "A run with all its resolved values. `./hoap2 run` takes this file as a scenario.")


def summarise(scenario: Scenario, outcome: master.Outcome) -> dict:
    """The content of summary.json."""
    numbers = metrics.compute(outcome.log, scenario) if outcome.log.count else {}
    verdict = bounds.judge(scenario.bounds, numbers)
    complete = not outcome.interrupted and outcome.error is None
    timing = outcome.timing.summary()
    return {
        "scenario": scenario.name,
        "title": scenario.title,
        "section": scenario.section,
        "ok": complete and all(entry["ok"] for entry in verdict.values()),
        "interrupted": outcome.interrupted,
        "error": outcome.error,
        "seed": scenario.seed,
        "sense": scenario.sensors,
        "link": scenario.link,
        "duration_s": outcome.timing.ticks * parameters.table().tick_us / 1e6,
        "duration_planned_s": scenario.duration_s,
        **numbers,
        **{key: value for key, value in timing.items() if key != "loop_s"},
        "bounds": verdict,
        **({"can": can_summary.summarise(outcome.link)} if scenario.link == "can" else {}),
    }


def exit_code(summary: dict) -> int:
    """130 when stopped by a signal, 1 when an error ended the run or a bound is missed."""
    if summary["interrupted"]:
        return EXIT_INTERRUPTED
    return EXIT_OK if summary["ok"] else EXIT_FAILED


@dataclass(frozen=True)
class Wishes:
    """How a run is to be made and shown; nothing of it changes what the run computes."""

    video: bool = True
    quiet: bool = False
    telemetry: options.Options = options.Options()


def execute(scenario: Scenario, products: Products, folder: RunFolder, stop: master.StopRequest, console: Console,
            wishes: Wishes = Wishes()) -> dict:  # fmt: skip
    """Run, judge, write every file, give the folder its name; returns the summary.

    A stop request ends the simulation, or leaves out what is still to come after it.
    """
    clock, quiet = products.clock, wishes.quiet
    run_id = run_telemetry.new_run_id()
    run_toml = resolved_toml(scenario, products.files, run_id)
    company = _company(scenario, products, wishes, folder, run_id, run_toml)
    clock.set_up_done()
    with clock.part("loop"):
        outcome = _simulate(scenario, products, stop, console, quiet, company)
    with clock.part("files"):
        folder.text("run.toml", run_toml)
        outcome.log.write(folder.work / "signals.parquet")
        if scenario.link == "can":
            from hoap2.can import report as can_report

            can_report.write_ticks(folder.work / can_report.FILE_NAME, outcome.link)
    with clock.part("report"):
        summary = summarise(scenario, outcome)
        summary["notes"] = _notes(company) + (can_summary.notes(summary["can"]) if "can" in summary else [])
        if company.commands is not None:
            summary["commands"] = company.commands.record
    with clock.part("pictures"):
        pictures = _pictures(folder, scenario, outcome.log, wishes.video, console, quiet, stop, summary["notes"])
    summary |= {"peak_memory_mb": peak_memory_mb(), "wall_s": clock.summary()}
    if outcome.log.count:
        with clock.part("report"):
            _report(folder, scenario, outcome, summary, pictures)
    summary["wall_s"] = clock.summary()
    finished = time.strftime("%Y-%m-%dT%H:%M:%S%z")
    timing = outcome.timing.summary() | _timing_of(company, outcome)
    folder.json("timing.json", timing | {"wall_s": summary["wall_s"], "finished": finished})
    folder.json("summary.json", summary)
    return runfolder.jsonable(summary) | {"folder": str(folder.finish())}


def _company(scenario: Scenario, products: Products, wishes: Wishes, folder: RunFolder, run_id: int,
             run_toml: str) -> master.Company:  # fmt: skip
    """Telemetry, pace and commands, as far as they are wanted."""
    wanted = wishes.telemetry
    about = run_telemetry.About(run_id, scenario.name, scenario.title, scenario.seed, scenario.sensors,
                                scenario.duration_s, run_toml, str(folder.path), wanted.accept_commands)  # fmt: skip
    log_path = folder.work / run_telemetry.LOG_NAME if wanted.log else None
    company = master.Company(pace=Pace() if wanted.realtime else None)
    if log_path is not None or wanted.live_url is not None:
        company.telemetry = run_telemetry.RunTelemetry(about, log_path, wanted.live_url, company.pace)
    if wanted.accept_commands:
        company.commands = command_desk.listening(products, run_id, company.telemetry, scenario.values, wanted.live_url)
    return company


def _notes(company: master.Company) -> list[str]:
    """What the user should know of a run that went on all the same."""
    notes = [] if company.telemetry is None else list(company.telemetry.notes)
    if company.commands is not None:
        notes += company.commands.notes()
    if company.pace is not None and company.pace.moved_s > 0.0:
        notes.append(f"not in real time: {company.pace.moved_s:.1f} s behind the wall clock at the end")
    return notes


def _timing_of(company: master.Company, outcome: master.Outcome) -> dict:
    """What pacing and telemetry have to say in timing.json."""
    said: dict = {}
    if company.pace is not None:
        said["pace"] = company.pace.summary()
    if company.telemetry is not None:
        counts = {name: n for name, n in company.telemetry.counts.items() if name != "waiting"}
        ticks = max(1, outcome.timing.ticks)
        us = {name: counts.pop(f"{part}_ns", 0) / 1e3 / ticks for name, part in
              (("us_a_tick", "spent"), ("sender_us_a_tick", "sender"))}  # fmt: skip
        said["telemetry"] = counts | us
    return said


def _simulate(scenario: Scenario, products: Products, stop: master.StopRequest, console: Console,
              quiet: bool, company: master.Company) -> master.Outcome:  # fmt: skip
    """The loop, with what it shows meanwhile."""
    title = scenario.name + (f" seed {scenario.seed}" if scenario.seed else "")
    progress = None if quiet else RunProgress(title, scenario.duration_s, scenario.steps_planned, console)
    company.progress = progress
    try:
        return master.run(products.controller, products.plant, ticks_of(scenario),
                          scenario.options["stop_after_fall_s"], stop, company, products.link)  # fmt: skip
    finally:
        if progress is not None:
            progress.close()
        if company.commands is not None:
            company.commands.close()


def _pictures(folder: RunFolder, scenario: Scenario, log: SignalLog, video: bool, console: Console, quiet: bool,
              stop: master.StopRequest, notes: list[str]) -> dict[str, Path]:  # fmt: skip
    """Snapshots (as Fig. 7.10 A) and the video; a run is not lost for want of a picture, the reason is noted."""
    made: dict[str, Path] = {}
    if log.count < 2 or stop.signal is not None or (quiet and not video):
        return made
    progress = None if quiet or not video else PartProgress("video", console)

    def show(done: int, total: int) -> bool:
        if progress is not None:
            progress(done, total)
        return stop.signal is None

    try:
        from hoap2 import pictures, recording

        run = recording.of_log(folder.path, log, scenario)
        made["snapshots"] = pictures.strip(run, _moments(log), folder.work / "snapshots.png", size=(240, 360))
        if video:
            written = pictures.write_video(run, folder.work / "video.mp4", progress=show)
            if written is None:
                notes.append("no video: stopped while it was rendered")
            else:
                made["video"] = written
    except (Exception, KeyboardInterrupt) as error:
        notes.append(f"pictures are missing: {error or type(error).__name__}")
    finally:
        if progress is not None:
            progress.close()
    return made


def _moments(log: SignalLog, count: int = 5) -> list[float]:
    """Times of the snapshots: evenly from the first step to the end."""
    first, last = float(log.t_s[metrics.first_judged_tick(log)]), float(log.t_s[-1])
    return [first + (last - first) * i / (count - 1) for i in range(count)]


def _report(folder: RunFolder, scenario: Scenario, outcome: master.Outcome, summary: dict,
            pictures: dict[str, Path]) -> None:  # fmt: skip
    """The report, or a note in the summary why there is none."""
    from hoap2 import report

    try:
        sections = []
        if scenario.link == "can":
            from hoap2.can import report as can_report

            sections.append(can_report.section(outcome.link, summary["can"]))
        report.write(folder.work / "report.html", scenario, outcome.log, summary, pictures, sections)
    except (Exception, KeyboardInterrupt) as error:
        summary["notes"].append(f"no report: {type(error).__name__}: {error}")
