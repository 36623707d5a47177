"""The tests on Linux CAN sockets, run in the emulated machine; and what its runner says when something is missing."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from hoap2.can import machine, machine_image
from hoap2.errors import UserError


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_the_socketcan_tests_pass_in_the_emulated_machine(tmp_path: Path, capfd: pytest.CaptureFixture[str]):
    if why := machine_image.why_not():
        pytest.skip(f"no emulated machine: {why}")
    junit = tmp_path / "socketcan.xml"
    code = machine.run_tests([], junit)
    said = capfd.readouterr().out
    assert code == 0, said[-8000:]
    suite = next(ElementTree.parse(junit).getroot().iter("testsuite"))
    assert int(suite.get("tests")) >= 6 and int(suite.get("skipped")) == 0
    logs = [path.read_text() for path in (machine_image.FOLDER / "out").glob("candump-*.log")]
    assert "vcan0 020##5" in "".join(logs)


def test_without_qemu_the_reason_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(UserError, match="no emulated machine: qemu-system-x86_64 is not installed"):
        machine.run(["true"], tmp_path / "out")


def test_a_machine_that_ends_without_a_verdict_is_a_failure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(machine_image, "why_not", lambda: "")
    monkeypatch.setattr(machine_image, "image", lambda say: machine_image.Image(tmp_path, tmp_path))
    monkeypatch.setattr(machine, "_qemu", lambda image, out: ["sh", "-c", "echo panic; exit 3"])
    verdict = machine.run(["true"], tmp_path / "out")
    assert verdict.exit_code is None and verdict.console == "panic\n"
    monkeypatch.setattr(machine, "_qemu", lambda image, out: ["sleep", "60"])
    assert machine.run(["true"], tmp_path / "late", timeout_s=0.5).exit_code is None
