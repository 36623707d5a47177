"""Bounds on both sides, and intervals of fractions."""

from __future__ import annotations

import pytest

from hoap2 import bounds, metric_names
from hoap2.bounds import Bound
from hoap2.statistics import wilson_95

SIDES = {"roll_deg.max": Bound(0.1, 1.5)}


@pytest.mark.parametrize(("value", "ok"), [(0.05, False), (0.1, True), (1.0, True), (1.5, True), (1.6, False),
                                           (None, False), (float("nan"), False)])  # fmt: skip
def test_both_sides(value, ok):
    verdict = bounds.judge(SIDES, {"roll_deg": {"max": value}})["roll_deg.max"]
    assert verdict["ok"] is ok and (verdict["min"], verdict["max"]) == (0.1, 1.5)


def test_flags_and_missing_metrics():
    asked = {"fell": Bound(1, 1), "stands_at_end": Bound(1, 1), "cop_tracking_m.rms": Bound(0, 1)}
    verdict = bounds.judge(asked, {"fell": True, "stands_at_end": False})
    assert [entry["ok"] for entry in verdict.values()] == [True, False, False]
    assert verdict["cop_tracking_m.rms"]["value"] is None


def test_no_fall_and_no_fault_are_always_asked_for():
    parsed = bounds.parse({"steps_taken": {"min": 36, "max": 36}}, metric_names.NAMES)
    assert parsed["fell"] == Bound(0, 0) and parsed["fault_count"] == Bound(0, 0)
    shows_a_fall = bounds.parse({"fell": {"min": 1, "max": 1}}, metric_names.NAMES)
    assert shows_a_fall["fell"] == Bound(1, 1)


@pytest.mark.parametrize(("successes", "trials"), [(0, 12), (1, 12), (12, 12), (19, 20), (20, 20), (500, 1000)])
def test_wilson_interval_against_scipy(successes, trials):
    stats = pytest.importorskip("scipy.stats")
    interval = stats.binomtest(successes, trials).proportion_ci(0.95, method="wilson")
    assert wilson_95(successes, trials) == pytest.approx((interval.low, interval.high), abs=1e-12)


def test_wilson_interval_without_trials():
    assert wilson_95(0, 0) == (0.0, 1.0)
