"""./hoap2 itself: help before any set-up, errors, and nothing to do the second time."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

from hoap2.cli import COMMANDS


def launch(script: Path, *arguments: str, timeout: float = 300.0, **options) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(script), *arguments], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          timeout=timeout, **options)


@pytest.fixture
def bare_copy(repo_root: Path, tmp_path: Path) -> Path:
    """The launcher in a folder with a space in its name, with nothing set up."""
    folder = tmp_path / "a bare copy"
    shutil.copytree(repo_root / "host_tools", folder / "host_tools", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(repo_root / "hoap2", folder / "hoap2")
    return folder


def test_help_and_version_need_no_set_up(bare_copy: Path):
    for option in ("--help", "-h", "help"):
        done = launch(bare_copy / "hoap2", option)
        assert done.returncode == 0 and "Commands:" in done.stdout
    assert launch(bare_copy / "hoap2").returncode == 0
    assert launch(bare_copy / "hoap2", "--version").stdout.startswith("hoap2 0.")
    assert not (bare_copy / ".venv").exists() and not (bare_copy / "build").exists()


def test_launcher_and_command_line_list_the_same_commands(repo_root: Path):
    usage = launch(repo_root / "hoap2", "--help").stdout
    listed = {line.split()[0]: " ".join(line.split()[1:]) for line in usage.splitlines() if line.startswith("  ")}
    assert listed == {name: " ".join(text.split()) for name, text in COMMANDS.items()}


def test_unknown_command_names_the_nearest_and_sets_nothing_up(bare_copy: Path):
    done = launch(bare_copy / "hoap2", "rnu")
    assert done.returncode == 2 and "did you mean 'run'?" in done.stderr
    done = launch(bare_copy / "hoap2", "xyzzy")
    assert done.returncode == 2 and "did you mean" not in done.stderr and "bench" in done.stderr
    assert not (bare_copy / ".venv").exists()


def test_second_time_does_nothing(repo_root: Path):
    script = repo_root / "hoap2"
    launch(script, "run", "--no-such-option", timeout=900)  # the first time may build
    log = repo_root / "build" / "setup.log"
    before = log.stat().st_size
    for arguments in (("test", "--help"), ("frame", "--help"), ("run", "--no-such-option")):
        done = launch(script, *arguments)
        assert "hoap2: " not in done.stderr, done.stderr
    assert log.stat().st_size == before


def test_from_anywhere_by_a_symlink_with_spaces(repo_root: Path, tmp_path: Path):
    link = tmp_path / "a link"
    link.symlink_to(repo_root / "hoap2")
    elsewhere = tmp_path / "else where"
    elsewhere.mkdir()
    done = launch(link, "test", "--help", cwd=elsewhere)
    assert done.returncode == 0 and "Usage: hoap2 test" in done.stdout


def test_generated_files_are_fresh(repo_root: Path):
    done = launch(repo_root / "hoap2", "generate", "--check")
    assert done.returncode == 0, f"stale: run ./hoap2 generate\n{done.stdout}{done.stderr}"


def test_stale_generated_file_is_found(repo_root: Path, tmp_path: Path):
    for folder in ("host_tools", "firmware", "sim", "docs", "fmu"):
        if (repo_root / folder).exists():
            shutil.copytree(repo_root / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(repo_root / "hoap2", tmp_path / "hoap2")
    header = tmp_path / "firmware/include/hoap2/generated/signals.h"
    header.write_text(header.read_text() + "\n")
    done = launch(tmp_path / "hoap2", "generate", "--check")
    assert done.returncode == 1 and "firmware/include/hoap2/generated/signals.h" in done.stdout


@pytest.fixture
def folder_of_nobody(bare_copy: Path):
    """A bare copy that an unprivileged user may write to, and that user's id (None: ours is unprivileged)."""
    folder = Path(tempfile.mkdtemp(prefix="hoap2 launcher "))
    shutil.copytree(bare_copy, folder / "copy")
    user = 65534 if os.geteuid() == 0 else None
    if user is not None:
        for path in [folder, *folder.rglob("*")]:
            os.chown(path, user, user)
    yield folder / "copy", user
    shutil.rmtree(folder)


def test_missing_packages_without_rights_name_the_command(folder_of_nobody):
    folder, user = folder_of_nobody
    tools = folder / "tools"
    tools.mkdir()
    for name, body in {"dpkg-query": "exit 1", "sudo": "exit 1"}.items():
        (tools / name).write_text(f"#!/bin/sh\n{body}\n")
        (tools / name).chmod(0o755)
    environment = {"PATH": f"{tools}:/usr/bin:/bin", "HOME": "/nonexistent"}
    done = launch(folder / "hoap2", "run", "floor-walk", env=environment, user=user, group=user, cwd="/")
    assert done.returncode == 3, done.stderr
    assert "sudo apt-get install --no-install-recommends cmake" in done.stderr and "libode-dev" in done.stderr
    for too_much in ("arm-none-eabi", "chromium", "qemu", "libgtest"):
        assert too_much not in done.stderr


def test_unwritable_folder_is_said(folder_of_nobody):
    folder, user = folder_of_nobody
    if user is not None:
        os.chown(folder, 0, 0)
    folder.chmod(0o555)
    done = launch(folder / "hoap2", "run", "floor-walk", user=user, group=user, cwd="/",
                  env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent"})
    folder.chmod(0o755)
    assert done.returncode == 3 and "cannot write" in done.stderr
