"""The benchmark measures what it says (its figures themselves are never judged)."""

from __future__ import annotations

import json

import pytest

from hoap2 import bench, scenario
from hoap2.bench import Spread
from hoap2.errors import UserError


def test_spread():
    spread = Spread.of([1000, 2000, 3000], overhead_ns=500)
    assert spread.median == pytest.approx(1.5) and 2.4 < spread.p99 <= 2.5


def test_fmus_and_libraries_walk_side_by_side():
    loaded = scenario.load("floor-walk", ["controller.calibrate_s=0.2"])
    samples, overhead = bench.walk(loaded, 1500, fmi=2)
    assert len(samples.array("controller")) > 200 and overhead > 0
    assert (samples.array("plant") > 0).all()


def test_no_walk_is_an_error():
    loaded = scenario.load("floor-walk")
    with pytest.raises(UserError, match="did not walk"):
        bench.walk(loaded, 50, fmi=3)


@pytest.mark.slow
def test_json_holds_every_figure(hoap2_cli):
    done = hoap2_cli("bench", "--json", "--repeat", "1", "--seconds", "3", timeout=300)
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    run = document["runs"][0]
    for name in ("controller_us", "plant_us", "fmu_exchange_us", "log_us"):
        assert run[name]["median"] > 0
    assert run["real_time_factor"] > 0 and 50 < run["peak_memory_mb"] < 5000
