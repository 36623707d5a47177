"""libhoap2_can in Python: its structs, laid out as sim/include/hoap2_link/link.h and firmware/can/frame.h have them."""

from __future__ import annotations

import ctypes
from functools import lru_cache

import numpy as np

from hoap2 import parameters, paths
from hoap2.errors import UserError
from hoap2.generate import can_table
from hoap2.generate.tables import Signal

BUSES, PRIORITIES = 2, 16
CAUSES = ("on_the_way", "superseded", "no_room", "node_down", "cut", "bad")
COMMAND_REALS = ("q_ref_rad", "qd_ref_rad_s", "tau_ff_Nm", "kp_Nm_rad", "kd_Nms_rad")
COMMAND_INTS = ("drive_mode",)
MEASURED_REALS = ("q_enc_rad", "gyro_S_rad_s", "accel_S_m_s2", "cell_force_N", "true_tau_Nm")
MEASURED_INTS = ("sensor_tick",)
TICK_FIELDS = ("busy_right_us", "busy_left_us", "lost", "refused", "holding", "state", "bus_modes")


@lru_cache(maxsize=1)
def refusals() -> tuple[str, ...]:
    """Why a frame is refused, by its number; 0 is none."""
    return ("none", *can_table.load().raw["refusal"])


class Frame(ctypes.Structure):
    """hoap2_can_frame_t."""

    _fields_ = [("identifier", ctypes.c_uint32), ("length", ctypes.c_uint8), ("flags", ctypes.c_uint8),
                ("data", ctypes.c_uint8 * 64)]  # fmt: skip


FD, BRS, EXTENDED, REMOTE = 1, 2, 4, 8


class Message(ctypes.Structure):
    """hoap2_can_message_t."""

    _fields_ = [("raw", ctypes.c_int32 * max(len(f.placed) for f in can_table.load().frames)),
                ("layout", ctypes.c_int16), ("kind", ctypes.c_uint8), ("board", ctypes.c_int8),
                ("counter", ctypes.c_uint8)]  # fmt: skip


class Counts(ctypes.Structure):
    """hoap2_link_counts_t."""

    _fields_ = [
        *((name, ctypes.c_int64 * BUSES) for name in ("queued", "delivered", "pending")),
        ("lost", ctypes.c_int64 * len(CAUSES) * BUSES),
        *((name, ctypes.c_int64 * BUSES) for name in ("error_frames", "not_acknowledged", "changed", "busy_ns")),
        *((name, ctypes.c_int64 * PRIORITIES) for name in ("frames", "latency_sum_ns", "latency_max_ns")),
        ("refused_by_controller", ctypes.c_int64 * 9), ("refused_by_boards", ctypes.c_int64 * 9),
        *((name, ctypes.c_int64) for name in ("holds", "hold_ticks", "clipped", "ticks")),
    ]  # fmt: skip


class Block:
    """Signals as the link takes and gives them: reals, then ints, in one piece of memory."""

    def __init__(self, rows: list[Signal]) -> None:
        table = parameters.table()
        reals, ints = ([n for s in rows if s.kind == kind for n in table.element_names(s)] for kind in ("real", "int"))
        size = 8 * len(reals) + 4 * len(ints)
        memory = np.zeros(size + -size % 8, dtype=np.uint8)
        self.names = {"real": reals, "int": ints}
        self.real = memory[: 8 * len(reals)].view(np.float64)
        self.integer = memory[8 * len(reals) : size].view(np.int32)
        self.pointer = ctypes.c_void_p(memory.ctypes.data)


def signal_rows(product: str, group: str, names: tuple[str, ...]) -> list[Signal]:
    """Rows of the signal table in this order."""
    rows = {s.name: s for s in parameters.table().select(product, group)}
    return [rows[name] for name in names]


class LinkParameters:
    """hoap2_link_params_t: reals first, then ints, each in the order of can.toml."""

    def __init__(self, values: dict[str, float]) -> None:
        rows = can_table.load().disturbances
        reals, ints = ([d for d in rows if d.kind == kind] for kind in ("real", "int"))
        given = {d.name: values.get(d.name, d.default) for d in rows}
        self._memory = b"".join((np.array([given[d.name] for d in reals], dtype=np.float64).tobytes(),
                                 np.array([given[d.name] for d in ints], dtype=np.int32).tobytes(), bytes(8)))
        self.pointer = ctypes.c_char_p(self._memory)


@lru_cache(maxsize=1)
def load() -> ctypes.CDLL:
    """The library of this build."""
    path = paths.can_library()
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise UserError(f"cannot load the library: {error}", "build again: ./hoap2 fmu build", 3) from None
    pointer, size_t, integer = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int
    signatures = {
        "hoap2_link_create": (pointer, []), "hoap2_link_destroy": (None, [pointer]),
        "hoap2_link_init": (integer, [pointer, pointer, ctypes.c_uint32]),
        "hoap2_link_exchange": (None, [pointer] * 6), "hoap2_link_counts": (None, [pointer, pointer]),
        "hoap2_link_state_size": (size_t, [pointer]), "hoap2_link_get_state": (None, [pointer, pointer]),
        "hoap2_link_set_state": (integer, [pointer, pointer, size_t]),
        "hoap2_link_frame_bits": (None, [pointer] * 3),
        "hoap2_can_protocol": (integer, []), "hoap2_can_find": (integer, [integer] * 3),
        "hoap2_can_encode": (integer, [integer, ctypes.c_uint8, pointer, pointer]),
        "hoap2_can_decode": (integer, [integer, pointer, pointer]),
    }  # fmt: skip
    for end in ("controller", "boards"):
        signatures |= {
            f"hoap2_{end}_end_create": (pointer, []), f"hoap2_{end}_end_destroy": (None, [pointer]),
            f"hoap2_{end}_end_receive": (integer, [pointer, integer, pointer]),
            f"hoap2_{end}_end_health": (None, [pointer] * 2),
        }  # fmt: skip
    signatures |= {
        "hoap2_controller_end_send": (None, [pointer] * 3), "hoap2_controller_end_inputs": (None, [pointer] * 2),
        "hoap2_boards_end_tick": (None, [pointer, pointer, integer, pointer, pointer]),
    }  # fmt: skip
    for name, (result, arguments) in signatures.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library
