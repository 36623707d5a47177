"""The messages and their channels; decoding that takes nothing for granted.

The bindings are made by lcm-gen at build time (`hoap2_lcm` in the build folder) from the .lcm files that
`./hoap2 generate` writes.
"""

from __future__ import annotations

import importlib
import struct
import sys
from functools import lru_cache
from types import ModuleType

from hoap2 import paths
from hoap2.errors import UserError

PREFIX = "HOAP2_"
# channel -> name of its type
CHANNELS = {f"{PREFIX}{name.upper()}": f"{name}_t"
            for name in ("state", "gait", "truth", "health", "event", "run", "command", "answer")}  # fmt: skip
STATE, GAIT, TRUTH, HEALTH, EVENT, RUN, COMMAND, ANSWER = CHANNELS
VARIABLE = frozenset({EVENT, RUN, COMMAND, ANSWER})  # their length depends on what they hold
FINGERPRINT_BYTES = 8
HEADER = struct.Struct(">qqqq")  # run_id, sequence, tick, time_us; behind the fingerprint, in all but a command
EVENT_KINDS = (
    "run_started",
    "step",
    "fault",
    "fall",
    "command_accepted",
    "command_refused",
    "push",
    "run_ended",
    "note",
)


class Foreign(ValueError):
    """Not a message of this channel: another type, another version, or another sender altogether."""


class Malformed(ValueError):
    """Begins as a message of this channel and is not one."""


@lru_cache(maxsize=1)
def bindings() -> ModuleType:
    """The package `hoap2_lcm` of this build: `bindings().gait_t()` makes a message."""
    folder = paths.built("host_tools/telemetry/python/hoap2_lcm").parent
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))
    try:
        return importlib.import_module("hoap2_lcm")
    except ImportError as error:
        raise UserError(f"cannot import the LCM bindings: {error}", "build them again: ./hoap2 fmu build", 3) from None


@lru_cache(maxsize=None)
def type_of(channel: str) -> type:
    """The class of a channel's messages."""
    return getattr(bindings(), CHANNELS[channel])


@lru_cache(maxsize=None)
def _fingerprint(channel: str) -> bytes:
    return type_of(channel)._get_packed_fingerprint()


@lru_cache(maxsize=None)
def _length(channel: str) -> int:
    """Bytes of a message without strings and variable arrays."""
    return len(type_of(channel)().encode())


def check(channel: str, data: bytes) -> None:
    """Raise Foreign or Malformed when these bytes cannot be decoded as a message of the channel."""
    if channel not in CHANNELS or data[:FINGERPRINT_BYTES] != _fingerprint(channel):
        raise Foreign(f"{channel}: not a message of this version")
    if channel not in VARIABLE:
        if len(data) != _length(channel):
            raise Malformed(f"{channel}: {len(data)} bytes, not {_length(channel)}")
        return
    decode(channel, data)


def decode(channel: str, data: bytes):
    """The message, or Foreign or Malformed.

    What lcm-gen makes for Python reads a cut string as a shorter one; so what was read must give the same bytes again.
    """
    if channel not in CHANNELS or data[:FINGERPRINT_BYTES] != _fingerprint(channel):
        raise Foreign(f"{channel}: not a message of this version")
    try:
        message = type_of(channel).decode(data)
        whole = len(data) == _length(channel) if channel not in VARIABLE else message.encode() == data
    except Exception as error:  # whatever the bindings stumble over
        raise Malformed(f"{channel}: {error}") from None
    if not whole:
        raise Malformed(f"{channel}: cut off, or with something behind its end")
    return message


def header(data: bytes) -> tuple[int, int, int, int]:
    """run_id, sequence, tick, time_us of a checked message that is not a command."""
    return HEADER.unpack_from(data, FINGERPRINT_BYTES)
