"""LCM URLs and connections: what is wrong with one is said in words before LCM says it in its own."""

from __future__ import annotations

import ipaddress
import os
import socket
from pathlib import Path
from urllib.parse import urlsplit

from hoap2.errors import UserError

DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
UDPM_PORT = 7667
PROVIDERS = ("udpm", "memq", "file")  # tcpq could make a run wait for its server
ROOM_BYTES = 4_000_000  # a second of messages at full rate
RMEM_MAX = Path("/proc/sys/net/core/rmem_max")


def url_or_default(url: str | None) -> str:
    """The URL given, else that of LCM_DEFAULT_URL, else multicast that stays on this machine."""
    return url or os.environ.get("LCM_DEFAULT_URL") or DEFAULT_URL


def hears(url: str | None) -> bool:
    """Can another process send something to this connection?"""
    return url is not None and url.partition("://")[0] == "udpm"


def check_url(url: str) -> None:
    """Raise UserError when no connection can be made with this URL, with what helps."""
    provider, separator, _ = url.partition("://")
    if not separator or provider not in PROVIDERS:
        raise UserError(f"not an LCM URL: {url!r}",
                        f"for example {DEFAULT_URL}, memq:// (one process) or file:///path/log.lcm?mode=w")  # fmt: skip
    if provider == "udpm":
        _check_group(url)


def _check_group(url: str) -> None:
    parts = urlsplit(url)
    try:
        group, port = ipaddress.IPv4Address(parts.hostname or "239.255.76.67"), parts.port or UDPM_PORT
    except ValueError as error:
        raise UserError(f"not an LCM URL: {url!r}: {error}", f"for example {DEFAULT_URL}") from None
    if not group.is_multicast:
        raise UserError(f"{url!r}: {group} is not a multicast address (224.0.0.0 to 239.255.255.255)",
                        f"for example {DEFAULT_URL}")  # fmt: skip
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect((str(group), port))
        except OSError as error:
            raise UserError(f"no multicast route to {group}: {error.strerror}",
                            f"this helps: sudo ip route add {group}/32 dev lo\n"
                            "or without multicast: --lcm file:///path/live.lcm?mode=w (a log), or memq:// within "
                            "one process") from None  # fmt: skip


def with_room(url: str) -> str:
    """The URL with the largest receive buffer that the system gives: a listener may have to wait for its turn."""
    if not url.startswith("udpm://") or "recv_buf_size" in url:
        return url
    try:
        allowed = int(RMEM_MAX.read_text())
    except (OSError, ValueError):
        return url
    return f"{url}{'&' if '?' in url else '?'}recv_buf_size={min(ROOM_BYTES, allowed)}"


def connect(url: str | None):
    """A connection (lcm.LCM) to this URL."""
    import lcm

    url = url_or_default(url)
    check_url(url)
    url = with_room(url)
    try:
        return lcm.LCM(url)
    except RuntimeError as error:
        raise UserError(f"cannot open {url}: {error}", _hint(url)) from None


def _hint(url: str) -> str:
    return "does its folder exist? to write: file:///path/log.lcm?mode=w" if url.startswith("file") else ""
