"""The tables of a study as CSV: a line a run, a line a group."""

from __future__ import annotations

import csv
import io

LEFT_OUT = ("bounds", "faults", "controller_us", "plant_us", "set_us", "get_and_log_us", "wall_s")
OF_A_GROUP = ("wilson_95", "counts", "fall_directions", "fall_steps", "title")


def flat(summary: dict, prefix: str = "") -> dict:
    """Nested dictionaries as one, names joined by dots; lists are left out."""
    out = {}
    for key, value in summary.items():
        if isinstance(value, dict):
            out |= flat(value, f"{prefix}{key}.")
        elif not isinstance(value, list):
            out[prefix + key] = value
    return out


def text(rows: list[dict]) -> str:
    """CSV of flat dictionaries; the columns are those of all rows."""
    file = io.StringIO()
    names = list(dict.fromkeys(name for row in rows for name in row))
    writer = csv.DictWriter(file, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return file.getvalue()


def runs_csv(rows: list[dict]) -> str:
    """A line a run."""
    return text([flat({key: value for key, value in row.items() if key not in LEFT_OUT}) for row in rows])


def groups_csv(entries: list[tuple[dict, dict]]) -> str:
    """A line a group: what names it, then its block of study.json, each fraction with both ends of its interval."""
    rows = []
    for named, block in entries:
        row = named | {key: value for key, value in block.items() if key not in OF_A_GROUP}
        for name, (low, high) in block["wilson_95"].items():
            row |= {f"{name}_low_95": low, f"{name}_high_95": high}
        row["fall_directions"] = " ".join(f"{word}:{count}" for word, count in block["fall_directions"].items())
        row["fall_steps"] = " ".join(map(str, block["fall_steps"]))
        rows.append(row)
    return text(rows)
