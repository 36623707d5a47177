"""`--link can`: the exchange of the two products goes through frames, boards and modelled buses (docs/can.md)."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping

import numpy as np

from hoap2.can import library
from hoap2.errors import UserError
from hoap2.wiring import Place, RowCall, Side, as_slice

__all__ = ["CanLink"]


def _places(names: list[str], wanted: list[str], who: str) -> Place:
    where = {name: i for i, name in enumerate(names)}
    missing = [name for name in wanted if name not in where]
    if missing:
        raise UserError(f"the {who} has no {', '.join(missing[:5])}, which the CAN link carries",
                        "both must use the names of docs/generated/signals.md")  # fmt: skip
    return as_slice(np.array([where[name] for name in wanted])) if wanted else slice(0, 0)


class _Taker:
    """Copies from a row of the log into a block of the link."""

    def __init__(self, side: Side, block: library.Block, real: np.ndarray, integer: np.ndarray, who: str) -> None:
        self.block, self.real, self.integer = block, real, integer
        names = {kind: [c.name for c in side.outputs if c.kind == kind] for kind in ("real", "int")}
        self.index = {kind: _places(names[kind], block.names[kind], who) for kind in names}

    def take(self, k: int) -> None:
        self.block.real[:] = self.real[k][self.index["real"]]
        self.block.integer[:] = self.integer[k][self.index["int"]]


class Giver:
    """Copies from a block of the link into the inputs of a side; its other inputs are left as they are."""

    def __init__(self, side: Side, block: library.Block) -> None:
        self.side, self.block = side, block
        self.index, self.source = {}, {}
        for kind in ("real", "int"):
            names = [c.name for c in side.inputs if c.kind == kind]
            wanted = [name for name in block.names[kind] if name in names]
            self.index[kind] = _places(names, wanted, "other side")
            self.source[kind] = _places(block.names[kind], wanted, "link")

    def give(self) -> None:
        self.side.real_in[self.index["real"]] = self.block.real[self.source["real"]]
        self.side.int_in[self.index["int"]] = self.block.integer[self.source["int"]]
        self.side.set_inputs()


class CanLink:
    """The link of one run. `writers` gives the master what sets the inputs of both sides."""

    def __init__(self, values: Mapping[str, float], run_seed: int) -> None:
        self._c = library.load()
        self._handle = self._c.hoap2_link_create()
        if not self._handle:
            raise MemoryError("no memory for a CAN link")
        if self._c.hoap2_link_init(self._handle, library.LinkParameters(dict(values)).pointer, run_seed & 0xFFFFFFFF):
            raise UserError("a parameter of the CAN link is out of its range", "see docs/generated/can.md")
        command, measured = library.COMMAND_REALS + library.COMMAND_INTS, library.MEASURED_REALS + library.MEASURED_INTS
        self.asked = library.Block(library.signal_rows("controller", "output", command))
        self.measured = library.Block(library.signal_rows("plant", "output", measured))
        self.to_plant = library.Block(library.signal_rows("controller", "output", command))
        self.to_controller = library.Block(library.signal_rows("plant", "output", measured))
        self._tick = np.zeros(len(library.TICK_FIELDS))
        self._pointers = [b.pointer for b in (self.asked, self.measured, self.to_plant, self.to_controller)]
        self._pointers.append(ctypes.c_void_p(self._tick.ctypes.data))
        self._rows: list[np.ndarray] = []

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self._c.hoap2_link_destroy(self._handle)
            self._handle = None

    def exchange(self) -> None:
        """One tick: from `asked` and `measured` to `to_plant` and `to_controller`."""
        self._c.hoap2_link_exchange(self._handle, *self._pointers)
        self._rows.append(self._tick.copy())

    def writers(self, controller: Side, plant: Side, of_controller: tuple[np.ndarray, np.ndarray],
                of_plant: tuple[np.ndarray, np.ndarray]) -> tuple[RowCall, RowCall]:  # fmt: skip
        """What sets the inputs of controller and plant from row k of their outputs, in this order."""
        asked = _Taker(controller, self.asked, *of_controller, "controller")
        measured = _Taker(plant, self.measured, *of_plant, "plant")
        to_controller, to_plant = Giver(controller, self.to_controller), Giver(plant, self.to_plant)

        def set_controller(k: int) -> None:
            asked.take(k)
            measured.take(k)
            self.exchange()
            to_controller.give()

        def set_plant(_k: int) -> None:
            to_plant.give()

        return set_controller, set_plant

    @property
    def ticks(self) -> np.ndarray:
        """A row each tick so far, columns as library.TICK_FIELDS."""
        return np.array(self._rows).reshape(-1, len(library.TICK_FIELDS))

    def counts(self) -> library.Counts:
        """Sums since the start of the run."""
        counts = library.Counts()
        self._c.hoap2_link_counts(self._handle, ctypes.byref(counts))
        return counts

    def save(self) -> bytes:
        """The whole state; `restore` continues from it bit for bit."""
        state = ctypes.create_string_buffer(self._c.hoap2_link_state_size(self._handle))
        self._c.hoap2_link_get_state(self._handle, state)
        return state.raw

    def restore(self, state: bytes) -> None:
        if self._c.hoap2_link_set_state(self._handle, state, len(state)):
            raise UserError("not a state of this CAN link")
