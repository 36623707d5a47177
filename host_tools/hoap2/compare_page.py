"""The page of a comparison: both verdicts, the video, overlaid curves, what differs; one offline HTML file."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path

from hoap2 import plots
from hoap2.figures import style
from hoap2.figures.walk_data import Walk
from hoap2.report import CSS
from hoap2.tables_shown import number

OWN_CSS = ".numbers td:nth-child(-n+4) { white-space: nowrap; max-width: none; }"
COLORS = (style.VERMILION, style.BLUE)
ROWS = (
    ("roll (deg)", lambda walk: walk.chest_deg[:, 0]),
    ("pitch (deg)", lambda walk: walk.chest_deg[:, 1]),
    ("CoM x (mm)", lambda walk: _column(walk.mm("p.true_com_W_m"), 0)),
    ("CoM y (mm)", lambda walk: _column(walk.mm("p.true_com_W_m"), 1)),
    ("\u0394r along (mm)", lambda walk: _column(walk.turned_mm("c.landing_shift_W_m"), 0)),
    ("\u0394r across (mm)", lambda walk: _column(walk.turned_mm("c.landing_shift_W_m"), 1)),
)


def _column(block, index: int):
    return None if block is None else block[:, index]


def curves(walks: tuple[Walk, Walk], names: tuple[str, str], base: Path) -> list[Path]:
    """<base>.png and .svg: roll, pitch, CoM and landing shift of both over the same time."""
    with style.drawing(style.WIDTH_IN, 8.2) as figure:
        axes_list = figure.subplots(
            len(ROWS), 1, sharex=True, gridspec_kw={"height_ratios": (1.3, 1.3, 1.3, 1.3, 1, 1)}
        )
        figure.subplots_adjust(left=0.105, right=0.985, top=0.955, bottom=0.055, hspace=0.16)
        for axes, (label, values) in zip(axes_list, ROWS):
            for walk, name, color, dash in zip(walks, names, COLORS, ("-", (0, (4, 1.5)))):
                column = values(walk)
                if column is not None:
                    axes.plot(*plots.thin(walk.t_s, column), color=color, linestyle=dash, label=name)
                if walk.fall_s is not None:
                    axes.axvline(walk.fall_s, color=color, linewidth=0.9, linestyle=":")
            axes.set_ylabel(label)
            axes.yaxis.set_label_coords(-0.075, 0.5)
        _limit(axes_list[0], walks, 0)
        _limit(axes_list[1], walks, 1)
        axes_list[-1].set_xlabel("time (s); dotted: the fall of the run in that colour")
        handles, labels = axes_list[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper center", ncols=2)
        return style.save(figure, base)


def _limit(axes, walks: tuple[Walk, Walk], column: int) -> None:
    """Without the fall itself, beside which nothing else could be seen."""
    ends = [walk.log.count if walk.fall_tick is None else max(1, walk.fall_tick - 500) for walk in walks]
    low = min(float(walk.chest_deg[:end, column].min()) for walk, end in zip(walks, ends))
    high = max(float(walk.chest_deg[:end, column].max()) for walk, end in zip(walks, ends))
    room = max(0.1, 0.15 * (high - low))
    axes.set_ylim(low - room, high + room)


def write(folder: Path, walks: tuple[Walk, Walk], names: tuple[str, str], found: dict, film: Path | None) -> Path:
    """compare.html and the curves as files of their own."""
    svg = next(path for path in curves(walks, names, folder / "compare") if path.suffix == ".svg")
    title = escape(f"{names[0]}, {names[1]}")
    parts = [f"<header><h1>{title}</h1></header>", *map(_verdict, names, (found["a"], found["b"]))]
    if film is not None:
        parts.append(f"<video controls muted loop playsinline src='{_data(film, 'video/mp4')}'></video>")
    alt = "Roll, pitch, CoM and landing shift of both runs"
    picture = f"<img class=strip style='background: white' alt='{alt}' src='{_data(svg, 'image/svg+xml')}'>"
    parts.append(f"<h2>Curves</h2><figure>{picture}</figure>")
    parts += [_parameters(found["parameters"]), _metrics(found["metrics"])]
    path = folder / "compare.html"
    path.write_text(
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<style>{CSS}{OWN_CSS}</style></head>\n<body><main>\n" + "\n".join(parts) + "\n</main></body></html>\n",
        encoding="utf-8",
    )
    return path


def _data(path: Path, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"


def _verdict(name: str, run: dict) -> str:
    missed = [metric for metric, entry in run["bounds"].items() if not entry["ok"]]
    notes = [
        f"seed {run['seed']}" if run["seed"] else "nominal",
        f"sensors {run['sense']}",
        f"{run['duration_s']:.2f} s",
    ]
    if run["fell"]:
        notes.append(f"fell {run['fall_direction']} at {run['fall_time_s']:.2f} s, step {number(run['fall_step'])}")
    if run["error"]:
        notes.append(f"ended by an error: {run['error']}")
    if missed:
        notes.append("missed: " + ", ".join(missed))
    word, kind = ("All bounds are met.", "good") if run["ok"] else ("Not ok.", "bad")
    return f"<p class='verdict {kind}'><strong>{escape(name)}: {word}</strong> {escape('; '.join(notes))}</p>"


def _table(head: tuple[str, ...], rows: list[list[str]], classes: str) -> str:
    lines = ["<tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows]
    return f'<div class="scroll"><table class="{classes}">' + "\n".join(lines) + "</table></div>"


def _metrics(rows: list[dict]) -> str:
    cells = [
        [f"<code>{escape(row['metric'])}</code>", number(row["a"]), number(row["b"]), number(row["difference"]),
         escape(row["unit"]), escape(row["text"])] for row in rows
    ]  # fmt: skip
    return "<h2>Numbers</h2>" + _table(("metric", "A", "B", "B less A", "unit", "meaning"), cells, "numbers")


def _parameters(rows: list[dict]) -> str:
    if not rows:
        return "<h2>Parameters that differ</h2><p>None.</p>"
    cells = [[f"<code>{escape(row['parameter'])}</code>", escape(str(row["a"])), escape(str(row["b"])),
              escape(row["unit"]), escape(row["text"])] for row in rows]  # fmt: skip
    return "<h2>Parameters that differ</h2>" + _table(("parameter", "A", "B", "unit", "meaning"), cells, "numbers")
