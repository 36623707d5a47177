"""Runs on soil: what is refused, and a walk that leaves its pool."""

from __future__ import annotations

import json

import pytest

REFUSED = [
    (["plant.soil_n=5"], ["soil_n = 5", "out of range [0.3, 2]"]),
    (["plant.soil_kphi_N_m_n2=-1"], ["soil_kphi_N_m_n2 = -1", "out of range"]),
    (["plant.soil_friction_rad=1.5"], ["soil_friction_rad = 1.5", "out of range"]),
    (["plant.soil_shear_m=0"], ["soil_shear_m = 0", "out of range"]),
    (["plant.soil_damping_Pas_m=nan"], ["soil_damping_Pas_m", "out of range"]),
    (["plant.soil_patches=[0, 6]"], ["soil_patches = 0", "out of range [1, 64]"]),
    (["plant.soil_cell_m=0.001", "plant.soil_size_m=[20, 20, 0.15]"], ["soil_cell_m = 0.001", "take a larger soil_cell_m"]),
    (["plant.solver=ode"], ["solver", "soil"]),
    (["soil.preset=lunar"], ["unknown soil preset 'lunar'", "dry_sand"]),
]


@pytest.mark.parametrize(("values", "words"), REFUSED)
def test_bad_soil_is_refused_before_the_run(hoap2_cli, tmp_path, values, words):
    options = [word for value in values for word in ("--set", value)]
    done = hoap2_cli("run", "sand-walk-lpc", "--no-video", "--out", tmp_path / "run", *options, cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    said = " ".join(done.stderr.split())
    assert all(word in said for word in words), said
    assert not (tmp_path / "run").exists()


def test_a_walk_out_of_its_pool_ends_and_says_so(hoap2_cli, tmp_path):
    """The pool ends 130 mm ahead of the toes; on firm soil nothing else can end the walk."""
    pool = ["--set", "plant.soil_size_m=[0.3, 0.56, 0.15]", "--set", "plant.soil_centre_m=[0.04, 0.0]",
            "--set", "soil.preset=sandy_loam"]
    done = hoap2_cli("run", "sand-walk-lpc", "--no-video", "--out", tmp_path / "run", "--json", *pool, cwd=tmp_path)
    assert done.returncode == 1
    summary = json.loads(done.stdout)
    assert "left the soil pool 0.3 x 0.56 m at x = 0." in summary["error"]
    assert not summary["ok"] and not summary["fell"]
    assert 3 <= summary["steps_taken"] <= 11 and summary["duration_s"] > 2.0
    assert (tmp_path / "run" / "report.html").exists()  # the run up to there is kept
