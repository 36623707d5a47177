"""Commands to a run: what is taken, what is refused and why, and what it does to the robot."""

from __future__ import annotations

import math

import numpy as np
import pytest
import rig
from sides import FakeSide, standing_plant, stepping_controller

from hoap2 import parameters
from hoap2.signal_log import SignalLog
from hoap2.telemetry import command_kinds, types
from hoap2.telemetry.command_desk import KEPT_IDS, MOST_A_SECOND, CommandDesk
from hoap2.telemetry.listen import Listener
from hoap2.wiring import log_columns


class Asked(FakeSide):
    """A side that keeps what was set on it, and refuses a gain of 13."""

    def __init__(self, product: str, script=None) -> None:
        super().__init__(product, script)
        self.given: dict[str, object] = {}

    def set_input(self, name, value):
        self.given[name] = value

    def set_parameters(self, values):
        from hoap2.fmu.archive import FmuCallError

        if 13.0 in values.values():
            raise FmuCallError("parameters refused: they do not go together")
        self.given |= values


class Telemetry:
    """Keeps what a desk says."""

    def __init__(self) -> None:
        self.answers, self.events = [], []

    def send(self, channel, message, tick=-1, where=3):
        assert channel == types.ANSWER
        self.answers.append(type(message).decode(message.encode()))

    def event(self, kind, text, tick=-1):
        self.events.append((kind, text))


class Desk(CommandDesk):
    """A desk without a network; the robot is in a mode, and the wall clock stands until it is moved."""

    def __init__(self, mode: str = "stand", fault: str | None = None) -> None:
        self.clock_s, self._next_id = 0.0, 0
        super().__init__(Asked("controller"), Asked("plant"), rig.RUN_ID, Telemetry(), parameters.defaults(),
                         now_s=lambda: self.clock_s)  # fmt: skip
        log = SignalLog(log_columns(self.controller, self.plant), 10)
        log.count = 1
        log.column("c.mode")[:] = parameters.table().enums["mode"].index(mode)
        log.column("c.fault")[:] = parameters.table().faults[fault] if fault else 0
        log.column("c.request_state")[:] = 0
        self.open(log)

    def ask(self, kind: str, name: str, *value: float, run_id: int = rig.RUN_ID, command_id: int | None = None,
            after_s: float = 1.0):  # fmt: skip
        self.clock_s += after_s
        self._next_id += 1
        message = types.type_of(types.COMMAND)()
        message.run_id, message.command_id = run_id, self._next_id if command_id is None else command_id
        message.kind, message.name, message.sender = kind, name, "test"
        message.value, message.n = list(value), len(value)
        self.take(types.COMMAND, message)
        return self.telemetry.answers[-1]


def test_walk_starts_with_the_scenarios_step_until_another_is_asked_for():
    desk = Desk()
    answer = desk.ask("walk", "start")
    given = desk.controller.given
    assert answer.accepted and given["walk_request"] == 2
    assert given["step_length_request_m"] == 0.015 and given["step_turn_request_rad"] == 0.0
    assert desk.ask("step", "turn_rad", -0.06).accepted
    assert given["step_turn_request_rad"] == -0.06 and given["step_length_request_m"] == 0.015
    assert desk.telemetry.events[-1] == ("command_accepted", "step turn_rad -0.06 (from test)")


def test_a_step_before_the_start_is_kept_and_told_so():
    desk = Desk()
    answer = desk.ask("step", "length_m", 0.02)
    assert answer.accepted and "walk start" in answer.reason
    desk.ask("walk", "start")
    assert desk.controller.given["step_length_request_m"] == 0.02


def test_stop_ends_a_walk_and_is_refused_to_one_who_stands():
    desk = Desk("walk")
    assert desk.ask("walk", "stop").accepted and desk.controller.given["walk_request"] == 1
    refused = Desk("stand")
    assert "stands already" in refused.ask("walk", "stop").reason and not refused.controller.given


@pytest.mark.parametrize("mode", ["hold", "crouch", "safe"])
@pytest.mark.parametrize("asked", [("walk", "start"), ("walk", "stop"), ("step", "length_m", 0.01)])
def test_after_a_fault_nothing_walks(mode, asked):
    desk = Desk(mode, "bad_input")
    answer = desk.ask(*asked)
    assert not answer.accepted and mode in answer.reason and "bad_input" in answer.reason
    assert not desk.controller.given and desk.telemetry.events[-1][0] == "command_refused"


def test_before_the_calibration_a_start_waits():
    answer = Desk("calibrate").ask("walk", "start")
    assert answer.accepted and "calibrated" in answer.reason


def test_a_push_begins_now_and_ends_after_its_time():
    desk = Desk()
    assert desk.poll(120) is None
    assert desk.ask("push", "head", 0.0, -20.0, 3.0, 0.1).accepted
    given = desk.plant.given
    assert given["push_now_force_W_N"] == [0.0, -20.0, 3.0] and given["push_now_link"] == 3
    assert desk.poll(130) == 220 and given["push_now_force_W_N"] == [0.0, -20.0, 3.0]
    assert "in place of" in desk.ask("push", "chest", 5.0, 0.0, 0.0, 0.05).reason
    assert desk.poll(175) == 180
    assert desk.poll(180) is None and given["push_now_force_W_N"] == [0.0, 0.0, 0.0]


def test_the_master_ends_a_push_at_its_very_tick():
    """And comes back to whole batches after it."""
    controller, plant = stepping_controller(), standing_plant()
    polled = []

    class OnePush:
        def open(self, log):
            self.log = log

        def poll(self, tick):
            polled.append(tick)
            return 23 if tick < 23 else None

    rig.run(controller, plant, 60, None, commands=OnePush())
    assert polled == [0, 10, 20, 23, 30, 40, 50]


def test_set_changes_a_tunable_parameter():
    desk = Desk()
    assert desk.ask("set", "tpcc_kp_1_s2", 30.0).accepted and desk.controller.given["tpcc_kp_1_s2"] == 30.0
    assert desk.ask("set", "lpc_gain", 0.3, 0.1).accepted and desk.controller.given["lpc_gain"] == [0.3, 0.1]
    assert desk.ask("set", "lpc_gain.y", 0.2).accepted and desk.controller.given["lpc_gain.y"] == 0.2
    answer = desk.ask("set", "tpcc_kv_1_s", 13.0)
    assert not answer.accepted and "do not go together" in answer.reason


@pytest.mark.parametrize(("asked", "words"), [
    (("jump", "up"), "unknown kind 'jump'"),
    (("walk", "sart"), "did you mean"),
    (("walk", "start", 1.0), "0 values needed, not 1"),
    (("step", "height_m", 0.01), "unknown step value 'height_m'"),
    (("step", "length_m"), "1 value needed, not 0"),
    (("step", "length_m", 0.081), "out of range [-0.08, 0.08] m"),
    (("step", "length_m", math.nan), "not a finite number"),
    (("step", "turn_rad", -math.inf), "not a finite number"),
    (("push", "chst", 1.0, 0.0, 0.0, 0.1), "did you mean"),
    (("push", "chest", 1.0, 0.0, 0.0), "4 values needed, not 3"),
    (("push", "chest", 200.1, 0.0, 0.0, 0.1), "more than 200 N"),
    (("push", "chest", 0.0, 0.0, 0.0, 0.1), "without a force"),
    (("push", "chest", 1.0, 0.0, 0.0, 2.1), "lasts 0.001 to 2 s"),
    (("push", "chest", 1.0, 0.0, 0.0, -0.1), "lasts 0.001 to 2 s"),
    (("push", "chest", 1.0, math.nan, 0.0, 0.1), "not a finite number"),
    (("set", "step_length_m", 0.01), "cannot change while the robot runs"),
    (("set", "tpc_kp_1_s2", 20.0), "did you mean"),
    (("set", "tpcc_kp_1_s2", 101.0), "out of range [0, 100]"),
    (("set", "tpcc_kp_1_s2", math.inf), "not a finite number"),
    (("set", "tpcc_kp_1_s2"), "takes 1 value, not 0"),
    (("set", "lpc_gain", 0.1, 0.2, 0.3), "takes 1 or 2 values, not 3"),
    (("set", "tpcc_kp_1_s2", *range(1000)), "not"),
    (("walk\x1b[31m", "start"), "unknown kind 'walk?[31m'"),
    (("x" * 10000, ""), "unknown kind"),
])  # fmt: skip
def test_bad_commands_are_refused_with_a_reason_and_change_nothing(asked, words):
    desk = Desk()
    answer = desk.ask(*asked)
    assert not answer.accepted and words in answer.reason, answer.reason
    assert not desk.controller.given and not desk.plant.given
    assert len(answer.value) <= command_kinds.MOST_VALUES + 1 and len(answer.kind) <= command_kinds.LONGEST_TEXT
    assert desk.record[-1]["accepted"] is False


def test_another_run_and_a_repetition_are_refused():
    desk = Desk()
    assert "this is run 77" in desk.ask("walk", "start", run_id=78).reason
    assert desk.ask("walk", "start", command_id=5).accepted
    desk.controller.given.clear()
    answer = desk.ask("walk", "start", command_id=5)
    assert not answer.accepted and "replayed" in answer.reason and not desk.controller.given
    bad = desk.ask("jump", "", command_id=6)
    assert not bad.accepted and "replayed" in desk.ask("walk", "start", command_id=6).reason
    assert KEPT_IDS >= 3600 * MOST_A_SECOND  # an hour of as much as may come


def test_too_fast_is_refused_and_a_flood_is_not_even_answered():
    desk = Desk("walk")
    taken = [desk.ask("step", "length_m", 0.01, after_s=0.0).accepted for _ in range(MOST_A_SECOND + 1)]
    assert taken == [1] * MOST_A_SECOND + [0]
    assert "at most 20 commands a second" in desk.telemetry.answers[-1].reason
    for _ in range(10_000):
        desk.ask("step", "length_m", 0.01, after_s=0.0)
    assert len(desk.telemetry.answers) < 50 and len(desk.record) < 50 and desk.too_fast > 9_900
    assert any("too fast" in note for note in desk.notes())
    assert desk.ask("step", "length_m", 0.01, after_s=1.0).accepted


def test_a_product_without_the_inputs_refuses():
    desk = Desk()
    for side in (desk.controller, desk.plant):
        side.inputs = [c for c in side.inputs if "request" not in c.name and "push_now" not in c.name]
    assert "has no input" in desk.ask("walk", "start").reason
    assert "has no input" in desk.ask("push", "chest", 1.0, 0.0, 0.0, 0.1).reason
    assert not desk.controller.given and not desk.plant.given


def test_what_the_controller_makes_of_the_request_is_told_once():
    desk = Desk("walk")
    refused = parameters.table().enums["request_state"].index("refused")
    desk._log.column("c.request_state")[:] = refused
    desk.poll(10)
    desk.poll(20)
    assert desk.telemetry.events == [("note", "the controller says of the walk request: refused")]


def test_a_run_with_a_silent_desk_is_the_run_without_one():
    def noisy():
        rng = np.random.default_rng(5)
        return standing_plant(lambda side, tick: side.put("gyro_S_rad_s", rng.normal(size=3)))

    plain, _ = rig.run(stepping_controller(), noisy(), 300, None)
    desk = Desk()
    listened, _ = rig.run(stepping_controller(), noisy(), 300, None, commands=desk)
    assert plain.error is None and listened.error is None
    assert plain.log.real[:301].tobytes() == listened.log.real[:301].tobytes()


def test_packets_that_are_no_commands_are_counted_and_told():
    """Cut, damaged, of another type: none of them reaches the desk; what came between them does."""
    desk = Desk()
    desk.listener = Listener("memq://", [types.COMMAND], desk.take)
    good = types.type_of(types.COMMAND)()
    good.run_id, good.command_id, good.kind, good.name = rig.RUN_ID, 9, "walk", "start"
    whole = good.encode()
    foreign = types.type_of(types.EVENT)().encode()
    for data in (whole[:-3], whole[:8], whole + b"x", foreign, b"", b"\xff" * 60, whole):
        desk.listener._lcm.publish(types.COMMAND, data)
    desk.poll(40)
    desk.close()
    assert [a.accepted for a in desk.telemetry.answers] == [1] and desk.controller.given["walk_request"] == 2
    assert any("3 malformed and 3 foreign" in note for note in desk.notes()), desk.notes()
