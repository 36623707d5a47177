"""Seeds: what they draw, in which ranges, and who wins."""

from __future__ import annotations

import math

import pytest

from hoap2 import scenario, seeds
from hoap2.errors import UserError

WIDTH = {
    "gyro_bias_S_rad_s": (0.0, math.radians(0.5)), "cell_gain": (1.0, 0.05), "floor_tilt_rad": (0.0, math.radians(0.5)),
    "friction_mu": (0.75, 0.25), "chest_com_shift_L_m": (0.0, 0.003),
}  # fmt: skip


def test_a_seed_always_draws_the_same():
    assert seeds.draw(5) == seeds.draw(5)
    assert seeds.draw(5) != seeds.draw(6)
    # Fixed for good: published results name seeds, so a seed may never come to mean something else.
    assert seeds.draw(1)["seed"] == (288545017.0,)
    assert seeds.draw(1)["friction_mu"][0] == pytest.approx(0.7226935970274007, abs=1e-12)


def test_draws_fill_their_ranges_and_stay_inside():
    drawn = [seeds.draw(seed) for seed in range(1, 401)]
    for name, (centre, half) in WIDTH.items():
        for element in range(len(drawn[0][name])):
            values = [d[name][element] for d in drawn]
            assert centre - half <= min(values) < centre - 0.9 * half
            assert centre + 0.9 * half < max(values) <= centre + half
    assert len({d["seed"] for d in drawn}) == 400
    assert all(1 <= d["seed"][0] < 2**31 for d in drawn)


def test_seed_zero_is_nominal():
    loaded, plain = scenario.load("floor-walk"), scenario.load("floor-walk")
    seeds.apply(loaded, 0)
    assert loaded.values == plain.values and loaded.draws == {} and loaded.seed == 0


def test_a_seed_changes_the_plant_only():
    loaded, plain = scenario.load("floor-walk"), scenario.load("floor-walk")
    seeds.apply(loaded, 3)
    assert loaded.values["controller"] == plain.values["controller"]
    changed = {n for n, v in loaded.values["plant"].items() if v != plain.values["plant"][n]}
    assert changed == set(seeds.draw(3)) == set(loaded.draws)


def test_the_command_line_wins_and_scenario_values_are_the_centre(tmp_path):
    path = tmp_path / "slope.toml"
    path.write_text('[scenario]\ntitle="s"\n[plant]\nfloor_tilt_rad=[0.1, 0]\nfriction_mu=0.9\n')
    loaded = scenario.load(str(path), ["plant.gyro_bias_S_rad_s=[0.001, 0, 0]"])
    seeds.apply(loaded, 4)
    plant, drawn = loaded.values["plant"], seeds.draw(4)
    assert plant["gyro_bias_S_rad_s"] == (0.001, 0.0, 0.0) and "gyro_bias_S_rad_s" not in loaded.draws
    assert plant["floor_tilt_rad"] == (0.1 + drawn["floor_tilt_rad"][0], drawn["floor_tilt_rad"][1])
    assert plant["friction_mu"] == (0.9,) and plant["cell_gain"] == drawn["cell_gain"]


def test_ranges():
    assert seeds.parse_range("1-4") == [1, 2, 3, 4]
    assert seeds.parse_range("1,3, 5-7,6") == [1, 3, 5, 6, 7]


@pytest.mark.parametrize("text", ["", "a", "1-", "5-3", "1..4", "-2", "1,,2", "1-99999"])
def test_bad_ranges(text):
    with pytest.raises(UserError, match="--seeds"):
        seeds.parse_range(text)
