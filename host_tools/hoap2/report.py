"""The report of a run: one HTML file that needs nothing else, no network and no script to be read."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path

from hoap2 import metric_names, parameters, plots
from hoap2.generate.tables import PRODUCTS
from hoap2.scenario import Scenario
from hoap2.signal_log import SignalLog
from hoap2.tables_shown import number

CSS = (Path(__file__).with_name("report.css")).read_text(encoding="utf-8")

FIGURES = (
    ("attitude", "Roll and pitch of the chest",
     "As Fig. 7.10 B. Hair lines mark the steps; the dashed line is the robot's own estimate."),
    ("plane", "CoM, CoP and footprints",
     "As Fig. 7.10 C, seen from above in the start frame. Filled soles were taken, dotted ones planned."),
    ("com_cop", "CoM and CoP over time", "Truth against plan and reference, start frame."),
    ("capture_point", "Capture point", "Desired by (7.10), measured by (7.1) from what the robot senses."),
    ("forces", "Foot forces", "Vertical force on each foot."),
    ("joints", "Joint references and true angles", "The legs; angles at the link."),
    ("torques", "Torques", "Drive torque of each joint as a part of its peak torque."),
    ("sensing", "Sensed less true", "Errors of the robot's own estimates of attitude, CoP and CoM."),
)  # fmt: skip


def write(path: Path, scenario: Scenario, log: SignalLog, summary: dict, pictures: dict[str, Path],
          sections: list[str] | None = None) -> None:  # fmt: skip
    """Write the report; every part is made from the log and the summary of this run. sections: more of them, as HTML."""
    run = plots.Run(log, scenario)
    parts = [_head(scenario, summary), _verdict(summary), _pictures(pictures), _bounds(summary), "<h2>Plots</h2>"]
    for name, title, caption in FIGURES:
        picture = plots.svg(getattr(plots, name)(run), name)
        parts.append(f"<figure><h3>{escape(title)}</h3>{picture}<figcaption>{escape(caption)}</figcaption></figure>")
    parts += [*(sections or []), _numbers(summary), _parameters(scenario), _timing(summary)]
    title = escape(f"{scenario.name}: {scenario.title}")
    path.write_text(
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<style>{CSS}</style></head>\n<body><main>\n" + "\n".join(parts) + "\n</main></body></html>\n",
        encoding="utf-8",
    )


def _table(head: list[str], rows: list[list[str]], classes: str = "") -> str:
    """Cells are ready HTML; a row's first item may carry its class as `class|`."""
    lines = ["<tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr>"]
    for row in rows:
        lines.append("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>")
    return f'<div class="scroll"><table class="{classes}">' + "\n".join(lines) + "</table></div>"


def _head(scenario: Scenario, summary: dict) -> str:
    sensors = {"ideal": "ideal sensors", "hoap2": "sensors as on the robot (preset hoap2)"}[summary["sense"]]
    seed = f"seed {summary['seed']}" if summary["seed"] else "nominal (no seed)"
    section = f"Section {escape(scenario.section)} of the chapter" if scenario.section else ""
    link = {"can": "over CAN", "ls-bus": "over FMI-LS-BUS"}.get(scenario.link, "")
    facts = [section, escape(scenario.name), seed, sensors, link, f"{summary['duration_s']:.2f} s"]
    return (
        f"<header><h1>{escape(scenario.title)}</h1><p class=facts>{' · '.join(f for f in facts if f)}</p>"
        f"<p>{escape(scenario.text)}</p></header>"
    )


def _verdict(summary: dict) -> str:
    missed = [name for name, entry in summary["bounds"].items() if not entry["ok"]]
    notes = []
    if summary["interrupted"]:
        notes.append("The run was interrupted; what follows is the part that was simulated.")
    if summary["error"]:
        notes.append(f"The run ended by an error: {summary['error']}")
    if summary.get("fell"):
        when = f"{summary['fall_time_s']:.2f} s, step {number(summary['fall_step'])}"
        notes.append(f"The robot fell {summary['fall_direction']} at {when}.")
    if summary.get("faults"):
        notes.append(f"Faults: {', '.join(summary['faults'])}.")
    if missed:
        notes.append(f"Missed: {', '.join(missed)}.")
    word, kind = ("All bounds are met.", "good") if summary["ok"] else ("Not ok.", "bad")
    return f"<p class='verdict {kind}'><strong>{word}</strong> {escape(' '.join(notes))}</p>"


def _data(path: Path, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"


def _pictures(pictures: dict[str, Path]) -> str:
    """The snapshots, as Fig. 7.10 A, and the video; whatever there is of them."""
    parts = []
    if "video" in pictures:
        parts.append(f"<video controls muted loop playsinline src='{_data(pictures['video'], 'video/mp4')}'></video>")
    if "snapshots" in pictures:
        parts.append(f"<img class=strip alt='Snapshots of the run' src='{_data(pictures['snapshots'], 'image/png')}'>")
    return "".join(parts)


def _bounds(summary: dict) -> str:
    rows = []
    for name, entry in summary["bounds"].items():
        unit, text = metric_names.NAMES.get(name, ("", ""))
        mark = "<span class=good>ok</span>" if entry["ok"] else "<span class=bad>missed</span>"
        rows.append([f"<code>{escape(name)}</code>", number(entry["value"]), number(entry["min"]), number(entry["max"]),
                     escape(unit), mark, escape(text)])  # fmt: skip
    return "<h2>Bounds</h2>" + _table(["metric", "value", "min", "max", "unit", "", "meaning"], rows, "numbers")


def _numbers(summary: dict) -> str:
    from hoap2.bounds import lookup

    rows = [
        [f"<code>{escape(name)}</code>", number(lookup(summary, name)), escape(unit), escape(text)]
        for name, (unit, text) in metric_names.NAMES.items()
    ]
    return "<h2>Numbers</h2>" + _table(["metric", "value", "unit", "meaning"], rows, "numbers")


def _value_text(value) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(_value_text(v) for v in value) + "]"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _parameters(scenario: Scenario) -> str:
    """Every resolved value; what differs from the default comes first and is marked."""
    parts = ["<h2>Parameters</h2>"]
    for product in PRODUCTS:
        changed, same = [], []
        for name, signal in parameters.known(product).items():
            value = scenario.values[product][name]
            cells = [f"<code>{escape(name)}</code>", *(
                escape(_value_text(parameters.plain(signal, v))) for v in (value, signal.default)
            ), escape(signal.unit), escape(signal.text)]  # fmt: skip
            (changed if value != signal.default else same).append(cells)
        head = ["parameter", "value", "default", "unit", "meaning"]
        parts.append(f"<h3>{product.capitalize()}: other than the default</h3>")
        parts.append(_table(head, changed, "changed") if changed else "<p>Nothing.</p>")
        parts.append(f"<details><summary>{len(same)} at their defaults</summary>{_table(head, same)}</details>")
    return "".join(parts)


def _timing(summary: dict) -> str:
    parts_s = [number(summary["wall_s"][part], 3) for part in ("set_up", "loop", "files", "pictures")]
    rows = [
        ["real-time factor (simulated over wall time of the loop)", number(summary["real_time_factor"], 3)],
        ["controller, us a tick: median, 99 %", _pair(summary["controller_us"])],
        ["plant, us a tick: median, 99 %", _pair(summary["plant_us"])],
        ["setting the inputs of both, us a tick: median, 99 %", _pair(summary["set_us"])],
        ["reading the outputs of both into the log, us a tick: median, 99 %", _pair(summary["get_and_log_us"])],
        ["exchange and log in all, us a tick: mean", number(summary["exchange_and_log_us"], 3)],
        ["set-up, loop, files, pictures, s", ", ".join(parts_s)],
        ["peak memory, MB", number(summary.get("peak_memory_mb"), 3)],
    ]
    return "<h2>Time and memory</h2>" + _table(["on this machine", ""], rows, "numbers")


def _pair(spread: dict) -> str:
    return f"{number(spread['median'], 3)}, {number(spread['p99'], 3)}"
