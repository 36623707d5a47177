"""The command line with the loop of its run timed: `python -m hoap2.bench.child NOTES.json run floor-walk ...`.

NOTES.json: when the loop began and ended (time.monotonic, which processes share), the mean microseconds a tick of its
parts, and median and 99th percentile of the steps while walking.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np

from hoap2 import cli, master, parameters
from hoap2.bench.measure import Spread, mean


def notes_of(outcome: master.Outcome) -> dict:
    """What the loop's own clock tells."""
    ticks = outcome.timing.ticks
    ns = {part: np.array(outcome.timing.ns[part][:ticks]) for part in master.Timing.PARTS}
    walking = outcome.log.column("c.mode")[:ticks] == parameters.table().enums["mode"].index("walk")
    notes = {"us": {part: mean(durations) / 1e3 for part, durations in ns.items()}}
    if walking.any():
        notes["walking_us"] = {part: vars(Spread.of(ns[part][walking])) for part in ("controller", "plant")}
    return notes


def main(file: str, arguments: list[str]) -> int:
    loop = master.run

    def timed(*positional, **named):
        begin = time.monotonic()
        outcome = loop(*positional, **named)
        end = time.monotonic()
        Path(file).write_text(json.dumps({"begin": begin, "end": end, **notes_of(outcome)}))
        return outcome

    master.run = timed
    return cli.main(arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
