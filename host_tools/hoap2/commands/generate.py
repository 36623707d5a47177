"""`generate`: the generated sources."""

from __future__ import annotations

import subprocess
import sys
from typing import Annotated

import typer


def command(
    check: Annotated[bool, typer.Option("--check", help="Write nothing; list stale files and exit 1 if any.")] = False,
) -> int:
    """Rewrite the sources generated from firmware/hoap2.json and firmware/signals.toml."""
    return subprocess.run([sys.executable, "-m", "hoap2.generate", *(["--check"] if check else [])]).returncode
