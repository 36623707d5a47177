"""Takes the commands to a run: checks, carries out, answers and records each one.

A command is carried out between two ticks: what it sets, the next tick uses. Which tick that was stands in its
answer, in the run's events and in summary.json.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from hoap2 import parameters
from hoap2.errors import UserError
from hoap2.fmu.archive import FmuError
from hoap2.signal_log import SignalLog
from hoap2.telemetry import types
from hoap2.telemetry.command_kinds import STEP_INPUTS, WALKS, Command, Refused, check, links, of_message
from hoap2.telemetry.listen import Listener
from hoap2.telemetry.run_telemetry import RunTelemetry
from hoap2.wiring import Side

MOST_A_SECOND = 20
MOST_ANSWERED_TOO_FAST = 5  # a second; a flood must not fill the log
KEPT_IDS = 100_000  # an id is refused as repeated for so many commands
SAFE_MODES = ("hold", "crouch", "safe")  # after a fault that ended the walk
TO_COME = ("start_up", "calibrate")


class Rate:
    """So many a second, saved up for at most one second."""

    def __init__(self, most: int, now_s: Callable[[], float]) -> None:
        self._most, self._now_s = most, now_s
        self._left, self._at_s = float(most), now_s()

    def takes(self) -> bool:
        now_s = self._now_s()
        self._left = min(self._most, self._left + (now_s - self._at_s) * self._most)
        self._at_s = now_s
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True


@dataclass
class Robot:
    """What a command can act on, and what was set there so far."""

    controller: Side
    plant: Side
    step: dict[str, float]  # requested step by name of the command; begins as the scenario's
    walk: str = "as_planned"
    push_end: int | None = None  # tick at which the push ends

    def give(self, product: str, name: str, value) -> None:
        """Set an operator's input, or Refused where this product has none."""
        side = getattr(self, product)
        first = parameters.table().element_names(parameters.operator_inputs(product)[name])[0]
        if not hasattr(side, "set_input") or first not in {c.name for c in side.inputs}:
            raise Refused(f"this {product} has no input {name}")
        side.set_input(name, value)


@dataclass
class CommandDesk:
    """The master's `commands`: see hoap2.master.Commands."""

    controller: Side
    plant: Side
    run_id: int
    telemetry: RunTelemetry
    values: parameters.Values
    listener: Listener | None = None  # None: whoever calls `take` is asked by hand
    now_s: Callable[[], float] = time.monotonic
    record: list[dict] = field(default_factory=list)  # of each command that was judged
    too_fast: int = 0  # not even answered

    def __post_init__(self) -> None:
        planned = self.values["controller"]
        names = {"length_m": "step_length_m", "sideways_m": "step_sideways_m", "turn_rad": "step_turn_rad"}
        self.robot = Robot(self.controller, self.plant, {n: planned[p][0] for n, p in names.items()})
        self._rate = Rate(MOST_A_SECOND, self.now_s)
        self._answers = Rate(MOST_ANSWERED_TOO_FAST, self.now_s)
        self._seen: dict[int, None] = {}
        self._log: SignalLog | None = None
        self._tick = self._request_state = 0
        self._acts = {"walk": self._walk, "step": self._step, "push": self._push, "set": self._set}

    def open(self, log: SignalLog) -> None:
        """The rows of the run, of which the last one tells how the robot is."""
        self._log = log

    def poll(self, tick: int) -> int | None:
        """Take what has come; the tick at which this must be called again at the latest."""
        self._tick, robot = tick, self.robot
        if robot.push_end is not None and tick >= robot.push_end:
            robot.push_end = None
            robot.give("plant", "push_now_force_W_N", [0.0, 0.0, 0.0])
        self._tell_request_state()
        if self.listener is not None:
            self.listener.poll(0.0)
        return robot.push_end

    def take(self, _channel: str, message) -> None:
        """Judge one command, carry it out if it is good, answer."""
        command = of_message(message)
        if not self._rate.takes():
            if self._answers.takes():
                self._answer(command, f"too fast: at most {MOST_A_SECOND} commands a second")
            else:
                self.too_fast += 1
            return
        try:
            self._refuse_strangers(message.run_id, command)
            check(command)
            self._answer(command, None, self._acts[command.kind](command))
        except Refused as refused:
            self._answer(command, str(refused))

    def notes(self) -> list[str]:
        """For the summary: what the user should know."""
        said = []
        taken = sum(entry["accepted"] for entry in self.record)
        if self.record:
            said.append(f"{taken} of {len(self.record)} commands were taken; what they asked is in summary.json, "
                        "run.toml alone does not repeat this run")  # fmt: skip
        if self.too_fast:
            said.append(f"{self.too_fast} commands came too fast to be answered")
        counter = None if self.listener is None else self.listener.counters.get(types.COMMAND)
        if counter is not None and (counter.malformed or counter.foreign):
            said.append(f"on {types.COMMAND}: {counter.malformed} malformed and {counter.foreign} foreign packets")
        return said

    def close(self) -> None:
        if self.listener is not None:
            self.listener.close()

    def _refuse_strangers(self, run_id: int, command: Command) -> None:
        if run_id != self.run_id:
            raise Refused(f"for run {run_id}; this is run {self.run_id}")
        if command.command_id in self._seen:
            raise Refused(f"command {command.command_id} was here already: replayed, or an id used twice")
        self._seen[command.command_id] = None
        if len(self._seen) > KEPT_IDS:
            del self._seen[next(iter(self._seen))]

    def _answer(self, command: Command, refusal: str | None, remark: str = "") -> None:
        accepted = refusal is None
        reason = remark if accepted else refusal
        message = types.type_of(types.ANSWER)()
        message.command_id, message.accepted, message.reason = command.command_id, int(accepted), reason
        message.kind, message.name = command.kind, command.name
        message.value = list(command.value)
        message.n = len(message.value)
        self.telemetry.send(types.ANSWER, message)
        text = f"{command}" + (f" (from {command.sender})" if command.sender else "") + (f": {reason}" if reason else "")
        self.telemetry.event("command_accepted" if accepted else "command_refused", text)
        self.record.append({"tick": self._tick, "kind": command.kind, "name": command.name,
                            "value": list(command.value), "accepted": accepted, "reason": reason,
                            "sender": command.sender})  # fmt: skip

    # --- what each kind does; the remark that goes with the acceptance is returned ---

    def _now(self, name: str) -> int | None:
        """An int of the robot's last row."""
        return int(self._log.column(name)[-1]) if self._log is not None and name in self._log else None

    def _tell_request_state(self) -> None:
        """What the controller itself makes of the request: it may find a step out of reach, or no walk possible."""
        state = self._now("c.request_state")
        if state is None or state == self._request_state:
            return
        self._request_state = state
        said = parameters.table().enums["request_state"][state]
        self.telemetry.event("note", f"the controller says of the walk request: {said}")

    def _mode(self) -> str:
        mode, modes = self._now("c.mode"), parameters.table().enums["mode"]
        return modes[mode] if mode is not None and 0 <= mode < len(modes) else ""

    def _refuse_after_a_fault(self) -> None:
        if self._mode() not in SAFE_MODES:
            return
        word = self._now("c.fault") or 0
        faults = [name for name, bit in parameters.table().faults.items() if word & bit]
        raise Refused(f"the robot does not walk any more: mode {self._mode()} after {', '.join(faults) or 'a fault'}")

    def _give_step(self) -> None:
        for name, signal in STEP_INPUTS.items():
            self.robot.give("controller", signal, self.robot.step[name])

    def _walk(self, command: Command) -> str:
        self._refuse_after_a_fault()
        mode = self._mode()
        if command.name == "stop" and mode == "stand":
            raise Refused("the robot stands already")
        self._give_step()
        wanted = WALKS[command.name]
        self.robot.give("controller", "walk_request", parameters.table().enums["walk_request"].index(wanted))
        self.robot.walk = wanted
        return "when the robot is calibrated" if mode in TO_COME and wanted == "walk" else ""

    def _step(self, command: Command) -> str:
        self._refuse_after_a_fault()
        before = dict(self.robot.step)
        self.robot.step[command.name] = command.value[0]
        try:
            self._give_step()
        except Refused:
            self.robot.step = before
            raise
        return "" if self.robot.walk == "walk" else "kept for a walk on request: walk start"

    def _push(self, command: Command) -> str:
        *force, duration_s = command.value
        ticks = max(1, round(duration_s * 1e6 / parameters.table().tick_us))
        self.robot.give("plant", "push_now_link", links().index(command.name))
        self.robot.give("plant", "push_now_point_L_m", [0.0, 0.0, 0.0])
        self.robot.give("plant", "push_now_force_W_N", force)
        remark = "in place of the push under way" if self.robot.push_end is not None else ""
        self.robot.push_end = self._tick + ticks
        return remark

    def _set(self, command: Command) -> str:
        if not hasattr(self.controller, "set_parameters"):
            raise Refused("the parameters of this controller cannot be changed")
        value = command.value[0] if len(command.value) == 1 else list(command.value)
        try:
            self.controller.set_parameters({command.name: value})
        except (FmuError, UserError) as error:
            raise Refused(str(error).rpartition("parameters refused: ")[2]) from None
        return ""


def listening(products, run_id: int, telemetry: RunTelemetry, values: parameters.Values, url: str | None) -> CommandDesk:
    """A desk that hears the commands on this connection. products: hoap2.products.Products."""
    desk = CommandDesk(products.controller, products.plant, run_id, telemetry, values)
    desk.listener = Listener(url, [types.COMMAND], desk.take)
    return desk
