"""FMI-LS-BUS: controller, plant and bus FMU in one event loop; every clock is driven by its own countdown.

An instant: the transmit clocks that are due tick, what they give goes to the receive clocks of the other side, all
FMUs update, new countdowns are asked for; again, while one of them is zero. Then all step to the next countdown.
All arguments of the FMI calls are made once.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path

from ..generate import can_table, ls_bus
from ..generate.tables import PRODUCTS, load
from .archive import FmuCallError, FmuFileError
from .instance import OK_OR_WARNING, FmuInstance

BOOT_TICKS = 4  # controller and boards are switched on while the robot stands still
CHANGED = 2  # fmi3IntervalChanged
NEVER = 1 << 62
MOST_ROUNDS = 20  # of one instant: two nodes that answer each other for ever are an error
NS = 1e9


class Terminals:
    """The bus terminals of one FMU: clocks, countdowns, and the bytes that wait for its receive clocks."""

    def __init__(self, fmu: FmuInstance, names: list[str]):
        references = {v.name: v.valueReference for v in fmu.archive.description.modelVariables}
        missing = [n for n in names if f"{n}.Tx_Clock" not in references]
        if missing:
            raise FmuFileError(f"{fmu.archive.path} has no bus terminal {missing[0]}")
        self.fmu, self.names, self.count = fmu, names, len(names)
        self.reference = {m: [references[f"{n}.{m}"] for n in names] for m in ls_bus.MEMBERS}
        self.peers: list[tuple[Terminals, int]] = []  # of each terminal: the one that it is connected with
        self.due_ns = [NEVER] * self.count
        self.waiting = [0] * self.count  # bytes for each receive clock
        self.arrived = 0  # terminals, as bits, for which something waits
        self.buffers = [ctypes.create_string_buffer(ls_bus.ROOM) for _ in names]
        self._sends: dict[int, tuple] = {}
        self._receives: dict[int, tuple] = {}
        library, self._handle = fmu._library, fmu._handle
        self._set_clock, self._set_binary = library.fmi3SetClock, library.fmi3SetBinary
        self._get_binary, self._update = library.fmi3GetBinary, library.fmi3UpdateDiscreteStates
        self._get_interval, self._do_step = library.fmi3GetIntervalDecimal, library.fmi3DoStep
        self._enter_event, self._enter_step = library.fmi3EnterEventMode, library.fmi3EnterStepMode
        n = self.count
        self._intervals, self._qualifiers = (ctypes.c_double * n)(), (ctypes.c_int * n)()
        self._interval_arguments = (self._handle, (ctypes.c_uint32 * n)(*self.reference["Tx_Clock"]),
                                    ctypes.c_size_t(n), self._intervals, self._qualifiers)  # fmt: skip
        self._flags, self._next = [ctypes.c_bool() for _ in range(5)], ctypes.c_double()
        self._update_arguments = (self._handle, *map(ctypes.byref, self._flags), ctypes.byref(self._next))
        self._now, self._size, self._reached = ctypes.c_double(), ctypes.c_double(), ctypes.c_double()
        self._step_flags = [ctypes.c_bool() for _ in range(3)]
        self._step_arguments = (self._handle, self._now, self._size, ctypes.c_bool(True),
                                *map(ctypes.byref, self._step_flags), ctypes.byref(self._reached))  # fmt: skip

    def _check(self, status: int, call: str) -> None:
        if status > OK_OR_WARNING:
            self.fmu._refused(call)

    def _part(self, kept: dict[int, tuple], mask: int, clock: str, data: str) -> tuple:
        """Arguments for these terminals alone, made once."""
        if mask not in kept:
            which = [i for i in range(self.count) if mask >> i & 1]
            n = len(which)
            count, sizes, values = ctypes.c_size_t(n), (ctypes.c_size_t * n)(), (ctypes.c_void_p * n)()
            clocks = (ctypes.c_uint32 * n)(*[self.reference[clock][i] for i in which])
            binaries = (ctypes.c_uint32 * n)(*[self.reference[data][i] for i in which])
            if kept is self._receives:
                values[:] = [ctypes.addressof(self.buffers[i]) for i in which]
            kept[mask] = (which, sizes, values, (self._handle, clocks, count, (ctypes.c_bool * n)(*[True] * n)),
                          (self._handle, binaries, count, sizes, values, count))  # fmt: skip
        return kept[mask]

    def ask_countdowns(self, now_ns: int) -> None:
        self._check(self._get_interval(*self._interval_arguments), "GetIntervalDecimal")
        for i in range(self.count):
            if self._qualifiers[i] == CHANGED:
                self.due_ns[i] = now_ns + round(self._intervals[i] * NS)

    def send(self, now_ns: int) -> bool:
        """Let the due transmit clocks tick; True when one did."""
        mask = 0
        for i, due in enumerate(self.due_ns):
            if due <= now_ns:
                mask |= 1 << i
                self.due_ns[i] = NEVER
        if not mask:
            return False
        which, sizes, values, clock, binary = self._part(self._sends, mask, "Tx_Clock", "Tx_Data")
        self._check(self._set_clock(*clock), "SetClock")
        self._check(self._get_binary(*binary), "GetBinary")
        for j, i in enumerate(which):
            size = sizes[j]
            peer, place = self.peers[i]
            peer.take(place, values[j], size)
        return True

    def take(self, place: int, address: int, size: int) -> None:
        """Bytes for a receive clock; the sender's own buffer is good only until the next call."""
        before = self.waiting[place]
        if before + size > ls_bus.ROOM:
            raise FmuCallError(f"{self.fmu.name}: {before + size} bytes for {self.names[place]}, {ls_bus.ROOM} fit")
        if size:
            ctypes.memmove(ctypes.addressof(self.buffers[place]) + before, address, size)
        self.waiting[place] = before + size
        self.arrived |= 1 << place

    def receive(self) -> None:
        """Let the receive clocks tick for which something waits."""
        if not self.arrived:
            return
        which, sizes, _, clock, binary = self._part(self._receives, self.arrived, "Rx_Clock", "Rx_Data")
        for j, i in enumerate(which):
            sizes[j] = self.waiting[i]
            self.waiting[i] = 0
        self.arrived = 0
        self._check(self._set_clock(*clock), "SetClock")
        self._check(self._set_binary(*binary), "SetBinary")

    def update(self) -> None:
        self._flags[0].value = True
        for _ in range(MOST_ROUNDS):
            self._check(self._update(*self._update_arguments), "UpdateDiscreteStates")
            if not self._flags[0].value:
                return
        raise FmuCallError(f"{self.fmu.name} asks for updates without end")

    def step(self, now_ns: int, end_ns: int) -> bool:
        """Step mode, step, event mode. True when the FMU wants an event here."""
        start_s = self.fmu.start_time_s + now_ns / NS
        self._now.value, self._size.value = start_s, (end_ns - now_ns) / NS
        self._check(self._enter_step(self._handle), "EnterStepMode")
        self._check(self._do_step(*self._step_arguments), "DoStep")
        self._check(self._enter_event(self._handle), "EnterEventMode")
        return self._step_flags[0].value


class LsBusLoop:
    """Three FMUs, initialised with event mode and connected; they stand at the end of the boot."""

    def __init__(self, controller: FmuInstance, plant: FmuInstance, bus: FmuInstance):
        can = can_table.load()
        self.controller = Terminals(controller, ls_bus.terminals(can, "controller"))
        self.plant = Terminals(plant, ls_bus.terminals(can, "plant"))
        self.bus = Terminals(bus, ls_bus.terminals(can, ls_bus.BUS))
        self.parts = (self.controller, self.plant, self.bus)
        self.bus.peers = [(self.controller if i % 2 == 0 else self.plant, i // 2) for i in range(self.bus.count)]
        self.controller.peers = [(self.bus, 2 * i) for i in range(self.controller.count)]
        self.plant.peers = [(self.bus, 2 * i + 1) for i in range(self.plant.count)]
        self.now_ns = 0
        self.tick_ns = 1000 * load().tick_us
        self.longest_step_ns = NEVER  # shorter than a tick: the FMUs are stepped within one, too
        self._settle()
        self.advance(BOOT_TICKS)

    def no_step(self) -> None:
        """Of a product that advance() steps."""

    def _settle(self) -> None:
        """One instant, until no countdown is due any more."""
        for _ in range(MOST_ROUNDS):
            for part in self.parts:
                part.send(self.now_ns)
            for part in self.parts:
                part.receive()
            for part in self.parts:
                part.update()
                part.ask_countdowns(self.now_ns)
            if min(min(p.due_ns) for p in self.parts) > self.now_ns:
                return
        raise FmuCallError(f"the FMUs answer each other without end at {self.now_ns / NS:.6f} s")

    def advance(self, ticks: int = 1) -> None:
        """Whole ticks; the outputs of both products can be read then."""
        end_ns = self.now_ns + ticks * self.tick_ns
        while self.now_ns < end_ns:
            next_ns = min(end_ns, self.now_ns + self.longest_step_ns, *(min(p.due_ns) for p in self.parts))
            for part in self.parts:
                part.step(self.now_ns, next_ns)
            self.now_ns = next_ns
            self._settle()

    def save(self) -> tuple:
        """The loop and all three FMUs, as bytes; good for a loop over other instances too."""
        return self.now_ns, [(part.fmu.serialize(), list(part.due_ns)) for part in self.parts]

    def restore(self, saved: tuple) -> None:
        """Go on from what save() gave."""
        self.now_ns, parts = saved
        for part, (state, due_ns) in zip(self.parts, parts, strict=True):
            restored = part.fmu.deserialize(state)
            part.fmu.set_state(restored)
            restored.release()
            part.due_ns = list(due_ns)


class LsBusLink:
    """The master's part in a run over bus terminals: nothing, the FMUs exchange frames (hoap2.wiring.Link)."""

    def writers(self, *_: object) -> tuple[Callable[[int], None], Callable[[int], None]]:
        return (lambda _tick: None), (lambda _tick: None)


def open_loop(files: dict[str, Path], parameters: dict[str, dict] | None = None) -> tuple[LsBusLoop, list[FmuInstance]]:
    """The three FMUs by flavour ("controller", "plant", "can_bus"), started; the caller closes them."""
    opened: list[FmuInstance] = []
    try:
        for flavour in (*PRODUCTS, ls_bus.BUS):
            opened.append(FmuInstance(files[flavour], flavour, event_mode=True))
            opened[-1].set_parameters((parameters or {}).get(flavour, {}))
            opened[-1].initialize()
        return LsBusLoop(*opened), opened
    except BaseException:
        for fmu in opened:
            fmu.close()
        raise
