"""The run folders that the page can replay."""

from __future__ import annotations

import json
import os
from pathlib import Path

from hoap2.errors import UserError

NEEDED = ("signals.parquet", "run.toml")
MAX_RUNS = 500


class RunList:
    """The complete run folders `<root>/<group>/<name>`, the latest first; summaries are read once."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        self._known: dict[str, tuple[float, dict]] = {}

    def entries(self) -> list[dict]:
        """id, scenario, verdict and time of each run."""
        found = []
        for folder in self._folders():
            key = folder.relative_to(self.root).as_posix()
            try:
                changed = (folder / "signals.parquet").stat().st_mtime
            except OSError:
                continue
            if key not in self._known or self._known[key][0] != changed:
                self._known[key] = (changed, _entry(key, folder, changed))
            found.append(self._known[key][1])
        found.sort(key=lambda entry: -entry["made_s"])
        return found[:MAX_RUNS]

    def folder(self, key: str) -> Path:
        """The folder of an id of `entries`; an error for anything else."""
        for folder in self._folders():
            if folder.relative_to(self.root).as_posix() == key:
                return folder
        raise UserError(f"there is no run {key} in {self.root}", "make one: ./hoap2 run floor-walk")

    def _folders(self) -> list[Path]:
        found = []
        try:
            groups = [entry for entry in os.scandir(self.root) if entry.is_dir() and not entry.name.startswith(".")]
        except OSError:
            return []
        for group in groups:
            try:
                runs = [Path(e.path) for e in os.scandir(group) if e.is_dir() and not e.name.startswith(".")]
            except OSError:
                continue
            found += [run for run in runs if all((run / name).is_file() for name in NEEDED)]
        return found


def _entry(key: str, folder: Path, made_s: float) -> dict:
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if not isinstance(summary, dict):
            summary = {}
    except (OSError, ValueError):
        summary = {}
    return {
        "id": key, "scenario": summary.get("scenario") or folder.parent.name, "name": folder.name,
        "title": summary.get("title") or "", "seed": summary.get("seed") or 0, "ok": summary.get("ok"),
        "fell": bool(summary.get("fell")), "interrupted": bool(summary.get("interrupted")),
        "duration_s": summary.get("duration_s"), "steps_taken": summary.get("steps_taken"), "made_s": made_s,
    }  # fmt: skip
