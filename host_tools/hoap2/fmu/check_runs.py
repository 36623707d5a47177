"""Checks of behaviour: states, steps, instances, threads, bad input; all to the bit."""

from __future__ import annotations

import math
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from ..generate.tables import load
from .build import VERSIONS
from .check import RESTORE_TICK, Check, Context, require, require_equal
from .check_files import subjects
from .instance import FmuArchive, FmuCallError, FmuInstance
from .pair import Pair, Trace, replay

STEP_SIZES = (1, 2, 5, 10)
EXCHANGE_BUDGET_US = 20.0


def versions_agree(context: Context) -> str:
    a, b = context.loop(2), context.loop(3)
    for product in a:
        require_equal(a[product], b[product], f"{product}, FMI 2 against FMI 3")
    return f"{context.ticks} ticks of closed loop equal"


def run_twice(context: Context) -> str:
    """A second run from the same files gives the same bytes."""
    with context.open_pair(3) as pair:
        again = pair.run(context.ticks)
    for product, trace in context.loop(3).items():
        require_equal(again[product], trace, f"{product}, second run")
    return f"{context.ticks} ticks of closed loop equal"


def _span(trace: Trace, begin: int, end: int) -> Trace:
    return Trace(outputs_real=trace.outputs_real[begin : end + 1], outputs_int=trace.outputs_int[begin : end + 1])


def _tail(trace: Trace, begin: int) -> Trace:
    return Trace(
        trace.inputs_real[begin:], trace.inputs_int[begin:], trace.outputs_real[begin:], trace.outputs_int[begin:]
    )


def restore(context: Context, version: int) -> str:
    """In mid-run: back by state, and in fresh instances by bytes; both go on as before."""
    expected = {product: _tail(trace, RESTORE_TICK) for product, trace in context.loop(version).items()}
    with context.open_pair(version) as pair:
        pair.run(RESTORE_TICK)
        step_index = int(pair.controller.outputs_int[pair.controller.output_slices["step_index"]][0])
        require(step_index > 0, f"the robot does not walk at tick {RESTORE_TICK}")
        sides = {"controller": pair.controller, "plant": pair.plant}
        states = {name: fmu.get_state() for name, fmu in sides.items()}
        blocks = {name: fmu.serialize(states[name]) for name, fmu in sides.items()}
        for attempt in ("first continuation", "restored"):
            found = pair.run(context.ticks - RESTORE_TICK)
            for name in sides:
                require_equal(found[name], expected[name], f"{name}, {attempt}")
            for name, fmu in sides.items():
                fmu.set_state(states[name])
        for state in states.values():
            state.release()
    _resume(context, version, blocks, expected)
    sizes = " and ".join(str(len(b)) for b in blocks.values())
    return f"in step {step_index} of the walk, by state and by bytes ({sizes}): equal"


def _resume(context: Context, version: int, blocks: dict[str, bytes], expected: dict[str, Trace]) -> None:
    """Bytes into instances that never ran, of this FMI version and of the other."""
    for target in (version, 5 - version):
        with (
            FmuInstance(context.files.fmu("controller", target)) as controller,
            FmuInstance(context.files.fmu("plant", target)) as plant,
        ):
            for fmu in (controller, plant):
                state = fmu.deserialize(blocks[fmu.product])
                fmu.set_state(state)
                state.release()
            found = Pair(controller, plant).run(context.ticks - RESTORE_TICK)
            for name in blocks:
                require_equal(found[name], expected[name], f"{name}, bytes into a fresh FMI {target} instance")


def step_sizes(context: Context, product: str, version: int) -> str:
    """Held inputs: n ticks in one step give the bytes of n steps."""
    recorded = context.loop(version)[product]
    span = max(STEP_SIZES)
    archive = FmuArchive(context.files.fmu(product, version))
    results = {}
    for ticks in STEP_SIZES:
        with FmuInstance(archive) as fmu:
            fmu.initialize()
            seen = []
            for point in range(0, min(context.ticks, 1000), span):
                fmu.inputs_real[:], fmu.inputs_int[:] = recorded.inputs_real[point], recorded.inputs_int[point]
                fmu.write()
                for _ in range(span // ticks):
                    fmu.step(ticks)
                fmu.read()
                seen.append(fmu.outputs_real.tobytes() + fmu.outputs_int.tobytes())
            results[ticks] = b"".join(seen) + fmu.serialize()
    archive.close()
    different = [n for n in STEP_SIZES if results[n] != results[1]]
    require(not different, f"steps of {different} ticks give other bytes than steps of 1")
    return f"steps of {', '.join(map(str, STEP_SIZES))} ticks: equal, state too"


def bad_steps(context: Context, product: str, version: int) -> str:
    """A step that is no whole number of ticks, or starts elsewhere, is refused and changes nothing."""
    with FmuInstance(context.files.fmu(product, version)) as fmu:
        fmu.initialize()
        fmu.step(7)
        before = fmu.serialize()
        sizes = {
            "half a tick": 0.5,
            "1.5 ticks": 1.5,
            "nothing": 0.0,
            "backwards": -1.0,
            "NaN": math.nan,
            "infinite": math.inf,
        }
        for name, ticks in sizes.items():
            _refused_step(fmu, name, fmu.time_s, ticks * 1e-3)
        for name, start_s in {"later": fmu.time_s + 1e-3, "earlier": 0.0, "NaN": math.nan}.items():
            _refused_step(fmu, f"start {name}", start_s, 1e-3)
        require(fmu.serialize() == before, "a refused step changed the state")
        fmu.step()
    return f"{len(sizes) + 3} kinds refused with a reason, state unchanged"


def _refused_step(fmu: FmuInstance, name: str, start_s: float, size_s: float) -> None:
    fmu.log.clear()
    try:
        fmu.call("DoStep", *fmu.step_arguments(start_s, size_s))
    except FmuCallError:
        require(bool(fmu.log), f"{name}: refused without a reason")
    else:
        require(False, f"a step ({name}) was accepted")


def interleaved(context: Context, product: str, version: int) -> str:
    """Two instances of one library, stepped in turn, do not feel each other."""
    recorded = context.loop(version)[product]
    ticks = min(context.ticks, 600)
    archive = FmuArchive(context.files.fmu(product, version))
    with FmuInstance(archive, name="one") as one, FmuInstance(archive, name="two") as two:
        one.initialize()
        two.initialize()
        for _ in range(50):  # two runs ahead, on other inputs
            two.step()
        found = Trace()
        found.note_outputs(one)
        for real, integer in list(zip(recorded.inputs_real, recorded.inputs_int))[:ticks]:
            one.inputs_real[:], one.inputs_int[:] = real, integer
            one.write()
            one.step()
            two.step()
            one.read()
            found.note_outputs(one)
    archive.close()
    require_equal(found, _span(recorded, 0, ticks), "beside another instance")
    return f"{ticks} ticks beside another instance: equal"


def other_threads(context: Context, product: str, version: int) -> str:
    """Created here, stepped from several other threads in turn, freed here."""
    recorded = context.loop(version)[product]
    parts = [(0, 200), (200, 400), (400, 600)]
    found = Trace()
    failures: list[BaseException] = []

    def part(begin: int, end: int) -> None:
        try:
            piece = replay(fmu, recorded, begin, end)
            skip = 1 if begin else 0
            found.outputs_real.extend(piece.outputs_real[skip:])
            found.outputs_int.extend(piece.outputs_int[skip:])
        except BaseException as e:  # handed to the main thread
            failures.append(e)

    with FmuInstance(context.files.fmu(product, version)) as fmu:
        fmu.initialize()
        for span in parts:
            worker = threading.Thread(target=part, args=span)
            worker.start()
            worker.join()
    if failures:
        raise failures[0]
    require_equal(found, _span(recorded, 0, 600), "from other threads")
    return f"600 ticks from {len(parts)} other threads: equal"


def at_once(context: Context, product: str, version: int) -> str:
    """Two instances of one library stepped by two threads at the same time."""
    recorded = context.loop(version)[product]
    ticks = min(context.ticks, 2500)
    with FmuArchive(context.files.fmu(product, version)) as archive:
        instances = [FmuInstance(archive, name=name) for name in ("one", "two")]
        for fmu in instances:
            fmu.initialize()
        with ThreadPoolExecutor(len(instances)) as pool:
            found = list(pool.map(lambda fmu: replay(fmu, recorded, 0, ticks), instances))
        for fmu in instances:
            fmu.close()
    for trace in found:
        require_equal(trace, _span(recorded, 0, ticks), "beside another thread's instance")
    return f"{ticks} ticks in two threads at the same time: equal"


def bad_parameters(context: Context, product: str, version: int) -> str:
    """Outside its range: the initialisation fails and names the variable and the range."""
    name = {"controller": "step_length_m", "plant": "friction_mu"}[product]
    signal = next(s for s in load().signals if s.product == product and s.name == name)
    for value in (signal.high + 1.0, signal.low - 1.0, math.nan):
        with FmuInstance(context.files.fmu(product, version)) as fmu:
            fmu.set_parameters({name: value})
            try:
                fmu.initialize()
            except FmuCallError as e:
                require(
                    name in str(e) and f"{signal.high:g}" in str(e),
                    f"the error does not name {name} and its range: {e}",
                )
            else:
                require(False, f"{name} = {value} was accepted")
    return f"{name} above, below, NaN: refused by name"


def nan_controller(context: Context, version: int) -> str:
    """NaN from the sensors: no error, no NaN out, a fault and the safe posture."""
    table = load()
    with FmuInstance(context.files.fmu("controller", version)) as fmu:
        fmu.initialize()
        recorded = context.loop(version)["controller"]
        replay(fmu, recorded, 0, 500)
        for tick in range(4000):
            fmu.inputs_real[:] = np.nan
            fmu.inputs_int[fmu.input_slices["sensor_tick"]] = 500 + tick
            fmu.write()
            fmu.step()
            fmu.read()
            drive = fmu.outputs_real[fmu.output_slices["q_ref_rad"]]
            require(bool(np.all(np.isfinite(drive))), f"a joint reference is not finite {tick + 1} ticks after the NaN")
        fault = int(fmu.outputs_int[fmu.output_slices["fault"]][0])
        mode = table.enums["mode"][int(fmu.outputs_int[fmu.output_slices["mode"]][0])]
    require(bool(fault & table.faults["bad_input"]), f"the fault word {fault} does not say bad_input")
    require(mode == "safe", f"the mode after 4 s of NaN is {mode}, not safe")
    return f"fault {fault}, mode {mode}, references finite"


def nan_plant(context: Context, version: int) -> str:
    """NaN drive settings: the step is refused with a reason and changes nothing."""
    recorded = context.loop(version)["plant"]
    with FmuInstance(context.files.fmu("plant", version)) as fmu:
        fmu.initialize()
        replay(fmu, recorded, 0, 300)
        kept = fmu.inputs_real.copy()
        before = fmu.serialize()
        fmu.inputs_real[fmu.input_slices["q_ref_rad"]] = np.nan
        fmu.write()
        reason = ""
        try:
            fmu.step()
        except FmuCallError as e:
            reason = str(e)
        require(bool(reason), "a step with NaN inputs was accepted")
        require("no reason" not in reason, "refused without a reason")
        fmu.inputs_real[:] = kept
        fmu.write()
        require(fmu.serialize() == before, "the refused step changed the state")
        require_equal(replay(fmu, recorded, 300, 600), _span(recorded, 300, 600), "after the refused step")
    return "refused with a reason, then goes on equal"


def checks() -> list[Check]:
    """The checks of this file."""
    found = [Check("FMI 2 = FMI 3", "pairs", versions_agree), Check("repeatable", "pair FMI 3", run_twice)]
    found += [Check("save and restore", f"pair FMI {v}", lambda c, v=v: restore(c, v)) for v in VERSIONS]
    each = {
        "communication steps": step_sizes,
        "bad steps refused": bad_steps,
        "two instances": interleaved,
        "other threads": other_threads,
        "two threads at once": at_once,
        "bad parameters refused": bad_parameters,
    }
    for name, function in each.items():
        found += [Check(name, f"{p} FMI {v}", lambda c, f=function, p=p, v=v: f(c, p, v)) for p, v in subjects()]
    for v in VERSIONS:
        found.append(Check("NaN inputs", f"controller FMI {v}", lambda c, v=v: nan_controller(c, v)))
        found.append(Check("NaN inputs", f"plant FMI {v}", lambda c, v=v: nan_plant(c, v)))
    return found
