"""`bench plant`: a step of the plant beside dWorldStep and MuJoCo, on the same walk, in one interleaved run.

Each simulator does a short chunk of ticks in turn, so that whatever else the machine does hits all of them alike.
Ratios are taken chunk by chunk; their median is the figure.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from hoap2 import parameters, paths
from hoap2.bench import measure, simulators
from hoap2.bench.measure import Spread
from hoap2.bench.recording import Recording, record
from hoap2.bench.simulators import MujocoSettings, MujocoSimulator, PlantSimulator
from hoap2.binding import Plant
from hoap2.errors import UserError

CASES = ("floor", "air")
CHUNK = 50  # ticks
WARM_UP = 200  # ticks that are stepped but not counted: landing on the soles, filling caches
COLD = 2  # ticks at the start of each turn, with the caches still full of another simulator: stepped, not counted
UPRIGHT = 0.9  # cosine of the pelvis' tilt; a robot that walks stays above 0.999
OURS = {"articulated": "articulated", "dworldstep": "ode"}
MUJOCO = {
    "mujoco_implicitfast": MujocoSettings("implicitfast"),
    "mujoco_euler": MujocoSettings("euler"),
    "mujoco_implicitfast_elliptic": MujocoSettings("implicitfast", elliptic=True),
    # another robot: one without Coulomb friction in its joints, which costs MuJoCo a constraint row a joint
    "mujoco_implicitfast_frictionless_joints": MujocoSettings("implicitfast", frictionloss=False),
}
RATIOS = ("dworldstep", *MUJOCO)


@dataclass
class Case:
    """One repetition of one case: durations (ns) of every simulator, (ticks,), and what the robots did.

    chunks: the ticks of each turn that count.
    """

    ns: dict[str, np.ndarray]
    robots: dict[str, dict]
    chunks: list[slice] = field(default_factory=list)

    def counted(self, name: str) -> np.ndarray:
        """Durations (ns) of a simulator's ticks that count."""
        return np.concatenate([self.ns[name][chunk] for chunk in self.chunks])

    def us(self) -> dict[str, dict]:
        return {name: vars(Spread.of(self.counted(name))) for name in self.ns}

    def ratio(self, of: str, to: str) -> float:
        """Median over the chunks of the ratio of the chunks' median ticks."""
        return measure.median([float(np.median(self.ns[of][c]) / np.median(self.ns[to][c])) for c in self.chunks])

    def ratio_of_means(self, of: str, to: str) -> float:
        """Whole time over whole time: heavy ticks count in full, and so does every interruption."""
        return float(self.counted(of).sum() / self.counted(to).sum())


def measure_case(recording: Recording, air: bool) -> Case:
    """All simulators through the whole recording, chunk by chunk in turn."""
    ours = [PlantSimulator(name, recording, air, solver=solver) for name, solver in OURS.items()]
    start = Plant(**(recording.plant_values | {"start_height_m": simulators.AIR_M if air else 0.0}))
    theirs = [MujocoSimulator(name, settings, recording, air, start) for name, settings in MUJOCO.items()]
    everyone = [*ours, *theirs]
    ns = {s.name: np.zeros(recording.ticks, dtype=np.int64) for s in everyone}
    track = _Track([s.name for s in everyone])
    chunks = [slice(a, min(a + CHUNK, recording.ticks)) for a in range(0, recording.ticks, CHUNK)]
    for number, chunk in enumerate(chunks):
        turn = number % len(everyone)  # who begins changes from chunk to chunk
        for simulator in everyone[turn:] + everyone[:turn]:
            simulator.chunk(chunk.start, ns[simulator.name][chunk])
        for simulator in everyone:
            track.look(simulator)
    _assert_two_solvers(track)
    case = Case(ns, track.robots(), [slice(c.start + COLD, c.stop) for c in chunks if c.start >= WARM_UP])
    for s in ours:
        case.robots[s.name]["outputs_us"] = s.outputs_us()
    counted = sum(c.start < WARM_UP for c in chunks)
    for s in theirs:
        case.robots[s.name] |= {"contacts_mean": float(np.mean(s.contacts[counted:])),
                                "contacts_max": max(s.contacts[counted:])}
    return case


class _Track:
    """Where each robot is after each chunk, and how far from the plant's dWorldStep."""

    def __init__(self, names: list[str]) -> None:
        self._com = {name: [] for name in names}
        self._upright = {name: [] for name in names}

    def look(self, simulator) -> None:
        seen = simulator.look()
        self._com[simulator.name].append(seen.com_W_m)
        self._upright[simulator.name].append(seen.upright)

    def com(self, name: str) -> np.ndarray:
        return np.array(self._com[name])

    def robots(self) -> dict[str, dict]:
        reference = self.com("dworldstep")
        return {name: {"stays_upright": bool(min(self._upright[name]) > UPRIGHT),
                       "com_off_dworldstep_max_m": float(np.abs(self.com(name) - reference).max()),
                       "com_moved_x_m": float(self.com(name)[-1, 0] - self.com(name)[0, 0])}
                for name in self._com}


def _assert_two_solvers(track: _Track) -> None:
    """The two solvers differ in their last bits after a while, or the plant did not obey the parameter."""
    if np.array_equal(track.com("articulated"), track.com("dworldstep")):
        raise UserError("the plant's two solvers gave the same bits: both rows would time the same one",
                        "is the library up to date? ./hoap2 fmu build", 3)


def summarise(cases: dict[str, Case]) -> dict:
    """Figures of one repetition."""
    return {
        "us": {name: {case: cases[case].us()[name] for case in cases} for name in (*OURS, *MUJOCO)},
        "ratio": {f"articulated_to_{other}": {case: cases[case].ratio("articulated", other) for case in cases}
                  for other in RATIOS},
        "ratio_of_means": {f"articulated_to_{other}": {case: cases[case].ratio_of_means("articulated", other)
                                                       for case in cases} for other in RATIOS},
        "robots": {name: {case: cases[case].robots[name] for case in cases} for name in (*OURS, *MUJOCO)},
    }


def run(seconds: float, repeat: int, progress: Callable[[str], None]) -> tuple[dict, list[dict[str, Case]]]:
    """Everything; the document, and each repetition's durations for the picture."""
    mujoco = simulators.import_mujoco()
    tick_s = parameters.table().tick_us / 1e6
    progress("recording the walk")
    recording = record(round(seconds / tick_s))
    done = []
    with measure.one_core() as core:
        about = measure.machine(core)
        for number in range(repeat):
            cases = {}
            for case in CASES:
                progress(f"{case}, {number + 1} of {repeat}")
                cases[case] = measure_case(recording, air=case == "air")
            done.append(cases)
    runs = [summarise(cases) for cases in done]
    model = str(simulators.MODEL.relative_to(paths.ROOT))
    document = {"machine": about, "mujoco": {"version": mujoco.__version__, "model": model},
                "settings": {"seconds": seconds, "ticks": recording.ticks, "repeat": repeat, "chunk_ticks": CHUNK,
                             "warm_up_ticks": WARM_UP, "cold_ticks": COLD,
                             "ticks_walking": int(recording.walking.sum()), "clock_us": simulators.clock_us()},
                **measure.medians(runs), "runs": runs}
    return document, done
