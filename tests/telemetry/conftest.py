"""What the telemetry tests share: the scripted sides of the host tests, runs with telemetry, a network of one's own."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "host"))  # sides.py

LOOPBACK = 'ip link set lo up; {route} exec "$@"'
ROUTE = "ip route add 224.0.0.0/4 dev lo;"


@pytest.fixture(scope="session")
def network_command():
    """The command that runs another one in a network with nothing but loopback: network_command([...], route=True)."""
    unshare = ["unshare", "--net"] if subprocess.run(["id", "-u"], capture_output=True).stdout.strip() == b"0" else \
        ["unshare", "--map-root-user", "--net"]  # fmt: skip
    if not shutil.which("unshare") or not shutil.which("ip") or subprocess.run([*unshare, "true"]).returncode != 0:
        pytest.skip("no network namespaces here")

    def command(arguments: list, route: bool = True) -> list[str]:
        script = LOOPBACK.format(route=ROUTE if route else "")
        return [*unshare, "bash", "-c", script, "bash", *map(str, arguments)]

    return command


@pytest.fixture
def private_network(network_command):
    """The same, for one test."""
    return network_command
