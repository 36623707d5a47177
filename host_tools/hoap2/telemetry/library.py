"""The publisher's C interface (host_tools/telemetry/include/hoap2_telemetry/telemetry.h) through ctypes."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import lru_cache

from hoap2 import paths
from hoap2.errors import UserError

TO_LOG, LIVE = 1, 2
Callback = ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.POINTER(ctypes.c_uint8), ctypes.c_int32)
_INT32S, _INT64S = ctypes.POINTER(ctypes.c_int32), ctypes.POINTER(ctypes.c_int64)


class Config(ctypes.Structure):
    """hoap2_telemetry_config_t"""

    _fields_ = [
        ("run_id", ctypes.c_int64), ("log_path", ctypes.c_char_p), ("live_url", ctypes.c_char_p),
        ("paced", ctypes.c_int32), ("tick_us", ctypes.c_int32),
        ("real", ctypes.POINTER(ctypes.c_double)), ("real_stride", ctypes.c_int64),
        ("integer", _INT32S), ("integer_stride", ctypes.c_int64),
        ("controller_ns", _INT64S), ("plant_ns", _INT64S),
        ("columns", _INT32S * 3), ("push_column", ctypes.c_int32),
    ]  # fmt: skip


class Counts(ctypes.Structure):
    """hoap2_telemetry_counts_t"""

    _fields_ = [
        (name, ctypes.c_int64)
        for name in ("logged", "published", "dropped", "decimated", "waiting", "spent_ns", "sender_ns")
    ]


@lru_cache(maxsize=1)
def load() -> ctypes.CDLL:
    """The library of this build, its functions with their types."""
    path = paths.telemetry_library()
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise UserError(f"cannot load the library: {error}", "build again: ./hoap2 fmu build", 3) from None
    pointer, text, int32, int64 = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int32, ctypes.c_int64
    signatures: dict[str, tuple] = {
        "open": (pointer, [ctypes.POINTER(Config), text, ctypes.c_size_t]),
        "rows": (None, [pointer, int64, ctypes.c_double, int64]),
        "send": (None, [pointer, text, text, int32, int64, int32]),
        "finish": (None, [pointer, int32]), "destroy": (None, [pointer]),
        "counts": (None, [pointer, ctypes.POINTER(Counts)]), "problem": (text, [pointer]),
        "subscribe": (ctypes.c_int, [pointer, Callback]), "poll": (ctypes.c_int, [pointer, ctypes.c_int]),
        "elements": (int32, [int32]), "config_size": (ctypes.c_size_t, []),
    }  # fmt: skip
    for name, (result, arguments) in signatures.items():
        function = getattr(library, f"hoap2_telemetry_{name}")
        function.restype, function.argtypes = result, arguments
    if library.hoap2_telemetry_config_size() != ctypes.sizeof(Config):
        raise UserError(f"{path} is of another version", "build again: ./hoap2 fmu build", 3)
    return library


class Publisher:
    """An open publisher; the arrays named in its config must outlive it."""

    def __init__(self, config: Config) -> None:
        self._library = load()
        error = ctypes.create_string_buffer(500)
        handle = self._library.hoap2_telemetry_open(ctypes.byref(config), error, len(error))
        if not handle:
            raise UserError(f"no telemetry: {error.value.decode(errors='replace')}")
        self._handle = ctypes.c_void_p(handle)
        self._config = config
        self._callback = None
        self._rows = self._library.hoap2_telemetry_rows

    def rows(self, end: int, lag_us: float, overruns: int) -> None:
        """The next rows, up to `end`."""
        self._rows(self._handle, end, lag_us, overruns)

    def send(self, channel: str, data: bytes, tick: int, where: int) -> None:
        """An encoded message; the library fills in its header."""
        self._library.hoap2_telemetry_send(self._handle, channel.encode(), data, len(data), tick, where)

    def counts(self) -> dict[str, int]:
        counts = Counts()
        self._library.hoap2_telemetry_counts(self._handle, ctypes.byref(counts))
        return {name: getattr(counts, name) for name, _ in Counts._fields_}

    def problem(self) -> str:
        return self._library.hoap2_telemetry_problem(self._handle).decode(errors="replace")

    def subscribe(self, callback: Callable[[str, bytes], None]) -> None:
        """Hear what is published on this connection (memq://); `poll` calls back."""
        self._callback = Callback(lambda channel, data, length: callback(channel.decode(), bytes(data[:length])))
        if self._library.hoap2_telemetry_subscribe(self._handle, self._callback) != 0:
            raise UserError("cannot listen on this connection")

    def poll(self, timeout_ms: int = 0) -> int:
        """Handle a message that is there; 0 when there is none."""
        return self._library.hoap2_telemetry_poll(self._handle, timeout_ms)

    def finish(self, ended: bool) -> None:
        """Write what is left and close; counts and problem can still be asked."""
        self._library.hoap2_telemetry_finish(self._handle, int(ended))

    def destroy(self) -> None:
        """Free it; nothing may be called any more."""
        handle, self._handle = self._handle, None
        if handle is not None:
            self._library.hoap2_telemetry_destroy(handle)
