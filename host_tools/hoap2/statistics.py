"""Fractions over seeds with their intervals."""

from __future__ import annotations

import math

NORMAL_975 = 1.959963984540054  # the normal distribution's 97.5 % point


def wilson_95(successes: int, trials: int) -> tuple[float, float]:
    """The Wilson score interval of a fraction, 95 %."""
    if trials <= 0:
        return 0.0, 1.0
    z2 = NORMAL_975**2
    share = successes / trials
    centre = (share + z2 / (2 * trials)) / (1 + z2 / trials)
    half = NORMAL_975 / (1 + z2 / trials) * math.sqrt(share * (1 - share) / trials + z2 / (4 * trials**2))
    low = 0.0 if successes == 0 else centre - half
    high = 1.0 if successes == trials else centre + half
    return low, high
