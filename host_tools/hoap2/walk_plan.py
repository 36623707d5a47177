"""The planned footprints of section 7.2.2 a, worked out from the parameters alone.

Kept apart from the firmware on purpose: a run is judged against what its parameters
ask for, not against what the controller says it planned.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Footprint:
    """Sole point under the ankle in the start frame. foot: 0 right, 1 left."""

    foot: int
    x_m: float
    y_m: float
    yaw_rad: float


def _beside(centre: tuple[float, float, float], foot: int, width_m: float) -> Footprint:
    x, y, yaw = centre
    left_m = (0.5 if foot == 1 else -0.5) * width_m
    return Footprint(foot, x - math.sin(yaw) * left_m, y + math.cos(yaw) * left_m, yaw)


def footprints(values: dict[str, tuple[float, ...]], steps: int) -> list[Footprint]:
    """Both start footprints, then one a step: L_x a step; sideways and turning double on the leading foot."""
    width = values["step_width_m"][0]
    length, sideways, turn = (values[n][0] for n in ("step_length_m", "step_sideways_m", "step_turn_rad"))
    prints = [_beside((0.0, 0.0, 0.0), foot, width) for foot in (0, 1)]
    x = y = yaw = 0.0
    for number in range(steps):
        foot = (int(values["first_swing_foot"][0]) + number) % 2
        if number < int(values["steps_forward"][0]):
            lead = 1.0 if foot == 1 else -1.0
            left = 2.0 * sideways if sideways * lead > 0.0 else 0.0
            heading = 2.0 * turn if turn * lead > 0.0 else 0.0
            middle = yaw + 0.5 * heading
            x += math.cos(middle) * length - math.sin(middle) * left
            y += math.sin(middle) * length + math.cos(middle) * left
            yaw += heading
        prints.append(_beside((x, y, yaw), foot, width))
    return prints


def end(values: dict[str, tuple[float, ...]], steps: int) -> tuple[float, float, float]:
    """Midpoint (m) and heading (rad) of the last footprint of each foot, in the start frame."""
    prints = footprints(values, steps)
    right = [p for p in prints if p.foot == 0][-1]
    left = [p for p in prints if p.foot == 1][-1]
    return 0.5 * (right.x_m + left.x_m), 0.5 * (right.y_m + left.y_m), 0.5 * (right.yaw_rad + left.yaw_rad)
