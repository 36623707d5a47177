"""`bench plant` on a terminal and as a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hoap2.bench import measure
from hoap2.bench.plant import CASES, Case

NAMES = {
    "articulated": "plant, articulated",
    "dworldstep": "plant, dWorldStep",
    "mujoco_implicitfast": "MuJoCo implicitfast",
    "mujoco_euler": "MuJoCo Euler",
    "mujoco_implicitfast_elliptic": "MuJoCo, elliptic cone",
    "mujoco_implicitfast_frictionless_joints": "MuJoCo, no joint Coulomb",
}
COLOURS = {"articulated": "#c8102e", "dworldstep": "#7a6a5a"}  # MuJoCo's are blue
BOUNDS = {"dworldstep": 0.1, "mujoco_implicitfast": 0.7}  # what the articulated solver is to keep, on the floor
REMARKS = (
    "a step of the plant: drives with torque limits, contacts, solver, foot wrenches, sensors, checks of input, state",
    "a step of MuJoCo: controls copied, drives with torque limits, collision, solver (Newton, warm start); no sensors",
    "elliptic cone, no joint Coulomb: implicitfast; the latter is another robot, 25 of MuJoCo's constraint rows less",
)


def show(document: dict, picture: Path) -> None:
    from rich.console import Console

    console = Console(highlight=False, soft_wrap=True)
    console.print(_table(document))
    settings, machine, robots = document["settings"], document["machine"], document["robots"]
    console.print()
    for line in REMARKS:
        console.print(f"  {line}")
    on_floor = {name: seen["floor"] for name, seen in robots.items()}
    console.print(f"  not in it: filling the plant's output struct, {on_floor['articulated']['outputs_us']:.1f} us")
    off_mm = {name: 1e3 * seen["com_off_dworldstep_max_m"] for name, seen in on_floor.items()}
    console.print(f"  MuJoCo {document['mujoco']['version']} {_stance(on_floor)}, "
                  f"{on_floor['mujoco_implicitfast']['contacts_mean']:.1f} contacts, CoM within "
                  f"{off_mm['mujoco_implicitfast']:.1f} mm of dWorldStep's "
                  f"({off_mm['mujoco_implicitfast_elliptic']:.1f} mm elliptic)")
    pinned = "" if machine["pinned_to_core"] is None else f", all on core {machine['pinned_to_core']}"
    console.print(f"  {settings['repeat']} x {settings['seconds']:g} s, {settings['chunk_ticks']} ticks each in turn; "
                  f"{machine['processor']}, {machine['cores']} cores{pinned}, load {machine['load']:.1f}")
    if text := measure.busy(machine):
        console.print(f"  [yellow]{text}[/]: durations are longer than they need be, the shares hold")
    console.print(f"  {picture}")


def _stance(on_floor: dict) -> str:
    fallen = [NAMES[name] for name, seen in on_floor.items() if not seen["stays_upright"]]
    return f"[bold red]has fallen ({', '.join(fallen)})[/]" if fallen else "stays on its feet"


def _table(document: dict):
    from rich.table import Table

    table = Table(title="a step of 1 ms, in us; share: what the articulated solver takes of it", title_justify="left",
                  box=None, padding=(0, 2, 0, 0))
    table.add_column("", no_wrap=True)
    for name in ("floor", "p99", "share", "bound", "air", "p99", "share"):
        table.add_column(name, justify="right", no_wrap=True)
    for name, text in NAMES.items():
        us, share = document["us"][name], document["ratio"].get(f"articulated_to_{name}")
        cells = {case: [f"{us[case]['median']:.1f}", f"{us[case]['p99']:.0f}", f"{share[case]:.2f}" if share else ""]
                 for case in CASES}
        bound = f"<= {BOUNDS[name]:g}" if name in BOUNDS else ""
        table.add_row(text, *cells["floor"], bound, *cells["air"])
    return table


def draw(document: dict, runs: list[dict[str, Case]], path: Path) -> None:
    """The distribution of the steps' durations, a row a simulator, on one logarithmic axis; all repetitions."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    us = {case: {name: np.concatenate([run[case].counted(name) for run in runs]) / 1e3 for name in NAMES}
          for case in CASES}
    edges = np.geomspace(*_range(us), 160)
    figure, axes = pyplot.subplots(1, len(CASES), figsize=(11, 4.8), sharex=True, sharey=True, layout="constrained")
    for axis, case in zip(axes, CASES):
        _dress(axis, edges)
        for row, name in enumerate(reversed(NAMES)):
            _ridge(axis, row, us[case][name], edges, document["us"][name][case]["median"], _colour(name))
        axis.set_title({"floor": "on the floor: standing, then stepping", "air": "in the air, without gravity"}[case],
                       loc="left", fontsize=10)
    axes[0].set_yticks(np.arange(len(NAMES)) + 0.1, list(reversed(NAMES.values())))
    axes[0].set_ylim(-0.15, len(NAMES))
    machine = document["machine"]
    figure.suptitle(f"HOAP-2, 31 degrees of freedom: duration of a step, and its median. {machine['processor']}, "
                    f"MuJoCo {document['mujoco']['version']}", x=0.01, ha="left", fontsize=11)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=130)
    pyplot.close(figure)


def _dress(axis, edges: np.ndarray) -> None:
    """A logarithmic axis with plain numbers, and no more ink than needed."""
    from matplotlib.ticker import FuncFormatter, NullFormatter

    axis.set_xscale("log")
    axis.set_xlim(edges[0], edges[-1])
    axis.set_xlabel("a step of 1 ms (us)")
    axis.xaxis.set_major_formatter(FuncFormatter(lambda us, _: f"{us:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.set_xticks([tick for tick in (2, 5, 10, 20, 50, 100, 200, 500, 1000) if edges[0] <= tick <= edges[-1]])
    axis.grid(axis="x", which="major", color="0.9")
    axis.set_axisbelow(True)
    axis.tick_params(left=False)
    for side in ("top", "right", "left"):
        axis.spines[side].set_visible(False)


def _colour(name: str) -> str:
    return COLOURS.get(name, "#2f6db5")


def _range(us: dict[str, dict[str, np.ndarray]]) -> tuple[float, float]:
    """Limits of the axis (us): all but the rarest steps, which are interruptions for the most part."""
    everything = [durations for case in us.values() for durations in case.values()]
    return (0.8 * min(float(np.percentile(each, 0.1)) for each in everything),
            2.0 * max(float(np.percentile(each, 98.0)) for each in everything))


def _ridge(axis, row: int, us: np.ndarray, edges: np.ndarray, middle: float, colour: str) -> None:
    """A histogram on its own base line, with the median marked and written."""
    counts, _ = np.histogram(us, edges)
    axis.stairs(row + 0.8 * counts / counts.max(), edges, baseline=row, fill=True, color=colour, alpha=0.75)
    axis.plot([edges[0], edges[-1]], [row, row], color="0.8", linewidth=0.6, zorder=0)
    axis.plot([middle, middle], [row, row + 0.85], color="black", linewidth=1.0)
    axis.text(middle * 1.05, row + 0.72, f"{middle:.1f}", fontsize=9, va="center", color=colour,
              bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.0})
