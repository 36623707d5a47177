"""Judge the FMUs: files, behaviour, and what other importers make of them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from .build import FmuSet
from .instance import FmuError
from .pair import Pair, Trace

CLOSED_LOOP_TICKS = 4000  # start-up, calibration, and the first steps of the walk
RESTORE_TICK = 3000


@dataclass
class Result:
    """One check of one thing."""

    check: str
    subject: str
    ok: bool
    detail: str
    seconds: float

    def as_dict(self) -> dict:
        return asdict(self)


class CheckFailed(Exception):
    """A check does not hold; the text says what was found."""


def require(condition: bool, text: str) -> None:
    """CheckFailed unless the condition holds."""
    if not condition:
        raise CheckFailed(text)


def require_equal(a: Trace, b: Trace, what: str) -> None:
    """CheckFailed unless two traces have equal output bytes; says where they part."""
    point = a.first_difference(b)
    require(point is None, f"{what}: outputs differ from communication point {point} on")


@dataclass
class Context:
    """What checks share: the files, and one recorded closed loop a FMI version."""

    files: FmuSet
    scratch: Path
    ticks: int = CLOSED_LOOP_TICKS

    def __post_init__(self) -> None:
        self._loops: dict[int, dict[str, Trace]] = {}

    def open_pair(self, version: int) -> Pair:
        return Pair.open(self.files.fmu("controller", version), self.files.fmu("plant", version))

    def loop(self, version: int) -> dict[str, Trace]:
        """The closed loop from the start with default parameters, recorded once."""
        if version not in self._loops:
            with self.open_pair(version) as pair:
                self._loops[version] = pair.run(self.ticks)
        return self._loops[version]


@dataclass(frozen=True)
class Check:
    """name, subject (file or pair), and the function that returns a line of detail or raises."""

    name: str
    subject: str
    run: Callable[[Context], str]


def all_checks(quick: bool) -> list[Check]:
    """Every check in the order in which they run; quick leaves out the compilation of the sources."""
    from . import check_files, check_importers, check_ls_bus, check_runs

    return [*check_files.checks(quick), *check_runs.checks(), *check_importers.checks(), *check_ls_bus.checks()]


def run_checks(
    context: Context, quick: bool = False, announce: Callable[[Check], None] | None = None
) -> Iterator[Result]:
    """Run all checks one by one; a check that breaks counts as failed, the others go on."""
    context.files.require()
    for check in all_checks(quick):
        if announce:
            announce(check)
        began = time.perf_counter()
        try:
            detail, ok = check.run(context), True
        except (CheckFailed, FmuError) as e:
            detail, ok = str(e), False
        except Exception as e:  # a broken FMU may make anything throw: report it, judge the rest
            detail, ok = f"{type(e).__name__}: {e}", False
        yield Result(check.name, check.subject, ok, detail, time.perf_counter() - began)
