"""Maps: how the outcome of the sand walks depends on one or two parameters."""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from hoap2 import parameters, products, runfolder, scenario
from hoap2 import seeds as seeds_module
from hoap2.errors import UserError
from hoap2.studies import collection, groups, light, own_value, sand, shown, sweep, tables
from hoap2.studies.sweep import PREDEFINED, Sweep

SCENARIOS = ("sand-walk", "sand-walk-lpc")
DEFAULT_SEEDS = "1-12"
Key = tuple[str, tuple[str, ...], str, int]  # sweep, cell, scenario, seed


@dataclass(frozen=True)
class Wish:
    """What the command line asked for."""

    vary: tuple[str, ...] = ()
    sweeps: tuple[str, ...] = ()  # names of predefined ones
    scenarios: tuple[str, ...] = ()
    seeds: str | None = None
    overrides: tuple[str, ...] = ()
    jobs: int = 1
    out: str | None = None
    resume: Path | None = None
    choice: products.Choice = products.Choice()


def _chosen(plan: dict) -> list[Sweep]:
    if plan["vary"] and plan["sweeps"]:
        raise UserError("give either --vary or --sweep, not both")
    if plan["vary"]:
        return [sweep.given(plan["vary"])]
    by_name = {each.name: each for each in PREDEFINED}
    for name in plan["sweeps"]:
        if name not in by_name:
            raise parameters.unknown("sweep", name, by_name)
    return [by_name[name] for name in plan["sweeps"]] or list(PREDEFINED)


def _plan(wish: Wish) -> dict:
    own = {"vary": list(wish.vary), "sweeps": list(wish.sweeps), "scenarios": list(wish.scenarios), "seeds": wish.seeds,
           "set": list(wish.overrides)}  # fmt: skip
    if wish.resume is None:
        defaults = {"scenarios": own["scenarios"] or list(SCENARIOS), "seeds": own["seeds"] or DEFAULT_SEEDS}
        return {"study": "map"} | own | defaults
    if wish.out is not None:
        raise UserError("give either --resume or --out, not both")
    plan = collection.resume_folder(wish.resume, "map")
    if own["vary"] or own["sweeps"]:
        plan |= {"vary": [], "sweeps": []}
    return plan | {key: value for key, value in own.items() if value}


def _base(plan: dict) -> tuple[str, list[str]]:
    """The scenario, with its overrides, whose own values factors and stars refer to."""
    return plan["scenarios"][0], plan["set"]


def run(wish: Wish, console: Console, show: bool = True) -> tuple[dict, int]:
    """Run what is missing; write study.json, both tables and the figure. Returns the document and the exit code."""
    plan = _plan(wish)
    sweeps = [own_value.resolve(each, *_base(plan)) for each in _chosen(plan)]
    seed_list = seeds_module.parse_range(plan["seeds"])
    loaded = {
        (each.name, cell, name): scenario.load(name, [*plan["set"], *each.overrides(cell)])
        for each in sweeps for cell in each.cells() for name in plan["scenarios"]
    }  # fmt: skip
    folder = wish.resume or collection.make_folder("study-map", wish.out, plan)
    collection.write(folder, collection.PLAN, json.dumps(plan, indent=2) + "\n")
    tasks = {(*key, seed): light.with_seed(nominal, seed) for key, nominal in loaded.items() for seed in seed_list}
    found = collection.collect(folder, tasks, wish.choice, wish.jobs, console, "study map")
    document = describe(sweeps, plan, seed_list, found) | {"folder": str(folder)}
    _write(folder, document, found)
    if show:
        shown.parameter_map(document, Console(highlight=False))
    return document, sand.exit_code(document)


def describe(sweeps: list[Sweep], plan: dict, seed_list: list[int], found: collection.Found) -> dict:
    """The content of study.json."""
    described = [_describe_sweep(each, plan, found) for each in sweeps]
    blocks = [cell[sand.key_of(name)] for each in described for cell in each["cells"] for name in plan["scenarios"]]
    planned, done = len(blocks) * len(seed_list), sum(block["runs"] for block in blocks)
    ended = {key: row["error"] for key, row in found.summaries.items() if not groups.counts(row)}
    return {
        "study": "map",
        "scenarios": plan["scenarios"],
        "seeds": seed_list,
        "set": plan["set"],
        "runs_planned": planned,
        "runs_done": done,
        "runs_kept_from_before": found.kept,
        "interrupted": found.stopped,
        "ok": done == planned and not found.stopped,
        "sweeps": described,
        "errors": {f"{k[0]} {' '.join(k[1])}, {k[2]} seed {k[3]}": t for k, t in (found.errors | ended).items()},
    }


def _describe_sweep(each: Sweep, plan: dict, found: collection.Found) -> dict:
    rows, failed = defaultdict(list), Counter(key[:3] for key in found.errors)
    for key, row in found.summaries.items():
        rows[key[:3]].append(row)
    cells = []
    for cell in each.cells():
        keys = {name: (each.name, cell, name) for name in plan["scenarios"]}
        blocks = {sand.key_of(name): groups.describe(rows[key], failed[key]) for name, key in keys.items()}
        cells.append({"values": dict(zip((axis.name for axis in each.axes), cell)), **blocks})
    axes = [
        {
            "name": a.name,
            "unit": own_value.unit(a),
            "values": list(a.values),
            "own": own_value.find(a, each, *_base(plan)),
        }
        for a in each.axes
    ]
    return {"name": each.name, "title": each.title, "axes": axes, "set": list(each.sets), "cells": cells}


def _write(folder: Path, document: dict, found: collection.Found) -> None:
    from hoap2.studies import map_plot

    rows = []
    for (name, cell, _, _), summary in found.summaries.items():
        rows.append({"sweep": name, "cell": " ".join(cell)} | summary)
    collection.write(folder, "runs.csv", tables.runs_csv(rows))
    entries = []
    for each in document["sweeps"]:
        for cell in each["cells"]:
            named = {f"value_{i}": value for i, value in enumerate(cell["values"].values(), 1)}
            for name in document["scenarios"]:
                entries.append(({"sweep": each["name"], "scenario": name} | named, cell[sand.key_of(name)]))
    collection.write(folder, "table.csv", tables.groups_csv(entries))
    if rows:
        map_plot.write(folder / "study", document)
    text = json.dumps(runfolder.jsonable(document), indent=2, ensure_ascii=False) + "\n"
    collection.write(folder, "study.json", text)
