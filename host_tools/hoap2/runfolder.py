"""Run folders: filled beside their place, then renamed, so that a folder is there whole or not at all."""

from __future__ import annotations

import json
import math
import os
import shutil
import time
from pathlib import Path

from hoap2.errors import UserError


def jsonable(value: object) -> object:
    """The same value with numbers that JSON cannot carry (NaN, infinity) as null, NumPy types as plain ones."""
    if isinstance(value, dict):
        return {str(k): jsonable(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [jsonable(v) for v in value]
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def target(group: str, out: str | None, root: Path | None = None) -> Path:
    """`out/<group>/<time stamp or out>`; an `out` with a slash is a path of its own."""
    if out and ("/" in out or out in (".", "..")):
        return Path(out)
    folder = (root or Path.cwd()) / "out" / group
    if out:
        return folder / out
    stamp = time.strftime("%Y-%m-%d_%H-%M-%S")
    path, number = folder / stamp, 2
    while path.exists():
        path, number = folder / f"{stamp}-{number}", number + 1
    return path


class RunFolder:
    """A folder under construction. `work` is where files go until `finish` gives it its name."""

    def __init__(self, path: Path) -> None:
        self.path = path
        if os.path.lexists(path):
            raise UserError(f"{path} is there already; nothing was overwritten", "give another name with --out")
        self.work = path.parent / f".{path.name}.part-{os.getpid()}"
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self.work.mkdir()
            probe = self.work / "probe"
            probe.write_bytes(b"0")
            probe.unlink()
        except OSError as error:
            raise UserError(f"cannot write to {path.parent}: {error.strerror}",
                            "choose a folder that can be written with --out PATH/NAME") from None  # fmt: skip

    def text(self, name: str, content: str) -> None:
        (self.work / name).write_text(content, encoding="utf-8")

    def json(self, name: str, content: dict) -> None:
        self.text(name, json.dumps(jsonable(content), indent=2, ensure_ascii=False) + "\n")

    def finish(self) -> Path:
        """Give the folder its name. Somebody else's folder of that name is left alone."""
        for number in range(1, 1000):
            path = self.path if number == 1 else self.path.with_name(f"{self.path.name}-{number}")
            if os.path.lexists(path):
                continue
            try:
                self.work.rename(path)
            except OSError:
                continue
            self.path = path
            return path
        raise UserError(f"cannot rename {self.work} to {self.path}", f"the run's files are in {self.work}")

    def discard(self) -> None:
        """Leave no trace of a run that never started."""
        shutil.rmtree(self.work, ignore_errors=True)
