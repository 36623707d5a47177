"""What others make of the FMUs: fmpy's own simulation, libcosim through the SSP, fmutool's look at each file."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np

from ..generate import ls_bus
from .check import Check, CheckFailed, Context, require, require_equal
from .check_files import subjects
from .instance import FmuInstance
from .pair import Trace

TICK_NS = 1_000_000
HELD_TICKS = 400


def fmpy_simulation(context: Context, product: str, version: int) -> str:
    """fmpy.simulate_fmu with the start values as inputs gives our values."""
    path = context.files.fmu(product, version)
    with FmuInstance(path) as fmu:
        fmu.initialize()
        rows = [r for r in fmu.rows.values() if r.group == "output"]
        names = [n for r in rows for n in (r.element_names if version == 2 else (r.name,))]
        result = fmpy.simulate_fmu(
            str(path), stop_time=HELD_TICKS * 1e-3, step_size=1e-3, output_interval=1e-3, output=names
        )
        require(len(result) == HELD_TICKS + 1, f"{len(result)} points instead of {HELD_TICKS + 1}")
        for point in range(HELD_TICKS + 1):
            flat = np.concatenate([np.asarray(result[n][point], dtype=np.float64).reshape(-1) for n in names])
            ours = np.concatenate([_values(fmu, r.name, r.kind) for r in rows])
            require(np.array_equal(flat, ours), f"point {point} differs")
            if point < HELD_TICKS:
                fmu.step()
                fmu.read()
    return f"{HELD_TICKS} ticks equal"


def _values(fmu: FmuInstance, name: str, kind: str) -> np.ndarray:
    array = fmu.outputs_real if kind == "real" else fmu.outputs_int
    return array[fmu.output_slices[name]].astype(np.float64)


def libcosim(context: Context) -> str:
    """The SSP in libcosim, step by step against the loop recorded here."""
    try:
        from libcosimpy.CosimExecution import CosimExecution
        from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
        from libcosimpy.CosimObserver import CosimObserver
    except ImportError as e:
        raise CheckFailed("libcosimpy is not installed: pip install libcosimpy==0.0.6") from e
    folder = context.scratch / "ssp"
    with zipfile.ZipFile(context.files.ssp) as archive:
        archive.extractall(folder)
    log_output_level(CosimLogLevel.ERROR)
    execution = CosimExecution.from_ssp_file(ssp_path=str(folder), step_size=TICK_NS)
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    slaves = {info.name.decode(): info.index for info in execution.slave_infos()}
    require(set(slaves) == {"controller", "plant"}, f"libcosim sees {sorted(slaves)}")
    recorded = context.loop(2)
    found = {product: Trace() for product in slaves}
    references = {product: _references(context, product) for product in slaves}
    for product, trace in found.items():  # the start is ours: libcosim shows values after steps only
        trace.outputs_real.append(recorded[product].outputs_real[0])
        trace.outputs_int.append(recorded[product].outputs_int[0])
    for _ in range(context.ticks):
        execution.step()
        for product, index in slaves.items():
            real, integer = references[product]
            found[product].outputs_real.append(np.array(observer.last_real_values(index, real)))
            found[product].outputs_int.append(np.array(observer.last_integer_values(index, integer), dtype=np.int32))
    for product in slaves:
        require_equal(found[product], recorded[product], f"{product} in libcosim")
    return f"{context.ticks} ticks of closed loop equal"


def _references(context: Context, product: str) -> tuple[list[int], list[int]]:
    with FmuInstance(context.files.fmu(product, 2)) as fmu:
        return tuple(
            [r for row in fmu.archive.select("output", kind) for r in row.references] for kind in ("real", "int")
        )


def fmutool(path: Path) -> str:
    """`fmutool -check` of the FMU manipulation toolbox; in a process of its own, since it writes to the terminal."""
    program = "import sys; from fmu_manipulation_toolbox.cli.fmutool import fmutool; sys.exit(fmutool())"
    done = subprocess.run(
        [sys.executable, "-c", program, "-input", str(path), "-check"], capture_output=True, text=True, timeout=120
    )
    said = [line for line in (done.stdout + done.stderr).splitlines() if line.startswith(("ERROR", "Module", "Import"))]
    require(done.returncode == 0 and not said, f"exit code {done.returncode}: {'; '.join(said[:3])}")
    return "no findings"


def checks() -> list[Check]:
    """The checks of this file."""
    found = [
        Check("fmpy simulate", f"{p} FMI {v}", lambda c, p=p, v=v: fmpy_simulation(c, p, v)) for p, v in subjects()
    ]
    look = "fmutool -check"
    found += [Check(look, f"{p} FMI {v}", lambda c, p=p, v=v: fmutool(c.files.fmu(p, v))) for p, v in subjects()]
    found += [Check(look, f"{f} LS-BUS", lambda c, f=f: fmutool(c.files.ls_bus(f))) for f in ls_bus.FLAVOURS]
    return [*found, Check("libcosim", "hoap2.ssp", libcosim)]
