"""`can`: the buses of the robot between processes: look, send, log, replay, find."""

from __future__ import annotations

import time
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


def _line(message, name: str, tail: str) -> str:
    identifier = f"{message.arbitration_id:08X}" if message.is_extended_id else f"{message.arbitration_id:03X}"
    head = f"{message.timestamp:17.6f}  {message.channel}  {identifier:>8}  [{message.dlc:2d}]"
    return f"{head}  {name:<22} {tail}".rstrip()


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
    from hoap2.can.watching import Warner, reading, until_stopped

    table = messages.load(dbc)
    warner, wanted = Warner(table), set(only or [])
    unknown = [w for w in wanted if w not in table.by_name and not _is_identifier(w)]
    if unknown:
        raise table.unknown(unknown[0])
    with reading(interface, channel, count, duration) as reader, until_stopped():
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
    from hoap2.can import messages, traffic

    frames = messages.rounds(frame, dbc)
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
    from hoap2.can.watching import reading, say, until_stopped
    from hoap2.errors import UserError

    if file.exists() and not force:
        raise UserError(f"{file} is there already", "another name, or --force")
    frames = 0
    with reading(interface, channel, count, duration) as reader:
        out = traffic.writer(file)
        try:
            with until_stopped():
                for message in reader:
                    out.on_message_received(message)
                    frames += 1
        finally:
            out.stop()
    say(f"{frames} frames in {file}")
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
    from hoap2.can.watching import say
    from hoap2.errors import UserError

    if not file.exists():
        raise UserError(f"no file {file}")
    buses = traffic.open_all(interface, channel)
    names = dict(zip(channel or [], buses))
    try:
        started = time.monotonic()
        sent = traffic.play(traffic.read_log(file),
                            lambda m: buses[0] if len(buses) == 1 else names.get(str(m.channel)), speed)  # fmt: skip
        say(f"{sent} frames in {time.monotonic() - started:.2f} s")
    finally:
        traffic.close_all(buses)
    return 0


@app.command()
def scan(
    interface: Annotated[str | None, typer.Option("--interface", "-i", help="Without: what works here.")] = None,
    channel: Channels = None,
    messages: Annotated[bool, typer.Option("--messages", help="List the messages of the DBC files.")] = False,
    dbc: Dbc = None,
    duration: Annotated[float, typer.Option("--duration", min=0.0, metavar="S", help="Listen so long.")] = 2.0,
) -> int:
    """What is there: interfaces that work here and their channels; or, with -i, who sends what, how often."""
    from hoap2.can import messages as tables
    from hoap2.can import watching

    if messages:
        for layout in tables.load(dbc).by_name.values():
            print(f"{layout.frame_id:03X}  {layout.name:<22} [{layout.length:2d}]  {layout.comment or ''}".rstrip())
        return 0
    if interface is None:
        return watching.show_interfaces()
    return watching.listen(interface, channel, tables.load(dbc), duration)


@app.command()
def hub(channel: Annotated[str, typer.Argument(help="Name, or path of the socket.")] = "hoap2") -> int:
    """Run the hub of a hoap2_unix channel until Ctrl-C. Without it, the first node starts one in the background."""
    import subprocess

    from hoap2 import paths
    from hoap2.can import unix_bus
    from hoap2.can.watching import say, until_stopped
    from hoap2.errors import UserError

    path = unix_bus.socket_path(channel)
    say(f"hub of {path}; Ctrl-C ends it")
    process = subprocess.Popen([str(paths.built("host_tools/can/hoap2_can_hub")), path])
    with until_stopped():
        code = process.wait()
        if code == unix_bus.HUB_RUNS:
            raise UserError(f"{path} has a hub already", "nothing to do: nodes can join it")
        return code
    process.terminate()
    return process.wait()


Scenario = Annotated[str, typer.Argument(metavar="SCENARIO", help="As of `run`; the same on both sides.")]
Sets = Annotated[list[str] | None, typer.Option("--set", metavar="A.B=VALUE", help="As of `run`.")]
Seed = Annotated[int, typer.Option(min=0, help="As of `run`.")]
Pace = Annotated[
    float | None, typer.Option("--pace", min=1e-3, help="By the clock, so many times real time; without: in lockstep.")
]
Wait = Annotated[float, typer.Option("--wait", min=0.0, metavar="S", help="For the other to appear.")]
Timeout = Annotated[float, typer.Option("--timeout", min=0.01, metavar="S", help="Silence after which it has gone.")]
Out = Annotated[Path | None, typer.Option("--out", metavar="FILE", help="Its signals, as signals.parquet of a run.")]


@app.command()
def controller(scenario: Scenario = "floor-walk", interface: Interface = UNIX, channel: Channels = None,
               overrides: Sets = None, seed: Seed = 0, duration: Duration = None, pace: Pace = None,
               wait: Wait = 30.0, timeout: Timeout = 2.0, out: Out = None) -> int:  # fmt: skip
    """The controller as a process: its frames on two buses. Start `can plant` with the same scenario beside it.

    Exit code: 0 done, 1 the plant fell silent or another controller is on the bus, 130 stopped.
    """
    from hoap2.can import process_run

    request = process_run.Request("controller", scenario, tuple(overrides or ()), seed, duration, out)
    return process_run.run(request, interface, channel, pace, wait, timeout)


@app.command()
def plant(scenario: Scenario = "floor-walk", interface: Interface = UNIX, channel: Channels = None,
          overrides: Sets = None, seed: Seed = 0, duration: Duration = None, pace: Pace = None,
          wait: Wait = 30.0, timeout: Timeout = 2.0, out: Out = None) -> int:  # fmt: skip
    """Robot, drives and boards as a process, beside `can controller`.

    Exit code: 0 done and not fallen, 1 fell or the controller fell silent, 130 stopped.
    """
    from hoap2.can import process_run

    request = process_run.Request("plant", scenario, tuple(overrides or ()), seed, duration, out)
    return process_run.run(request, interface, channel, pace, wait, timeout)
