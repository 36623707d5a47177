"""One run or a study over seeds, from a request to folders and tables."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from hoap2 import bounds, metric_names, parallel, products, runfolder, runner, scenario, seeds, statistics, tables_shown
from hoap2.master import StopRequest
from hoap2.progress import PartProgress
from hoap2.tables_shown import MISSED, OK, in_unit
from hoap2.telemetry import options


@dataclass(frozen=True)
class Request:
    """What the command line asked for; small and picklable, so that a worker can start from it."""

    scenario: str
    overrides: tuple[str, ...] = ()
    sensors: str | None = None
    duration_s: float | None = None
    choice: products.Choice = products.Choice()
    video: bool = True
    telemetry: options.Options = options.Options()

    def load(self) -> scenario.Scenario:
        return scenario.load(self.scenario, list(self.overrides), self.sensors, self.duration_s)


@dataclass(frozen=True)
class Result:
    """A study's study.json and the exit code that goes with it."""

    document: dict
    exit_code: int


def run_one(request: Request, loaded: scenario.Scenario, out: str | None, console: Console,
            path: Path | None = None, quiet: bool = False) -> dict:  # fmt: skip
    """One run into its folder (`path`, or from `out`); returns the summary. No folder is left by bad input."""
    wishes = runner.Wishes(request.video, quiet, request.telemetry)
    request.telemetry.check()
    with StopRequest() as stop:  # from here on a stop still leaves a whole, marked folder
        folder = runfolder.RunFolder(path or runfolder.target(loaded.name, out))
        try:
            both = products.open_both(request.choice, loaded)
            try:
                return runner.execute(loaded, both, folder, stop, console, wishes)
            finally:
                both.close()
        finally:
            folder.discard()  # nothing is left there after `finish`


def _seed_run(request: Request, seed: int, path: Path) -> dict:
    loaded = request.load()
    seeds.apply(loaded, seed)
    return run_one(request, loaded, None, Console(stderr=True), path, quiet=True)


def run_study(request: Request, seed_list: list[int], out: str | None, jobs: int, console: Console,
              show: bool = True) -> Result:  # fmt: skip
    """Run all seeds, at most `jobs` at a time; write study.json and study.csv; print the table."""
    loaded = request.load()
    folder = runfolder.target(loaded.name, out)
    _make_folder(folder)
    summaries, errors = {}, {}
    progress = PartProgress(f"{loaded.name} seeds", console)
    with StopRequest() as stop:
        try:
            _run_all(request, seed_list, folder, jobs, stop, progress, summaries, errors)
        finally:
            progress.close()
    interrupted = stop.signal is not None
    document = _document(loaded, seed_list, summaries, errors, interrupted) | {"folder": str(folder)}
    _write(folder, document)
    if show:
        _show(document, Console(highlight=False))
    code = runner.EXIT_INTERRUPTED if interrupted else runner.EXIT_OK if document["ok"] else runner.EXIT_FAILED
    return Result(document, code)


def _make_folder(folder: Path) -> None:
    probe = runfolder.RunFolder(folder)  # the same checks and messages as for a run
    probe.discard()
    folder.mkdir()


def _run_all(request: Request, seed_list: list[int], folder: Path, jobs: int, stop: StopRequest,
             progress: PartProgress, summaries: dict, errors: dict) -> None:  # fmt: skip
    width = max(3, len(str(max(seed_list))))
    tasks = {seed: (request, seed, folder / f"seed-{seed:0{width}d}") for seed in seed_list}

    def finished(seed: int, summary: dict | None, error: str | None) -> None:
        if error is None:
            summaries[seed] = summary
        else:
            errors[seed] = error

    def beat() -> None:
        missed = sum(not s["ok"] for s in summaries.values()) + len(errors)
        done = len(summaries) + len(errors)
        progress(done, len(seed_list), f"{done} of {len(seed_list)} runs, {missed} not ok")

    parallel.run_all(_seed_run, tasks, jobs, stop, finished, beat)


def _document(loaded: scenario.Scenario, seed_list: list[int], summaries: dict, errors: dict,
              interrupted: bool) -> dict:  # fmt: skip
    """The content of study.json."""
    rows = [summaries[seed] for seed in seed_list if seed in summaries]
    complete = [row for row in rows if not row["interrupted"]]
    judged = {}
    for name, bound in loaded.bounds.items():
        entries = [row["bounds"][name] for row in complete]
        values = [e["value"] for e in entries if e["value"] is not None]
        judged[name] = {
            "least": min(values, default=None), "largest": max(values, default=None),
            "min": bound.low, "max": bound.high, "met": _fraction([e["ok"] for e in entries]),
        }  # fmt: skip
    return {
        "scenario": loaded.name,
        "seeds": seed_list,
        "ok": not interrupted and not errors and len(complete) == len(seed_list) and all(r["ok"] for r in rows),
        "interrupted": interrupted,
        "runs_ok": _fraction([row["ok"] for row in complete] + [False] * len(errors)),
        "runs_fallen": _fraction([bool(row.get("fell")) for row in complete]),
        "bounds": judged,
        "errors": {str(seed): text for seed, text in errors.items()},
        "runs": rows,
    }


def _fraction(flags: list[bool]) -> dict:
    low, high = statistics.wilson_95(sum(flags), len(flags))
    return {"count": sum(flags), "of": len(flags), "wilson_95": [low, high]}


def _flat(summary: dict, prefix: str = "") -> dict:
    out = {}
    for key, value in summary.items():
        if isinstance(value, dict):
            out |= _flat(value, f"{prefix}{key}.")
        elif not isinstance(value, list):
            out[prefix + key] = value
    return out


def _write(folder: Path, document: dict) -> None:
    text = io.StringIO()
    left_out = ("bounds", "title", "section")
    rows = [_flat({k: v for k, v in row.items() if k not in left_out}) for row in document["runs"]]
    if rows:
        names = list(dict.fromkeys(name for row in rows for name in row))
        writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    content = json.dumps(runfolder.jsonable(document), indent=2, ensure_ascii=False) + "\n"
    for name, data in (("study.csv", text.getvalue()), ("study.json", content)):
        part = folder / f".{name}.part"
        part.write_text(data, encoding="utf-8")
        part.rename(folder / name)


def _show(document: dict, console: Console) -> None:
    if not console.is_terminal:
        console = Console(highlight=False, width=160)
    names = [name for name in document["bounds"] if name not in bounds.ALWAYS]  # those show in the last column
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    table.add_column("seed", justify="right", no_wrap=True)
    for name in names:
        unit = tables_shown.UNITS.get(metric_names.NAMES[name][0], (metric_names.NAMES[name][0], 1.0))[0]
        head = name.replace(".", "_").removesuffix(f"_{metric_names.NAMES[name][0]}").replace("_", " ")
        table.add_column(f"{head}\n{unit}", justify="right")
    table.add_column("", no_wrap=True)
    for row in document["runs"]:
        table.add_row(str(row["seed"]), *[_cell(name, row["bounds"][name]) for name in names], _state(row))
    for seed, text in document["errors"].items():
        table.add_row(seed, *[""] * len(names), f"[red]{text.splitlines()[0][:60]}[/]")
    table.add_section()
    for label in ("least", "largest", "min", "max"):
        cells = [in_unit(name, document["bounds"][name][label]) for name in names]
        table.add_row(label, *cells, "", style="dim" if label in ("min", "max") else "bold")
    console.print(table)
    for label, key in (("ok", "runs_ok"), ("fallen", "runs_fallen")):
        share = document[key]
        low, high = share["wilson_95"]
        console.print(f"{label}: {share['count']} of {share['of']} runs (95 %: {100 * low:.0f}-{100 * high:.0f} %)")
    console.print(f"study folder: {document['folder']}", soft_wrap=True)


def _state(row: dict) -> str:
    if row["interrupted"]:
        return "interrupted"
    if row["error"]:
        return f"[red]{row['error'].splitlines()[0][:60]}[/]"
    if row.get("fell"):
        return f"fell {row['fall_direction']}, step {row['fall_step']}, {row['fall_time_s']:.1f} s"
    return ", ".join(row["faults"]) or (OK if row["ok"] else MISSED)


def _cell(name: str, entry: dict) -> str:
    text = in_unit(name, entry["value"])
    return text if entry["ok"] else f"[bold red]{text}[/]"
