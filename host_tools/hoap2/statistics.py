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


def student_975(freedom: int) -> float:
    """The 97.5 % point of Student's t distribution."""
    if freedom < 1:
        return math.inf
    low, high = 0.0, 1e4
    while high - low > 1e-10 * (1.0 + low):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _student_cdf(middle, freedom) < 0.975 else (low, middle)
    return 0.5 * (low + high)


def _student_cdf(t: float, freedom: int) -> float:
    """By the finite sums for whole degrees of freedom, in theta = atan(t / sqrt(freedom)); t >= 0."""
    theta = math.atan2(t, math.sqrt(freedom))
    sine, cosine = math.sin(theta), math.cos(theta)
    odd = freedom % 2
    term = cosine if odd else 1.0
    total = term if freedom > 1 else 0.0
    for k in range(3 if odd else 2, freedom - 1, 2):
        term *= cosine * cosine * (k - 1) / k
        total += term
    return 0.5 + (theta + sine * total) / math.pi if odd else 0.5 + 0.5 * sine * total


def mean_95(values: list[float]) -> tuple[float, float, float] | None:
    """Mean and both ends of its 95 % interval (Student's t); None for fewer than two values."""
    count = len(values)
    if count < 2:
        return None
    mean = math.fsum(values) / count
    deviation = math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (count - 1))
    half = student_975(count - 1) * deviation / math.sqrt(count)
    return mean, mean - half, mean + half
