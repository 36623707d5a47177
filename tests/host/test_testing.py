"""The sum of the rings of tests."""

from __future__ import annotations

from pathlib import Path

from hoap2 import testing
from hoap2.testing import Ring

CTEST = """<testsuite name="x" tests="4" failures="1" disabled="0" skipped="1">
<testcase name="a.b" classname="a.b" status="run"/>
<testcase name="a.c" classname="a.c" status="fail"><failure/></testcase>
</testsuite>"""
PYTEST = """<testsuites><testsuite name="pytest" errors="1" failures="2" skipped="3" tests="10">
<testcase classname="tests.t" name="one"><error/></testcase></testsuite></testsuites>"""


def count(tmp_path: Path, text: str) -> Ring:
    ring = Ring("r")
    (tmp_path / "junit.xml").write_text(text)
    testing._count(tmp_path / "junit.xml", ring)
    return ring


def test_counts_of_ctest_and_pytest(tmp_path: Path):
    ring = count(tmp_path, CTEST)
    assert (ring.passed, ring.failed, ring.skipped) == (2, 1, 1) and ring.failures == ["a.c::a.c"]
    ring = count(tmp_path, PYTEST)
    assert (ring.passed, ring.failed, ring.skipped) == (4, 3, 3) and ring.failures == ["tests.t::one"]


def test_no_result_is_a_failure(tmp_path: Path):
    ring = Ring("r")
    testing._count(tmp_path / "none.xml", ring)
    assert not ring.ok and ring.failed == 1


def test_an_empty_ring_is_not_well():
    assert not Ring("r").ok and not Ring("r", passed=3, failed=1).ok and Ring("r", passed=3, skipped=1).ok


def test_last_line_is_the_sum():
    rings = [Ring("C/C++", passed=5, failed=1, failures=["x::y"]), Ring("Python", passed=2, skipped=1)]
    text = testing.summarise(rings)
    assert text.splitlines()[-1] == "tests: 7 passed, 1 failed, 1 skipped"
    assert "failed: x::y" in text
