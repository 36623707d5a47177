"""A product as a side of the co-simulation master without FMI (see hoap2.master.Side)."""

from __future__ import annotations

from hoap2 import parameters
from hoap2.binding import Controller, Plant
from hoap2.signal_log import Column


def _columns(product: str, group: str) -> list[Column]:
    table = parameters.table()
    return [Column(name, s.unit, s.kind) for s in table.select(product, group) for name in table.element_names(s)]


class LibrarySide:
    """Steps a Controller or a Plant of the binding; its arrays are views of the C structs."""

    def __init__(self, product: Controller | Plant) -> None:
        self.product = product
        name = "controller" if isinstance(product, Controller) else "plant"
        self.inputs, self.outputs = _columns(name, "input"), _columns(name, "output")
        self.real_in, self.int_in = product.inputs.flat()
        self.real_out, self.int_out = product.outputs.flat()
        self.step = product.step

    def set_input(self, name: str, value) -> None:
        """One row of the inputs."""
        self.product.inputs.view(name)[...] = value

    def get_outputs(self) -> None:
        """Nothing to do: a step leaves its outputs in the struct."""

    def set_inputs(self) -> None:
        """Nothing to do: a step reads the struct."""
