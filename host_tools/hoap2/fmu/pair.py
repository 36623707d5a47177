"""Controller and plant FMU wired together: the smallest Jacobi master, for checks and tests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hoap2.parameters import operator_inputs

from .instance import FmuInstance


@dataclass
class Trace:
    """What one product took and gave, a row a communication point: point 0 is after initialisation."""

    inputs_real: list[np.ndarray] = field(default_factory=list)
    inputs_int: list[np.ndarray] = field(default_factory=list)
    outputs_real: list[np.ndarray] = field(default_factory=list)
    outputs_int: list[np.ndarray] = field(default_factory=list)

    def note_outputs(self, fmu: FmuInstance) -> None:
        self.outputs_real.append(fmu.outputs_real.copy())
        self.outputs_int.append(fmu.outputs_int.copy())

    def note_inputs(self, fmu: FmuInstance) -> None:
        self.inputs_real.append(fmu.inputs_real.copy())
        self.inputs_int.append(fmu.inputs_int.copy())

    def outputs(self) -> bytes:
        """All outputs as bytes: equal means equal to the bit."""
        return np.array(self.outputs_real).tobytes() + np.array(self.outputs_int).tobytes()

    def first_difference(self, other: Trace) -> int | None:
        """Index of the first communication point whose outputs differ."""
        pairs = zip(self.outputs_real, other.outputs_real), zip(self.outputs_int, other.outputs_int)
        points = [i for pair in pairs for i, (a, b) in enumerate(pair) if a.tobytes() != b.tobytes()]
        if points:
            return min(points)
        return (
            None
            if len(self.outputs_real) == len(other.outputs_real)
            else min(map(len, (self.outputs_real, other.outputs_real)))
        )


class Pair:
    """Both FMUs, initialised with parameters; step() exchanges, then steps both."""

    def __init__(self, controller: FmuInstance, plant: FmuInstance):
        self.controller, self.plant = controller, plant
        self._wires = [wire for a, b in ((plant, controller), (controller, plant)) for wire in self._connect(a, b)]

    @classmethod
    def open(cls, controller: Path, plant: Path, parameters: Mapping[str, Mapping] | None = None) -> Pair:
        """Load both files and initialise them; parameters by product."""
        opened = []
        try:
            for product, path in (("controller", controller), ("plant", plant)):
                opened.append(FmuInstance(path, product))
                opened[-1].set_parameters((parameters or {}).get(product, {}))
                opened[-1].initialize()
        except BaseException:
            for fmu in opened:
                fmu.close()
            raise
        return cls(*opened)

    @staticmethod
    def _connect(source: FmuInstance, sink: FmuInstance) -> list[tuple[np.ndarray, slice, np.ndarray, slice]]:
        wires = []
        for name, where in sink.input_slices.items():
            if name in operator_inputs(sink.product):
                continue
            kind = sink.rows[name].kind
            wires.append(
                (getattr(source, f"outputs_{kind}"), source.output_slices[name], getattr(sink, f"inputs_{kind}"), where)
            )
        return wires

    def exchange(self) -> None:
        """Outputs of both -> inputs of both."""
        for source, take, sink, put in self._wires:
            sink[put] = source[take]
        self.controller.write()
        self.plant.write()

    def step(self) -> None:
        self.exchange()
        self.controller.step()
        self.plant.step()
        self.controller.read()
        self.plant.read()

    def run(self, ticks: int) -> dict[str, Trace]:
        """Step and note everything, by product."""
        traces = {"controller": Trace(), "plant": Trace()}
        sides = {"controller": self.controller, "plant": self.plant}
        for name, fmu in sides.items():
            traces[name].note_outputs(fmu)
        for _ in range(ticks):
            self.step()
            for name, fmu in sides.items():
                traces[name].note_inputs(fmu)
                traces[name].note_outputs(fmu)
        return traces

    def close(self) -> None:
        self.controller.close()
        self.plant.close()

    def __enter__(self) -> Pair:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def replay(fmu: FmuInstance, recorded: Trace, begin: int = 0, end: int | None = None) -> Trace:
    """Step an initialised FMU through recorded inputs, one tick each."""
    trace = Trace()
    trace.note_outputs(fmu)
    for real, integer in list(zip(recorded.inputs_real, recorded.inputs_int))[begin:end]:
        fmu.inputs_real[:], fmu.inputs_int[:] = real, integer
        fmu.write()
        fmu.step()
        fmu.read()
        trace.note_outputs(fmu)
    return trace
