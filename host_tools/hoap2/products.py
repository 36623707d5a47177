"""The two products of a run: which FMUs, opened with a scenario's parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from hoap2 import parameters, paths
from hoap2.errors import UserError
from hoap2.fmu.instance import FmuError, FmuInstance
from hoap2.fmu.ls_bus_loop import LsBusLink, LsBusLoop
from hoap2.generate import ls_bus
from hoap2.generate.tables import PRODUCTS
from hoap2.master import Side
from hoap2.scenario import Scenario
from hoap2.signal_log import Column, columns_of
from hoap2.wall_clock import WallClock
from hoap2.wiring import DirectLink, Link


LS_BUS_LINK = "ls-bus"


@dataclass(frozen=True)
class Choice:
    """FMUs named by the user, or None for the built ones of an FMI version."""

    controller: Path | None = None
    plant: Path | None = None
    fmi: int = 3

    def path(self, product: str) -> Path:
        named = getattr(self, product)
        if named is None:
            return paths.fmu(product, self.fmi)
        if not named.is_file():
            raise UserError(f"no FMU file {named}", f"--{product} takes the path of an .fmu file")
        return named


class FmuSide:
    """An FMU as the master sees it: its arrays are the FMU's own exchange buffers."""

    def __init__(self, instance: FmuInstance) -> None:
        self.instance = instance
        product = instance.product
        units = {c.name[2:]: c.unit for c in columns_of(product)}
        named = (("real", instance.output_names_real), ("int", instance.output_names_int))
        self.outputs = [Column(name, units[name], kind) for kind, names in named for name in names]
        table = parameters.table()
        rows = [s for s in table.select(product, "input") if not s.operator or s.name in instance.rows]
        self.inputs = [Column(element, s.unit, s.kind) for s in rows for element in table.element_names(s)]
        self.real_out, self.int_out = instance.outputs_real, instance.outputs_int
        self.real_in, self.int_in = instance.inputs_real, instance.inputs_int
        self.get_outputs, self.set_inputs, self.step = instance.read, instance.write, instance.stepper()
        self.reads_into, self.writes_from = instance.reads_into, instance.writes_from
        self.set_input, self.set_parameters = instance.set_input, instance.set_parameters


@dataclass
class Products:
    """Both sides, initialised, the files they came from, and how to let go of them."""

    controller: Side
    plant: Side
    files: dict[str, Path]
    instances: tuple[FmuInstance, ...] = ()
    link: Link = field(default_factory=DirectLink)
    clock: WallClock = field(default_factory=WallClock)  # runs since they began to be opened

    def close(self) -> None:
        """Free the FMUs; a failing one does not keep the other."""
        for instance in self.instances:
            try:
                instance.terminate()
            except FmuError:
                instance.close()


def _open(product: str, path: Path, scenario: Scenario, event_mode: bool = False) -> FmuInstance:
    instance = FmuInstance(path, product, event_mode=event_mode)
    try:
        values = scenario.values.get(product, {})
        for name, signal in (parameters.known(product) if values else {}).items():
            if name in instance.rows:
                instance.set_parameters({name: values[name]})
            elif values[name] != signal.default:
                raise UserError(f"{path} has no parameter {name}, which this scenario sets",
                                f"leave {product}.{name} at its default, or use an FMU that has it")  # fmt: skip
        instance.initialize()
    except BaseException:
        instance.close()
        raise
    return instance


def open_both(choice: Choice, scenario: Scenario) -> Products:
    """Both FMUs, started with the scenario's parameters; UserError when one cannot be used."""
    clock = WallClock()
    if scenario.link == LS_BUS_LINK:
        return _open_ls_bus(choice, scenario, clock)
    files = {product: choice.path(product) for product in PRODUCTS}
    link = open_link(scenario)
    opened: list[FmuInstance] = []
    try:
        for product in PRODUCTS:
            opened.append(_open(product, files[product], scenario))
    except (FmuError, UserError) as error:
        for instance in opened:
            instance.close()
        if isinstance(error, UserError):
            raise
        raise UserError(str(error)) from None
    return Products(FmuSide(opened[0]), FmuSide(opened[1]), files, tuple(opened), link, clock)


def _open_ls_bus(choice: Choice, scenario: Scenario, clock: WallClock) -> Products:
    """Controller, plant and bus FMU, joined by their bus terminals; the plant's step drives all three."""
    if choice.fmi != 3:
        raise UserError("FMI-LS-BUS is for FMI 3.0", "leave out --fmi, or use --link can")
    named = {"controller": choice.controller, "plant": choice.plant}
    files = {f: choice.path(f) if named.get(f) else paths.ls_bus_fmu(f) for f in ls_bus.FLAVOURS}
    opened: list[FmuInstance] = []
    try:
        for flavour, path in files.items():
            opened.append(_open(flavour, path, scenario, event_mode=True))
        loop = LsBusLoop(*opened)
    except (FmuError, UserError) as error:
        for instance in opened:
            instance.close()
        if isinstance(error, UserError):
            raise
        raise UserError(str(error), "--link ls-bus takes FMUs with bus terminals (docs/ls_bus.md)") from None
    controller, plant = FmuSide(opened[0]), FmuSide(opened[1])
    controller.step, plant.step = loop.no_step, loop.advance
    return Products(controller, plant, files, tuple(opened), LsBusLink(), clock)


def open_link(scenario: Scenario) -> Link:
    """What carries the signals of this scenario."""
    if scenario.link == "direct":
        return DirectLink()
    from hoap2.can.link import CanLink

    return CanLink(scenario.can, scenario.seed)
