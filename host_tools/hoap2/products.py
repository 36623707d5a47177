"""The two products of a run: which FMUs, opened with a scenario's parameters."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from hoap2 import parameters, paths
from hoap2.errors import UserError
from hoap2.generate.tables import PRODUCTS
from hoap2.runner import Products
from hoap2.scenario import Scenario


@dataclass(frozen=True)
class Choice:
    """FMUs named by the user, or None for the built ones of an FMI version."""

    controller: Path | None = None
    plant: Path | None = None
    fmi: int = 3

    def path(self, product: str) -> Path:
        named = getattr(self, product)
        if named is None:
            return paths.fmu(product, self.fmi)
        if not named.is_file():
            raise UserError(f"no FMU file {named}", f"--{product} takes the path of an .fmu file")
        return named
