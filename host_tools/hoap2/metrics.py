"""The numbers of a run, from its log alone. metric_names.py says what each means."""

from __future__ import annotations

import math

import numpy as np

from hoap2 import parameters, walk_metrics, walk_plan
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog

FALL_TILT_RAD = math.radians(45.0)
UPRIGHT_RAD = FALL_TILT_RAD / 3
AT_LIMIT = 0.999
END_WINDOW_S = 0.5


def chest_tilt_rad(roll_rad: np.ndarray, pitch_rad: np.ndarray) -> np.ndarray:
    """Angle between the chest's vertical axis and the world's, from roll and pitch (yaw-pitch-roll order)."""
    return np.arccos(np.clip(np.cos(roll_rad) * np.cos(pitch_rad), -1.0, 1.0))


def fall_tick(log: SignalLog) -> int | None:
    """First tick with the chest tilted by more than 45 deg or with a contact of anything but the soles."""
    rpy = log.block("p.true_chest_rpy_rad")
    fallen = (chest_tilt_rad(rpy[:, 0], rpy[:, 1]) > FALL_TILT_RAD) | (log.column("p.other_contacts") > 0)
    ticks = np.flatnonzero(fallen)
    return int(ticks[0]) if ticks.size else None


def chest_up_W(rpy_rad: np.ndarray) -> np.ndarray:
    """Horizontal part of the chest's vertical axis, world frame, (ticks, 2): where the chest leans."""
    roll, pitch, yaw = rpy_rad.T
    ahead, left = np.sin(pitch) * np.cos(roll), -np.sin(roll)
    return np.column_stack([np.cos(yaw) * ahead - np.sin(yaw) * left, np.sin(yaw) * ahead + np.cos(yaw) * left])


def fall_direction(log: SignalLog, tick: int) -> str:
    """Where the chest leans at the fall (still upright there: where it leans most after it), as the robot saw it.

    The heading is the chest's yaw while it last stood upright: yaw means little in a robot that lies.
    """
    rpy = log.block("p.true_chest_rpy_rad")
    tilt = chest_tilt_rad(rpy[:, 0], rpy[:, 1])
    upright = np.flatnonzero(tilt[: tick + 1] < UPRIGHT_RAD)
    heading = rpy[upright[-1], 2] if upright.size else rpy[0, 2]
    seen = tick if tilt[tick] > UPRIGHT_RAD else tick + int(np.argmax(tilt[tick:]))
    x, y = chest_up_W(rpy[seen : seen + 1])[0]
    ahead, left = math.cos(heading) * x + math.sin(heading) * y, math.cos(heading) * y - math.sin(heading) * x
    if abs(left) > abs(ahead):
        return "left" if left > 0 else "right"
    return "forward" if ahead > 0 else "backward"


def first_judged_tick(log: SignalLog) -> int:
    """The first step's tick; without steps, the first tick after calibration."""
    if "c.step_index" in log:
        ticks = np.flatnonzero(log.column("c.step_index") >= 1)
        if ticks.size:
            return int(ticks[0])
    if "c.mode" in log:
        ready = parameters.table().enums["mode"].index("stand")
        ticks = np.flatnonzero(log.column("c.mode") >= ready)
        if ticks.size:
            return int(ticks[0])
    return 0


def longest_run(flags: np.ndarray) -> int:
    """Largest number of consecutive true ticks in any column of (ticks, columns)."""
    best = 0
    for column in flags.T:
        edges = np.flatnonzero(np.diff(np.concatenate(([0], column.view(np.int8), [0]))))
        if edges.size:
            best = max(best, int((edges[1::2] - edges[::2]).max()))
    return best


def _spread(values: np.ndarray | None, scale: float = 1.0) -> dict[str, float | None]:
    """{max, rms} of signed numbers or of row vectors' lengths."""
    if values is None or values.size == 0 or not np.isfinite(values).all():
        return {"max": None, "rms": None}
    sizes = np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=1)
    return {"max": float(sizes.max()) * scale, "rms": float(np.sqrt(np.mean(sizes**2))) * scale}


def _signed(values: np.ndarray, scale: float) -> dict[str, float | None]:
    """{min, max} with their signs."""
    if values.size == 0 or not np.isfinite(values).all():
        return {"min": None, "max": None}
    return {"min": float(values.min()) * scale, "max": float(values.max()) * scale}


def _rows(log: SignalLog, name: str, rows: slice) -> np.ndarray | None:
    block = log.block(name)
    return None if block is None else block[rows]


def _difference(log: SignalLog, a: str, b: str, columns: int, rows: slice) -> np.ndarray | None:
    first, second = log.block(a), log.block(b)
    if first is None or second is None:
        return None
    return first[rows, :columns] - second[rows, :columns]


def to_start_frame(points_W_m: np.ndarray, scenario: Scenario) -> np.ndarray:
    """Horizontal positions seen from where the robot started."""
    plant = scenario.values["plant"]
    yaw = plant["start_yaw_W_rad"][0]
    turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    return (np.asarray(points_W_m)[..., :2] - plant["start_pos_W_m"]) @ turn


def _wrap(angle_rad: float) -> float:
    return math.remainder(angle_rad, 2 * math.pi)


def _middle(feet_pos_W_m: np.ndarray, feet_yaw_W_rad: np.ndarray, scenario: Scenario) -> np.ndarray:
    """Midpoint and heading of the feet in the start frame, (x m, y m, yaw rad)."""
    xy = to_start_frame(feet_pos_W_m.reshape(2, 3), scenario).mean(axis=0)
    half_twist = 0.5 * _wrap(feet_yaw_W_rad[1] - feet_yaw_W_rad[0])
    yaw = _wrap(feet_yaw_W_rad[0] + half_twist - scenario.values["plant"]["start_yaw_W_rad"][0])
    return np.array([xy[0], xy[1], yaw])


def _position(log: SignalLog, scenario: Scenario) -> dict:
    """Where the feet ended, and how far from the end of the plan that the parameters ask for."""
    got = _middle(log.block("p.true_foot_pos_W_m")[-1], log.block("p.true_foot_yaw_W_rad")[-1], scenario)
    plan = walk_plan.end(scenario.values["controller"], scenario.steps_planned)
    return {
        "progress_x_m": got[0],
        "progress_y_m": got[1],
        "turn_deg": math.degrees(got[2]),
        "plan_x_m": plan[0],
        "plan_y_m": plan[1],
        "plan_turn_deg": math.degrees(plan[2]),
        "final_error_m": math.hypot(got[0] - plan[0], got[1] - plan[1]),
        "final_error_yaw_deg": math.degrees(_wrap(got[2] - plan[2])),
    }


def _standing(log: SignalLog, fell: bool, limit_m_s: float) -> dict:
    window = max(1, round(END_WINDOW_S / (parameters.table().tick_us / 1e6)))
    speed = float(np.linalg.norm(log.block("p.true_base_vel_W_m_s")[-window:], axis=1).max())
    force = log.block("p.true_foot_force_W_N")[-window:].reshape(-1, 2, 3)[:, :, 2]
    both = bool((force > 0.0).all())
    return {"end_speed_m_s": speed, "stands_at_end": bool(not fell and both and speed <= limit_m_s)}


def _steps(log: SignalLog, tick: int | None) -> dict:
    """Steps completed, and the step of the last lift-off, up to the fall."""
    last = log.count - 1 if tick is None else tick
    done = int(log.column("c.steps_done")[last]) if "c.steps_done" in log else None
    fall_step = None
    if tick is not None and "c.phase" in log:
        single = parameters.table().enums["phase"].index("single_support")
        lifted = np.flatnonzero(log.column("c.phase")[: tick + 1] == single)
        fall_step = int(log.column("c.step_index")[lifted[-1]]) if lifted.size else 0
    return {"steps_taken": done, "fall_step": fall_step}


def _faults(log: SignalLog) -> dict:
    if "c.fault" not in log:
        return {"fault_count": 0, "faults": []}
    word = int(np.bitwise_or.reduce(log.column("c.fault")))
    named = [name for name, bit in parameters.table().faults.items() if word & bit]
    rest = word & ~sum(parameters.table().faults.values())
    named += [f"bit_{i}" for i in range(32) if rest >> i & 1]
    return {"fault_count": len(named), "faults": named}


def _capture_point(log: SignalLog, scenario: Scenario) -> np.ndarray:
    """(7.1) from the truth: CoM + CoM rate / omega, with the CoM's height above the soles at the start."""
    com, rate = log.block("p.true_com_W_m"), log.block("p.true_com_rate_W_m_s")
    feet = log.block("p.true_foot_pos_W_m")
    height = float(com[0, 2] - 0.5 * (feet[0, 2] + feet[0, 5]))
    gravity = scenario.values["plant"]["gravity_m_s2"][0]
    if height <= 0.0 or gravity <= 0.0:
        return np.full((log.count, 2), np.nan)
    return com[:, :2] + rate[:, :2] / math.sqrt(gravity / height)


def _tracking(log: SignalLog, scenario: Scenario, rows: slice) -> dict:
    cp_ref = log.block("c.cp_ref_W_m")
    joints = _difference(log, "c.q_ref_rad", "p.true_q_rad", 25, rows)
    joint = _spread(joints.ravel() if joints is not None else None, 180.0 / math.pi)
    return {
        "cop_tracking_m": _spread(_difference(log, "c.cop_ref_W_m", "p.true_cop_W_m", 2, rows)),
        "cop_est_error_m": _spread(_difference(log, "c.cop_est_W_m", "p.true_cop_W_m", 2, rows)),
        "com_tracking_m": _spread(_difference(log, "c.com_plan_W_m", "p.true_com_W_m", 2, rows)),
        "com_est_error_m": _spread(_difference(log, "c.com_est_W_m", "p.true_com_W_m", 2, rows)),
        "cp_tracking_m": _spread(None if cp_ref is None else (cp_ref - _capture_point(log, scenario))[rows]),
        "joint_tracking_deg": joint,
    }


def compute(log: SignalLog, scenario: Scenario) -> dict:
    """All numbers of a run. Estimates, tracking and torques are judged up to a fall."""
    tick = fall_tick(log)
    fell = tick is not None
    start = first_judged_tick(log)
    judged = slice(start, log.count)
    standing = slice(start, tick if fell and tick > start else log.count)
    rpy = log.block("p.true_chest_rpy_rad")
    degrees = 180.0 / math.pi
    result = {
        "fell": fell,
        "fall_time_s": float(log.t_s[tick]) if fell else None,
        "fall_direction": (direction := fall_direction(log, tick) if fell else None),
        "fell_backward": direction == "backward",
        "steps_planned": scenario.steps_planned,
        **_steps(log, tick),
        **_faults(log),
        "judged_from_s": float(log.t_s[start]),
        "roll_deg": _spread(rpy[judged, 0], degrees),
        "pitch_deg": _spread(rpy[judged, 1], degrees),
        "pitch_signed_deg": _signed(rpy[standing, 1], degrees),
    }
    for axis, name in enumerate(("roll", "pitch")):
        error = None
        if f"c.{name}_est_rad" in log:
            error = (log.column(f"c.{name}_est_rad") - rpy[:, axis])[standing]
        result[f"{name}_est_error_deg"] = _spread(error, degrees)
    peak = np.array([joint["torque_peak_Nm"] for joint in parameters.table().robot["joints"]])
    at_limit = np.abs(log.block("p.true_tau_Nm")[: tick if fell else None]) >= AT_LIMIT * peak
    force = log.block("p.true_foot_force_W_N")
    last = tick if fell else log.count - 1
    result |= {
        **_position(log, scenario),
        **_standing(log, fell, scenario.options["stand_speed_m_s"]),
    }
    return result | {
        "survived": walk_metrics.survived(result, scenario),
        "sinkage_mid_stance_m": walk_metrics.sinkage_mid_stance_m(log, last),
        "landing_shift_m": _spread(walk_metrics.landing_shifts_m(log, last)),
        "com_deviation_m": _spread(_rows(log, "c.com_deviation_W_m", standing)),
        **_tracking(log, scenario, standing),
        "torque_limit_max_s": longest_run(at_limit) * parameters.table().tick_us / 1e6,
        "foot_force_max_N": float(max(force[:, 2].max(), force[:, 5].max())),
    }
