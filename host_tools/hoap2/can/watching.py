"""Looking at buses for the command line: reading until Ctrl-C, who sends what, what works here."""

from __future__ import annotations

import contextlib
import signal
import sys
from collections import defaultdict

import can

from hoap2.can import interfaces, traffic
from hoap2.can.messages import Messages


def say(text: str) -> None:
    """To the user, beside what the command prints."""
    print(f"hoap2 can: {text}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def until_stopped():
    """Ctrl-C and SIGTERM end the loop inside, with what was read so far kept."""

    def stop(*_) -> None:
        raise KeyboardInterrupt

    previous = signal.signal(signal.SIGTERM, stop)
    try:
        yield
    except KeyboardInterrupt:
        pass
    finally:
        signal.signal(signal.SIGTERM, previous)


@contextlib.contextmanager
def reading(interface: str, channels: list[str] | None, count: int | None, duration_s: float | None):
    buses = traffic.open_all(interface, channels)
    reader = traffic.Reader(buses, count, duration_s)
    try:
        yield reader
    finally:
        reader.stop()
        traffic.close_all(buses)
        if reader.lost:
            say(f"{reader.lost} frames came faster than they were handled, and are missing")


class Warner:
    """Says once of each sender that it speaks another protocol."""

    def __init__(self, messages: Messages) -> None:
        self.messages, self.told = messages, set()

    def look(self, message) -> None:
        protocol = self.messages.foreign_protocol(message)
        if protocol is not None and (protocol, message.arbitration_id) not in self.told:
            self.told.add((protocol, message.arbitration_id))
            say(f"{self.messages.name(message)} speaks protocol 0x{protocol:04X}, the DBC files are of "
                 f"0x{self.messages.protocol:04X}: take those of its version (--dbc); values may be wrong")  # fmt: skip


def show_interfaces() -> int:
    """Which interfaces work here, and their channels."""
    for name, why in interfaces.available().items():
        channels = [] if why else [str(c["channel"]) for c in can.detect_available_configs([name])
                                   if name in ("hoap2_unix", "socketcan")]  # fmt: skip
        print(f"{name:<14} {'-  ' + why if why else 'ok ' + interfaces.KNOWN[name][0]}")
        for channel in channels:
            print(f"{'':<14}    channel {channel}")
    return 0


def listen(interface: str, channel: list[str] | None, table: Messages, duration_s: float) -> int:
    """Who sends what, how often; 1 when nobody does."""
    tallies: dict[tuple, traffic.Tally] = defaultdict(traffic.Tally)
    names, warner = {}, Warner(table)
    with reading(interface, channel, None, duration_s) as reader, until_stopped():
        for message in reader:
            key = (str(message.channel), message.is_extended_id, message.arbitration_id)
            tallies[key].take(message, table.fault(message))
            names[key] = table.name(message) or "?"
            warner.look(message)
    if not tallies:
        say(f"nobody sent anything in {duration_s:g} s")
        return 1
    print(f"{'channel':<14} {'id':>8}  {'message':<22} {'bytes':<8} {'frames':>7} {'1/s':>8}")
    for key, tally in sorted(tallies.items()):
        lengths = ",".join(map(str, sorted(tally.lengths)))
        wrong = f"  {tally.faults} wrong" if tally.faults else ""
        identifier = f"{key[2]:08X}" if key[1] else f"{key[2]:03X}"
        counts = f"{tally.frames:7d} {tally.rate_hz:8.1f}{wrong}"
        print(f"{key[0]:<14} {identifier:>8}  {names[key]:<22} {lengths:<8} {counts}")
    return 0
