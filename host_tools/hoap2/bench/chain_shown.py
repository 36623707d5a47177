"""`bench run` on a terminal."""

from __future__ import annotations

from hoap2.bench import measure

PARTS = {
    "controller": "controller",
    "plant": "plant",
    "exchange": "exchange by FMI, both: set, get, step calls",
    "log": "log",
    "rest": "rest of the loop",
}


def show(document: dict) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(title=f"a tick of 1 ms in a run of {document['scenario']}, in us", title_justify="left", box=None,
                  padding=(0, 2), show_footer=True)
    tick_us = document["tick_us"]
    table.add_column("", footer="tick")
    table.add_column("mean", justify="right", footer=f"{tick_us:.1f}")
    table.add_column("share", justify="right", footer="100 %")
    for name, text in PARTS.items():
        us = document["split"][name]
        table.add_row(text, f"{us:.1f}", f"{us / tick_us:.0%}".replace("%", " %"))
    console = Console(highlight=False, soft_wrap=True)
    console.print(table)
    console.print()
    walking, wall, machine = document["walking"], document["wall_s"], document["machine"]
    console.print("  while walking, median (p99), with the step calls of FMI: " + ", ".join(
        f"{name} {walking[name]['median']:.1f} ({walking[name]['p99']:.1f}) us" for name in ("controller", "plant")))
    console.print(f"  {document['real_time_factor']:.1f} x real time: {wall['loop']:.2f} s for "
                  f"{document['simulated_s']:.1f} s; with set-up ({wall['set_up']:.2f} s) and report "
                  f"({wall['report']:.2f} s) {wall['total']:.2f} s")
    console.print(f"  peak memory {document['peak_memory_mb']:.0f} MB")
    pinned = "" if machine["pinned_to_core"] is None else f", all on core {machine['pinned_to_core']}"
    console.print(f"  median of {len(document['runs'])}; {machine['processor']}, {machine['cores']} cores{pinned}, "
                  f"load {machine['load']:.1f}, FMI {document['fmi']:g}")
    if text := measure.busy(machine):
        console.print(f"  [yellow]{text}[/]: the run is slower than it need be")
