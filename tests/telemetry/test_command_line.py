"""`./hoap2 command` against a real run, in a network of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import rig

from hoap2.telemetry import types

ROOT = Path(__file__).resolve().parents[2]

SCRIPT = """
run() { "$PYTHON" -m hoap2.cli "$@"; }
run command walk start --timeout 0.3 >"$OUT/nobody" 2>&1; echo "nobody $?"
"$PYTHON" -m hoap2.cli run floor-stand --duration 100 --realtime --no-video --no-telemetry --out "$OUT/deaf" >"$OUT/deaf.log" 2>&1 &
deaf=$!
run command walk start --timeout 30 >"$OUT/deaf.said" 2>&1; echo "deaf $?"
kill -TERM $deaf; wait $deaf
"$PYTHON" -m hoap2.cli run floor-stand --duration 100 --realtime --accept-commands --no-video --out "$OUT/run" >"$OUT/run.log" 2>&1 &
asked=$!
run command walk start --timeout 30 --json >"$OUT/start" 2>&1; echo "start $?"
run command push chest 0 -4 0 0.05 --json >"$OUT/push" 2>&1; echo "push $?"
run command push chest 0 -4000 0 0.05 >"$OUT/hard" 2>&1; echo "hard $?"
run command set tpcc_kp_1_s2 25 --json >"$OUT/set" 2>&1; echo "set $?"
COLUMNS=150 LINES=45 run monitor --once >"$OUT/monitor" 2>&1; echo "monitor $?"
run command step length_m far >"$OUT/bad" 2>&1; echo "bad $?"
sleep 1.5
kill -TERM $asked; wait $asked; echo "run $?"
"""


@pytest.fixture(scope="module")
def played(tmp_path_factory, request):
    """What the script above left: exit codes, texts, the run folder."""
    out = tmp_path_factory.mktemp("commands")
    command = request.getfixturevalue("network_command")(["bash", "-c", SCRIPT])
    environment = os.environ | {"PYTHON": sys.executable, "OUT": str(out), "NO_COLOR": "1",
                                "PYTHONPATH": str(ROOT / "host_tools")}  # fmt: skip
    done = subprocess.run(command, env=environment, cwd=out, capture_output=True, text=True, timeout=300)
    codes = dict(line.split() for line in done.stdout.splitlines())
    return out, {name: int(code) for name, code in codes.items()}, done.stderr


def test_without_a_run_it_says_how_to_start_one(played):
    out, codes, _ = played
    assert codes["nobody"] == 2
    text = (out / "nobody").read_text()
    assert "no run is heard" in text and "--accept-commands" in text


def test_a_run_without_the_switch_takes_none(played):
    out, codes, _ = played
    assert codes["deaf"] == 2 and "takes no commands" in (out / "deaf.said").read_text()


def test_a_command_is_answered_and_the_exit_code_says_how(played):
    out, codes, _ = played
    assert (codes["start"], codes["push"], codes["set"], codes["hard"], codes["bad"]) == (0, 0, 0, 1, 2), played[2]
    assert json.loads((out / "push").read_text())["value"] == [0.0, -4.0, 0.0, 0.05]
    assert "more than 200 N" in (out / "hard").read_text() and "not a number" in (out / "bad").read_text()


def test_the_monitor_shows_the_run(played):
    out, codes, _ = played
    text = (out / "monitor").read_text()
    assert codes["monitor"] == 0 and "floor-stand" in text and "takes commands" in text and "mode" in text


def test_the_run_can_be_told_from_its_log(played):
    """Each command stands in the summary and in telemetry.lcm with its tick, and did there what it said."""
    out, codes, _ = played
    assert codes["run"] == 130
    commands = json.loads((out / "run" / "summary.json").read_text())["commands"]
    assert [c["accepted"] for c in commands] == [True, True, False, True]
    log = rig.read(out / "run" / "telemetry.lcm")
    answers = rig.of(types.ANSWER, log)
    assert [(a.tick, bool(a.accepted)) for a in answers] == [(c["tick"], c["accepted"]) for c in commands]
    events = [(e.kind, e.tick) for e in rig.of(types.EVENT, log)]
    assert ("command_accepted", commands[0]["tick"]) in events and ("command_refused", commands[2]["tick"]) in events
    pushed = [m.tick for m in rig.of(types.TRUTH, log) if m.true_push_force_W_N[1] == -4.0]
    begin = commands[1]["tick"]
    assert pushed and begin < min(pushed) and max(pushed) <= begin + 50
    assert any(m.mode == 3 and m.tick > commands[0]["tick"] for m in rig.of(types.GAIT, log))
