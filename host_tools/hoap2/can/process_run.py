"""`./hoap2 can controller` and `./hoap2 can plant`: a product, its end of the buses, and what became of it."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from pathlib import Path

from hoap2 import metrics, parameters, runner, scenario, seeds
from hoap2.binding import Controller, Plant
from hoap2.can import library
from hoap2.can.process import OTHER, Options, Process
from hoap2.errors import UserError
from hoap2.generate import can_table
from hoap2.library_side import LibrarySide
from hoap2.master import StopRequest
from hoap2.signal_log import SignalLog, columns_of

PRODUCTS = {"controller": Controller, "plant": Plant}


@dataclass(frozen=True)
class Request:
    """What to run: name is `controller` or `plant`."""

    name: str
    scenario: str
    overrides: tuple[str, ...] = ()
    seed: int = 0
    duration_s: float | None = None
    out: Path | None = None


def _say(name: str, text: str) -> None:
    print(f"hoap2 can {name}: {text}", file=sys.stderr, flush=True)


class _Rows:
    """The side's outputs as rows of a log."""

    def __init__(self, name: str, side: LibrarySide, ticks: int) -> None:
        self.log, self.side = SignalLog(columns_of(name), ticks + 1), side

    def take(self, _tick: int) -> None:
        row = self.log.count
        if row < len(self.log.real):
            self.log.real[row], self.log.integer[row] = self.side.real_out, self.side.int_out
            self.log.count += 1


def _loaded(request: Request) -> scenario.Scenario:
    loaded = scenario.load(request.scenario, [*request.overrides, "scenario.link=can"], None, request.duration_s)
    seeds.apply(loaded, request.seed)
    return loaded


def run(request: Request, interface: str, channels: list[str] | None, pace: float | None, wait_s: float,
        timeout_s: float) -> int:  # fmt: skip
    """Run one of the two to its end; the exit code."""
    name, loaded = request.name, _loaded(request)
    if request.out is not None and not request.out.parent.is_dir():
        raise UserError(f"no folder {request.out.parent}")
    side = LibrarySide(PRODUCTS[name](**loaded.values[name]))
    ticks = runner.ticks_of(loaded)
    rows = _Rows(name, side, ticks)
    with StopRequest() as stop:
        wanted = Options(interface, tuple(channels or ("right", "left")), ticks, pace, wait_s, timeout_s)
        process = Process(side, name, wanted, rows.take, lambda: stop.signal is not None)
        try:
            how = "in lockstep" if pace is None else f"at {pace:g} of real time"
            _say(name, f"{loaded.name}, {loaded.duration_s:g} s {how}, on {interface} {', '.join(wanted.channels)}; "
                       f"waits for the {OTHER[name]}")  # fmt: skip
            started = time.monotonic()
            ended = process.run()
            wall_s = time.monotonic() - started
        finally:
            process.close()
    rows.take(process.tick)
    if request.out is not None:
        rows.log.write(request.out)
    return _tell(request, process, rows.log, ended, wall_s)


def _tell(request: Request, process: Process, log: SignalLog, ended: str, wall_s: float) -> int:
    name, health = request.name, process.end.health()
    simulated_s = max(0, process.tick) * parameters.table().tick_us * 1e-6
    refused = [f"{count} {why}" for why, count in zip(library.refusals(), health.refused) if count]
    print(f"{name}: {ended}; {simulated_s:.3f} s simulated in {wall_s:.2f} s, {process.frames['sent']} frames sent, "
          f"{process.frames['received']} received, refused: {', '.join(refused) or 'none'}")  # fmt: skip
    good = ended == "done"
    if name == "plant":
        fall = metrics.fall_tick(log) if log.count else None
        com_m = log.block("p.true_com_W_m")[-1]
        modes = f"{health.holding} of {len(can_table.load().boards)} boards in a safe mode, {health.holds} holds"
        print(f"plant: {'stands' if fall is None else f'fell at {log.t_s[fall]:.3f} s'}, "
              f"CoM at {com_m[0]:.4f}, {com_m[1]:.4f}, {com_m[2]:.4f} m; {modes}")  # fmt: skip
        good = good and fall is None
    else:
        table, faults = parameters.table(), int(log.column("c.fault")[-1])
        said = [n for n, bit in table.faults.items() if faults & bit]
        state = can_table.load().raw["enum"]["controller_state"][health.state]
        print(f"controller: {state}, faults: {', '.join(said) or 'none'}")
    return runner.EXIT_INTERRUPTED if ended == "stopped" else 0 if good else 1
