"""What all Python tests share: where things are, and the slow ring."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def repo_root() -> Path:
    """The checkout."""
    return ROOT


@pytest.fixture(scope="session")
def build_dir() -> Path:
    """The build whose libraries and FMUs are tested (build/release, or HOAP2_BUILD_DIR)."""
    from hoap2.paths import build_dir

    return build_dir()


@pytest.fixture
def hoap2_cli():
    """Call the command line in a process of its own: hoap2_cli("run", "floor-walk", cwd=..., timeout=60)."""

    def call(*arguments: str, timeout: float = 120.0, **options) -> subprocess.CompletedProcess[str]:
        return subprocess.run([sys.executable, "-m", "hoap2.cli", *map(str, arguments)], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=timeout, **options)

    return call


def pytest_configure(config: pytest.Config) -> None:
    # child processes of tests find the package as the tests do
    import os

    paths = [str(ROOT / "host_tools"), *filter(None, [os.environ.get("PYTHONPATH")])]
    os.environ["PYTHONPATH"] = os.pathsep.join(paths)
