"""The documentation page that lies in each FMU."""

from __future__ import annotations

from html import escape

from .fmi import PRODUCT_TEXT, token, variable_text
from .tables import GROUPS, Signal, Table

STYLE = """body { font: 15px/1.5 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; color: #222; }
h1, h2 { font-weight: 600; } h2 { margin-top: 2em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; width: 100%; } th, td { text-align: left; padding: .25em .6em; vertical-align: top; }
tr:nth-child(even) { background: #f4f6f8; } th { border-bottom: 2px solid #888; }
code, pre { font-family: monospace; background: #f0f2f4; } code { padding: 0 .2em; } pre { padding: .8em;
overflow-x: auto; }
ol.joints { columns: 4; } img.robot { float: right; border-radius: 8px; margin-left: 1em; } .note { color: #555; }"""

ABOUT = {
    "controller": """<p>The firmware of the walking controller, exactly as it runs elsewhere, behind FMI
Co-Simulation. In:
encoder angles, gyro, accelerometer, the eight force cells of the feet, and the counter of sensor frames. Out: per joint
the six drive settings (mode, angle, rate, torque feed-forward, stiffness, damping), and what the controller plans and
senses. It starts up, calibrates while it stands, walks the planned steps and stands again. <code>walk_request</code>
and the step requests beside it let somebody steer the walk; left alone, the parameters decide.</p>
<p>Inputs that are NaN, out of range or stale (<code>sensor_tick</code> no longer rises) are never an error: the
controller
holds, finishes the step, crouches to a safe posture and says so in <code>fault</code> and <code>mode</code>.</p>""",
    "plant": """<p>The robot with its 25 joints in the Open Dynamics Engine: drives, sensors, floor with tilt and
blocks,
pushes. In: per joint the six drive settings. Out: the sensors as the controller gets them, and the truth (names that
begin with <code>true_</code>). <code>push_now_force_W_N</code> pushes while it is not zero. The libraries libode and libccd lie beside the binary.</p>
<p>An input that is NaN, or a motion that blows up, ends the step with an error and a logged reason; the plant then
stands where it stood before that step.</p>""",
}

EXAMPLE = """from fmpy import simulate_fmu
result = simulate_fmu("hoap2_{product}_fmi{version}.fmu", stop_time=1.0, step_size=0.001, output_interval=0.001,
                      start_values={{{start}}})"""
START = {"controller": '"step_length_m": 0.02', "plant": '"friction_mu": 0.5'}

RULES = """<ul>
<li>One tick is {tick_ms:g} ms. A communication step must be a whole number of ticks and start at the current time;
any other step is an error with a logged reason and changes nothing.</li>
<li>Inputs are held during a step: a step of <i>n</i> ticks gives the same bytes as <i>n</i> steps of one tick.</li>
<li>No output answers an input before the next step, so there is no algebraic loop: exchange, then step both
(Jacobi).</li>
<li>Parameters are fixed after initialisation, but for those marked tunable. A value outside its range ends the
initialisation with an error that names it.</li>
<li>Outputs are valid from initialisation mode on.</li>
<li>States can be saved, restored, and turned into bytes; restoring continues bit for bit. The bytes carry the hash of
the table of signals and a checksum, and are good for both FMI versions of this FMU.</li>
<li>Several instances can run at once, each stepped from any thread, one thread at a time.</li>
<li>Log categories: <code>logStatusError</code>, <code>logStatusWarning</code>, <code>logEvents</code>; only through the
callback, only when logging is on.</li>
<li>Not offered: Model Exchange, Scheduled Execution, event mode, derivatives of any kind.</li>
</ul>"""


def _rows_table(table: Table, product: str, group: str) -> str:
    out = [
        "<table><tr><th>name</th><th>size</th><th>unit</th><th>start</th>"
        + ("<th>range</th>" if group == "parameter" else "")
        + "<th></th></tr>"
    ]
    for s in table.select(product, group):
        cells = [
            f"<code>{s.name}</code>"
            + (" <span class=note>tunable</span>" if s.tunable else "")
            + (" <span class=note>from the operator</span>" if s.operator else ""),
            " &times; ".join(f"{n} ({table.sizes[n]})" for n in s.size_names) or "1",
            escape(s.unit) if s.kind == "real" else "integer",
            _start(s, group),
        ]
        if group == "parameter":
            cells.append(f"{s.low:g} &hellip; {s.high:g}")
        cells.append(escape(variable_text(table, s, sized=False)))
        out.append("<tr>" + "".join(f"<td>{c}</td>" for c in cells) + "</tr>")
    return "\n".join(out) + "\n</table>"


def _start(s: Signal, group: str) -> str:
    if group == "output":
        return "calculated"
    return f"{s.default[0]:g}" if len(set(s.default)) == 1 else "per element"


def _names(table: Table, product: str) -> str:
    joint = next(s for s in table.select(product, "input") if s.size_names == ("joint",))
    cells = next(
        (s for s in table.select(product, "input") + table.select(product, "output") if s.size_names == ("cell",)), None
    )
    text = (
        f"<p>FMI 3.0 has one variable a row, arrays row-major. FMI 2.0 has one scalar an element, named by joint or "
        f"label: element 3 of <code>{joint.name}</code> is <code>{table.element_names(joint)[3]}</code>"
    )
    if cells:
        text += f", element 0 of <code>{cells.name}</code> is <code>{table.element_names(cells)[0]}</code>"
    return text + " (counted from 0).</p>"


def page(table: Table, product: str) -> str:
    """documentation/index.html of one product, for both FMI versions."""
    joints = "".join(f"<li><code>{name}</code></li>" for name in table.labels["joint"])
    links = ", ".join(f"{i} {link['name']}" for i, link in enumerate(table.robot["links"]))
    cells = ", ".join(table.labels["cell"])
    examples = "\n\n".join(EXAMPLE.format(product=product, version=v, start=START[product]) for v in (2, 3))
    faults = ", ".join(f"{bit} {name.replace('_', ' ')}" for name, bit in table.faults.items())
    order = (
        f"<h2>Order of the joints</h2><ol class=joints start=0>{joints}</ol>"
        f"<p>Force cells: {cells}.</p><p>Links: {links}.</p>"
    )
    if product == "controller":
        order += f"<p>Bits of <code>fault</code>: {faults}.</p>"
    groups = "\n".join(f"<h2>{group.capitalize()}s</h2>\n{_rows_table(table, product, group)}" for group in GROUPS)
    about = (
        f"<img class=robot src=robot.png alt='the robot'>\n<h1>hoap2_{product}</h1>\n"
        f"<p><b>{escape(PRODUCT_TEXT[product])}.</b></p>\n{ABOUT[product]}\n"
        f"<p class=note>Instantiation token {token(table, product)}. Generated from the table of signals.</p>\n"
    )
    rules = f"<h2>Rules</h2>\n{RULES.format(tick_ms=table.tick_us / 1000)}\n"
    frames = (
        "<h2>Units and frames</h2>\n<p>SI units, angles in rad. Names carry frame and unit: W world (x forward, y "
        f"left, z up), S sensor (chest axes), L link.</p>\n{_names(table, product)}\n"
    )
    licence = (
        '<h2>Licence</h2>\n<p>BSD 3-Clause; see <a href="licenses/LICENSE.txt">licenses/</a>, which also holds the '
        "licences of the libraries inside.</p>\n"
    )
    return (
        f"<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><title>hoap2_{product}</title>\n"
        f"<style>{STYLE}</style></head><body>\n{about}{rules}<h2>Example</h2>\n<pre>{escape(examples)}</pre>\n"
        f"{order}\n{frames}{groups}\n{licence}</body></html>\n"
    )
