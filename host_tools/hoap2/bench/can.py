"""`bench can`: what the frames of a tick cost, the modelled link, and the loop of the three FMUs with bus terminals."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable

import numpy as np

from hoap2 import parameters, paths, products, scenario
from hoap2.bench import measure
from hoap2.can import library
from hoap2.generate import can_table

TICKS = 4000
WARM_UP = 200


def frames_of_a_tick() -> list[int]:
    """Layouts of what goes over both buses in every tick, and of the slow boards' as if they came too."""
    return [i for i, f in enumerate(can_table.load().frames)
            if f.period_ticks == 1 or f.kind.name in ("command", "status")]  # fmt: skip


def _loops() -> ctypes.CDLL:
    loops = ctypes.CDLL(str(paths.built("sim/bench/libhoap2_can_loops.so")))
    pointer, int32 = ctypes.c_void_p, ctypes.c_int32
    loops.bench_codec.restype, loops.bench_codec.argtypes = int32, [pointer, int32, pointer, int32, pointer, pointer]
    loops.bench_link.restype, loops.bench_link.argtypes = None, [pointer, pointer, pointer, int32, pointer]
    for name in ("hoap2_link_create", "hoap2_link_destroy", "hoap2_link_init"):
        function, known = getattr(loops, name), getattr(library.load(), name)
        function.restype, function.argtypes = known.restype, known.argtypes
    return loops


def _raw(layouts: list[int], rng: np.random.Generator) -> np.ndarray:
    """Random values within the ranges, (ticks, frames, fields)."""
    table = can_table.load()
    fields = max(len(f.placed) for f in table.frames)
    raw = np.zeros((TICKS, len(layouts), fields), dtype=np.int32)
    for i, layout in enumerate(layouts):
        for j, placed in enumerate(table.frames[layout].placed):
            raw[:, i, j] = rng.integers(placed.field.low, placed.field.high, TICKS, endpoint=True)
    return raw


def _codec(loops: ctypes.CDLL, layouts: list[int], raw: np.ndarray) -> dict:
    numbers = np.array(layouts, dtype=np.int32)
    ns = np.zeros((2, TICKS), dtype=np.int64)
    refused = loops.bench_codec(numbers.ctypes.data, len(layouts), raw.ctypes.data, TICKS, ns[0].ctypes.data,
                                ns[1].ctypes.data)  # fmt: skip
    if refused:
        raise RuntimeError(f"{refused} frames did not come back as they were made")
    ns = ns[:, WARM_UP:]
    spread = {name: vars(measure.Spread.of(part)) for name, part in (("encode_us", ns[0]), ("decode_us", ns[1]))}
    return spread | {"both_us": vars(measure.Spread.of(ns.sum(axis=0)))}


def _link(loops: ctypes.CDLL) -> dict:
    handle = loops.hoap2_link_create()
    loops.hoap2_link_init(handle, library.LinkParameters({}).pointer, 0)
    asked = library.Block(library.signal_rows("controller", "output", library.COMMAND_REALS + library.COMMAND_INTS))
    measured = library.Block(library.signal_rows("plant", "output", library.MEASURED_REALS + library.MEASURED_INTS))
    asked.integer[:] = 1
    posture = np.array(parameters.known("controller")["posture_rad"].default)
    asked.real[: posture.size] = measured.real[: posture.size] = posture
    ns = np.zeros(TICKS, dtype=np.int64)
    loops.bench_link(handle, asked.pointer, measured.pointer, TICKS, ns.ctypes.data)
    loops.hoap2_link_destroy(handle)
    return vars(measure.Spread.of(ns[WARM_UP:]))


def _ls_bus() -> dict:
    """A tick of floor-walk in the host loop: all three FMUs, and their outputs read."""
    loaded = scenario.load("floor-walk", ["scenario.link=ls-bus"], None, None)
    both = products.open_both(products.Choice(), loaded)
    ns = np.zeros(TICKS, dtype=np.int64)
    try:
        step, reads, now = both.plant.step, (both.controller.get_outputs, both.plant.get_outputs), time.perf_counter_ns
        for k in range(TICKS):
            began = now()
            step()
            for read in reads:
                read()
            ns[k] = now() - began
    finally:
        both.close()
    return vars(measure.Spread.of(ns[WARM_UP:]))


def run(repeat: int, status: Callable[[str], None]) -> dict:
    """Medians over the repetitions."""
    loops, layouts = _loops(), frames_of_a_tick()
    raw = _raw(layouts, np.random.default_rng(1))
    runs = []
    with measure.one_core() as core:
        machine = measure.machine(core)
        for i in range(repeat):
            status(f"frames and link, {i + 1} of {repeat}")
            runs.append({"codec": _codec(loops, layouts, raw), "link_us": _link(loops), "ls_bus_us": _ls_bus()})
    lengths = [can_table.load().frames[i].length for i in layouts]
    return {"frames": len(layouts), "bytes": sum(lengths), "machine": machine, **measure.medians(runs), "runs": runs}


def show(document: dict) -> None:
    """On a terminal."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=f"{document['frames']} frames of a tick, {document['bytes']} bytes, in us", title_justify="left",
                  box=None, padding=(0, 2))  # fmt: skip
    for name in ("", "median", "p99"):
        table.add_column(name, justify="right" if name else "left")
    codec = document["codec"]
    rows = (("encode", codec["encode_us"]), ("decode", codec["decode_us"]), ("both", codec["both_us"]),
            ("link: nodes, boards, both buses", document["link_us"]),
            ("LS-BUS: three FMUs in the host loop", document["ls_bus_us"]))  # fmt: skip
    for name, spread in rows:
        table.add_row(name, f"{spread['median']:.2f}", f"{spread['p99']:.2f}")
    console = Console(highlight=False, soft_wrap=True)
    console.print(table)
    machine = document["machine"]
    console.print(f"  median of {len(document['runs'])}; {machine['processor']}, load {machine['load']:.1f}")
    if text := measure.busy(machine):
        console.print(f"  [yellow]{text}[/]: it is slower than it need be")
