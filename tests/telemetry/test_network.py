"""Over udpm, always in a network of its own: paced runs, loggers, replays, no route, strangers."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import lcm
import pytest

import paced_run
import rig
from hoap2.telemetry import types
from hoap2.telemetry.log_file import LogFile
from sides import standing_plant, stepping_controller

HERE = Path(__file__).parent
URL = "udpm://239.255.76.67:7667?ttl=0"
LOGPLAYER = "/usr/bin/lcm-logplayer"


def paced(private_network, folder: Path, seconds: float, *options: str) -> dict:
    """paced_run.py in a private network."""
    command = private_network([sys.executable, HERE / "paced_run.py", folder, seconds, *options])
    done = subprocess.run(command, capture_output=True, text=True, timeout=200 + 3 * seconds)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def paced_in_peace(private_network, folder: Path, seconds: float, *options: str) -> dict:
    """The same; where lcm-logger cannot be put before everything else (see paced_run.first), the best of three."""
    for attempt in range(3):
        (folder / str(attempt)).mkdir()
        found = paced(private_network, folder / str(attempt), seconds, *options)
        if found["logger_first"] or not found["missing"]:
            break
    return found


def check_paced(found: dict, seconds: float) -> None:
    ticks = round(1000 * seconds)
    assert found["missing"] == found["added"] == found["problems"] == []
    assert found["recorded"] == found["logged"] > 2 * ticks
    telemetry = found["timing"]["telemetry"]
    assert telemetry["dropped"] == telemetry["decimated"] == 0
    for channel, count in (("HOAP2_STATE", ticks + 1), ("HOAP2_GAIT", ticks + 1), ("HOAP2_TRUTH", ticks // 10 + 1)):
        counter = found["counters"][channel]
        assert counter.pop("received") == count, channel
        assert not any(counter.values()), (channel, counter)
    loop_s, moved_s = found["timing"]["loop_s"], found["timing"]["pace"]["moved_s"]
    assert seconds - 0.01 <= loop_s <= seconds + moved_s + 0.5, "it kept to the wall clock, or says by how much not"
    assert found["duration_s"] == seconds


def test_nothing_of_a_paced_run_is_lost_whatever_the_listeners_do(private_network, tmp_path: Path):
    """Debian's lcm-logger has every byte of the run's own log, while others come late, hang and die."""
    check_paced(paced_in_peace(private_network, tmp_path, 6.0, "--trouble"), 6.0)


@pytest.mark.slow
def test_nothing_is_lost_in_a_minute(private_network, tmp_path: Path):
    found = paced_in_peace(private_network, tmp_path, 60.0)
    check_paced(found, 60.0)
    assert found["steps_taken"] > 130


def test_a_paced_run_computes_what_an_unpaced_one_does(hoap2_cli, private_network, tmp_path: Path):
    options = ("floor-walk", "--duration", "2.5", "--no-video", "--json", "--seed", "4", "--out")
    command = [sys.executable, "-m", "hoap2.cli", "run", *options, tmp_path / "paced", "--realtime"]
    subprocess.run(private_network(command), capture_output=True, timeout=120)
    hoap2_cli("run", *options, tmp_path / "free", "--no-telemetry")
    done = hoap2_cli("diff", tmp_path / "paced", tmp_path / "free")
    assert done.returncode == 0 and done.stdout == "equal: 2501 ticks, every signal\n"


LISTENER = """
import json, sys, time
from hoap2.telemetry import types
from hoap2.telemetry.listen import Listener
listener, end = Listener(sys.argv[1]), time.monotonic() + float(sys.argv[2])
print("ready", flush=True)
while time.monotonic() < end:
    listener.poll(0.1)
    run = listener.latest.get(types.RUN)
    if run is not None and run.state == run.ENDED and "HOAP2_GAIT" in listener.counters:
        listener.poll(0.3)
        break
print(json.dumps({c: [k.received, k.lost, k.replayed, k.malformed, k.foreign] for c, k in listener.counters.items()}))
"""

SCRIPT = """
set -eu
{python} -c "$LISTENER" '{url}' 60 > {folder}/heard &
listener=$!
until grep -q ready {folder}/heard; do sleep 0.1; done
{player}
wait $listener
"""


def heard(private_network, folder: Path, player: str) -> dict[str, list[int]]:
    """What a listener counts while something plays."""
    script = SCRIPT.format(python=sys.executable, url=URL, folder=folder, player=player)
    done = subprocess.run(private_network(["bash", "-c", script]), capture_output=True, text=True, timeout=120,
                          env=os.environ | {"LISTENER": LISTENER, "LCM_DEFAULT_URL": URL})  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads((folder / "heard").read_text().splitlines()[-1])


@pytest.fixture(scope="module")
def recorded(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("log") / "telemetry.lcm"
    rig.run(stepping_controller(step_ticks=50, lead_ticks=20, steps=3), standing_plant(), 800, path)
    return path


def test_replay_is_heard_as_the_run_was(private_network, recorded: Path, tmp_path: Path):
    begin = time.monotonic()
    counts = heard(private_network, tmp_path, f"{sys.executable} -m hoap2.cli replay {recorded} --speed 0.5")
    assert time.monotonic() - begin >= 1.6, "0.8 s at half speed"
    in_log = {c: sum(e.channel == c for e in LogFile(recorded)) for c in types.CHANNELS}
    assert counts.pop(types.RUN)[0] >= 3, "repeated each second"
    assert counts == {c: [n, 0, 0, 0, 0] for c, n in in_log.items() if n and c != types.RUN}


@pytest.mark.skipif(not Path(LOGPLAYER).exists(), reason="liblcm-bin is not installed")
def test_logplayer_plays_our_log_and_lcm_logger_records_it(private_network, recorded: Path, tmp_path: Path):
    """Round trip through Debian's tools: the messages that come back are those of the log."""
    copy = tmp_path / "copy.lcm"
    script = f"""
        {" ".join(paced_run.first())} /usr/bin/lcm-logger -q --lcm-url='{URL}' {copy} & logger=$!
        sleep 1
        {LOGPLAYER} --lcm-url='{URL}' --speed=2 {recorded}
        sleep 1; kill -TERM $logger; wait $logger || true"""
    done = subprocess.run(private_network(["bash", "-c", script]), capture_output=True, text=True, timeout=60)
    assert copy.exists(), done.stderr
    came_back = [(e.channel, e.data) for e in LogFile(copy)]
    assert sorted(came_back) == sorted((e.channel, e.data) for e in LogFile(recorded)) and len(came_back) > 1700


def test_strangers_on_the_network_are_counted(private_network, recorded: Path, tmp_path: Path):
    noise = tmp_path / "noise.py"
    noise.write_text(f"""
import lcm, random, socket
from hoap2.telemetry import types
ours, random = lcm.LCM({URL!r}), random.Random(1)
state = types.type_of(types.STATE)().encode()
for _ in range(50):
    ours.publish(types.STATE, state[: random.randrange(8, len(state))])
    ours.publish(types.GAIT, random.randbytes(random.randrange(300)))
raw = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
for _ in range(200):  # not even LCM
    raw.sendto(random.randbytes(random.randrange(1, 400)), ("239.255.76.67", 7667))
""")
    player = f"{sys.executable} {noise}; {sys.executable} -m hoap2.cli replay {recorded}"
    counts = heard(private_network, tmp_path, player)
    assert counts[types.STATE][:4] == [801, 0, 0, 50] and counts[types.GAIT] == [801, 0, 0, 0, 50]


def test_without_a_multicast_route_it_says_what_helps(private_network, recorded: Path, tmp_path: Path):
    for arguments in (["run", "floor-stand", "--realtime", "--out", tmp_path / "a"], ["replay", recorded]):
        done = subprocess.run(private_network([sys.executable, "-m", "hoap2.cli", *arguments], route=False),
                              capture_output=True, text=True, timeout=60, cwd=tmp_path)  # fmt: skip
        assert done.returncode == 2 and "no multicast route to 239.255.76.67" in done.stderr
        assert "sudo ip route add 239.255.76.67/32 dev lo" in done.stderr
        assert "file:///" in done.stderr and "memq://" in done.stderr
        assert "Traceback" not in done.stderr and len(done.stderr.splitlines()) <= 4
    assert list(tmp_path.iterdir()) == [], "no run folder is left"
    # and the command does help
    script = f"ip route add 239.255.76.67/32 dev lo; {sys.executable} -m hoap2.cli replay {recorded} --speed 10"
    done = subprocess.run(
        private_network(["bash", "-c", script], route=False), capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0 and f"{len(list(LogFile(recorded)))} messages" in done.stderr


def test_paced_into_a_file_needs_no_network(hoap2_cli, private_network, tmp_path: Path):
    live = tmp_path / "live.lcm"
    arguments = ["run", "floor-stand", "--realtime", "--duration", "2", "--no-video", "--lcm", f"file://{live}?mode=w",
                 "--out", tmp_path / "a"]  # fmt: skip
    done = subprocess.run(private_network([sys.executable, "-m", "hoap2.cli", *arguments], route=False),
                          capture_output=True, text=True, timeout=60)  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    states = [e for e in LogFile(live) if e.channel == types.STATE]
    assert len(states) == 2001
    first, last = (lcm.EventLog(str(live)).read_next_event().timestamp, states[-1].time_us)
    assert 1.9e6 < last - first < 10e6, "these times are the wall clock's"
