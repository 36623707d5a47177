"""The panels of the monitor in the terminal."""

from __future__ import annotations

import math

from rich.console import Group
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from hoap2 import parameters
from hoap2.monitor.terminal_drawing import Canvas, bar, horizon
from hoap2.monitor.terminal_view import SILENT_S, View
from hoap2.telemetry import types
from hoap2.telemetry.ask import START_HINT

BORDER = "bright_black"
SHOWN_AHEAD_M, SHOWN_ACROSS_M = 0.17, 0.20  # of the ground around the feet
FINE_RAD = math.radians(4.0)  # tilts below this are shown ten times as large
NEAR_LIMIT = 0.05  # of a joint's range
EVENT_STYLE = {"fault": "bold red", "fall": "bold red", "command_refused": "yellow", "command_accepted": "green",
               "push": "magenta", "step": "bright_black", "run_started": "cyan", "run_ended": "cyan"}  # fmt: skip


def panel(content, title: str, style: str = BORDER) -> Panel:
    return Panel(content, title=f"[bold]{title}[/]", title_align="left", border_style=style, padding=(0, 1))


def word(enum: str, index: int) -> str:
    """An enum's word for people."""
    entries = parameters.table().enums[enum]
    return entries[index].replace("_", " ") if 0 <= index < len(entries) else str(index)


def header(view: View) -> Text:
    """One line: which run, how it does."""
    run, health = view.latest(types.RUN), view.latest(types.HEALTH)
    out = Text(no_wrap=True, overflow="ellipsis")
    if view.run_id is None:
        return out.append("no run is heard", "bold yellow").append(f" on {view.listener.url}")
    state, style = "running", "bold green"
    if view.ended:
        state, style = f"ended: {view.end}" if view.end else "ended", "bold cyan"
    elif (view.silent_s or 0.0) > SILENT_S:
        state, style = f"silent for {view.silent_s:.0f} s", "bold yellow"
    elif health is not None and health.state == health.PAUSED:
        state, style = "paused", "bold yellow"
    out.append(f" {state} ", style)
    if run is not None:
        seed = f", seed {run.seed}" if run.seed else ""
        out.append(f" {run.scenario}{seed}", "bold").append(f", sensors {run.sensors}")
    if health is not None:
        speed = health.real_time_factor if view.real_time is None else view.real_time
        of_all = f" of {run.duration_s:.2f}" if run is not None else ""
        out.append(f"   t {health.time_us / 1e6:8.2f}{of_all} s   ").append(f"{speed:.2f} x real time")
    if run is not None and run.accepts_commands:
        out.append("   takes commands", "green")
    if view.listener.other_schema:
        out.append("   made with another table of signals", "bold red")
    return out


def nobody(view: View) -> Panel:
    """What to do when no run is there."""
    counters = view.listener.counters
    strange = sum(c.foreign + c.malformed for c in counters.values())
    lines = [Text(f"No run is heard on {view.listener.url}.", "bold"), Text(""), Text(START_HINT),
             Text("or play a finished one again: ./hoap2 replay out/floor-walk/..."), Text(""),
             Text("This monitor waits for it; q or Ctrl-C ends it.", "bright_black")]  # fmt: skip
    if strange:
        lines.append(Text(f"{strange} packets of something else came.", "yellow"))
    return panel(Group(*lines), "monitor", "yellow")


def attitude(view: View, width: int, rows: int) -> Panel:
    """Artificial horizon of the chest as the robot estimates it, and the truth beside the numbers."""
    gait, truth = view.latest(types.GAIT), view.latest(types.TRUTH)
    if gait is None:
        return panel(Text("-"), "attitude")
    roll, pitch = gait.roll_est_rad, gait.pitch_est_rad
    gain = 10.0 if math.hypot(roll, pitch) < FINE_RAD else 1.0
    table = Table.grid(padding=(0, 1))
    known = truth.true_chest_rpy_rad if truth is not None else (math.nan,) * 3
    for name, estimate, true in (("roll", roll, known[0]), ("pitch", pitch, known[1])):
        scale, shown, is_true = 5.0, math.degrees(estimate), math.degrees(true)
        colour = "green" if abs(shown) < 2.0 else "yellow" if abs(shown) < 5.0 else "bold red"
        table.add_row(name, Text(f"{shown:+6.2f} deg", colour), bar(shown, -scale, scale, max(8, width - 32), colour),
                      Text(f"true {is_true:+.2f}", "bright_black"))  # fmt: skip
    drawn = [horizon(roll, pitch, width, rows, gain)] if rows > 2 else []
    return panel(Group(*drawn, table), f"attitude, tilt x {gain:g}" if drawn else "attitude")


def feet(view: View, columns: int, rows: int) -> Panel:
    """Both soles from above, the walk's heading upward: CoP, CoM and capture point (CP) between them."""
    gait = view.latest(types.GAIT)
    if gait is None:
        return panel(Text("-"), "feet")
    sole = parameters.table().robot["feet"]
    heading = 0.5 * (gait.foot_ref_yaw_W_rad[0] + gait.foot_ref_yaw_W_rad[1])
    middle = [0.5 * (gait.foot_ref_W_m[0][i] + gait.foot_ref_W_m[1][i]) for i in range(2)]

    def seen(point) -> tuple[float, float]:
        """World to screen: left of the robot to the left, ahead upward."""
        dx, dy = point[0] - middle[0], point[1] - middle[1]
        ahead = math.cos(heading) * dx + math.sin(heading) * dy
        return math.sin(heading) * dx - math.cos(heading) * dy, ahead

    scale = max(SHOWN_AHEAD_M / (4 * rows), SHOWN_ACROSS_M / (2 * columns))
    rows = min(rows, math.ceil(SHOWN_AHEAD_M / (4 * scale)))
    canvas = Canvas(columns, rows, (0.0, 0.5 * (sole["ankle_to_toe_m"] - sole["ankle_to_heel_m"])), scale)
    for foot, style in ((0, "green"), (1, "blue")):
        x, y, yaw = *gait.foot_ref_W_m[foot][:2], gait.foot_ref_yaw_W_rad[foot]
        corners = []
        for along, across in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
            ahead = sole["ankle_to_toe_m"] if along > 0 else -sole["ankle_to_heel_m"]
            left = across * sole["half_width_m"]
            corners.append(seen((x + math.cos(yaw) * ahead - math.sin(yaw) * left,
                                 y + math.sin(yaw) * ahead + math.cos(yaw) * left)))  # fmt: skip
        loaded = gait.foot_force_est_N[foot] > 5.0
        canvas.outline(corners, f"bold bright_{style}" if loaded else "bright_black")
        canvas.mark(seen((x, y)), "R" if foot == 0 else "L", "bright_black")
    marks = (("com_est_W_m", "◆", "bold yellow", "CoM"), ("cp_est_W_m", "○", "bold magenta", "CP"),
             ("cop_ref_W_m", "+", "bold cyan", "CoP ref."), ("cop_est_W_m", "●", "bold red", "CoP"))  # fmt: skip
    legend = Text(no_wrap=True, overflow="ellipsis")
    for name, character, style, text in marks:
        canvas.mark(seen(getattr(gait, name)[:2]), character, style)
        legend.append(f"{character} ", style).append(f"{text}  ", "bright_black")
    force = Text(f"right {gait.foot_force_est_N[0]:5.1f} N   left {gait.foot_force_est_N[1]:5.1f} N", "bright_black")
    return panel(Group(canvas.text(), legend, force), "feet from above")


def gait_numbers(view: View) -> Panel:
    """Mode, phase, step, requests, shifts, faults."""
    gait = view.latest(types.GAIT)
    if gait is None:
        return panel(Text("-"), "gait")
    table = Table.grid(padding=(0, 2))
    stance = ("right", "left", "both")[gait.stance_foot] if 0 <= gait.stance_foot < 3 else "?"
    mode = word("mode", gait.mode)
    table.add_row("mode", Text(mode, "bold red" if mode in ("hold", "crouch", "safe") else "bold"))
    table.add_row("phase", f"{word('phase', gait.phase)}, stance {stance}")
    table.add_row("step", f"{gait.step_index}, {gait.steps_done} done" + (", walk done" if gait.walk_done else ""))
    length, sideways, turn = gait.step_advance_m_rad
    table.add_row("advance", f"{1e3 * length:+.1f} mm, {1e3 * sideways:+.1f} mm left, {math.degrees(turn):+.1f} deg")
    request = word("request_state", gait.request_state)
    table.add_row("request", Text(request, "yellow" if request in ("limited", "refused") else ""))
    for name, vector in (("CoM deviation", gait.com_deviation_W_m), ("TPCC shift", gait.tpcc_shift_W_m),
                         ("landing shift", gait.landing_shift_W_m)):  # fmt: skip
        table.add_row(name, f"{1e3 * vector[0]:+6.1f} {1e3 * vector[1]:+6.1f} mm")
    truth = view.latest(types.TRUTH)
    if truth is not None:
        push = math.sqrt(sum(f * f for f in truth.true_push_force_W_N))
        table.add_row("push", Text(f"{push:.1f} N", "bold magenta" if push else "bright_black"))
        sunk = [1e3 * z for z in truth.true_sinkage_m]
        table.add_row("sinkage", f"{sunk[0]:.1f}, {sunk[1]:.1f} mm (right, left)")
    return panel(Group(table, faults(gait.fault)), "gait")


def faults(fault_word: int) -> Text:
    """The set bits by name, with what they mean."""
    table, out = parameters.table(), Text()
    if not fault_word:
        return out.append("no fault", "green")
    for name, bit in table.faults.items():
        if fault_word & bit:
            out.append(f"{name}: ", "bold red").append(f"{table.fault_texts[name]}. ", "red")
    return out


def joints(view: View, width: int, rows: int) -> Panel:
    """Angle, reference, where it lies in the soft limits, and the torque's share of the peak; legs when space is short."""
    state, truth = view.latest(types.STATE), view.latest(types.TRUTH)
    if state is None:
        return panel(Text("-"), "joints")
    robot = parameters.table().robot["joints"]
    names = list(enumerate(robot))
    if rows < len(names) + 1:
        names = [(i, j) for i, j in names if any(part in j["name"] for part in ("hip", "knee", "ankle"))]
    table = Table(box=None, padding=(0, 1), pad_edge=False, header_style="bright_black")
    bar_width = max(8, width - 50)
    for title in ("joint", "angle", "ref.", "soft limits", "torque"):
        table.add_column(title, justify="left" if title in ("joint", "soft limits") else "right", no_wrap=True)
    for i, joint in names[: max(1, rows - 1)]:
        q, ref = math.degrees(state.q_enc_rad[i]), math.degrees(state.q_ref_rad[i])
        low, high = (math.degrees(x) for x in joint["limit_soft_rad"])
        near = min(q - low, high - q) < NEAR_LIMIT * (high - low)
        share = 100.0 * abs(truth.true_tau_Nm[i]) / joint["torque_peak_Nm"] if truth is not None else math.nan
        table.add_row(joint["name"], f"{q:+7.2f}", Text(f"{ref:+7.2f}", "cyan"),
                      bar(q, low, high, bar_width, "bold red" if near else "green", ref),
                      Text(f"{share:3.0f} %", "bold red" if share > 99.0 else "yellow" if share > 60.0 else ""))  # fmt: skip
    return panel(table, "joints (deg), torque of the peak")


def health(view: View) -> Panel:
    """Times of a tick, overruns, and what each channel lost."""
    told = view.latest(types.HEALTH)
    rows = Table.grid(padding=(0, 2))
    if told is not None:
        rows.add_row("controller", f"{told.controller_us:.1f} us", f"longest {told.controller_max_us:.0f}")
        rows.add_row("plant", f"{told.plant_us:.1f} us", f"longest {told.plant_max_us:.0f}")
        rows.add_row("telemetry", f"{told.telemetry_us:.1f} us", f"dropped {told.dropped}")
        late = Text(f"{told.overruns}", "yellow" if told.overruns else "")
        paced = (f"{told.lag_us:.0f} us behind", Text("late batches ").append_text(late)) if told.paced else ("-", "")
        rows.add_row("wall clock", *paced)
    channels = Table(box=None, padding=(0, 1), pad_edge=False, header_style="bright_black")
    for title in ("channel", "1/s", "lost", "replayed", "bad", "foreign"):
        channels.add_column(title, justify="left" if title == "channel" else "right", no_wrap=True)
    counters = view.listener.counters
    strangers = [c for c in counters if c not in types.CHANNELS]
    for channel in [c for c in types.CHANNELS if c in counters] + strangers[:2]:
        counter = counters[channel]
        numbers = [Text(str(n), "bold yellow" if n else "bright_black")
                   for n in (counter.lost, counter.replayed, counter.malformed, counter.foreign)]  # fmt: skip
        name = channel.removeprefix(types.PREFIX).lower() if channel in types.CHANNELS else channel[:12]
        channels.add_row(name, f"{view.rates.get(channel, 0.0):.0f}", *numbers)
    return panel(Group(rows, Text(""), channels), "health")


def steering(view: View) -> Panel:
    """How to ask something of this run."""
    run = view.latest(types.RUN)
    if run is None or not run.accepts_commands:
        return panel(Text("this run takes none\n(./hoap2 run ... --accept-commands)", "bright_black"), "commands")
    lines = ("walk start | stop", "step length_m 0.02", "push chest 0 5 0 0.1", "set tpcc_kp_1_s2 22")
    out = Text("from another terminal:\n", "bright_black", no_wrap=True)
    for line in lines:
        out.append(f"./hoap2 command {line}\n")
    out.rstrip()
    return panel(out, "commands")


def events(view: View, rows: int) -> Panel:
    """The last ones, the newest at the bottom; steps, of which there are so many, only as far as they leave room."""
    out = Text(no_wrap=True, overflow="ellipsis")
    rows = max(1, rows)
    others = [e for e in view.events if e.kind != "step"][-rows:]
    steps = [e for e in view.events if e.kind == "step"][len(others) - rows :] if len(others) < rows else []
    shown = sorted(others + steps, key=lambda e: e.time_s)
    for i, event in enumerate(shown):
        out.append(f"{event.time_s:8.3f} ", "bright_black")
        if not event.text.startswith(event.kind):
            out.append(f"{event.kind.replace('_', ' ')}  ", EVENT_STYLE.get(event.kind, ""))
        out.append(event.text, "bright_black" if event.kind == "step" else "")
        out.append("\n" if i + 1 < len(shown) else "")
    return panel(out if shown else Text("none yet", "bright_black"), "events")
