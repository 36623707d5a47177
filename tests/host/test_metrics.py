"""The numbers of a run, on signals whose answer is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from hoap2 import bounds, metric_names, metrics, parameters, scenario, walk_plan
from hoap2.signal_log import SignalLog, columns_of

TICKS = 18000
DEG = math.pi / 180


@pytest.fixture
def walk() -> scenario.Scenario:
    return scenario.load("floor-walk")


@pytest.fixture
def log(walk) -> SignalLog:
    """A faultless walk: 36 steps of 0.4 s from 1.8 s on, feet moving as planned, standing still at the end."""
    log = SignalLog(columns_of("controller") + columns_of("plant"), TICKS)
    log.count = TICKS
    log.real[:], log.integer[:] = 0.0, 0
    index = np.clip((np.arange(TICKS) - 1800) // 400 + 1, 0, 36)
    walking = (np.arange(TICKS) >= 1800) & (np.arange(TICKS) < 1800 + 36 * 400)
    enums = parameters.table().enums
    log.column("c.step_index")[:] = index
    log.column("c.steps_done")[:] = np.clip((np.arange(TICKS) - 1800) // 400, 0, 36)
    log.column("c.walk_done")[:] = np.arange(TICKS) >= 1800 + 36 * 400
    log.column("c.mode")[:] = np.where(walking, enums["mode"].index("walk"), enums["mode"].index("stand"))
    log.column("c.phase")[:] = np.where(walking, enums["phase"].index("single_support"), 0)
    feet = log.block("p.true_foot_pos_W_m")
    feet[:] = [0, -0.039, 0, 0, 0.039, 0]
    feet[-5000:, [0, 3]] = 0.42
    log.block("p.true_com_W_m")[:] = [0.009, 0.0, 0.2575]
    log.block("p.true_foot_force_W_N")[:, [2, 5]] = 34.5
    return log


def put_rpy(log: SignalLog, axis: int, rows, degrees) -> None:
    log.block("p.true_chest_rpy_rad")[rows, axis] = np.asarray(degrees) * DEG


def test_a_faultless_walk(log, walk):
    result = metrics.compute(log, walk)
    assert not result["fell"] and result["fall_time_s"] is None and result["fall_direction"] is None
    assert result["steps_planned"] == result["steps_taken"] == 36 and result["fall_step"] is None
    assert result["stands_at_end"] is True and result["faults"] == []
    assert result["judged_from_s"] == 1.8
    assert result["final_error_m"] == pytest.approx(0.0, abs=1e-12)
    assert result["progress_x_m"] == pytest.approx(0.42)


def test_every_named_metric_has_a_value(log, walk):
    result = metrics.compute(log, walk)
    missing = [n for n in metric_names.NAMES if bounds.lookup(result, n) is None]
    assert missing == ["fall_time_s", "fall_step"], "only what a run without a fall cannot have"


def test_roll_and_pitch_count_from_the_first_step_on(log, walk):
    put_rpy(log, 0, slice(0, 1800), 9.0)
    put_rpy(log, 0, slice(2000, 2001), -1.25)
    put_rpy(log, 1, slice(1800, TICKS), 0.5)
    result = metrics.compute(log, walk)
    assert result["roll_deg"]["max"] == pytest.approx(1.25)
    assert result["roll_deg"]["rms"] == pytest.approx(1.25 / math.sqrt(TICKS - 1800))
    assert result["pitch_deg"] == {"max": pytest.approx(0.5), "rms": pytest.approx(0.5)}


@pytest.mark.parametrize(("axis", "sign", "word"), [(1, 1, "forward"), (1, -1, "backward"), (0, 1, "right"),
                                                    (0, -1, "left")])  # fmt: skip
def test_fall_by_tilt(log, walk, axis, sign, word):
    ramp = np.clip(np.arange(TICKS) - 8000, 0, 900) * 0.1 * sign  # 0.1 deg a tick: 45 deg after 450 ticks
    put_rpy(log, axis, slice(None), ramp)
    result = metrics.compute(log, walk)
    assert result["fell"] and result["fall_direction"] == word
    assert result["fall_time_s"] == pytest.approx(8.451)
    assert result["fall_step"] == 17 and result["steps_taken"] == 16
    assert not result["stands_at_end"]


def test_a_tilt_of_two_axes_counts_as_one(log, walk):
    put_rpy(log, 0, slice(9000, 9001), 33.0)
    put_rpy(log, 1, slice(9000, 9001), 33.0)
    assert metrics.fall_tick(log) == 9000, "45.3 deg in all"
    put_rpy(log, 1, slice(9000, 9001), 32.0)
    assert metrics.fall_tick(log) is None, "44.7 deg in all"


def test_fall_by_contact(log, walk):
    log.column("p.other_contacts")[7000:7005] = 2
    put_rpy(log, 1, slice(7000, TICKS), -30.0)
    result = metrics.compute(log, walk)
    assert result["fall_time_s"] == 7.0 and result["fall_direction"] == "backward" and result["fall_step"] == 14


def test_fall_before_the_first_step(log, walk):
    log.column("p.other_contacts")[500:] = 1
    result = metrics.compute(log, walk)
    assert result["fall_step"] == 0 and result["steps_taken"] == 0


def test_estimate_errors_are_judged_up_to_the_fall(log, walk):
    log.column("c.pitch_est_rad")[:] = 0.2 * DEG
    log.column("c.pitch_est_rad")[2000] = -0.7 * DEG
    log.column("c.pitch_est_rad")[9500:] = 80 * DEG
    put_rpy(log, 1, slice(9500, TICKS), 50.0)
    result = metrics.compute(log, walk)
    assert result["pitch_est_error_deg"]["max"] == pytest.approx(0.7)
    assert result["pitch_est_error_deg"]["rms"] == pytest.approx(0.2, rel=0.01)


def test_torque_limit_is_the_longest_stretch_of_one_joint(log, walk):
    peak = [joint["torque_peak_Nm"] for joint in parameters.table().robot["joints"]]
    tau = log.block("p.true_tau_Nm")
    tau[3000:3010, 3] = peak[3]
    tau[3010:3030, 4] = -peak[4]
    tau[4000:4100, 5] = 0.99 * peak[5]
    assert metrics.compute(log, walk)["torque_limit_max_s"] == pytest.approx(0.020)


def test_tracking_and_sensing_distances(log, walk):
    log.block("p.true_cop_W_m")[1800:] = [0.003, 0.004]
    log.block("c.com_plan_W_m")[:] = [0.009, 0.002]
    log.block("c.q_ref_rad")[1800:, 7] = -0.5 * DEG
    result = metrics.compute(log, walk)
    assert result["cop_tracking_m"] == {"max": pytest.approx(0.005), "rms": pytest.approx(0.005)}
    assert result["cop_est_error_m"]["rms"] == pytest.approx(0.005)
    assert result["com_tracking_m"]["max"] == pytest.approx(0.002)
    assert result["joint_tracking_deg"]["max"] == pytest.approx(0.5)
    assert result["joint_tracking_deg"]["rms"] == pytest.approx(0.1), "over all 25 joints"


def test_capture_point_from_the_truth(log, walk):
    """(7.1) with omega = sqrt(g / z)."""
    log.block("p.true_com_rate_W_m_s")[:] = [0.1, 0.0, 0.0]
    omega = math.sqrt(9.81 / 0.2575)
    log.block("c.cp_ref_W_m")[:] = [0.009 + 0.1 / omega, 0.003]
    assert metrics.compute(log, walk)["cp_tracking_m"]["max"] == pytest.approx(0.003)


def test_positions_are_seen_from_the_start(log, walk):
    turned = scenario.load("floor-walk", ["plant.start_pos_W_m=[1000, -500]", "plant.start_yaw_W_rad=2.2"])
    c, s = math.cos(2.2), math.sin(2.2)
    feet = log.block("p.true_foot_pos_W_m").reshape(-1, 2, 3)
    xy = feet[:, :, :2] @ np.array([[c, s], [-s, c]]) + [1000, -500]
    feet[:, :, :2] = xy
    log.block("p.true_foot_yaw_W_rad")[:] = 2.2 + 0.01
    result = metrics.compute(log, turned)
    assert result["progress_x_m"] == pytest.approx(0.42) and result["progress_y_m"] == pytest.approx(0.0, abs=1e-9)
    assert result["final_error_m"] == pytest.approx(0.0, abs=1e-9)
    assert result["final_error_yaw_deg"] == pytest.approx(0.01 / DEG)


@pytest.mark.parametrize(("right_deg", "left_deg", "turn_deg"), [(0, 20, 10), (175, -175, 180), (-30, -10, -20)])
def test_the_heading_is_midway_between_the_feet(log, walk, right_deg, left_deg, turn_deg):
    log.block("p.true_foot_yaw_W_rad")[:] = [right_deg * DEG, left_deg * DEG]
    assert abs(metrics.compute(log, walk)["turn_deg"]) == pytest.approx(abs(turn_deg))


@pytest.mark.parametrize(("name", "row", "value"), [
    ("p.true_base_vel_W_m_s", slice(-300, -299), [0.021, 0, 0]),
    ("p.true_foot_force_W_N", slice(-300, -299), [0, 0, 0, 0, 0, 69]),
])  # fmt: skip
def test_not_standing_still(log, walk, name, row, value):
    log.block(name)[row] = value
    assert metrics.compute(log, walk)["stands_at_end"] is False


def test_faults_are_named(log, walk):
    faults = parameters.table().faults
    log.column("c.fault")[5000:5010] = faults["reach_limit"]
    log.column("c.fault")[6000:] = faults["bad_input"]
    result = metrics.compute(log, walk)
    assert result["faults"] == ["bad_input", "reach_limit"] and result["fault_count"] == 2


def test_a_run_cut_short_is_still_judged(walk):
    log = SignalLog(columns_of("controller") + columns_of("plant"), 10)
    log.count = 1
    log.real[:], log.integer[:] = 0.0, 0
    result = metrics.compute(log, walk)
    assert result["steps_taken"] == 0 and not result["fell"]


def controller_values(**changes) -> dict:
    overrides = [f"controller.{name}={value}" for name, value in changes.items()]
    return scenario.load("floor-walk", overrides).values["controller"]


def test_plan_straight_on():
    values = controller_values()
    prints = walk_plan.footprints(values, 36)
    assert len(prints) == 38 and walk_plan.end(values, 36) == pytest.approx((0.42, 0.0, 0.0))
    # Each step lands L_x ahead of the other foot, half the width to its own side.
    assert prints[2].x_m == pytest.approx(0.015) and prints[3].x_m == pytest.approx(0.030)
    assert [p.foot for p in prints[2:6]] == [0, 1, 0, 1]
    assert all(abs(p.y_m) == pytest.approx(0.039) for p in prints)


def test_plan_sideways_and_turning():
    left = controller_values(step_length_m=0.0, step_sideways_m=0.01, steps_forward=20, steps_in_place=4)
    assert walk_plan.end(left, 24) == pytest.approx((0.0, 0.20, 0.0))
    widths = [abs(a.y_m - b.y_m) for a, b in zip(walk_plan.footprints(left, 24), walk_plan.footprints(left, 24)[1:])]
    assert min(widths) >= 0.078 - 1e-12, "the legs never cross"
    right = controller_values(step_length_m=0.0, step_sideways_m=-0.01, steps_forward=20, steps_in_place=4)
    assert walk_plan.end(right, 24) == pytest.approx((0.0, -0.20, 0.0))
    turn = controller_values(step_length_m=0.0, step_turn_rad=0.05)
    assert walk_plan.end(turn, 36) == pytest.approx((0.0, 0.0, 28 * 0.05))
    # Nearly a circle's arc: its chord.
    x, y, yaw = walk_plan.end(controller_values(step_turn_rad=0.05), 36)
    assert yaw == pytest.approx(1.4) and math.hypot(x, y) == pytest.approx(0.42 * math.sin(0.7) / 0.7, rel=2e-3)
    assert math.atan2(y, x) == pytest.approx(0.7, abs=0.03)
