"""`can`: the buses of the robot between processes: look, send, log, replay, find."""

from __future__ import annotations

import contextlib
import signal
import sys
import time
from collections import defaultdict
from pathlib import Path
from typing import Annotated

import typer

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    help="CAN buses by python-can's interfaces: look at them, send, log, replay. `can scan` lists what works here.",
)
Interface = Annotated[str, typer.Option("--interface", "-i", help="hoap2_unix, socketcan, udp_multicast, slcan, ...")]
Channels = Annotated[list[str] | None, typer.Option("--channel", "-c", help="Bus, such as vcan0; repeat for more.")]
Dbc = Annotated[list[Path] | None, typer.Option("--dbc", help="DBC files instead of the generated ones.")]
Count = Annotated[int | None, typer.Option("--count", "-n", min=1, help="End after so many frames.")]
Duration = Annotated[float | None, typer.Option("--duration", min=0.0, metavar="S", help="End after so many seconds.")]
UNIX = "hoap2_unix"


def _say(text: str) -> None:
    print(f"hoap2 can: {text}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def _until_stopped():
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
def _reading(interface: str, channels: list[str] | None, count: int | None, duration_s: float | None):
    from hoap2.can import traffic

    buses = traffic.open_all(interface, channels)
    reader = traffic.Reader(buses, count, duration_s)
    try:
        yield reader
    finally:
        reader.stop()
        traffic.close_all(buses)
        if reader.lost:
            _say(f"{reader.lost} frames came faster than they were handled, and are missing")


def _line(message, name: str, tail: str) -> str:
    identifier = f"{message.arbitration_id:08X}" if message.is_extended_id else f"{message.arbitration_id:03X}"
    head = f"{message.timestamp:17.6f}  {message.channel}  {identifier:>8}  [{message.dlc:2d}]"
    return f"{head}  {name:<22} {tail}".rstrip()


class _Warner:
    """Says once of each sender that it speaks another protocol."""

    def __init__(self, messages) -> None:
        self.messages, self.told = messages, set()

    def look(self, message) -> None:
        protocol = self.messages.foreign_protocol(message)
        if protocol is not None and (protocol, message.arbitration_id) not in self.told:
            self.told.add((protocol, message.arbitration_id))
            _say(f"{self.messages.name(message)} speaks protocol 0x{protocol:04X}, the DBC files are of "
                 f"0x{self.messages.protocol:04X}: take those of its version (--dbc); values may be wrong")  # fmt: skip


@app.command()
def dump(
    interface: Interface = UNIX,
    channel: Channels = None,
    only: Annotated[list[str] | None, typer.Option("--only", metavar="NAME|ID", help="Only these messages.")] = None,
    raw: Annotated[bool, typer.Option("--raw", help="Bytes, not values.")] = False,
    dbc: Dbc = None,
    count: Count = None,
    duration: Duration = None,
) -> int:
    """Show frames as they come, decoded by name and unit."""
    from hoap2.can import messages

    table = messages.load(dbc)
    warner, wanted = _Warner(table), set(only or [])
    unknown = [w for w in wanted if w not in table.by_name and not _is_identifier(w)]
    if unknown:
        raise table.unknown(unknown[0])
    with _reading(interface, channel, count, duration) as reader, _until_stopped():
        for message in reader:
            name = table.name(message)
            if wanted and name not in wanted and f"{message.arbitration_id:03X}" not in {w.upper() for w in wanted}:
                continue
            warner.look(message)
            fault = table.fault(message)
            values = "" if raw else ", ".join(map(str, table.values(message)))
            print(_line(message, name, f"({fault}) {bytes(message.data).hex(' ')}" if fault else values or
                        bytes(message.data).hex(" ")), flush=True)  # fmt: skip
    return 0


def _is_identifier(text: str) -> bool:
    try:
        return int(text, 16) >= 0
    except ValueError:
        return False


@app.command()
def send(
    frame: Annotated[list[str], typer.Argument(help="061#DEADBEEF, 061##1... (CAN FD), or NAME signal=value ...")],
    interface: Interface = UNIX,
    channel: Annotated[str | None, typer.Option("--channel", "-c", help="Bus.")] = None,
    count: Annotated[int, typer.Option("--count", "-n", min=1, help="So many times; our counter goes on.")] = 1,
    period: Annotated[float, typer.Option("--period", min=0.0, metavar="S", help="Time between two.")] = 0.01,
    dbc: Dbc = None,
) -> int:
    """Send frames: in candump's notation, or one by name, its CRC and protocol filled in."""
    from hoap2.can import traffic

    frames = _frames(frame, count, dbc)
    (bus,) = traffic.open_all(interface, [channel] if channel else None)
    try:
        for i in range(count):
            if i:
                time.sleep(period)
            for message in frames(i):
                traffic.send(bus, message)
    finally:
        bus.shutdown()
    return 0


def _frames(words: list[str], count: int, dbc: list[Path] | None):
    """Round number -> its frames."""
    from hoap2.can import messages
    from hoap2.errors import UserError

    if "#" in words[0]:
        parsed = [messages.parse(word) for word in words]
        return lambda _i: parsed
    table, values = messages.load(dbc), {}
    for word in words[1:]:
        name, equals, value = word.partition("=")
        if not equals:
            raise UserError(f"'{word}' is not signal=value")
        try:
            values[name] = float(value)
        except ValueError:
            values[name] = value  # a word of the DBC's value table
    first = values.get(messages.COUNTER, 0)

    def numbered(i: int):
        own = messages.COUNTER in [s.name for s in table.by_name[words[0]].signals]
        return [table.encode(words[0], {**values, messages.COUNTER: (first + i) % 256} if own else values)]

    table.encode(words[0], values)  # before the bus is opened
    return numbered


@app.command()
def log(
    file: Annotated[Path, typer.Argument(help=".log is candump's format; or .asc, .blf, .csv, .trc.")],
    interface: Interface = UNIX,
    channel: Channels = None,
    count: Count = None,
    duration: Duration = None,
    force: Annotated[bool, typer.Option("--force", help="Write over a file that is there.")] = False,
) -> int:
    """Write what comes into a file, until Ctrl-C, --count or --duration."""
    from hoap2.can import traffic
    from hoap2.errors import UserError

    if file.exists() and not force:
        raise UserError(f"{file} is there already", "another name, or --force")
    frames = 0
    with _reading(interface, channel, count, duration) as reader:
        out = traffic.writer(file)
        try:
            with _until_stopped():
                for message in reader:
                    out.on_message_received(message)
                    frames += 1
        finally:
            out.stop()
    _say(f"{frames} frames in {file}")
    return 0


@app.command()
def replay(
    file: Annotated[Path, typer.Argument(help="A log of `can log`, candump -L or python-can.")],
    interface: Interface = UNIX,
    channel: Channels = None,
    speed: Annotated[float, typer.Option("--speed", min=0.0, help="Times as fast; 0: as fast as possible.")] = 1.0,
) -> int:
    """Send the frames of a log again, at their times.

    With one channel all go there; with several, each goes to the channel that it was logged from.
    """
    from hoap2.can import traffic
    from hoap2.errors import UserError

    if not file.exists():
        raise UserError(f"no file {file}")
    buses = traffic.open_all(interface, channel)
    names = dict(zip(channel or [], buses))
    try:
        started = time.monotonic()
        sent = traffic.play(traffic.read_log(file),
                            lambda m: buses[0] if len(buses) == 1 else names.get(str(m.channel)), speed)  # fmt: skip
        _say(f"{sent} frames in {time.monotonic() - started:.2f} s")
    finally:
        traffic.close_all(buses)
    return 0


@app.command()
def scan(
    interface: Annotated[str | None, typer.Option("--interface", "-i", help="Listen; without: what works here.")] = None,
    channel: Channels = None,
    messages: Annotated[bool, typer.Option("--messages", help="List the messages of the DBC files.")] = False,
    dbc: Dbc = None,
    duration: Annotated[float, typer.Option("--duration", min=0.0, metavar="S", help="Listen so long.")] = 2.0,
) -> int:
    """What is there: interfaces that work here and their channels; or, with -i, who sends what, how often."""
    from hoap2.can import messages as tables

    if messages:
        for layout in tables.load(dbc).by_name.values():
            print(f"{layout.frame_id:03X}  {layout.name:<22} [{layout.length:2d}]  {layout.comment or ''}".rstrip())
        return 0
    if interface is None:
        return _show_interfaces()
    return _listen(interface, channel, tables.load(dbc), duration)


def _show_interfaces() -> int:
    import can

    from hoap2.can import interfaces

    for name, why in interfaces.available().items():
        channels = [] if why else [str(c["channel"]) for c in can.detect_available_configs([name])
                                   if name in (UNIX, "socketcan")]  # fmt: skip
        print(f"{name:<14} {'-  ' + why if why else 'ok ' + interfaces.KNOWN[name][0]}")
        for channel in channels:
            print(f"{'':<14}    channel {channel}")
    return 0


def _listen(interface: str, channel: list[str] | None, table, duration_s: float) -> int:
    from hoap2.can import traffic

    tallies: dict[tuple, traffic.Tally] = defaultdict(traffic.Tally)
    names, warner = {}, _Warner(table)
    with _reading(interface, channel, None, duration_s) as reader, _until_stopped():
        for message in reader:
            key = (str(message.channel), message.is_extended_id, message.arbitration_id)
            tallies[key].take(message, table.fault(message))
            names[key] = table.name(message) or "?"
            warner.look(message)
    if not tallies:
        _say(f"nobody sent anything in {duration_s:g} s")
        return 1
    print(f"{'channel':<14} {'id':>8}  {'message':<22} {'bytes':<8} {'frames':>7} {'1/s':>8}")
    for key, tally in sorted(tallies.items()):
        lengths = ",".join(map(str, sorted(tally.lengths)))
        wrong = f"  {tally.faults} wrong" if tally.faults else ""
        identifier = f"{key[2]:08X}" if key[1] else f"{key[2]:03X}"
        counts = f"{tally.frames:7d} {tally.rate_hz:8.1f}{wrong}"
        print(f"{key[0]:<14} {identifier:>8}  {names[key]:<22} {lengths:<8} {counts}")
    return 0


@app.command()
def hub(channel: Annotated[str, typer.Argument(help="Name, or path of the socket.")] = "hoap2") -> int:
    """Run the hub of a hoap2_unix channel until Ctrl-C. Without it, the first node starts one in the background."""
    import subprocess

    from hoap2 import paths
    from hoap2.can import unix_bus
    from hoap2.errors import UserError

    path = unix_bus.socket_path(channel)
    _say(f"hub of {path}; Ctrl-C ends it")
    process = subprocess.Popen([str(paths.built("host_tools/can/hoap2_can_hub")), path])
    with _until_stopped():
        code = process.wait()
        if code == unix_bus.HUB_RUNS:
            raise UserError(f"{path} has a hub already", "nothing to do: nodes can join it")
        return code
    process.terminate()
    return process.wait()
