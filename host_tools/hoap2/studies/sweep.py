"""Grids over one or two parameters: `plant.soil_n=0.9:1.3:5`, `controller.lpc_moves_cp=off,on`."""

from __future__ import annotations

import itertools
import re
from dataclasses import dataclass

from hoap2.errors import UserError

MOST_VALUES = 200


@dataclass(frozen=True)
class Axis:
    """One parameter and the texts of its values, as --set takes them."""

    name: str
    values: tuple[str, ...]


@dataclass(frozen=True)
class Sweep:
    """A grid: one or two axes, and what else each of its runs is set to."""

    name: str
    title: str
    axes: tuple[Axis, ...]
    sets: tuple[str, ...] = ()

    def cells(self) -> list[tuple[str, ...]]:
        """The values of the axes, the last axis fastest."""
        return list(itertools.product(*(axis.values for axis in self.axes)))

    def overrides(self, cell: tuple[str, ...]) -> list[str]:
        """What --set would say for a cell."""
        return [*self.sets, *(f"{axis.name}={value}" for axis, value in zip(self.axes, cell))]


def parse(text: str) -> Axis:
    """`a.b=low:high:count` or `a.b=v1,v2,...` (a list as a value in its brackets).

    Numbers after an x (`x0.8:x1.2:5`, `x0.5,x1,x2`) are factors of the scenario's own value: own_value.py.
    """
    name, equals, right = text.partition("=")
    name, right = name.strip(), right.strip()
    if not equals or "." not in name or not right:
        raise UserError(f"--vary {text!r}: write it as table.name=low:high:count or table.name=v1,v2,...",
                        "for example plant.soil_n=0.9:1.3:5 or scenario.sensors=ideal,hoap2")  # fmt: skip
    if ":" in right:
        return Axis(name, _grid(text, right))
    values = tuple(value.strip() for value in re.split(r",(?![^\[]*\])", right))
    if not all(values) or len(set(values)) != len(values):
        raise UserError(f"--vary {text!r}: a value is missing or given twice")
    return Axis(name, values)


def _grid(text: str, right: str) -> tuple[str, ...]:
    factor = "x" if right.startswith("x") else ""
    parts = right.split(":")
    try:
        low, high, count = float(parts[0].removeprefix("x")), float(parts[1].removeprefix(factor)), int(parts[2])
        if len(parts) != 3:
            raise ValueError
    except (ValueError, IndexError):
        raise UserError(f"--vary {text!r}: a grid is low:high:count, for example 4.8e6:7.2e6:5") from None
    if not 2 <= count <= MOST_VALUES or low == high:
        raise UserError(f"--vary {text!r}: 2 to {MOST_VALUES} different values")
    return tuple(f"{factor}{low + (high - low) * i / (count - 1):.10g}" for i in range(count))


def given(texts: list[str]) -> Sweep:
    """The sweep of the command line's --vary options."""
    axes = tuple(parse(text) for text in texts)
    if len(axes) > 2:
        raise UserError(f"--vary is given {len(axes)} times", "a map has one or two parameters")
    if len({axis.name for axis in axes}) != len(axes):
        raise UserError(f"--vary {axes[0].name} is given twice")
    return Sweep("vary", " and ".join(axis.name for axis in axes), axes)


def _one(name: str, title: str, parameter: str, values: str, *sets: str) -> Sweep:
    return Sweep(name, title, (parse(f"{parameter}={values}"),), sets)


# A long pool, so that walks longer than the chapter's and backward ones stay on it.
LONG_POOL = ("plant.soil_size_m=[2.0, 0.56, 0.15]", "plant.soil_centre_m=[0.0, 0.0]")

PREDEFINED = (
    _one("soil-k", "Soil: k_φ", "plant.soil_kphi_N_m_n2", "x0.8:x1.2:5"),
    _one("soil-n", "Soil: exponent n", "plant.soil_n", "x0.96:x1.04:5"),
    _one("soil-shear", "Soil: shear length K", "plant.soil_shear_m", "x0.5,x0.75,x1,x1.5,x2.5"),
    _one("soil-phi", "Soil: friction angle φ", "plant.soil_friction_rad", "x0.8:x1.2:5"),
    _one("tpcc-gain", "TPCC gain K_p", "controller.tpcc_kp_1_s2", "x0,x0.5,x1,x1.5,x2"),
    _one("cp-rule", "Control of the capture point", "controller.cp_controller", "plan,cps,cpt"),
    _one("lpc-moves-cp", "CP moves with the landing", "controller.lpc_moves_cp", "off,on"),
    _one("cp-offset-x", "Sagittal offset of the CP", "controller.cp_offset_x_m",
         "0.0065,0.0083,0.0088,0.0093,0.0098,0.0103,0.0113"),
    _one("step-length", "Step length L_x", "controller.step_length_m", "-0.015,-0.0075,0.005,0.01,0.015,0.02,0.025",
         *LONG_POOL),
    _one("step-time", "Step time T", "controller.step_time_s", "0.35,0.375,0.4,0.45,0.5"),
    _one("lpc-gain", "Landing control: K_L", "controller.lpc_gain", "x0.5,x1,x1.5,x2,x3"),
    _one("lpc-forget", "Landing control: λ", "controller.lpc_forget", "0,0.3,0.5,0.7,0.9"),
    _one("sensors", "Sensors", "scenario.sensors", "ideal,hoap2"),
    _one("soil-law", "Law of the soil", "plant.soil_law", "bekker,rft"),
    _one("rft-zeta", "Resistive forces: ζ", "plant.soil_rft_zeta", "1.4,3,4,5,6,7,8,10", "plant.soil_law=rft"),
    _one("softness", "Soil: k_φ, softer", "plant.soil_kphi_N_m_n2",
         "x0.6,x0.7,x0.8,x0.85,x0.9,x1"),
    Sweep("offset-k", "Sagittal offset of the CP, and k_φ",
          (parse("controller.cp_offset_x_m=0.0073,0.0083,0.0093,0.0103,0.0113"), parse("plant.soil_kphi_N_m_n2=x0.8:x1.2:5"))),
)  # fmt: skip
