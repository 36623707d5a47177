"""Controller or plant as a process of its own: one end of the buses, stepped in step with the other or by the clock.

In lockstep each end ends its frames of a tick with a mark (a 29-bit frame, which no board listens to) and waits for
the other's; so the run is the same as `./hoap2 run --link can` without disturbances. Paced, both tick by the wall
clock and take what has come.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache

import can

from hoap2 import parameters
from hoap2.can import interfaces, traffic
from hoap2.can.ends import BoardsEnd, ControllerEnd
from hoap2.errors import UserError
from hoap2.generate import can_table

BOOT_TICKS = 4  # as in sim/can/link_state.cpp: switched on, exchanging, the robot not moving
MARK = {"controller": 0x1F0A5A30, "plant": 0x1F0A5A31}  # lowest priority; data: ticks done
HERE, BYE = 0, 0xFFFFFFFF  # instead of a number of ticks
OTHER = {"controller": "plant", "plant": "controller"}
SAFE_TICKS = 500  # what is still done after the other has gone: both sides show their safe modes
DOUBLED = 3
UNFIT = {"virtual": "does not leave the process", "slcan": "does not carry CAN FD: it has 8 bytes a frame"}


@dataclass(frozen=True)
class Options:
    """How the process is to run. pace: simulated over wall time, None for lockstep. timeout_s: silence of the other."""

    interface: str = "hoap2_unix"
    channels: tuple[str, ...] = ("right", "left")
    ticks: int = 1000
    pace: float | None = None
    wait_s: float = 30.0
    timeout_s: float = 2.0
    options: dict = field(default_factory=dict)


class Process:
    """One of the two. `run` returns why it ended: `done`, or what went wrong."""

    def __init__(self, side, name: str, wanted: Options, on_tick: Callable[[int], None] = lambda k: None,
                 stopped: Callable[[], bool] = lambda: False) -> None:  # fmt: skip
        self.side, self.name, self.wanted = side, name, wanted
        self.other = OTHER[name]
        self.on_tick, self.stopped = on_tick, stopped
        self.end = ControllerEnd(side) if name == "controller" else BoardsEnd(side)
        self.tick = -BOOT_TICKS
        self.frames = {"sent": 0, "received": 0}
        self.alone_since: int | None = None  # tick at which the other fell silent
        self._heard_s = time.monotonic()
        self._marked = [-BOOT_TICKS - 1, -BOOT_TICKS - 1]
        self._heard = self._other_ended = False
        buses = can_table.load().buses
        if len(wanted.channels) != len(buses) or len(set(wanted.channels)) != len(buses):
            raise UserError(f"the robot has {len(buses)} buses: give a --channel for {' and for '.join(buses)}",
                            "such as -c right -c left, or -c vcan0 -c vcan1")  # fmt: skip
        if wanted.interface in UNFIT:
            raise UserError(f"{wanted.interface} {UNFIT[wanted.interface]}", "hoap2_unix, socketcan, udp_multicast do")
        if wanted.interface == "udp_multicast" and len(set(map(interfaces.multicast_port, wanted.channels))) == 1:
            raise UserError("each UDP bus needs a port of its own: who listens on a port hears all its groups",
                            "such as -c 239.74.163.2:43113 -c 239.74.163.2:43114")  # fmt: skip
        self._buses = traffic.open_all(wanted.interface, list(wanted.channels), self._bus_options())

    def _bus_options(self) -> dict:
        own = {"name": self.name} if self.wanted.interface == "hoap2_unix" else {}
        return {**own, **self.wanted.options}

    def close(self) -> None:
        traffic.close_all(self._buses)

    def run(self) -> str:
        """Tick until the end; the plant starts moving when the controller has been heard."""
        return self._ticks() if self._wait_for_other() else "stopped"

    def _ticks(self) -> str:
        tick_s = parameters.table().tick_us * 1e-6
        started, first = time.monotonic(), self.tick
        while self.tick < self.wanted.ticks:
            if self.stopped():
                return "stopped"
            self._one_tick()
            if self.name == "controller" and self.end.health().state == DOUBLED:
                return "another controller is on the bus: this one is silent"
            if self.alone_since is not None and self.tick - self.alone_since >= SAFE_TICKS:
                how = "ended" if self._other_ended else "fell silent"
                return f"the {self.other} {how} at {self.alone_since * tick_s:.3f} s"
            if self._other_ended and self.wanted.pace is not None:
                break
            if self.wanted.pace is not None:
                due = started + (self.tick - first) * tick_s / self.wanted.pace
                time.sleep(max(0.0, due - time.monotonic()))
        for bus in range(len(self._buses)):
            self._tell(bus, BYE)
        return "done"

    def _one_tick(self) -> None:
        booting = self.tick < 0
        sends = self.end.begin() if self.name == "controller" else self.end.begin(booting)
        if self.name == "plant":
            self.end.finish()
        self._send(sends)
        if self.wanted.pace is None and self.alone_since is None:
            self._exchange_marks()
        else:
            self._drain()
        if self.name == "controller":
            self.end.finish()
        if not booting:
            self.on_tick(self.tick)
            self.side.step()
        self.tick += 1

    def _send(self, frames: list[tuple[int, can.Message]]) -> None:
        for bus, message in frames:
            traffic.send(self._buses[bus], message)
        self.frames["sent"] += len(frames)

    def _mark(self, bus: int) -> None:
        self._tell(bus, self.tick + BOOT_TICKS + 1)

    def _tell(self, bus: int, value: int) -> None:
        data = value.to_bytes(4, "little")
        traffic.send(self._buses[bus], can.Message(arbitration_id=MARK[self.name], is_extended_id=True, data=data))

    def _exchange_marks(self) -> None:
        for bus in range(len(self._buses)):
            self._mark(bus)
        deadline = time.monotonic() + self.wanted.timeout_s
        for bus in range(len(self._buses)):
            while self._marked[bus] < self.tick:
                left = deadline - time.monotonic()
                if left <= 0 or self._other_ended or not self._receive(bus, min(left, 0.2)) and self.stopped():
                    self.alone_since = self.tick
                    return

    def _drain(self) -> None:
        for bus in range(len(self._buses)):
            while self._receive(bus, 0.0):
                pass
        if self.alone_since is None and time.monotonic() - self._heard_s > self.wanted.timeout_s:
            self.alone_since = self.tick

    def _receive(self, bus: int, timeout_s: float) -> bool:
        try:
            message = self._buses[bus].recv(timeout_s)
        except (can.CanError, OSError) as error:
            raise UserError(f"the bus failed: {error}", exit_code=1) from None
        if message is None or message.is_error_frame:
            return message is not None
        if message.is_extended_id:
            if message.arbitration_id == MARK[self.other] and len(message.data) == 4:
                self._take_mark(bus, int.from_bytes(message.data, "little"))
            return True
        if self._own(message):
            return True
        self.frames["received"] += 1
        self._heard_s = time.monotonic()
        self.end.receive(bus, message)
        return True

    def _take_mark(self, bus: int, value: int) -> None:
        self._heard = True
        if value == BYE:
            self._other_ended = True
        else:
            self._marked[bus] = value - BOOT_TICKS - 1

    def _own(self, message: can.Message) -> bool:
        # python-can's UDP buses give a sender its own frames; on the others a frame of ours is a second controller's
        from_controller = message.arbitration_id in _of_controller()
        return self.wanted.interface == "udp_multicast" and from_controller == (self.name == "controller")

    def _wait_for_other(self) -> bool:
        """Say that this end is there until the other does so too; False when stopped meanwhile."""
        deadline = time.monotonic() + self.wanted.wait_s
        while not self._heard:
            if self.stopped():
                return False
            if time.monotonic() > deadline:
                where = f"{self.wanted.interface} {', '.join(self.wanted.channels)}"
                raise UserError(f"no {self.other} on {where} within {self.wanted.wait_s:g} s",
                                f"start ./hoap2 can {self.other} with the same scenario and channels", 1)  # fmt: skip
            for bus in range(len(self._buses)):
                self._tell(bus, HERE)
                while not self._heard and self._receive(bus, 0.1):
                    pass
        for bus in range(len(self._buses)):
            self._tell(bus, HERE)
        return True


@lru_cache(maxsize=1)
def _of_controller() -> frozenset[int]:
    """Identifiers that the controller sends."""
    return frozenset(f.identifier for f in can_table.load().frames if f.sender == "controller")
