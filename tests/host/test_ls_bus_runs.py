"""`--link ls-bus`: a whole walk through the three FMUs, against the modelled link."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from hoap2 import master, paths, products, runner, scenario
from hoap2.errors import UserError


def walk(link: str, sensors: str = "hoap2") -> master.Outcome:
    loaded = scenario.load("floor-walk", [f"scenario.link={link}", f"scenario.sensors={sensors}"], None, None)
    both = products.open_both(products.Choice(), loaded)
    try:
        ticks = runner.ticks_of(loaded)
        return master.run(both.controller, both.plant, ticks, 1.0, master.StopRequest(), link=both.link)
    finally:
        both.close()


def test_the_walk_through_three_fmus_equals_that_over_can_to_the_bit() -> None:
    of_fmus, of_link = walk("ls-bus").log, walk("can").log
    assert of_fmus.column("c.steps_done")[-1] == 36
    assert of_fmus.count == of_link.count
    rows = slice(0, of_fmus.count)
    assert np.array_equal(of_fmus.real[rows].view(np.int64), of_link.real[rows].view(np.int64))
    assert np.array_equal(of_fmus.integer[rows], of_link.integer[rows])


@pytest.mark.slow
def test_a_run_folder_repeats_itself(hoap2_cli, tmp_path: Path) -> None:
    first, again = tmp_path / "first", tmp_path / "again"
    options = ("--duration", "0.5", "--no-video", "--out")
    done = hoap2_cli("run", "floor-walk", "--link", "ls-bus", *options, first)
    assert done.returncode in (0, 1), done.stderr
    summary = json.loads((first / "summary.json").read_text())
    assert summary["link"] == "ls-bus" and summary["error"] is None
    assert "can_bus_sha256" in (first / "run.toml").read_text()
    done = hoap2_cli("run", first / "run.toml", *options, again)
    assert done.returncode in (0, 1), done.stderr
    assert (first / "signals.parquet").read_bytes() == (again / "signals.parquet").read_bytes()


def test_fmus_that_have_no_terminals_are_refused() -> None:
    plain = paths.fmu("controller", 3)
    for choice, said in ((products.Choice(fmi=2), "FMI 3.0"), (products.Choice(controller=plain), "not offered")):
        with pytest.raises(UserError, match=said):
            products.open_both(choice, scenario.load("floor-walk", ["scenario.link=ls-bus"], None, 0.1))


def test_disturbances_of_the_modelled_link_are_refused() -> None:
    with pytest.raises(UserError, match="over CAN"):
        scenario.load("floor-walk", ["scenario.link=ls-bus", "can.loss=0.1"], None, 0.1)
