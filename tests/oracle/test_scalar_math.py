"""The firmware's own mathematical functions against mpmath: within 1 ulp over their whole range."""

from __future__ import annotations

import ctypes
import math
import random
from collections.abc import Callable
from pathlib import Path

import mpmath
import pytest

SAMPLES = 4000
BITS = 1300  # enough to reduce an angle of 2^1023 rad

Sample = Callable[[random.Random], tuple[float, ...]]


@pytest.fixture(scope="module")
def library(build_dir: Path) -> ctypes.CDLL:
    return ctypes.CDLL(str(build_dir / "firmware" / "libhoap2_controller.so"))


def number(dice: random.Random, low: int, high: int) -> float:
    """A number whose binary exponent is even between both."""
    return math.ldexp(dice.uniform(1.0, 2.0), dice.randint(low, high)) * dice.choice((-1.0, 1.0))


def near_quarter_turn(dice: random.Random) -> tuple[float]:
    """As near to a multiple of pi/2 as a double gets: there the digits of pi decide."""
    return (dice.randrange(1, 10**dice.randint(1, 15)) * math.pi / 2,)


ANGLES: dict[str, Sample] = {
    "joints": lambda dice: (dice.uniform(-7.0, 7.0),),
    "small to large": lambda dice: (number(dice, -60, 21),),
    "up to the largest": lambda dice: (number(dice, 20, 1023),),
    "quarter turns": near_quarter_turn,
}
CASES: dict[str, tuple[Callable, dict[str, Sample]]] = {
    "hoap2_sin": (mpmath.sin, ANGLES),
    "hoap2_cos": (mpmath.cos, ANGLES),
    "hoap2_exp": (mpmath.exp, {
        "walk": lambda dice: (dice.uniform(-1.0, 6.0),),
        "all": lambda dice: (dice.uniform(-745.0, 709.7),),
        "small": lambda dice: (number(dice, -70, -1),),
    }),
    "hoap2_atan2": (mpmath.atan2, {
        "plane": lambda dice: (dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0)),
        "any": lambda dice: (number(dice, -1070, 1023), number(dice, -1070, 1023)),
        "near the axes": lambda dice: (number(dice, -70, -40), number(dice, -3, 3))[:: dice.choice((-1, 1))],
        "between the table's entries": lambda dice: ((2 * dice.randrange(8) + 1) / 16 * (1 + number(dice, -50, -3)), 1.0),
    }),
    "hoap2_hypot": (mpmath.hypot, {
        "plane": lambda dice: (dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0)),
        "alike": lambda dice: (number(dice, -40, 40), number(dice, -40, 40)),
        "any": lambda dice: (number(dice, -1074, 1022), number(dice, -1074, 1022)),
    }),
}  # fmt: skip


def error_in_ulp(got: float, true: mpmath.mpf) -> float:
    """Distance in units of the last place of the true value (subnormal ones: of the least number)."""
    exponent = int(mpmath.frexp(true)[1])
    return float(abs(mpmath.mpf(got) - true) / mpmath.ldexp(1, max(exponent - 53, -1074)))


@pytest.mark.parametrize(("name", "part"), [(name, part) for name, (_, parts) in CASES.items() for part in parts])
def test_within_one_ulp(library: ctypes.CDLL, name: str, part: str) -> None:
    true, parts = CASES[name]
    function = getattr(library, name)
    dice = random.Random(f"{name} {part}")
    function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * len(parts[part](dice))
    worst, where = 0.0, ()
    with mpmath.workprec(BITS if part == "up to the largest" else 250):
        for _ in range(SAMPLES):
            arguments = parts[part](dice)
            error = error_in_ulp(function(*arguments), true(*(mpmath.mpf(a) for a in arguments)))
            if not error <= worst:
                worst, where = error, arguments
    assert worst <= 0.85, f"{worst} ulp at {where}"
    assert worst > 0.2, "no rounding at all: not what was to be tested"
