"""Two finished runs side by side: what differs in their numbers and parameters, and the folder with it all."""

from __future__ import annotations

import json
from pathlib import Path

from rich.console import Console
from rich.table import Table

from hoap2 import metric_names, parameters, runfolder, runner
from hoap2.bounds import lookup
from hoap2.errors import UserError
from hoap2.figures import walk_data
from hoap2.figures.walk_data import Walk
from hoap2.generate.tables import PRODUCTS
from hoap2.master import StopRequest
from hoap2.progress import PartProgress
from hoap2.tables_shown import number


def names(first: Walk, second: Walk) -> tuple[str, str]:
    """What the runs are called: scenario and seed when these tell them apart, else their folders as well."""
    both = [
        walk.scenario.name + (f" seed {walk.summary['seed']}" if walk.summary["seed"] else "")
        for walk in (first, second)
    ]
    if both[0] == both[1]:
        both = [f"{name} ({walk.folder.resolve().name})" for name, walk in zip(both, (first, second))]
    return f"A: {both[0]}", f"B: {both[1]}"


def metric_rows(first: Walk, second: Walk) -> list[dict]:
    """Every metric that either run has: both values and their difference, B less A."""
    rows = []
    for name, (unit, text) in metric_names.NAMES.items():
        a, b = lookup(first.summary, name), lookup(second.summary, name)
        if a is None and b is None:
            continue
        difference = None if a is None or b is None else b - a
        rows.append({"metric": name, "unit": unit, "text": text, "a": a, "b": b, "difference": difference})
    return rows


def parameter_rows(first: Walk, second: Walk) -> list[dict]:
    """The parameters of both products in which the runs differ."""
    rows = []
    for product in PRODUCTS:
        for name, signal in parameters.known(product).items():
            a, b = (parameters.plain(signal, walk.scenario.values[product][name]) for walk in (first, second))
            if a != b:
                rows.append(
                    {"parameter": f"{product}.{name}", "unit": signal.unit, "text": signal.text, "a": a, "b": b}
                )
    return rows


def document(first: Walk, second: Walk) -> dict:
    """The content of compare.json."""
    kept = (
        "scenario",
        "seed",
        "sense",
        "ok",
        "duration_s",
        "fell",
        "fall_step",
        "fall_time_s",
        "fall_direction",
        "error",
        "bounds",
    )
    return {
        **{key: {"folder": str(walk.folder), **{k: walk.summary.get(k) for k in kept}}
           for key, walk in (("a", first), ("b", second))},
        "metrics": metric_rows(first, second),
        "parameters": parameter_rows(first, second),
    }  # fmt: skip


def run(first: Path, second: Path, out: str | None, video: bool, console: Console) -> tuple[dict, int]:
    """Write page, curves, numbers and video into a new folder; a stop leaves out the video."""
    if first.resolve() == second.resolve():
        raise UserError(f"{first} is compared with itself", "give two run folders")
    walks = walk_data.load(first), walk_data.load(second)
    with StopRequest() as stop:
        folder = runfolder.RunFolder(runfolder.target("compare", out))
        try:
            found = document(*walks)
            folder.json("compare.json", found)
            film = _film(walks, folder.work / "compare.mp4", stop, console) if video else None
            from hoap2 import compare_page

            compare_page.write(folder.work, walks, names(*walks), found, film)
            found["folder"] = str(folder.finish())
        finally:
            folder.discard()
    return found, runner.EXIT_INTERRUPTED if stop.signal is not None else runner.EXIT_OK


def _film(walks: tuple[Walk, Walk], path: Path, stop: StopRequest, console: Console) -> Path | None:
    from hoap2 import compare_video

    progress = PartProgress("video", console)

    def show(done: int, total: int) -> bool:
        progress(done, total)
        return stop.signal is None

    try:
        return compare_video.write(walks, names(*walks), path, show)
    finally:
        progress.close()


def show(found: dict, console: Console) -> None:
    """The differences, on a screen."""
    for key, label in (("a", "A"), ("b", "B")):
        run_ = found[key]
        verdict = "[bold green]ok[/]" if run_["ok"] else "[bold red]not ok[/]"
        fell = (
            f"; fell {run_['fall_direction']} at {run_['fall_time_s']:.2f} s, step {run_['fall_step']}"
            if run_["fell"]
            else ""
        )
        console.print(f"{label}: {run_['scenario']}, {run_['folder']}: {verdict}{fell}", soft_wrap=True)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for name in ("", "A", "B", "B less A"):
        table.add_column(name, justify="left" if not name else "right")
    for row in found["metrics"]:
        if row["a"] != row["b"]:
            cells = [number(row[key]) for key in ("a", "b", "difference")]
            table.add_row(f"{row['metric']} [dim]{row['unit']}[/]", *cells)
    table.add_section()
    for row in found["parameters"]:
        table.add_row(row["parameter"], _short(row["a"]), _short(row["b"]), "")
    console.print(table)
    console.print(f"folder: {found['folder']}", soft_wrap=True)


def _short(value) -> str:
    text = json.dumps(value) if isinstance(value, list) else number(value)
    return text if len(text) <= 24 else text[:21] + "..."
