"""FMUs with bus terminals one by one: order of calls, bytes that are no operations."""

from __future__ import annotations

import ctypes
import random
from pathlib import Path

import pytest
from hoap2.fmu.archive import FmuCallError
from hoap2.fmu.build import FmuSet
from hoap2.fmu.check_ls_bus import FIRST_BYTES, first_sent
from hoap2.fmu.instance import FmuInstance
from hoap2.fmu.ls_bus_loop import Terminals
from hoap2.generate import can_table, ls_bus

NOT_YET_KNOWN, UNCHANGED, CHANGED = 0, 1, 2
UNKNOWN = bytes.fromhex("ff000000 08000000")
ANSWER = bytes.fromhex("01000000 12000000 0800") + UNKNOWN


@pytest.fixture(scope="module")
def files(build_dir: Path) -> FmuSet:
    found = FmuSet(build_dir / "fmu")
    found.require()
    return found


class Node:
    """One FMU with event mode, its terminals called one by one."""

    def __init__(self, files: FmuSet, flavour: str) -> None:
        self.fmu = FmuInstance(files.ls_bus(flavour), flavour, event_mode=True)
        self.fmu.initialize()
        self.part = Terminals(self.fmu, ls_bus.terminals(can_table.load(), flavour))
        self.reference = {m: r[0] for m, r in self.part.reference.items()}

    def interval(self, member: str = "Tx_Clock") -> tuple[float, int]:
        value, qualifier = (ctypes.c_double * 1)(), (ctypes.c_int * 1)()
        self._call("GetIntervalDecimal", member, value, qualifier)
        return value[0], qualifier[0]

    def set_clock(self, member: str) -> None:
        self._call("SetClock", member, (ctypes.c_bool * 1)(True))

    def get(self, member: str = "Tx_Data") -> bytes:
        size, value = (ctypes.c_size_t * 1)(), (ctypes.c_void_p * 1)()
        self._call("GetBinary", member, size, value, ctypes.c_size_t(1))
        return ctypes.string_at(value[0], size[0]) if size[0] else b""

    def set(self, data: bytes, member: str = "Rx_Data") -> None:
        buffer = ctypes.create_string_buffer(data, max(1, len(data)))
        values = (ctypes.c_void_p * 1)(ctypes.addressof(buffer))
        self._call("SetBinary", member, (ctypes.c_size_t * 1)(len(data)), values, ctypes.c_size_t(1))

    def _call(self, name: str, member: str, *rest: object) -> None:
        reference = self.reference.get(member, 60000)
        self.fmu.call(name, (ctypes.c_uint32 * 1)(reference), ctypes.c_size_t(1), *rest)

    def receive(self, data: bytes) -> None:
        self.set_clock("Rx_Clock")
        self.set(data)
        self.part.update()

    def send(self) -> bytes:
        self.set_clock("Tx_Clock")
        data = self.get()
        self.part.update()
        return data

    def warnings(self) -> list[str]:
        return [text for _, category, text in self.fmu.log if category == "logStatusWarning"]


@pytest.fixture
def node(files: FmuSet, request: pytest.FixtureRequest):
    made = Node(files, getattr(request, "param", "controller"))
    yield made
    made.fmu.close()


@pytest.mark.parametrize("node", ["controller", "plant"], indirect=True)
def test_a_node_counts_down_to_zero_once_it_has_sent(node: Node) -> None:
    assert node.interval() == (0.0, CHANGED), "its bit rates wait"
    assert node.interval() == (0.0, UNCHANGED)
    assert node.send() == FIRST_BYTES
    # the update did the first tick
    assert node.interval() == (0.0, CHANGED)
    assert node.send().startswith(bytes.fromhex("11000000"))
    assert node.interval()[1] == NOT_YET_KNOWN
    assert node.send() == b"", "a clock may tick with nothing to send"
    assert not node.part.step(0, 400_000)
    node.part.update()
    assert node.interval()[1] == NOT_YET_KNOWN, "no whole millisecond yet"
    assert node.part.step(400_000, 1_000_000), "it asks for event mode"
    node.part.update()
    assert node.interval() == (0.0, CHANGED)


@pytest.mark.parametrize("node", ["can_bus"], indirect=True)
def test_the_bus_counts_down_to_the_end_of_the_millisecond(node: Node) -> None:
    node.part.update()
    assert node.interval() == (0.001, CHANGED)
    assert node.interval() == (0.001, UNCHANGED)
    assert node.send() == b""
    assert node.interval() == (0.001, CHANGED)
    node.part.step(0, 300_000)
    node.part.update()
    assert node.interval() == (0.0007, UNCHANGED)


def frames_of(data: bytes) -> list[bytes]:
    """The operations in a binary, by their lengths."""
    found = []
    while data:
        length = int.from_bytes(data[4:8], "little")
        found.append(data[:length])
        data = data[length:]
    return found


@pytest.mark.parametrize("node", ["can_bus"], indirect=True)
def test_the_bus_sorts_by_identifier_and_sends_nothing_back(files: FmuSet, node: Node) -> None:
    sent = [o for o in frames_of(first_sent(files.ls_bus("controller"), "controller")["right"]) if o[0] == 0x11]
    node.receive(b"".join(reversed(sent)))
    for tick in range(2):
        node.part.step(tick * 1_000_000, (tick + 1) * 1_000_000)
        node.reference = {m: r[1] for m, r in node.part.reference.items()}  # right_boards
        got = frames_of(node.send())
        if tick == 0:
            assert got == sorted(sent, key=lambda o: o[8:12][::-1])
    assert got == []
    node.reference = {m: r[0] for m, r in node.part.reference.items()}
    assert node.send() == b"", "what the controller sent does not come back to it"


@pytest.mark.parametrize("node", ["controller", "plant", "can_bus"], indirect=True)
def test_what_is_no_operation_is_answered_and_changes_nothing(node: Node) -> None:
    if node.fmu.product != "can_bus":
        node.send(), node.send()
    node.receive(UNKNOWN)
    assert node.send() == ANSWER
    assert len(node.warnings()) == 1
    node.receive(ANSWER)
    assert node.send() == b"", "a format error is not answered by another"


@pytest.mark.parametrize("node", ["controller", "plant", "can_bus"], indirect=True)
def test_no_bytes_stop_an_fmu(files: FmuSet, node: Node) -> None:
    rng = random.Random(1)
    good = first_sent(files.ls_bus("plant"), "plant")["right"]
    for end in range(0, 120):
        node.receive(good[:end])
        node.send()
    for _ in range(500):
        data = bytearray(good[: rng.randrange(len(good))] + rng.randbytes(rng.randrange(40)))
        for _ in range(rng.randrange(4)):
            if data:
                data[rng.randrange(len(data))] = rng.randrange(256)
        node.receive(bytes(data))
        node.send()
    node.receive(rng.randbytes(ls_bus.ROOM))
    node.part.step(0, 5_000_000)
    node.part.update()


def test_a_binary_larger_than_its_size_is_refused(node: Node) -> None:
    node.set_clock("Rx_Clock")
    with pytest.raises(FmuCallError, match="maxSize"):
        node.set(bytes(ls_bus.ROOM + 1))


def test_binaries_can_be_touched_only_while_their_clock_ticks(node: Node) -> None:
    with pytest.raises(FmuCallError, match="does not tick"):
        node.get()
    with pytest.raises(FmuCallError, match="does not tick"):
        node.set(b"")
    node.set_clock("Tx_Clock")
    assert node.get() == FIRST_BYTES
    node.part.update()
    with pytest.raises(FmuCallError, match="does not tick"):
        node.get()


def test_wrong_references_and_modes_are_refused_with_the_reason(node: Node) -> None:
    with pytest.raises(FmuCallError, match="no bus terminal"):
        node.set_clock("nothing")
    with pytest.raises(FmuCallError, match="another type"):
        node.set_clock("Rx_Data")
    with pytest.raises(FmuCallError, match="another type"):
        node.interval("Rx_Clock")
    with pytest.raises(FmuCallError, match="in event mode"):
        node.fmu.call("DoStep", *node.fmu.step_arguments(0.0, 0.001))
    node.fmu.call("EnterStepMode")
    with pytest.raises(FmuCallError, match="between steps"):
        node.interval()
    with pytest.raises(FmuCallError, match="current time"):
        node.fmu.call("DoStep", *node.fmu.step_arguments(0.5, 0.001))
    for size in (-0.001, float("nan"), float("inf")):
        with pytest.raises(FmuCallError, match="not possible"):
            node.fmu.call("DoStep", *node.fmu.step_arguments(0.0, size))
    node.fmu.call("DoStep", *node.fmu.step_arguments(0.0, 0.0))  # what importers make of a countdown of 0
    node.fmu.call("DoStep", *node.fmu.step_arguments(0.0, 0.001))


def test_frames_that_nobody_takes_are_dropped_and_told(node: Node) -> None:
    node.part.step(0, 200_000_000)
    node.part.update()
    assert any("nobody takes it" in text for text in node.warnings())
    assert 0 < len(node.send()) <= ls_bus.ROOM


def test_another_bit_rate_is_told_by_the_bus(files: FmuSet) -> None:
    node = Node(files, "can_bus")
    node.receive(FIRST_BYTES)
    assert not node.warnings()
    node.receive(bytes.fromhex("40000000 0d000000 01 20a10700"))
    assert "500000 bit/s" in node.warnings()[0]
    node.fmu.close()
