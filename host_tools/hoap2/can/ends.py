"""The ends of the buses in Python: the controller's node, or the robot's boards, with frames of python-can."""

from __future__ import annotations

import ctypes

import can
import numpy as np

from hoap2.can import library
from hoap2.can.link import Giver
from hoap2.wiring import Side

END_FRAMES = 9 * 16
COMMAND = library.COMMAND_REALS + library.COMMAND_INTS
MEASURED = library.MEASURED_REALS + library.MEASURED_INTS


class Frames(ctypes.Structure):
    """hoap2_end_frames_t."""

    _fields_ = [("count", ctypes.c_int32), ("bus", ctypes.c_int32 * END_FRAMES), ("frame", library.Frame * END_FRAMES)]


class Health(ctypes.Structure):
    """hoap2_end_health_t."""

    _fields_ = [(name, ctypes.c_int32) for name in ("state", "holding", "holds", "clipped")] + [
        ("refused", ctypes.c_int32 * 9)]  # fmt: skip


def to_message(frame: library.Frame) -> can.Message:
    fd, fast = bool(frame.flags & library.FD), bool(frame.flags & library.BRS)
    return can.Message(arbitration_id=frame.identifier, is_extended_id=False, data=bytes(frame.data[: frame.length]),
                       is_fd=fd, bitrate_switch=fast)  # fmt: skip


def to_frame(message: can.Message) -> library.Frame:
    flags = (library.FD if message.is_fd else 0) | (library.BRS if message.bitrate_switch else 0)
    flags |= (library.EXTENDED if message.is_extended_id else 0) | (library.REMOTE if message.is_remote_frame else 0)
    frame = library.Frame(message.arbitration_id, len(message.data), flags)
    ctypes.memmove(frame.data, bytes(message.data), len(message.data))
    return frame


class _Copy:
    """Outputs of a side into a block."""

    def __init__(self, side: Side, block: library.Block) -> None:
        self.side, self.block = side, block
        names = {kind: [c.name for c in side.outputs if c.kind == kind] for kind in ("real", "int")}
        self.index = {kind: np.array([names[kind].index(n) for n in block.names[kind]], dtype=int) for kind in names}

    def __call__(self) -> None:
        self.side.get_outputs()
        self.block.real[:] = self.side.real_out[self.index["real"]]
        self.block.integer[:] = self.side.int_out[self.index["int"]]


class _End:
    """One end: `receive` each frame, `begin` a tick (its frames), `finish` it (the inputs of the side)."""

    name = ""

    def __init__(self, side: Side, out_block: library.Block, in_block: library.Block) -> None:
        self.side, self._out, self._in = side, out_block, in_block
        self._take, self._give = _Copy(side, out_block), Giver(side, in_block)
        self._c = library.load()
        self._handle = self._call("create")
        if not self._handle:
            raise MemoryError(f"no memory for the {self.name} of a CAN bus")
        self._frames = Frames()

    def _call(self, function: str, *arguments):
        return getattr(self._c, f"hoap2_{self.name}_end_{function}")(*arguments)

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self._call("destroy", self._handle)
            self._handle = None

    def receive(self, bus: int, message: can.Message) -> int:
        return self._call("receive", self._handle, bus, ctypes.byref(to_frame(message)))

    def health(self) -> Health:
        health = Health()
        self._call("health", self._handle, ctypes.byref(health))
        return health

    def _sent(self) -> list[tuple[int, can.Message]]:
        frames = self._frames
        return [(frames.bus[i], to_message(frames.frame[i])) for i in range(frames.count)]


class ControllerEnd(_End):
    """The controller's node."""

    name = "controller"

    def __init__(self, side: Side) -> None:
        super().__init__(side, library.Block(library.signal_rows("controller", "output", COMMAND)),
                         library.Block(library.signal_rows("plant", "output", MEASURED)))  # fmt: skip

    def begin(self) -> list[tuple[int, can.Message]]:
        """The frames of this tick, by bus."""
        self._take()
        self._call("send", self._handle, self._out.pointer, ctypes.byref(self._frames))
        return self._sent()

    def finish(self) -> None:
        """All has arrived: the inputs of the next step."""
        self._call("inputs", self._handle, self._in.pointer)
        self._give.give()


class BoardsEnd(_End):
    """The nine boards of the robot."""

    name = "boards"

    def __init__(self, side: Side) -> None:
        super().__init__(side, library.Block(library.signal_rows("plant", "output", MEASURED)),
                         library.Block(library.signal_rows("controller", "output", COMMAND)))  # fmt: skip
        self._last_sensor_tick: int | None = None

    def begin(self, booting: bool = False) -> list[tuple[int, can.Message]]:
        """The boards act on what has arrived; the frames of this tick, by bus."""
        self._take()
        sensor_tick = int(self._out.integer[0])
        fresh = booting or sensor_tick != self._last_sensor_tick
        self._last_sensor_tick = sensor_tick
        self._call("tick", self._handle, self._out.pointer, int(fresh), self._in.pointer, ctypes.byref(self._frames))
        return self._sent()

    def finish(self) -> None:
        """The inputs of the plant's next step."""
        self._give.give()
