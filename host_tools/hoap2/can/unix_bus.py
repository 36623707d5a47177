"""CAN between processes without CAN hardware or network: a python-can interface on AF_UNIX sockets (`hoap2_unix`).

A channel is a socket file with a hub behind it, which the first node starts: a name is a file in the user's run
folder, a path is itself. Frames are neither lost nor reordered; all nodes see them in the same order. The packets
are those of host_tools/can/include/hoap2_can_unix/packet.h.
"""

from __future__ import annotations

import errno
import os
import select
import socket
import struct
import subprocess
import tempfile
import time
from pathlib import Path

import can

from hoap2 import paths
from hoap2.errors import UserError

NAME = "hoap2_unix"
LINGER_S = 2.0  # a hub that a node started ends when it has been alone for so long
GREETING_S = 5.0
MAGIC, ECHO = 0x48324331, 1
ANSWERS = {1: "its name is taken: a node named '{name}' is on the channel", 2: "the channel is full (64 nodes)",
           3: "the hub is of another version"}  # fmt: skip
EXTENDED, REMOTE, ERROR = 0x80000000, 0x40000000, 0x20000000
BRS, ESI, FD, OWN = 1, 2, 4, 8
ERROR_CLASSES, IDENTIFIER = 0x1FFFFFFF, 0x1FFFFFFF
RX_OVERFLOW = (0x04, 1)  # class and data[1] of the hub's error frame for a node that was too slow
_HELLO, _WELCOME, _HEADER = struct.Struct("=II32s"), struct.Struct("=II"), struct.Struct("=QIBB2x")
_LARGEST = _HEADER.size + 64
HUB_RUNS = 4  # exit code of the hub's program
_GONE = (errno.EPIPE, errno.ECONNRESET, errno.ENOTCONN, errno.EBADF)


def folder() -> Path:
    """Where channels that are only names live; private to the user."""
    base = os.environ.get("XDG_RUNTIME_DIR")
    path = Path(base) / "hoap2-can" if base else Path(tempfile.gettempdir()) / f"hoap2-can-{os.getuid()}"
    path.mkdir(mode=0o700, parents=True, exist_ok=True)
    if path.stat().st_uid != os.getuid():
        raise can.CanInitializationError(f"{path} belongs to another user; set XDG_RUNTIME_DIR")
    return path


def socket_path(channel: str) -> str:
    """The socket of a channel."""
    if not channel or channel in (".", ".."):
        raise can.CanInitializationError("a hoap2_unix channel needs a name or the path of a socket")
    path = os.path.abspath(channel) if "/" in channel else str(folder() / channel)
    if len(os.fsencode(path)) > 107:
        raise can.CanInitializationError(f"the path of a channel has at most 107 bytes: {path}")
    return path


def start_hub(path: str, linger_s: float = LINGER_S) -> None:
    """Start the hub of a channel in the background; nothing when there is one."""
    try:
        program = str(paths.built("host_tools/can/hoap2_can_hub"))
    except UserError as error:
        raise can.CanInitializationError(f"no hub at {path}, and none can be started: {error}") from None
    done = subprocess.run([program, "--detach", "--linger", f"{linger_s:g}", path], stdin=subprocess.DEVNULL,
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)  # fmt: skip
    if done.returncode not in (0, HUB_RUNS):
        raise can.CanInitializationError(done.stderr.strip() or f"the hub ended with {done.returncode}")


def _join_once(path: str, name: str, echo: bool) -> socket.socket:
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    try:
        connection.settimeout(GREETING_S)
        connection.connect(path)
        connection.sendall(_HELLO.pack(MAGIC, ECHO if echo else 0, name.encode()))
        answer = connection.recv(_WELCOME.size + 1)
        if not answer:
            raise ConnectionRefusedError(errno.ECONNREFUSED, "the hub was just leaving")
    except BaseException:
        connection.close()
        raise
    magic, code = _WELCOME.unpack(answer) if len(answer) == _WELCOME.size else (0, 3)
    if magic != MAGIC or code:
        connection.close()
        raise can.CanInitializationError(f"cannot join {path}: " + ANSWERS.get(code, ANSWERS[3]).format(name=name))
    connection.setblocking(False)
    return connection


def join(path: str, name: str, echo: bool, with_hub: bool) -> socket.socket:
    """Join a channel, starting its hub if there is none and with_hub."""
    for attempt in range(5):
        try:
            return _join_once(path, name, echo)
        except (FileNotFoundError, ConnectionError):
            if not with_hub:
                start = "start one (./hoap2 can hub) or another node"
                raise can.CanInitializationError(f"no hub at {path}: {start}") from None
        except TimeoutError:
            raise can.CanInitializationError(f"what listens at {path} does not answer") from None
        except OSError as error:
            raise can.CanInitializationError(f"cannot join {path}: {error.strerror}") from None
        if not os.path.isdir(os.path.dirname(path)):
            raise can.CanInitializationError(f"the folder of the channel is not there: {os.path.dirname(path)}")
        time.sleep(0.02 * attempt)  # the last hub may just be leaving
        start_hub(path)
    raise can.CanInitializationError(f"cannot join {path}: its hubs keep leaving")


def pack(message: can.Message) -> bytes:
    """A message as it goes to the hub."""
    identifier = message.arbitration_id
    if message.is_extended_id:
        identifier |= EXTENDED
    if message.is_error_frame:
        identifier = ERROR | (message.arbitration_id & ERROR_CLASSES)
    flags = 0
    if message.is_fd:
        flags = FD | (BRS if message.bitrate_switch else 0) | (ESI if message.error_state_indicator else 0)
    if message.is_remote_frame:
        return _HEADER.pack(0, identifier | REMOTE, message.dlc, flags)
    return _HEADER.pack(0, identifier, len(message.data), flags) + message.data


def unpack(packet: bytes, channel: str) -> can.Message:
    """A packet of the hub as a message."""
    time_ns, identifier, length, flags = _HEADER.unpack_from(packet)
    return can.Message(
        timestamp=time_ns * 1e-9, arbitration_id=identifier & IDENTIFIER, is_extended_id=bool(identifier & EXTENDED),
        is_remote_frame=bool(identifier & REMOTE), is_error_frame=bool(identifier & ERROR), channel=channel, dlc=length,
        data=packet[_HEADER.size :], is_fd=bool(flags & FD), is_rx=not flags & OWN, bitrate_switch=bool(flags & BRS),
        error_state_indicator=bool(flags & ESI),
    )  # fmt: skip


class UnixBus(can.BusABC):
    """A node on a channel.

    channel: a name, or the path of a socket. name: of this node, alone on its channel; None lets the hub make one up.
    with_hub: start the hub when there is none. fd: whether CAN FD frames may be sent. Filters are python-can's own.
    """

    _socket: socket.socket | None = None

    def __init__(self, channel: str = "hoap2", can_filters=None, receive_own_messages: bool = False,
                 name: str | None = None, with_hub: bool = True, fd: bool = True, **kwargs) -> None:  # fmt: skip
        path = socket_path(str(channel))
        if len((name or "").encode()) > 31:
            raise can.CanInitializationError("the name of a node has at most 31 bytes")
        self.channel_info = f"{NAME} channel {channel}"
        self._channel, self._fd = str(channel), fd
        self._can_protocol = can.CanProtocol.CAN_FD if fd else can.CanProtocol.CAN_20
        self._socket = join(path, name or "", receive_own_messages, with_hub)
        self._readable, self._writable = select.poll(), select.poll()
        self._readable.register(self._socket, select.POLLIN)
        self._writable.register(self._socket, select.POLLOUT)
        super().__init__(channel=channel, can_filters=can_filters, **kwargs)

    def fileno(self) -> int:
        return self._socket.fileno() if self._socket else -1

    def send(self, msg: can.Message, timeout: float | None = None) -> None:
        """Send; waits for room, at most timeout seconds (None: for ever)."""
        if msg.is_fd and not self._fd:
            raise can.CanOperationError("this node was opened without CAN FD (fd=False)")
        packet = pack(msg)
        while True:
            try:
                self._open().send(packet)
                return
            except BlockingIOError:
                if not self._writable.poll(None if timeout is None else 1e3 * timeout):
                    raise can.CanTimeoutError(f"the hub of {self._channel} took nothing for {timeout:g} s") from None
            except OSError as error:
                raise self._error(error) from None

    def _recv_internal(self, timeout: float | None) -> tuple[can.Message | None, bool]:
        while True:
            try:
                packet = self._open().recv(_LARGEST)
                break
            except BlockingIOError:
                if not self._readable.poll(None if timeout is None else 1e3 * timeout):
                    return None, False
            except OSError as error:
                raise self._error(error) from None
        if not packet:
            raise can.CanOperationError(f"the hub of {self._channel} has gone")
        return unpack(packet, self._channel), False

    def _open(self) -> socket.socket:
        if self._socket is None:
            raise can.CanOperationError(f"this node of {self._channel} is shut down")
        return self._socket

    def _error(self, error: OSError) -> can.CanOperationError:
        if error.errno in _GONE:
            return can.CanOperationError(f"the hub of {self._channel} has gone")
        if error.errno == errno.EINVAL:
            return can.CanOperationError("not a CAN frame")
        return can.CanOperationError(f"{self._channel}: {error.strerror}", error.errno)

    def shutdown(self) -> None:
        super().shutdown()
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    @staticmethod
    def _detect_available_configs() -> list[dict]:
        """Channels with a socket in the user's folder."""
        try:
            names = sorted(p.name for p in folder().iterdir() if p.is_socket())
        except (OSError, can.CanInitializationError):
            return []
        return [{"interface": NAME, "channel": name} for name in names]
