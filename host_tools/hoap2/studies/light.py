"""Light runs: a run's numbers without its folder, and the fingerprint of all that decides them."""

from __future__ import annotations

import copy
import functools
import hashlib
import json
from pathlib import Path

from hoap2 import master, metrics, parameters, products, runfolder, runner, seeds, walk_metrics, walk_plan
from hoap2.generate.tables import PRODUCTS
from hoap2.master import StopRequest
from hoap2.scenario import Scenario

LEFT_OUT = ("title", "section", "notes")


@functools.lru_cache(maxsize=8)
def _file_sha256(path: Path, _stamp: tuple[int, int]) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def file_sha256(path: Path) -> str:
    """The file's hash, worked out again only when the file has changed."""
    status = path.stat()
    return _file_sha256(path, (status.st_mtime_ns, status.st_size))


def product_hashes(choice: products.Choice) -> dict[str, str]:
    """SHA-256 of both FMUs."""
    return {product: file_sha256(choice.path(product)) for product in PRODUCTS}


def fingerprint(scenario: Scenario, hashes: dict[str, str]) -> str:
    """Names a run by all that its numbers depend on: both FMUs, every value, and the code that works out the numbers.

    Bounds are not among them: they judge the numbers and do not change them.
    """
    named = {p: dict(zip(parameters.known(p), (scenario.values[p][n] for n in parameters.known(p)))) for p in PRODUCTS}
    content = {
        "values": named, "options": scenario.options, "duration_s": scenario.duration_s, "products": hashes,
        "link": [scenario.link, scenario.can] if scenario.link != "direct" else [],
        "code": [file_sha256(Path(module.__file__)) for module in (metrics, walk_metrics, walk_plan)],
    }  # fmt: skip
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def with_seed(scenario: Scenario, seed: int) -> Scenario:
    """A copy with the seed's draws."""
    seeded = copy.deepcopy(scenario)
    seeds.apply(seeded, seed)
    return seeded


def execute(scenario: Scenario, choice: products.Choice) -> dict:
    """Run to the end and summarise; nothing is written."""
    with StopRequest() as stop:
        both = products.open_both(choice, scenario)
        try:
            outcome = master.run(both.controller, both.plant, runner.ticks_of(scenario),
                                 scenario.options["stop_after_fall_s"], stop, link=both.link)  # fmt: skip
        finally:
            both.close()
    summary = runner.summarise(scenario, outcome)
    return runfolder.jsonable({key: value for key, value in summary.items() if key not in LEFT_OUT})
