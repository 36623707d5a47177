"""The monitor in the terminal: redraws what a run publishes until it is told to stop."""

from __future__ import annotations

import contextlib
import select
import sys
import time
from collections.abc import Iterator

from rich.console import Console, Group
from rich.layout import Layout
from rich.live import Live
from rich.text import Text

from hoap2.monitor import terminal_panels as panels
from hoap2.monitor.terminal_view import View

FRAMES_A_SECOND = 10
MIDDLE = 96  # columns from which on drawings and numbers stand side by side
NUMBERS = 52  # width of the numbers when the joints stand beside them
BESIDE = 86  # that and the least for the joints
JOINT_ROWS = 28  # of the panel with all of them
KEYS = "q quit   space hold the picture   Ctrl-C quit"


def frame(view: View, width: int, height: int):
    """One picture for a terminal of this size."""
    if view.run_id is None:
        return panels.nobody(view)
    body = height - 2
    layout = Layout()
    layout.split_column(Layout(panels.header(view), size=1), Layout(name="body"),
                        Layout(Text(KEYS, "bright_black", no_wrap=True, overflow="ellipsis"), size=1))  # fmt: skip
    if width >= MIDDLE:
        left = min(46, width // 3)
        layout["body"].split_row(Layout(_drawings(view, left, body), size=left + 4), *_numbers(view, width - left - 4, body))
    else:
        layout["body"].update(_narrow(view, width, body))
    return layout


def _drawings(view: View, width: int, body: int):
    rows = max(4, body - 9)
    sky = max(3, min(15, rows // 3))
    return Group(panels.attitude(view, width, sky), panels.feet(view, width, max(3, rows - sky - 1)))


def _numbers(view: View, width: int, body: int) -> list[Layout]:
    """A column of numbers; where there is room, one for the joints beside it, with the events below them."""
    beside, events_beside = width >= BESIDE, width >= BESIDE and body >= JOINT_ROWS + 5
    parts = [Layout(panels.gait_numbers(view), size=15)]
    health_rows = min(16, body - 15 - (0 if events_beside else 6))
    if health_rows >= 6:
        parts.append(Layout(panels.health(view), size=health_rows))
    left = body - 15 - max(0, health_rows)
    parts.append(Layout(panels.steering(view) if events_beside else panels.events(view, left - 2)))
    column = Layout()
    column.split_column(*parts)
    if not beside:
        return [column]
    joint_rows = JOINT_ROWS if events_beside else body
    right = Layout(size=width - NUMBERS)
    joints = [Layout(panels.joints(view, width - NUMBERS, joint_rows - 2), size=joint_rows)]
    if events_beside:
        joints.append(Layout(panels.events(view, body - joint_rows - 2)))
    right.split_column(*joints)
    return [column, right]


def _narrow(view: View, width: int, body: int):
    """What matters most first; a terminal that is too low cuts off the rest."""
    parts = [(panels.gait_numbers(view), 13), (panels.attitude(view, width - 4, 0), 4),
             (panels.feet(view, min(50, width - 4), 10), 14)]  # fmt: skip
    shown = []
    for part, rows in parts:
        if not shown or body >= rows:
            shown.append(part)
            body -= rows
    if body >= 4:
        rows = min(8, body - 2)
        shown.append(panels.events(view, rows))
        body -= rows + 2
    for part, rows in ((panels.health(view), 16), (panels.joints(view, width, 13), 15)):
        if body >= rows:
            shown.append(part)
            body -= rows
    return Group(*shown)


@contextlib.contextmanager
def keys() -> Iterator[object]:
    """A function that returns the key that was hit, or "". Without a terminal nobody hits one."""
    if not sys.stdin.isatty():
        yield lambda: ""
        return
    import termios
    import tty

    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        yield lambda: sys.stdin.read(1) if select.select([sys.stdin], [], [], 0.0)[0] else ""
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def watch(url: str | None, console: Console) -> int:
    """Until q or Ctrl-C."""
    view, held = View(url), False
    try:
        with keys() as key, Live(console=console, screen=True, auto_refresh=False) as live:
            due = time.monotonic()
            while True:
                view.poll(max(0.0, min(0.1, due - time.monotonic())))
                hit = key()
                if hit in ("q", "Q", "\x1b"):
                    return 0
                held = held != (hit == " ")
                if time.monotonic() >= due:
                    due = time.monotonic() + 1.0 / FRAMES_A_SECOND
                    if not held:
                        live.update(frame(view, *console.size), refresh=True)
    except KeyboardInterrupt:
        return 0
    finally:
        view.close()


def once(url: str | None, console: Console, timeout_s: float) -> int:
    """One picture, when there is something of everything; 1 when no run is heard."""
    view = View(url)
    try:
        end = time.monotonic() + timeout_s
        while not (view.complete and view.rates) and time.monotonic() < end:
            view.poll(0.1)
        height = max(console.height, 25)
        console.print(frame(view, console.width, height), height=height if view.run_id is not None else None)
        return 0 if view.run_id is not None else 1
    finally:
        view.close()
