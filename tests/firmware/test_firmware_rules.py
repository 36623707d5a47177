"""The firmware keeps its own rules: seen in its sources and in the symbols it leaves open."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

TRANSCENDENTAL = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "sqrt", "cbrt", "exp",
                  "expm1", "log", "log1p", "log10", "pow", "hypot", "fmod", "sincos")
# What the controller may take from outside: memory moves of the compiler, the two functions of the mathematical library
# that are exact everywhere, and what every shared library carries.
OUTSIDE = {"memcpy", "memset", "memmove", "memcmp", "__stack_chk_fail", "__cxa_finalize", "__gmon_start__",
           "_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable", "sqrt", "floor"}
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def sources(repo_root: Path) -> list[Path]:
    """The hand-written firmware, without what runs on the bare target only."""
    found = [path for path in sorted((repo_root / "firmware").rglob("*"))
             if path.suffix in {".c", ".cpp", ".h", ".hpp"} and "generated" not in path.parts and
             "target" not in path.parts]
    assert len(found) > 20
    return found


def code(path: Path) -> str:
    """The text with comments and strings blanked, line numbers kept."""
    return COMMENT_OR_STRING.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), path.read_text())


def hits(repo_root: Path, pattern: str, but_for: tuple[str, ...] = ()) -> list[str]:
    """Every place where a pattern occurs in the code."""
    expression = re.compile(pattern)
    places = []
    for path in sources(repo_root):
        if path.name in but_for:
            continue
        for number, line in enumerate(code(path).splitlines(), start=1):
            if expression.search(line):
                places.append(f"{path.relative_to(repo_root)}:{number}: {line.strip()}")
    return places


def test_transcendental_functions_come_through_one_door(repo_root: Path) -> None:
    names = "|".join(TRANSCENDENTAL)
    assert not hits(repo_root, rf"(?<![\w.>])(?:std::)?(?:{names})f?\s*\(", but_for=("scalar_math.h", "scalar_math.c"))
    assert not hits(repo_root, r"\.(?:norm|normalized|normalize|stableNorm)\(", but_for=("scalar_math.h",))


def test_no_heap_no_exceptions_no_io(repo_root: Path) -> None:
    assert not hits(repo_root, r"\b(?:new|delete|malloc|calloc|realloc|free)\b\s*[\(\w\[]")
    assert not hits(repo_root, r"\b(?:throw|try|catch|dynamic_cast|typeid)\b")
    assert not hits(repo_root, r"\b(?:printf|fprintf|puts|fopen|std::cout|iostream|std::vector|std::string|std::map)\b")


def test_no_unbounded_loops(repo_root: Path) -> None:
    assert not hits(repo_root, r"\bwhile\s*\(\s*(?:1|true)\s*\)|\bfor\s*\(\s*;\s*;|\bgoto\b")


def test_no_mutable_statics(repo_root: Path) -> None:
    assert not hits(repo_root, r"\bstatic\s+(?!inline|const|constexpr|_Static_assert)[\w:<>]+\s+[\w\[\]]+\s*(?:=|;|\{)")


@pytest.fixture(scope="module")
def controller_library(build_dir: Path) -> Path:
    library = build_dir / "firmware" / "libhoap2_controller.so"
    assert library.exists(), f"{library} is missing: build first (./hoap2 test does)"
    return library


def test_the_library_needs_nothing_but_mathematics(controller_library: Path) -> None:
    listed = subprocess.run(["nm", "-D", "--undefined-only", str(controller_library)], capture_output=True, text=True,
                            check=True).stdout
    needed = {line.split()[-1].split("@")[0] for line in listed.splitlines() if line.strip()}
    assert needed <= OUTSIDE, f"unexpected: {sorted(needed - OUTSIDE)}"


def test_the_library_holds_no_writable_data(controller_library: Path) -> None:
    listed = subprocess.run(["nm", "--defined-only", "--format=sysv", str(controller_library)], capture_output=True,
                            text=True, check=True).stdout
    rows = [[cell.strip() for cell in line.split("|")] for line in listed.splitlines() if line.count("|") == 6]
    assert any(section == ".text" for *_, section in rows)
    start_up_code = re.compile(r"__dso_handle|__TMC_END__|completed\.\d+|__bss_start|_edata|_end")
    writable = [(row[0], row[-1]) for row in rows
                if row[-1] in {".data", ".bss", ".tdata", ".tbss"} and not start_up_code.fullmatch(row[0])]
    assert not writable


def test_the_can_nodes_need_nothing_but_memory_moves(build_dir: Path) -> None:
    archive = build_dir / "firmware" / "libhoap2_can_nodes.a"
    listed = subprocess.run(["nm", "--format=posix", str(archive)], capture_output=True, text=True, check=True).stdout
    symbols = [line.split()[:2] for line in listed.splitlines() if len(line.split()) >= 2]
    defined = {name for name, kind in symbols if kind not in "Uw"}
    assert "hoap2_can_decode" in defined and "hoap2_can_board_tick" in defined
    outside = {name for name, kind in symbols if kind == "U"} - defined
    assert outside <= {"memcpy", "memset", "memmove", "memcmp", "_GLOBAL_OFFSET_TABLE_", "__stack_chk_fail"}
    assert not {name for name, kind in symbols if kind in "dDbBC"}, "writable data"
