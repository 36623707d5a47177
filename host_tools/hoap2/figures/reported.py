"""`The book reports / measured here` for each figure: rows of (what, book, here)."""

from __future__ import annotations

from hoap2.figures import measured
from hoap2.figures.walk_data import Walk

Row = tuple[str, str, str]


def _text(value: float | None, unit: str, digits: int = 2) -> str:
    return "-" if value is None else f"{value:.{digits}f} {unit}".replace("-", "\N{MINUS SIGN}")


def rows(number: str, walk: Walk, other: Walk | None) -> list[Row]:
    """other: the same run with landing position control switched off, for the figures that need it."""
    return {"7.8": _design, "7.10": _floor, "7.11": _sand, "7.12": _sand_controlled, "7.13": _floor_controlled}[number](
        walk, other
    )


def _design(walk: Walk, _: Walk | None) -> list[Row]:
    values = walk.scenario.values["controller"]
    length, width = 1e3 * values["step_length_m"][0], 1e3 * values["step_width_m"][0]
    steps = f"{values['steps_forward'][0]:g} + {values['steps_in_place'][0]:g}, {values['step_time_s'][0]:g} s"
    offset = 1e3 * values["cp_offset_x_m"][0], 1e3 * values["cp_offset_inward_m"][0]
    return [
        ("foot prints", "L_x 15 mm, L_y 78 mm, L_\u03b8 0\N{DEGREE SIGN}",
         f"L_x {length:g} mm, L_y {width:g} mm, L_\u03b8 {values['step_turn_rad'][0] * 57.29578:g}\N{DEGREE SIGN}"),
        ("steps, T_step", "28 forward + 8 in place, 0.4 s", steps),
        ("CP at a step's end", "designed from the foot prints",
         f"next ankle, {offset[0]:g} mm ahead, {offset[1]:g} mm inward"),
        ("reference CoP", "plotted; no figures in the text",
         f"inside the stance sole by {_text(measured.cop_margin_mm(walk), 'mm', 1)} or more"),
    ]  # fmt: skip


def _constant_range(walk: Walk) -> str:
    roll = [_text(measured.roll_rms_deg(walk, *steps), "", 2).strip() for steps in ((5, 16), (17, 28))]
    sway = [_text(measured.sway_mm(walk, *steps), "", 1).strip() for steps in ((5, 16), (17, 28))]
    return f"rms roll {roll[0]}, then {roll[1]} deg; CoM \u00b1{sway[0]}, then \u00b1{sway[1]} mm (steps 5-16, 17-28)"


def _floor(walk: Walk, _: Walk | None) -> list[Row]:
    pitch = walk.summary["pitch_deg"]["max"]
    return [
        ("outcome", "could stably walk, step, and stop", measured.outcome(walk)),
        ("lateral, roll", "kept in the constant range", _constant_range(walk)),
        ("pitch", "not described", f"at most {_text(pitch, 'deg')}"),
        ("\u0394r_k", "0", f"largest {_text(_largest(walk), 'mm', 1)}"),
    ]


def _largest(walk: Walk) -> float | None:
    shifts = walk.shifts_mm[1]
    return float(abs(shifts).max()) if shifts.size else None


def _grown(walk: Walk) -> str:
    grown, tenth = measured.pitch_grown(walk), measured.pitch_at_step_deg(walk, 10)
    text = f"{_text(tenth, 'deg', 1)} in step 10"
    if grown is None:
        return text
    after = grown[1] - measured.walk_begins_s(walk)
    return f"{text}; beyond {measured.PITCH_GROWN_DEG:g} deg backward for good from step {grown[0]} on ({after:.1f} s)"


def _sand(walk: Walk, _: Walk | None) -> list[Row]:
    drawn = f"seed {walk.summary['seed']}" if walk.summary["seed"] else "nominal"
    return [
        ("outcome", "fell backward at the 18th step", measured.outcome(walk)),
        ("pitch", "grew rapidly after about the 10th step (5 s)", _grown(walk)),
        ("repeated", "several times, never a stable walk", f"this run: {drawn}; ./hoap2 study sand runs many"),
        ("sinkage, mid stance", "not given", _text(measured.sinkage_mm(walk), "mm", 1)),
    ]


def _shift_text(walk: Walk) -> str:
    shifts = walk.shifts_mm[1]
    if not shifts.size:
        return "-"
    x, y = (abs(shifts[:, i]).max() for i in (0, 1))
    return f"largest along {x:.1f} mm, across {y:.1f} mm"


def _sand_controlled(walk: Walk, other: Walk | None) -> list[Row]:
    roll, pitch = walk.summary["roll_deg"]["max"], walk.summary["pitch_deg"]["max"]
    return [
        ("outcome", "walked to the end", measured.outcome(walk)),
        ("roll, pitch", "divergence well suppressed", f"at most {_text(roll, 'deg')} and {_text(pitch, 'deg')}"),
        ("\u0394r_k", "calculated and applied", _shift_text(walk)),
        ("without control", "Fig. 7.11: fell backward", measured.outcome(other) if other else "-"),
        ("sinkage, mid stance", "not given", _text(measured.sinkage_mm(walk), "mm", 1)),
    ]


def _floor_controlled(walk: Walk, other: Walk | None) -> list[Row]:
    both = [_text(w.summary["roll_deg"]["rms"], "deg", 3) if w else "-" for w in (walk, other)]
    sway = [_text(measured.sway_mm(w, 5, 28), "mm", 2) if w else "-" for w in (walk, other)]
    stiffness = walk.scenario.values["plant"]["roll_stiffness_Nm_rad"][0]
    joints = f"{stiffness:g} Nm/rad in this run" if stiffness else "rigid in this run"
    return [
        ("outcome", "walked to the end", measured.outcome(walk)),
        ("roll", "less than in Fig. 7.10", f"rms {both[0]}; same run without control {both[1]}"),
        ("lateral sway", "suppressed, it seems", f"CoM \u00b1{sway[0]}; without control \u00b1{sway[1]} (steps 5-28)"),
        ("\u0394r_k", "plotted", _shift_text(walk)),
        ("elastic roll joints", "make the foot land early and kick", joints),
    ]
