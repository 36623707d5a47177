"""`test`: every ring of tests, from C units to full simulations."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

CONTEXT_SETTINGS = {"allow_extra_args": True, "ignore_unknown_options": True}


def command(
    context: typer.Context,
    quick: Annotated[bool, typer.Option("--quick", help="Leave out slow tests and the sanitizers (< 5 min).")] = False,
    keyword: Annotated[str, typer.Option("-k", metavar="EXPR", help="Only Python tests that match.")] = "",
    paths: Annotated[list[str] | None, typer.Argument(help="Test files, or any options of pytest.")] = None,
) -> int:
    """Build and run the tests: C and C++ (ctest), the same under sanitizers, Python (pytest).

    `test socketcan` runs the tests on Linux CAN sockets in an emulated machine; the full test does so too.
    With -k, files or pytest's own options, only the Python tests run.
    Exit code: 0 all passed, 1 a test failed or none was found.
    """
    from hoap2.testing import run_all, run_pytest

    if (paths or [""])[0] == "socketcan":
        from hoap2.can.machine import run_tests
        from hoap2.paths import ROOT

        options = [*(["-k", keyword] if keyword else []), *context.args]
        return run_tests(paths[1:], ROOT / "build" / "socketcan.xml", options)
    chosen = [*(["-k", keyword] if keyword else []), *(paths or []), *context.args]
    chosen = [word if word.startswith("-") or not Path(word).exists() else str(Path(word).resolve()) for word in chosen]
    if chosen:
        return 0 if run_pytest(quick, chosen).ok else 1
    return run_all(quick)
