"""`bench page` measures what it says (its figures themselves are never judged)."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.slow
def test_the_figures_of_the_page_are_there(network, chromium, tmp_path: Path) -> None:
    command = [*network.enter, sys.executable, "-m", "hoap2.cli", "bench", "page", "--json", "--seconds", "10"]
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=tmp_path, timeout=300)
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    samples = document["samples"]
    assert len(samples) >= 2 and all(a["at_s"] < b["at_s"] for a, b in zip(samples, samples[1:]))
    least, most = (pick(s["pictures_1_s"] for s in samples) for pick in (min, max))
    assert 0.0 < document["pictures_least_1_s"] == least <= document["pictures_1_s"] <= most
    assert 0.2 < document["shown_1_s"] < 2.5, "the run is paced"
    assert 2.0 < document["heap_mb"]["last"] < 100.0 and 100.0 < document["browser_mb"]["last"] < 3000.0
    assert document["lost"] >= 0 and not list(tmp_path.iterdir()), "it leaves nothing behind"
