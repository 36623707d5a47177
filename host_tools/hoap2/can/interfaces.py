"""python-can interfaces by name: which work on this machine, and opening one with an error that says what to do."""

from __future__ import annotations

import importlib.util
import socket
from collections.abc import Mapping
from pathlib import Path

import can

from hoap2 import paths
from hoap2.can import unix_bus
from hoap2.errors import UserError, nearest

CAN_LINK_TYPE = "280"  # ARPHRD_CAN
MULTICAST_CHANNEL, MULTICAST_PORT = "239.74.163.2", 43113
DEFAULT_CHANNELS = {"hoap2_unix": "hoap2", "socketcan": "vcan0", "udp_multicast": MULTICAST_CHANNEL, "virtual": "hoap2"}
# IPv6, and frames that leave the machine, are python-can's defaults; neither is wanted here.
OPTIONS = {
    "hoap2_unix": {"fd": True}, "socketcan": {"fd": True}, "udp_multicast": {"fd": True, "hop_limit": 0},
    "virtual": {"protocol": can.CanProtocol.CAN_FD},
}  # fmt: skip

can.interfaces.BACKENDS.setdefault(unix_bus.NAME, ("hoap2.can.unix_bus", "UnixBus"))


def can_devices() -> list[str]:
    """Network devices of the kernel that are CAN."""
    types = Path("/sys/class/net").glob("*/type")
    return sorted(t.parent.name for t in types if t.read_text().strip() == CAN_LINK_TYPE)


def _why_not_socketcan() -> str:
    try:
        socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
    except (OSError, AttributeError):
        return "this kernel has no CAN sockets (AF_CAN)"
    return "" if can_devices() else "no CAN device: ip link add dev vcan0 type vcan; ip link set vcan0 up"


def _why_not_multicast() -> str:
    if importlib.util.find_spec("msgpack") is None:
        return "msgpack is not installed"
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect((MULTICAST_CHANNEL, 9))
        except OSError:
            return f"no route for multicast: ip route add {MULTICAST_CHANNEL}/32 dev lo"
    return ""


def _why_not_slcan() -> str:
    return "" if importlib.util.find_spec("serial") else "pyserial is not installed"


def _why_not_unix() -> str:
    try:
        paths.built("host_tools/can/hoap2_can_hub")
    except UserError as error:
        return str(error)
    return ""


KNOWN = {
    "hoap2_unix": ("between processes of this machine, on AF_UNIX sockets", _why_not_unix),
    "socketcan": ("Linux CAN sockets", _why_not_socketcan),
    "udp_multicast": ("between processes, by UDP", _why_not_multicast),
    "slcan": ("a serial CAN adapter, or one behind socket://host:port; 8 bytes a frame", _why_not_slcan),
    "virtual": ("inside one process", lambda: ""),
}


def available() -> dict[str, str]:
    """Interface -> why it does not work here; an empty text when it does."""
    return {name: why_not() for name, (_, why_not) in KNOWN.items()}


def _works_here() -> str:
    return "these work here: " + ", ".join(name for name, why in available().items() if not why)


def multicast_port(channel: str) -> int:
    """The port of GROUP or GROUP:PORT."""
    _, colon, port = channel.partition(":")
    if colon and not (port.isdecimal() and 0 < int(port) < 65536):
        raise UserError(f"'{channel}' is not GROUP:PORT", f"such as {MULTICAST_CHANNEL}:{MULTICAST_PORT}")
    return int(port) if colon else MULTICAST_PORT


def open_bus(interface: str, channel: str | None = None, options: Mapping[str, object] | None = None) -> can.BusABC:
    """A node on a bus of any interface of python-can; CAN FD where the interface has it.

    UserError: unknown interface, no such bus, or this machine cannot; the hint lists what works.
    """
    if interface not in can.interfaces.BACKENDS:
        raise UserError(f"python-can has no interface '{interface}'",
                        nearest(interface, can.interfaces.BACKENDS) or _works_here())  # fmt: skip
    channel = channel or DEFAULT_CHANNELS.get(interface)
    if channel is None:
        raise UserError(f"interface {interface} needs --channel", "for slcan: a serial device, or socket://host:port")
    why = KNOWN[interface][1]() if interface in KNOWN else ""
    if why:
        raise UserError(f"{interface} does not work here: {why}", _works_here())
    arguments = {**OPTIONS.get(interface, {}), **(options or {})}
    if interface == "udp_multicast":
        arguments["port"], channel = multicast_port(channel), channel.partition(":")[0]
    try:
        return can.Bus(interface=interface, channel=channel, ignore_config=True, **arguments)
    except (can.CanError, OSError, ValueError, TypeError, ImportError) as error:
        there = f"CAN devices: {', '.join(can_devices())}" if interface == "socketcan" else _works_here()
        raise UserError(f"cannot open {interface} channel {channel}: {error}", there) from None
