"""The study of section 7.3: both grounds, with and without landing position control, over many seeds."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from hoap2 import products, runfolder, runner, scenario
from hoap2 import seeds as seeds_module
from hoap2.errors import UserError
from hoap2.scenario import Scenario
from hoap2.studies import collection, groups, light, shown, tables

SCENARIOS = ("sand-walk", "sand-walk-lpc", "floor-walk", "floor-walk-lpc")
DEFAULT_SEEDS = "101-150"
NOTE = (
    "A seed decides sensor noise, gyro bias, cell gains, friction, floor tilt, chest CoM and the soil's roughness. "
    "survived: all steps, at least 350 of 420 mm, stands at the end, not fallen."
)


@dataclass(frozen=True)
class Wish:
    """What the command line asked for."""

    seeds: str | None = None
    overrides: tuple[str, ...] = ()
    jobs: int = 1
    out: str | None = None
    resume: Path | None = None
    choice: products.Choice = products.Choice()


def key_of(name: str) -> str:
    """A scenario's name as a key of study.json."""
    return name.replace("-", "_")


def _plan(wish: Wish) -> tuple[dict, Path]:
    """Seeds and overrides, from the command line or from the folder that goes on, and the study's folder."""
    if wish.resume is None:
        plan = {"study": "sand", "seeds": wish.seeds or DEFAULT_SEEDS, "set": list(wish.overrides)}
        seeds_module.parse_range(plan["seeds"])
        for name in SCENARIOS:
            scenario.load(name, plan["set"])
        return plan, collection.make_folder("study-sand", wish.out, plan)
    if wish.out is not None:
        raise UserError("give either --resume or --out, not both")
    plan = collection.resume_folder(wish.resume, "sand")
    plan |= {"seeds": wish.seeds} if wish.seeds else {}
    plan |= {"set": list(wish.overrides)} if wish.overrides else {}
    seeds_module.parse_range(plan["seeds"])
    collection.write(wish.resume, collection.PLAN, json.dumps(plan, indent=2) + "\n")
    return plan, wish.resume


def run(wish: Wish, console: Console, show: bool = True) -> tuple[dict, int]:
    """Run what is missing; write study.json, both tables and the figure. Returns the document and the exit code."""
    plan, folder = _plan(wish)
    seed_list = seeds_module.parse_range(plan["seeds"])
    loaded = {name: scenario.load(name, plan["set"]) for name in SCENARIOS}
    # by seed first: a study that is stopped early has some of everything
    tasks = {(name, seed): light.with_seed(loaded[name], seed) for seed in seed_list for name in SCENARIOS}
    found = collection.collect(folder, tasks, wish.choice, wish.jobs, console, "study sand")
    document = describe(loaded, seed_list, found) | {"folder": str(folder)}
    _write(folder, document, found)
    if show:
        shown.sand(document, Console(highlight=False))
    return document, exit_code(document)


def exit_code(document: dict) -> int:
    """130 when stopped, 1 when runs ended by an error."""
    if document["interrupted"]:
        return runner.EXIT_INTERRUPTED
    return runner.EXIT_OK if document["ok"] else runner.EXIT_FAILED


def describe(loaded: dict[str, Scenario], seed_list: list[int], found: collection.Found) -> dict:
    """The content of study.json."""
    by_name = {name: {seed: row for (n, seed), row in found.summaries.items() if n == name} for name in loaded}
    blocks = {}
    for name, nominal in loaded.items():
        failed = sum(n == name for n, _ in found.errors)
        blocks[key_of(name)] = {"title": nominal.title} | groups.describe(list(by_name[name].values()), failed)
    planned = len(loaded) * len(seed_list)
    whole = sum(block["runs"] for block in blocks.values())
    return {
        "study": "sand",
        "note": NOTE,
        "seeds": seed_list,
        "runs_planned": planned,
        "runs_done": whole,
        "runs_kept_from_before": found.kept,
        "interrupted": found.stopped,
        "ok": whole == planned and not found.stopped,
        **blocks,
        "floor_roll_rms_difference_deg": groups.paired_difference(
            by_name["floor-walk-lpc"], by_name["floor-walk"], "roll_deg.rms"
        ),
        "errors": {f"{name} seed {seed}": text for (name, seed), text in found.errors.items()}
        | {f"{n} seed {s}": row["error"] for (n, s), row in found.summaries.items() if not groups.counts(row)},
    }


def _write(folder: Path, document: dict, found: collection.Found) -> None:
    from hoap2.studies import sand_plot

    rows = [found.summaries[key] for key in sorted(found.summaries, key=lambda k: (SCENARIOS.index(k[0]), k[1]))]
    collection.write(folder, "runs.csv", tables.runs_csv(rows))
    collection.write(
        folder, "table.csv", tables.groups_csv([({"scenario": n}, document[key_of(n)]) for n in SCENARIOS])
    )
    if rows:
        sand_plot.write(folder / "study", document, {n: [r for r in rows if r["scenario"] == n] for n in SCENARIOS})
    text = json.dumps(runfolder.jsonable(document), indent=2, ensure_ascii=False) + "\n"
    collection.write(folder, "study.json", text)
