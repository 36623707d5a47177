"""An FMU file, unpacked and read: what it says about itself, with clear errors."""

from __future__ import annotations

import difflib
import math
import shutil
import tempfile
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import fmpy
from fmpy.model_description import ModelDescription, ModelVariable

from ..generate.tables import PRODUCTS, Table, load

REAL_TYPES = ("Real", "Float64")
INT_TYPES = ("Integer", "Int32")


class FmuError(Exception):
    """Something about an FMU is wrong; the text says what and what to do."""


class FmuFileError(FmuError):
    """The file is missing, damaged, or of a kind that cannot be run here."""


class FmuVariableError(FmuError):
    """A variable is missing, unknown, or has another type or size."""


class FmuCallError(FmuError):
    """The FMU refused a call; the text carries the reason that it logged."""


@dataclass(frozen=True)
class Row:
    """A row of signals.toml as this FMU offers it: its references in one FMI version."""

    name: str
    kind: str  # "real" or "int"
    group: str  # "input", "output", "parameter"
    shape: tuple[int, ...]
    references: tuple[int, ...]  # one (FMI 3) or one an element (FMI 2)
    element_names: tuple[str, ...]

    @property
    def count(self) -> int:
        return math.prod(self.shape)


def nearest(name: str, known: Iterable[str]) -> str:
    """` (did you mean x?)`, or nothing."""
    close = difflib.get_close_matches(name, list(known), n=1)
    return f" (did you mean {close[0]}?)" if close else ""


class FmuArchive:
    """An unpacked FMU. Several instances can share one; close() removes the files."""

    def __init__(self, path: str | Path, product: str | None = None):
        """product: "controller" or "plant"; found by the variables when not given."""
        self.path = Path(path)
        self.folder = Path(tempfile.mkdtemp(prefix="hoap2_fmu_"))
        try:
            self._unpack()
            self.description: ModelDescription = self._read_description()
            self.version = 2 if self.description.fmiVersion == "2.0" else 3
            self._check_binary()
            table = load()
            self.product = product or self._find_product(table)
            self.rows = self._rows(table)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Remove the unpacked files. Instances that run keep their library in memory."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self) -> FmuArchive:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _unpack(self) -> None:
        """Unpack the description and the binaries (not the sources: nobody runs them)."""
        if not self.path.exists():
            raise FmuFileError(f"{self.path}: there is no such file; ./hoap2 fmu build makes the project's FMUs")
        if self.path.is_dir():
            raise FmuFileError(f"{self.path} is a folder, not an FMU")
        try:
            with zipfile.ZipFile(self.path) as archive:
                for member in archive.infolist():
                    name = member.filename
                    if name == "modelDescription.xml" or name.startswith(("binaries/", "resources/")):
                        archive.extract(member, self.folder)
        except (zipfile.BadZipFile, OSError, EOFError, NotImplementedError, RuntimeError, ValueError) as e:
            raise FmuFileError(
                f"{self.path} cannot be read as an FMU: {e}. Get or build it anew (./hoap2 fmu build)"
            ) from e
        except Exception as e:  # zlib.error has no common base with the others
            raise FmuFileError(f"{self.path} is damaged: {e}") from e
        if not (self.folder / "modelDescription.xml").exists():
            raise FmuFileError(f"{self.path} is no FMU: there is no modelDescription.xml in it")

    def _read_description(self) -> ModelDescription:
        path = self.folder / "modelDescription.xml"
        try:
            version = ElementTree.parse(path).getroot().get("fmiVersion", "an unknown version")
        except ElementTree.ParseError as e:
            raise FmuFileError(f"{self.path}: its modelDescription.xml is no XML: {e}") from e
        if not (version == "2.0" or version.startswith("3.")):
            raise FmuFileError(f"{self.path} is made for FMI {version}; FMI 2.0 and 3.0 can be run")
        try:
            description = fmpy.read_model_description(str(self.folder), validate=False)
        except Exception as e:
            raise FmuFileError(f"{self.path}: its modelDescription.xml cannot be read: {e}") from e
        if description.coSimulation is None:
            raise FmuFileError(f"{self.path} is not a Co-Simulation FMU")
        return description

    def _check_binary(self) -> None:
        folder = fmpy.platform if self.version == 2 else fmpy.platform_tuple
        binary = (
            self.folder
            / "binaries"
            / folder
            / (self.description.coSimulation.modelIdentifier + fmpy.sharedLibraryExtension)
        )
        if not binary.exists():
            found = sorted(p.name for p in (self.folder / "binaries").glob("*")) or ["none"]
            raise FmuFileError(f"{self.path} has no binary for {folder} (it has: {', '.join(found)})")
        self.binary = binary

    def _names(self) -> set[str]:
        return {v.name for v in self.description.modelVariables}

    def _expected_names(self, table: Table, product: str, group: str) -> set[str]:
        rows = [s for s in table.select(product, group) if not s.operator]
        return {n for s in rows for n in (table.element_names(s) if self.version == 2 else [s.name])}

    def _find_product(self, table: Table) -> str:
        """The product whose inputs and outputs this FMU has."""
        names = self._names()
        missing = {
            p: (self._expected_names(table, p, "input") | self._expected_names(table, p, "output")) - names
            for p in PRODUCTS
        }
        for product in PRODUCTS:
            if not missing[product]:
                return product
        best = min(PRODUCTS, key=lambda p: len(missing[p]))
        some = ", ".join(sorted(missing[best])[:4])
        raise FmuVariableError(
            f"{self.path} is neither a controller nor a plant of this project: for a {best} it lacks "
            f"{len(missing[best])} variables ({some}, ...); docs/generated/signals.md lists them all"
        )

    def _rows(self, table: Table) -> dict[str, Row]:
        """Inputs and outputs must all be there; parameters and the operator's inputs as far as the FMU has them."""
        variables = {v.name: v for v in self.description.modelVariables}
        rows: dict[str, Row] = {}
        for group in ("input", "output", "parameter"):
            for s in table.select(self.product, group):
                elements = tuple(table.element_names(s))
                names = elements if self.version == 2 else (s.name,)
                missing = [n for n in names if n not in variables]
                if missing and (group == "parameter" or s.operator):
                    continue
                if missing:
                    raise FmuVariableError(
                        f"{self.path} has no {group} {missing[0]}{nearest(missing[0], variables)}, "
                        f"which a {self.product} needs"
                    )
                self._check_variables([variables[n] for n in names], s.kind, group, s.count)
                references = tuple(variables[n].valueReference for n in names)
                rows[s.name] = Row(s.name, s.kind, group, s.shape, references, elements)
        return rows

    def _check_variables(self, variables: list[ModelVariable], kind: str, group: str, count: int) -> None:
        allowed = REAL_TYPES if kind == "real" else INT_TYPES
        elements = 0
        for v in variables:
            if v.type not in allowed:
                raise FmuVariableError(f"{self.path}: {v.name} is of type {v.type}, not {' or '.join(allowed)}")
            if v.causality != group:
                raise FmuVariableError(f"{self.path}: {v.name} has causality {v.causality}, not {group}")
            elements += math.prod(int(d.start) for d in v.dimensions) if self.version == 3 else 1
        if elements != count:
            raise FmuVariableError(f"{self.path}: {variables[0].name} has {elements} elements, not {count}")

    def select(self, group: str, kind: str) -> list[Row]:
        """Rows of one group and kind, in the order of signals.toml."""
        return [r for r in self.rows.values() if r.group == group and r.kind == kind]
