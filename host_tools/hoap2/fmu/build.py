"""Build the FMUs with CMake and say where they are."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from ..errors import UserError
from ..generate import ls_bus
from ..generate.tables import PRODUCTS
from ..paths import ROOT, build_dir

VERSIONS = (2, 3)


@dataclass(frozen=True)
class FmuSet:
    """The FMUs and the SSP of one build."""

    folder: Path

    def fmu(self, product: str, version: int) -> Path:
        return self.folder / f"hoap2_{product}_fmi{version}.fmu"

    def ls_bus(self, flavour: str) -> Path:
        return self.folder / f"{ls_bus.identifier(flavour)}.fmu"

    @property
    def ssp(self) -> Path:
        return self.folder / "hoap2.ssp"

    def files(self) -> list[Path]:
        of_signals = [self.fmu(product, version) for product in PRODUCTS for version in VERSIONS]
        return [*of_signals, *(self.ls_bus(flavour) for flavour in ls_bus.FLAVOURS), self.ssp]

    def require(self) -> None:
        """UserError when a file is missing."""
        for path in self.files():
            if not path.exists():
                raise UserError(f"{path} is missing", "build it: ./hoap2 fmu build", exit_code=3)


def built() -> FmuSet:
    """The FMUs of the build in use (HOAP2_BUILD_DIR, or build/release)."""
    return FmuSet(build_dir() / "fmu")


def _cmake() -> str:
    """Debian's cmake, not the one that a Python package brings."""
    found = "/usr/bin/cmake" if Path("/usr/bin/cmake").exists() else shutil.which("cmake")
    if not found:
        raise UserError("cmake is not installed", "apt-get install cmake", exit_code=3)
    return found


def build() -> FmuSet:
    """Configure if needed, build what is out of date, return the files."""
    folder = build_dir()
    if not (folder / "CMakeCache.txt").exists():
        preset = ["--preset", "release", "-B", str(folder), f"-DPython3_EXECUTABLE={sys.executable}"]
        _run([_cmake(), *preset], "configuring failed")
    targets = [f"hoap2_{product}_fmi{version}_fmu" for product in PRODUCTS for version in VERSIONS]
    targets += [f"{ls_bus.identifier(flavour)}_fmu" for flavour in ls_bus.FLAVOURS] + ["hoap2_ssp"]
    _run([_cmake(), "--build", str(folder), "--target", *targets], "the build failed")
    files = built()
    files.require()
    return files


def _run(command: list[str], what: str) -> None:
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        last = "\n".join((done.stdout + done.stderr).strip().splitlines()[-25:])
        raise UserError(f"{what}:\n{last}", f"the command was: {' '.join(command)}", exit_code=3)
