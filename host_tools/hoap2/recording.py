"""What a finished run holds for pictures: motion, marks, footprints, terrain."""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from hoap2 import parameters
from hoap2.errors import UserError
from hoap2.generate.tables import PRODUCTS
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog

RIGHT, LEFT = 0, 1
_NEEDED = ("true_base_pos_W_m", "true_base_quat_W", "true_q_rad", "true_com_W_m", "true_cop_W_m",
           "true_push_force_W_N", "true_foot_pos_W_m", "true_foot_yaw_W_rad")  # fmt: skip
_PLANT = ("true_sinkage_m",)  # not in the logs of earlier versions
_CONTROLLER = ("cp_est_W_m", "footprint_W_m_rad", "step_index", "stance_foot")


@dataclass
class Step:
    """One step: rows first..last of the log, the foot that lands."""

    number: int
    first: int
    last: int
    left: bool


@dataclass
class Recording:
    """Signals over time, (ticks, elements), and the resolved parameters of both products."""

    folder: Path
    t_s: np.ndarray
    signal: dict[str, np.ndarray]
    controller: dict = field(default_factory=dict)
    plant: dict = field(default_factory=dict)
    name: str = ""
    steps: list[Step] = field(default_factory=list)

    @property
    def on_soil(self) -> bool:
        """Whether the ground is a pool of soil."""
        return self.plant.get("ground") in ("soil", 1)

    @property
    def end_s(self) -> float:
        """Time of the last row."""
        return float(self.t_s[-1])

    def row(self, t_s: float) -> int:
        """The row nearest to a time; an error when the run does not cover it."""
        if not math.isfinite(t_s) or not self.t_s[0] - 1e-6 <= t_s <= self.end_s + 1e-6:
            raise UserError(f"t = {t_s:g} s is outside the run",
                            f"{self.folder} holds {self.t_s[0]:g} to {self.end_s:g} s")  # fmt: skip
        return int(np.argmin(np.abs(self.t_s - t_s)))

    def values(self, name: str, row: int) -> np.ndarray | None:
        """One signal at one row; None when the run does not have it."""
        data = self.signal.get(name)
        return None if data is None else data[row]

    def footprints(self, row: int) -> list[tuple[float, float, float, bool]]:
        """x, y, yaw, left of both start soles, of each step done, and of the target of the step under way."""
        feet, yaw = self.signal["true_foot_pos_W_m"][0], self.signal["true_foot_yaw_W_rad"][0]
        prints = [(feet[3 * f], feet[3 * f + 1], yaw[f], f == LEFT) for f in (RIGHT, LEFT)]
        for step in self.steps:
            if step.first > row:
                break
            x, y, heading = self.signal["footprint_W_m_rad"][min(row, step.last)]
            prints.append((x, y, heading, step.left))
        return prints

    def active_pushes(self, t_s: float) -> list[tuple[int, np.ndarray]]:
        """Link and point (link frame) of the pushes that act at a time, the strongest first."""
        found = []
        durations = np.ravel(self.plant.get("push_duration_s", []))
        for k, duration_s in enumerate(durations):
            start_s = float(np.ravel(self.plant["push_start_s"])[k])
            if duration_s > 0.0 and start_s <= t_s <= start_s + duration_s:
                force = np.reshape(self.plant["push_force_W_N"], (-1, 3))[k]
                point = np.reshape(self.plant["push_point_L_m"], (-1, 3))[k]
                found.append((float(np.linalg.norm(force)), int(np.ravel(self.plant["push_link"])[k]), point))
        return [(link, point) for _, link, point in sorted(found, key=lambda entry: -entry[0])]


def _steps(index: np.ndarray, stance: np.ndarray) -> list[Step]:
    """Stretches of equal step_index > 0. The landing foot is the one that is not the stance foot in them."""
    steps = []
    borders = np.flatnonzero(np.diff(index)) + 1
    for first, last in zip(np.r_[0, borders], np.r_[borders, len(index)] - 1):
        feet = stance[first : last + 1]
        single = feet[(feet == RIGHT) | (feet == LEFT)]
        if index[first] > 0 and single.size:
            steps.append(Step(int(index[first]), int(first), int(last), bool(np.mean(single == RIGHT) > 0.5)))
    return steps


def _columns(product: str, names: tuple[str, ...]) -> dict[str, list[str]]:
    table = parameters.table()
    prefix = {"controller": "c.", "plant": "p."}[product]
    rows = {s.name: s for s in table.select(product, "output")}
    return {name: [prefix + e for e in table.element_names(rows[name])] for name in names}


def _read_signals(path: Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    needed = _columns("plant", _NEEDED)
    optional = _columns("plant", _PLANT) | _columns("controller", _CONTROLLER)
    try:
        have = set(pyarrow.parquet.read_schema(path).names)
        missing = [c for columns in needed.values() for c in columns if c not in have]
        if "t_s" not in have or missing:
            raise UserError(f"{path} has no column {(missing or ['t_s'])[0]}", "was the run made by another version?")
        wanted = needed | {n: c for n, c in optional.items() if have.issuperset(c)}
        table = pyarrow.parquet.read_table(path, columns=["t_s"] + [c for group in wanted.values() for c in group])
    except (OSError, pyarrow.ArrowInvalid) as error:
        raise UserError(f"cannot read {path}: {error}") from None
    signal = {n: np.column_stack([table[c].to_numpy() for c in columns]) for n, columns in wanted.items()}
    return table["t_s"].to_numpy(), signal


def load(folder: str | Path) -> Recording:
    """Read a run folder (signals.parquet and run.toml)."""
    folder = Path(folder)
    log, settings = folder / "signals.parquet", folder / "run.toml"
    if not folder.is_dir():
        raise UserError(f"there is no run folder {folder}", "make one: ./hoap2 run floor-walk")
    for file in (log, settings):
        if not file.is_file():
            raise UserError(f"{folder} is no complete run folder: {file.name} is missing")
    try:
        document = tomllib.loads(settings.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UserError(f"cannot read {settings}: {error}") from None
    t_s, signal = _read_signals(log)
    return _finished(folder, t_s, signal, {p: document.get(p, {}) for p in PRODUCTS},
                     document.get("scenario", {}).get("name", folder.name))  # fmt: skip


def of_log(folder: Path, log: SignalLog, scenario: Scenario) -> Recording:
    """The recording of a run that is still in memory; `folder` is where it is going to be."""
    signal = {}
    for prefix, names in (("p.", _NEEDED), ("p.", _PLANT), ("c.", _CONTROLLER)):
        for name in names:
            block = log.block(prefix + name)
            if block is None and names is _NEEDED:
                raise UserError(f"the run has no signal {name}", "was it made by another version?")
            if block is not None:
                signal[name] = block
    values = {p: {n: parameters.plain(parameters.known(p)[n], v) for n, v in scenario.values[p].items()}
              for p in PRODUCTS}  # fmt: skip
    return _finished(folder, log.t_s, signal, values, scenario.name)


def _finished(folder: Path, t_s: np.ndarray, signal: dict[str, np.ndarray], values: dict[str, dict],
              name: str) -> Recording:  # fmt: skip
    # A diverged run ends in values that are not numbers: show it up to there.
    motion = [signal[n] for n in ("true_base_pos_W_m", "true_base_quat_W", "true_q_rad")]
    finite = np.all([np.isfinite(m).all(axis=1) for m in motion], axis=0)
    count = len(finite) if finite.all() else int(np.argmin(finite))
    if count == 0:
        raise UserError(f"{folder} holds no pose of the robot")
    run = Recording(folder, t_s[:count], {n: v[:count] for n, v in signal.items()}, values["controller"],
                    values["plant"], name)  # fmt: skip
    if set(_CONTROLLER) <= set(run.signal):
        run.steps = _steps(run.signal["step_index"][:, 0], run.signal["stance_foot"][:, 0])
    return run
