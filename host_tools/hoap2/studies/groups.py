"""What the runs of one scenario over many seeds have in common: fractions, medians, directions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import numpy as np

from hoap2 import bounds, statistics

# Fractions of a group: name -> the metric that is true or false of a run.
FRACTIONS = {"survived": "survived", "fell": "fell", "fell_backward": "fell_backward"}
# Medians over all runs of a group: name -> metric.
MEDIANS = {
    "median_max_pitch_deg": "pitch_deg.max",
    "median_max_roll_deg": "roll_deg.max",
    "median_rms_roll_deg": "roll_deg.rms",
    "median_rms_pitch_deg": "pitch_deg.rms",
    "median_sinkage_mid_stance_m": "sinkage_mid_stance_m",
    "median_landing_shift_rms_m": "landing_shift_m.rms",
    "median_progress_x_m": "progress_x_m",
    "median_pitch_est_error_rms_deg": "pitch_est_error_deg.rms",
}


def values(rows: Iterable[dict], metric: str) -> list[float]:
    """A metric of all runs that have it."""
    found = (bounds.lookup(row, metric) for row in rows)
    return [value for value in found if value is not None]


def median(numbers: list[float]) -> float | None:
    return float(np.median(numbers)) if numbers else None


def counts(row: dict) -> bool:
    """Whether a run came to its end, or to its fall."""
    return row["error"] is None or bool(row["fell"])


def describe(rows: list[dict], errors: int = 0) -> dict:
    """The group's block in study.json.

    rows: summaries of runs. A run that an error ended while it stood, like one that could not start (`errors` of
    them), counts for nothing but `errors`; what happens to a robot that lies changes nothing.
    Each fraction has its 95 % Wilson interval under the same name in `wilson_95`.
    """
    whole = [row for row in rows if counts(row)]
    block: dict = {"runs": len(whole), "errors": errors + len(rows) - len(whole), "wilson_95": {}, "counts": {}}
    for name, metric in FRACTIONS.items():
        count = sum(bool(row.get(metric)) for row in whole)
        key = f"{name}_fraction"
        block[key] = count / len(whole) if whole else None
        block["wilson_95"][key] = list(statistics.wilson_95(count, len(whole)))
        block["counts"][name] = count
    fallen = [row for row in whole if row["fell"]]
    steps = sorted(int(row["fall_step"]) for row in fallen if row["fall_step"] is not None)
    block["fall_directions"] = dict(Counter(row["fall_direction"] for row in fallen).most_common())
    block["fall_steps"] = steps
    block["median_fall_step"] = median([float(step) for step in steps])
    for name, metric in MEDIANS.items():
        block[name] = median(values(whole, metric))
    block["largest_max_pitch_deg"] = max(values(whole, "pitch_deg.max"), default=None)
    return block


def paired_difference(rows: dict[int, dict], base: dict[int, dict], metric: str) -> dict:
    """rows less base, seed by seed, of a metric; only seeds whose both runs came to their end without a fall."""
    seeds = [s for s in sorted(rows) if s in base and not any(r["fell"] or not counts(r) for r in (rows[s], base[s]))]
    pairs = [(s, bounds.lookup(rows[s], metric), bounds.lookup(base[s], metric)) for s in seeds]
    found = {s: a - b for s, a, b in pairs if a is not None and b is not None}
    mean = statistics.mean_95(list(found.values()))
    return {
        "metric": metric,
        "pairs": len(found),
        "mean": mean[0] if mean else None,
        "mean_95": list(mean[1:]) if mean else None,
        "mean_of_base": float(np.mean([b for _, _, b in pairs])) if pairs else None,
        "differences": {str(seed): value for seed, value in found.items()},
    }
