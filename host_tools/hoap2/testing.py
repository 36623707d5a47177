"""Runs the rings of tests and adds up what they say."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

from hoap2.paths import ROOT

LOG = ROOT / "build" / "test.log"
SHOWN_FAILURES = 20  # of each ring, in the summary


@dataclass
class Ring:
    """The result of one ring of tests."""

    name: str
    passed: int = 0
    failed: int = 0
    skipped: int = 0
    seconds: float = 0.0
    note: str = ""
    failures: list[str] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        return self.failed == 0 and self.passed > 0


def _say(text: str) -> None:
    print(f"hoap2 test: {text}", flush=True)


def _cmake(tool: str = "cmake") -> str:
    """Debian's tool, not the one that a Python package brings."""
    path = Path("/usr/bin") / tool
    return str(path) if path.exists() else tool


def _logged(command: list[str]) -> bool:
    """Run into the log; show the end of it when the command fails."""
    with LOG.open("ab") as log:
        start = log.tell()
        log.write(f"\n==== {' '.join(command)}\n".encode())
        log.flush()
        done = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, cwd=ROOT)
    if done.returncode:
        text = LOG.read_bytes()[start:].decode(errors="replace")
        print("\n".join(text.splitlines()[-60:]))
        _say(f"failed; all of it is in {LOG}")
    return done.returncode == 0


def build(preset: str) -> bool:
    """Configure and build a preset."""
    if not (ROOT / "build" / preset / "build.ninja").exists():
        if not _logged([_cmake(), "--preset", preset, f"-DPython3_EXECUTABLE={sys.executable}"]):
            return False
    return _logged([_cmake(), "--build", "--preset", preset])


def _count(junit: Path, ring: Ring) -> None:
    """Add the counts of a JUnit file (ctest's and pytest's differ in where they put them)."""
    if not junit.exists():
        ring.failed += 1
        ring.note = "no result file"
        return
    for suite in ElementTree.parse(junit).getroot().iter("testsuite"):
        total = int(suite.get("tests", 0))
        failed = int(suite.get("failures", 0)) + int(suite.get("errors", 0))
        skipped = int(suite.get("skipped", 0)) + int(suite.get("disabled", 0))
        ring.failed += failed
        ring.skipped += skipped
        ring.passed += total - failed - skipped
        for case in suite.iter("testcase"):
            if case.find("failure") is not None or case.find("error") is not None:
                ring.failures.append(f"{case.get('classname')}::{case.get('name')}".replace("\n", " ")[:120])


def run_ctest(preset: str, quick: bool) -> Ring:
    """Build a preset and run its C and C++ tests."""
    ring = Ring("C/C++ (sanitizers)" if preset == "asan" else "C/C++")
    start = time.monotonic()
    _say(f"building build/{preset}")
    if not build(preset):
        ring.failed, ring.note = 1, "build failed"
    else:
        _say(f"running the C and C++ tests of build/{preset}")
        junit = ROOT / "build" / preset / "ctest.xml"
        junit.unlink(missing_ok=True)
        command = [_cmake("ctest"), "--test-dir", f"build/{preset}", "--output-on-failure", "--no-tests=error",
                   "--output-junit", str(junit), "-j", str(os.cpu_count() or 1),
                   *(["--progress"] if sys.stdout.isatty() else [])]
        excluded = ([] if not quick else ["slow"]) + (["no_sanitizers"] if preset == "asan" else [])
        command += ["-LE", f"^({'|'.join(excluded)})$"] if excluded else []
        done = subprocess.run(command, cwd=ROOT, stdin=subprocess.DEVNULL)
        _count(junit, ring)
        if done.returncode and not ring.failed:
            ring.failed, ring.note = 1, f"ctest ended with {done.returncode}"
    ring.seconds = time.monotonic() - start
    return ring


def run_pytest(quick: bool, chosen: list[str] | None = None) -> Ring:
    """Run the Python tests; its own summary line is the last that it prints."""
    ring = Ring("Python")
    start = time.monotonic()
    junit = ROOT / "build" / "pytest.xml"
    junit.unlink(missing_ok=True)
    junit.parent.mkdir(exist_ok=True)
    command = [sys.executable, "-m", "pytest", f"--rootdir={ROOT}", "-c", str(ROOT / "pyproject.toml"),
               f"--junitxml={junit}", "--durations=10", *(["-m", "not slow"] if quick else []), *(chosen or [])]
    if not any(Path(word.split("::")[0]).exists() for word in chosen or []):
        command.append(str(ROOT / "tests"))
    done = subprocess.run(command)
    _count(junit, ring)
    if done.returncode and not ring.failed:
        ring.failed, ring.note = 1, f"pytest ended with {done.returncode}"
    ring.seconds = time.monotonic() - start
    return ring


def summarise(rings: list[Ring]) -> str:
    """The last lines of a test run."""
    lines = [f"{ring.name:<20} {ring.passed:5d} passed {ring.failed:4d} failed {ring.skipped:4d} skipped "
             f"{ring.seconds:7.1f} s  {ring.note}".rstrip() for ring in rings]
    lines += [f"failed: {name}" for ring in rings for name in ring.failures[:SHOWN_FAILURES]]
    passed, failed, skipped = (sum(getattr(r, name) for r in rings) for name in ("passed", "failed", "skipped"))
    lines.append(f"tests: {passed} passed, {failed} failed, {skipped} skipped")
    return "\n".join(lines)


def run_all(quick: bool) -> int:
    """Every ring, the Python tests last; 0 when all passed."""
    LOG.parent.mkdir(exist_ok=True)
    LOG.write_text("")
    rings = [run_ctest("host", quick)]
    if not quick:
        rings.append(run_ctest("asan", quick))
    _say("running the Python tests")
    rings.append(run_pytest(quick))
    print(summarise(rings), flush=True)
    return 0 if all(ring.ok for ring in rings) else 1
