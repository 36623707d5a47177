"""Seeds: what a seed draws, and ranges of seeds as `1-20` or `1,3,5-7`."""

from __future__ import annotations

import math
import random

from hoap2 import parameters
from hoap2.errors import UserError
from hoap2.scenario import Scenario

GYRO_BIAS_RAD_S = math.radians(0.5)
CELL_GAIN = 0.05
FLOOR_TILT_RAD = math.radians(0.5)
FRICTION_RANGE = (0.5, 1.0)
CHEST_COM_M = 0.003
SOIL_ROUGHNESS_M = 0.0005  # rms
TAKEN = ("seed", "friction_mu", "soil_seed", "soil_roughness_m")  # unless the scenario sets them
MOST_SEEDS = 10000


def draw(seed: int, soil: bool = False) -> dict[str, tuple[float, ...]]:
    """The plant's disturbances of one seed, always drawn in this order; those of the soil only where there is some."""
    rng = random.Random(seed)

    def spread(half_width: float, count: int, centre: float = 0.0) -> tuple[float, ...]:
        return tuple(centre + rng.uniform(-half_width, half_width) for _ in range(count))

    drawn = {
        # Only random() is promised to stay the same in every Python.
        "seed": (float(1 + int(rng.random() * (2**31 - 2))),),
        "gyro_bias_S_rad_s": spread(GYRO_BIAS_RAD_S, 3),
        "cell_gain": spread(CELL_GAIN, parameters.known("plant")["cell_gain"].count, 1.0),
        "floor_tilt_rad": spread(FLOOR_TILT_RAD, 2),
        "friction_mu": (rng.uniform(*FRICTION_RANGE),),
        "chest_com_shift_L_m": spread(CHEST_COM_M, 3),
    }
    if soil:
        drawn["soil_seed"] = (float(1 + int(rng.random() * (2**31 - 2))),)
        drawn["soil_roughness_m"] = (SOIL_ROUGHNESS_M,)
    return drawn


def apply(scenario: Scenario, seed: int) -> None:
    """Put a seed's draws into the scenario; 0 is the nominal run.

    Biases, tilts and shifts are added to the scenario's own value and gains multiply it;
    friction, the roughness of soil and the seeds of noise and roughness are taken unless the
    scenario sets them. What the command line sets (Scenario.forced) stays as it is.
    """
    if seed == 0:
        return
    if scenario.seed:
        raise UserError(f"{scenario.name}: this file already holds the draws of seed {scenario.seed}",
                        "leave --seed away")  # fmt: skip
    plant = scenario.values["plant"]
    scenario.seed = seed
    soil = plant["ground"][0] == parameters.table().enums["ground"].index("soil")
    for name, drawn in draw(seed, soil).items():
        if f"plant.{name}" in scenario.forced:
            continue
        if name in TAKEN:
            if f"plant.{name}" in scenario.explicit:
                continue
            value = drawn
        elif name == "cell_gain":
            value = tuple(a * b for a, b in zip(plant[name], drawn))
        else:
            value = tuple(a + b for a, b in zip(plant[name], drawn))
        signal = parameters.known("plant")[name]
        plant[name] = tuple(min(max(v, signal.low), signal.high) for v in value)
        scenario.draws[name] = parameters.plain(signal, drawn)


def parse_range(text: str) -> list[int]:
    """`1-20`, `1,3,5-7` as a list of seeds in the order given, each once."""
    seeds: list[int] = []
    for part in text.split(","):
        low, dash, high = part.strip().partition("-")
        if not low.isdigit() or (dash and not high.isdigit()):
            raise UserError(f"--seeds {text!r}: write it as 1-20 or 1,3,5-7")
        first, last = int(low), int(high) if dash else int(low)
        if last < first:
            raise UserError(f"--seeds {text!r}: {part.strip()} runs backwards")
        if last - first >= MOST_SEEDS:
            raise UserError(f"--seeds {text!r}: at most {MOST_SEEDS} seeds")
        seeds += [seed for seed in range(first, last + 1) if seed not in seeds]
    return seeds
