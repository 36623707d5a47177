"""Saved states of a running FMU: kept, gone back to, as bytes."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING

from .archive import FmuCallError

if TYPE_CHECKING:
    from .instance import FmuInstance


def state_call(name: str, version: int) -> str:
    """FMI 3's name of a function for states as the given version spells it."""
    if version == 3:
        return name
    return name.replace("FMUState", "FMUstate").replace("Deserialize", "DeSerialize")


class FmuState:
    """A saved state of one instance; freed with it, or before by release()."""

    def __init__(self, owner: FmuInstance, pointer: ctypes.c_void_p, tick: int | None):
        self.owner, self.pointer, self.tick = owner, pointer, tick
        owner.states.append(self)

    def release(self) -> None:
        """Give the memory back; harmless when done twice."""
        if self.pointer and self.owner.component:
            self.owner.call("FreeFMUState", ctypes.byref(self.pointer))
            self.owner.states.remove(self)
        self.pointer = ctypes.c_void_p()


class WithStates:
    """The states of an FmuInstance."""

    def get_state(self: FmuInstance) -> FmuState:
        """Save everything; the state stays with this instance."""
        pointer = ctypes.c_void_p()
        self.call("GetFMUState", ctypes.byref(pointer))
        return FmuState(self, pointer, self.tick)

    def set_state(self: FmuInstance, state: FmuState) -> None:
        """Go back to a saved state; the output arrays are read, the input arrays stay as they are."""
        if state.owner is not self or not state.pointer:
            raise FmuCallError(
                f"{self.name}: this state was released, or is another instance's; pass its bytes on instead"
            )
        self.call("SetFMUState", state.pointer)
        self.initialised = True
        self.tick = state.tick if state.tick is not None else self._tick_of_fmu()
        self.read()

    def serialize(self: FmuInstance, state: FmuState | None = None) -> bytes:
        """A state (default: the present one) as bytes, good for another instance or process."""
        kept = state or self.get_state()
        size = ctypes.c_size_t()
        self.call("SerializedFMUStateSize", kept.pointer, ctypes.byref(size))
        block = ctypes.create_string_buffer(size.value)
        self.call("SerializeFMUState", kept.pointer, block, size)
        if state is None:
            kept.release()
        return block.raw

    def deserialize(self: FmuInstance, block: bytes) -> FmuState:
        """Bytes -> a state of this instance, for set_state()."""
        pointer = ctypes.c_void_p()
        self.call("DeserializeFMUState", block, ctypes.c_size_t(len(block)), ctypes.byref(pointer))
        return FmuState(self, pointer, None)

    def _tick_of_fmu(self: FmuInstance) -> int:
        """The FMU's own time as ticks since the start time."""
        time_s = ctypes.c_double()
        if self.version == 2:
            self.call("GetRealStatus", ctypes.c_int(2), ctypes.byref(time_s))
        else:
            time_reference = (ctypes.c_uint32 * 1)(0)
            self.call("GetFloat64", time_reference, ctypes.c_size_t(1), ctypes.byref(time_s), ctypes.c_size_t(1))
        return round((time_s.value - self.start_time_s) * 1000)
