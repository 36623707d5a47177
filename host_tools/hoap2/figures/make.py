"""From a figure's number to its files: the run it needs, the run it compares with, the drawing."""

from __future__ import annotations

import copy
from pathlib import Path

from rich.console import Console

from hoap2 import master, products, runner, scenario, seeds, study
from hoap2.errors import UserError
from hoap2.figures import book, walk_data
from hoap2.figures.book import BookFigure
from hoap2.figures.walk_data import Walk


def figure(wanted: BookFigure, run: Path | None, seed: int, out: Path | None, force: bool,
           console: Console) -> list[Path]:  # fmt: skip
    """Draw a figure from the run in a folder, or from one that is made first; returns the files."""
    if run is not None and seed:
        raise UserError("give either --run or --seed, not both", "a run has its seed already")
    if run is not None and out is None:
        check_target(run, wanted, force)  # before the time for a companion run is spent
    folder = run or _make_run(wanted, seed, console)
    walk = walk_data.load(folder)
    book.check(wanted, walk)
    target = out or folder
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"cannot make {target}: {error.strerror}") from None
    check_target(target, wanted, force)
    from hoap2.figures import draw

    return draw.write(wanted, walk, _companion(walk) if walk.controls_landing else None, base(target, wanted))


def base(folder: Path, wanted: BookFigure) -> Path:
    """The files' path without their suffix."""
    return folder / f"figure_{wanted.number.replace('.', '_')}"


def check_target(folder: Path, wanted: BookFigure, force: bool) -> None:
    there = [p for p in (base(folder, wanted).with_suffix(s) for s in (".png", ".svg")) if p.exists()]
    if there and not force:
        raise UserError(
            f"{there[0]} is there already; nothing was overwritten", "--force overwrites, --out DIR avoids it"
        )


def _make_run(wanted: BookFigure, seed: int, console: Console) -> Path:
    """The scenario's run, without video, in a folder of its own in out/."""
    request = study.Request(wanted.scenario, video=False)
    loaded = request.load()
    seeds.apply(loaded, seed)
    summary = study.run_one(request, loaded, None, console)
    if summary["interrupted"]:
        raise KeyboardInterrupt
    console.print(f"run folder: {summary['folder']}", soft_wrap=True)
    return Path(summary["folder"])


def _companion(walk: Walk) -> Walk:
    """The same run with landing position control switched off: same seed, same draws, same everything else."""
    loaded: scenario.Scenario = copy.deepcopy(walk.scenario)
    loaded.values["controller"]["landing_control"] = (0.0,)
    both = products.open_both(products.Choice(), loaded)
    try:
        with master.StopRequest() as stop:
            outcome = master.run(both.controller, both.plant, runner.ticks_of(loaded),
                                 loaded.options["stop_after_fall_s"], stop, link=both.link)  # fmt: skip
    finally:
        both.close()
    if outcome.interrupted:
        raise KeyboardInterrupt
    return Walk(walk.folder, outcome.log, loaded, runner.summarise(loaded, outcome))
