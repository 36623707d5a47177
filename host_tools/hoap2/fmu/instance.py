"""One running FMU: whole arrays a call, preallocated, for either FMI version.

The arrays `inputs_real, inputs_int, outputs_real, outputs_int` are this instance's exchange
buffers: fill or read them in place, `write()` and `read()` move them in one FMI call each.
`input_slices[name]` and `output_slices[name]` say where a row of signals.toml lies in them.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from pathlib import Path

import fmpy.fmi2
import fmpy.fmi3
import numpy as np
import numpy.typing as npt

from .archive import FmuArchive, FmuCallError, FmuError, FmuFileError, FmuVariableError, nearest
from .buffers import DTYPE, Exchange, ParameterValues, RowCall
from .states import FmuState, WithStates, state_call

__all__ = ["FmuArchive", "FmuCallError", "FmuError", "FmuFileError", "FmuInstance", "FmuState", "FmuVariableError"]

OK_OR_WARNING = 1
KEPT_LOG_LINES = 200


class FmuInstance(WithStates):
    """A Co-Simulation FMU, FMI 2.0 or 3.0, with the variables of signals.toml."""

    def __init__(
        self,
        source: str | Path | FmuArchive,
        product: str | None = None,
        name: str | None = None,
        logging: bool = True,
        event_mode: bool = False,
    ):
        """source: an FMU file, or an archive that several instances share. event_mode: see ls_bus_loop.py."""
        self._own_archive = not isinstance(source, FmuArchive)
        self.archive = FmuArchive(source, product) if self._own_archive else source
        self.version, self.product, self.rows = self.archive.version, self.archive.product, self.archive.rows
        self.name = name or self.product
        self.log: list[tuple[int, str, str]] = []  # status, category, text
        self.states: list[FmuState] = []  # not yet released
        self._parameters = ParameterValues(self.rows, self.product, self.archive.description)
        self.tick = 0
        self.start_time_s = 0.0
        self.component: ctypes.c_void_p | None = None
        self.initialised = False
        try:
            self._load(logging, event_mode)
        except BaseException:
            self.close()
            raise
        self._make_buffers()

    # --- set-up ---

    def _load(self, logging: bool, event_mode: bool) -> None:
        description = self.archive.description
        kind = fmpy.fmi2.FMU2Slave if self.version == 2 else fmpy.fmi3.FMU3Slave
        token = description.guid if self.version == 2 else description.instantiationToken
        try:
            self.fmu = kind(
                guid=token,
                unzipDirectory=str(self.archive.folder),
                modelIdentifier=description.coSimulation.modelIdentifier,
                instanceName=self.name,
            )
            if self.version == 2:
                self.fmu.instantiate(loggingOn=logging, callbacks=self._fmi2_callbacks())
            else:
                self.fmu.instantiate(loggingOn=logging, eventModeUsed=event_mode, logMessage=self._keep_fmi3)
        except Exception as e:
            raise FmuFileError(f"{self.archive.path}: the FMU cannot be started: {e}{self._logged()}") from e
        self.component = self.fmu.component
        self._handle = ctypes.c_void_p(self.component)
        # the same library once more, without fmpy's argument conversions: they cost more than the calls
        self._library = ctypes.CDLL(str(self.archive.binary))

    def _fmi2_callbacks(self) -> fmpy.fmi2.fmi2CallbackFunctions:
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self._keep_fmi2)
        callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
        return callbacks

    def _keep_fmi2(self, _environment: object, _name: bytes, status: int, category: bytes, text: bytes) -> None:
        self._keep_fmi3(None, status, category, text)

    def _keep_fmi3(self, _environment: object, status: int, category: bytes, text: bytes) -> None:
        self.log.append((status, (category or b"").decode(errors="replace"), (text or b"").decode(errors="replace")))
        del self.log[:-KEPT_LOG_LINES]

    def _logged(self) -> str:
        """The reasons that the FMU gave since the last successful call that was checked."""
        texts = [text for status, _, text in self.log if status > OK_OR_WARNING]
        return ": " + "; ".join(texts[-3:]) if texts else ""

    def _make_buffers(self) -> None:
        parts = {
            (group, kind): Exchange(self.archive.select(group, kind), kind, self.version)
            for group in ("input", "output")
            for kind in ("real", "int")
        }
        self.inputs_real, self.inputs_int = parts["input", "real"].array, parts["input", "int"].array
        self.outputs_real, self.outputs_int = parts["output", "real"].array, parts["output", "int"].array
        self.input_slices = parts["input", "real"].slices | parts["input", "int"].slices
        self.output_slices = parts["output", "real"].slices | parts["output", "int"].slices
        self.output_names_real = parts["output", "real"].element_names
        self.output_names_int = parts["output", "int"].element_names
        prefix = f"fmi{self.version}"
        names = {"real": "Real", "int": "Integer"} if self.version == 2 else {"real": "Float64", "int": "Int32"}
        self._parts = parts
        self._functions = {
            (group, kind): getattr(self._library, prefix + verb + names[kind])
            for group, verb in (("input", "Set"), ("output", "Get"))
            for kind in ("real", "int")
        }
        self._writers, self._readers = self._calls("input"), self._calls("output")
        self._now, self._size = ctypes.c_double(), ctypes.c_double()
        self._do_step = getattr(self._library, f"{prefix}DoStep")
        if self.version == 2:
            self._step_rest = (ctypes.c_int(1),)
        else:
            self._step_results = (*[ctypes.c_bool() for _ in range(3)], ctypes.c_double())
            self._step_rest = (ctypes.c_bool(True), *[ctypes.byref(r) for r in self._step_results])
        self._step_arguments = (self._handle, self._now, self._size, *self._step_rest)

    def _calls(self, group: str) -> list[tuple]:
        """(function, arguments) of each call that moves something between the FMU and its arrays."""
        parts = [(kind, self._parts[group, kind]) for kind in ("real", "int")]
        return [(self._functions[group, k], (self._handle, *part.arguments)) for k, part in parts if part.array.size]

    # --- calls ---

    def call(self, name: str, *arguments: object) -> None:
        """An FMI function by its name without the prefix; FmuCallError when it refuses."""
        if name.endswith("FMUState") or "FMUStateSize" in name:
            name = state_call(name, self.version)
        if not self.component:
            raise FmuCallError(f"{self.name}: the instance is closed")
        seen = len(self.log)
        function = getattr(self._library, f"fmi{self.version}{name}")
        status = function(self._handle, *arguments)
        if status > OK_OR_WARNING:
            self._refused(name, seen)

    def _refused(self, name: str, seen: int = 0) -> None:
        texts = [text for status, _, text in self.log[seen:] if status > OK_OR_WARNING] or [
            text for status, _, text in self.log[-1:]
        ]
        reason = ": " + "; ".join(texts) if texts else " and gave no reason"
        raise FmuCallError(f"{self.name} ({self.archive.path.name}) refused {name} at {self.time_s:.3f} s{reason}")

    def set_parameters(self, values: Mapping[str, float | int | npt.ArrayLike]) -> None:
        """Parameters by row name (a number fills an array) or by element name (`r_knee.posture_rad`)."""
        for name, value in values.items():
            row, data = self._parameters.resolve(name, value)
            self._values_call("Set", row.kind, row.references, data)
            self._parameters.keep(row, data)

    def _values_call(self, verb: str, kind: str, references: tuple[int, ...], data: np.ndarray) -> None:
        types = {"real": "Real", "int": "Integer"} if self.version == 2 else {"real": "Float64", "int": "Int32"}
        array = (ctypes.c_uint32 * len(references))(*references)
        sizes = (ctypes.c_size_t(data.size),) if self.version == 3 else ()
        self.call(
            verb + types[kind], array, ctypes.c_size_t(len(references)), ctypes.c_void_p(data.ctypes.data), *sizes
        )

    def get(self, name: str) -> np.ndarray:
        """A row's present value, straight from the FMU (slow; for tests and looks)."""
        if name not in self.rows:
            raise FmuVariableError(f"the {self.product} has no variable {name}{nearest(name, self.rows)}")
        row = self.rows[name]
        data = np.zeros(row.count, dtype=DTYPE[row.kind])
        self._values_call("Get", row.kind, row.references, data)
        return data.reshape(row.shape)

    # --- life ---

    def initialize(self, start_time_s: float = 0.0, stop_time_s: float | None = None) -> None:
        """Through initialisation into stepping; the outputs are read."""
        self.start_time_s, self.tick = start_time_s, 0
        stop = (ctypes.c_double(stop_time_s or 0.0),)
        start = (ctypes.c_double(start_time_s),)
        tolerance = ctypes.c_double(0.0)
        if self.version == 2:
            no, defined = ctypes.c_int(0), ctypes.c_int(stop_time_s is not None)
            self.call("SetupExperiment", no, tolerance, *start, defined, *stop)
            self.call("EnterInitializationMode")
        else:
            no, defined = ctypes.c_bool(False), ctypes.c_bool(stop_time_s is not None)
            self.call("EnterInitializationMode", no, tolerance, *start, defined, *stop)
        self.call("ExitInitializationMode")
        self.initialised = True
        self._read_start_inputs()
        self.read()

    def _read_start_inputs(self) -> None:
        """The input arrays begin as the FMU's start values."""
        for kind, array in (("real", self.inputs_real), ("int", self.inputs_int)):
            references = [r for row in self.archive.select("input", kind) for r in row.references]
            if references:
                self._values_call("Get", kind, tuple(references), array)

    @property
    def time_s(self) -> float:
        return self.start_time_s + (self.tick * 1000) / 1e6

    def set_input(self, name: str, value: float | int | npt.ArrayLike) -> None:
        """One row of the inputs, at once, in the FMU and in the input array."""
        if name not in self.input_slices:
            raise FmuVariableError(f"the {self.product} has no input {name}{nearest(name, self.input_slices)}")
        row = self.rows[name]
        array = getattr(self, f"inputs_{row.kind}")[self.input_slices[name]]
        array[:] = np.asarray(value).reshape(-1)
        self._values_call("Set", row.kind, row.references, array)

    def write(self) -> None:
        """Input arrays -> FMU."""
        for function, arguments in self._writers:
            if function(*arguments) > OK_OR_WARNING:
                self._refused("set inputs")

    def read(self) -> None:
        """FMU -> output arrays."""
        for function, arguments in self._readers:
            if function(*arguments) > OK_OR_WARNING:
                self._refused("get outputs")

    def writes_from(self, real: np.ndarray, integer: np.ndarray) -> Callable[[int], None]:
        """A function of k (not checked) that sets the inputs from row k of these (ticks, elements), without a copy.

        With fewer columns than inputs it sets the first ones; they must be whole rows of the table.
        """
        return self._row_function("input", real, integer, "set inputs")

    def reads_into(self, real: np.ndarray, integer: np.ndarray) -> Callable[[int], None]:
        """A function of k (not checked) that reads all outputs into row k of these; the output arrays stay."""
        return self._row_function("output", real, integer, "get outputs")

    def _row_function(self, group: str, real: np.ndarray, integer: np.ndarray, what: str) -> Callable[[int], None]:
        parts = {kind: self._parts[group, kind] for kind in ("real", "int")}
        given = {"real": real, "int": integer}
        if group == "input":
            parts = {kind: part.leading(given[kind].shape[1]) for kind, part in parts.items()}
        calls = [
            RowCall(self._functions[group, kind], self._handle, part, given[kind])
            for kind, part in parts.items()
            if part.array.size
        ]
        bound = [(c.function, c.arguments, c.values, c.address, c.stride, c.rows) for c in calls]

        def move(k: int) -> None:
            for function, arguments, values, address, stride, _ in bound:
                values.value = address + k * stride
                if function(*arguments) > OK_OR_WARNING:
                    self._refused(what)

        return move

    def stepper(self) -> Callable[[], None]:
        """step() of one tick as a function that does nothing else: what a loop of many ticks calls."""
        now, do_step, log = ctypes.c_double(), self._do_step, self.log
        arguments = (self._handle, now, ctypes.c_double(1000 / 1e6), *self._step_rest)

        def step() -> None:
            tick = self.tick
            now.value = self.start_time_s + (tick * 1000) / 1e6
            seen = len(log)
            if do_step(*arguments) > OK_OR_WARNING:
                self._refused("DoStep", seen)
            self.tick = tick + 1

        return step

    def step(self, tick_count: int = 1) -> None:
        """Advance by whole ticks of 1 ms with the inputs held; neither writes nor reads the arrays."""
        self._now.value = self.start_time_s + (self.tick * 1000) / 1e6
        self._size.value = (tick_count * 1000) / 1e6
        seen = len(self.log)
        if self._do_step(*self._step_arguments) > OK_OR_WARNING:
            self._refused("DoStep", seen)
        self.tick += tick_count

    def step_arguments(self, start_s: float, size_s: float) -> tuple:
        """Arguments of call("DoStep", ...) for any start and size, as tests of refusals need them."""
        return ctypes.c_double(start_s), ctypes.c_double(size_s), *self._step_rest

    def terminate(self) -> None:
        """End the simulation and free everything."""
        if self.component and self.initialised:
            self.call("Terminate")
        self.close()

    def close(self) -> None:
        """Free the instance, whatever its state."""
        if self.component:
            for state in list(self.states):
                state.release()
            getattr(self._library, f"fmi{self.version}FreeInstance")(self._handle)
            self.component = None
        if self._own_archive:
            self.archive.close()

    def __enter__(self) -> FmuInstance:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
