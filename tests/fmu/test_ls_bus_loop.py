"""Controller, plant and bus FMU together: cut wires, nonsense, emergency stop, states. See also test_checks.py."""

from __future__ import annotations

import ctypes
import random
from collections.abc import Callable
from pathlib import Path

import pytest
from hoap2.fmu.archive import FmuCallError, FmuFileError
from hoap2.fmu.build import FmuSet
from hoap2.fmu.instance import FmuInstance
from hoap2.fmu.ls_bus_loop import LsBusLoop, open_loop
from hoap2.generate import can_table, ls_bus
from hoap2.generate.tables import load

UNKNOWN = bytes.fromhex("ff000000 08000000")  # no operation


@pytest.fixture(scope="module")
def files(build_dir: Path) -> FmuSet:
    found = FmuSet(build_dir / "fmu")
    found.require()
    return found


@pytest.fixture
def loop(files: FmuSet):
    made, opened = open_loop({f: files.ls_bus(f) for f in ls_bus.FLAVOURS}, {"controller": {"stale_limit_ticks": 4}})
    yield made
    for fmu in opened:
        fmu.close()


def give(take: Callable[[int, int, int], None], place: int, data: bytes) -> None:
    """Bytes for a terminal, from a buffer that lives as long as the call."""
    buffer = ctypes.create_string_buffer(data, len(data))
    take(place, ctypes.addressof(buffer), len(data))


class Nobody:
    """A wire that ends."""

    def take(self, *_: object) -> None: ...


def test_a_cut_wire_is_found_by_both_sides(loop: LsBusLoop) -> None:
    loop.advance(50)
    controller, plant = loop.controller.fmu, loop.plant.fmu
    assert controller.get("fault") == 0
    loop.bus.peers = [(Nobody(), 0)] * loop.bus.count
    loop.advance(4)
    assert controller.get("fault") == 0, "up to four silent ticks are bridged"
    held = plant.get("q_ref_rad").copy()
    loop.advance(2)
    assert controller.get("fault") != 0
    before = controller.get("q_ref_rad").copy()
    loop.advance(600)
    assert abs(controller.get("q_ref_rad") - before).max() > 0.01, "the controller goes to its crouch"
    assert abs(plant.get("q_ref_rad") - held).max() < 0.01, "the boards hold"


def test_nonsense_on_the_wire_does_not_touch_the_walk(files: FmuSet, loop: LsBusLoop) -> None:
    take, rng = loop.controller.take, random.Random(2)

    def disturbed(place: int, address: int, size: int) -> None:
        take(place, address, size)
        give(take, place, UNKNOWN + rng.randbytes(30))

    loop.controller.take = disturbed
    loop.advance(300)
    noisy = loop.controller.fmu.get("q_ref_rad").tobytes()
    quiet, opened = open_loop({f: files.ls_bus(f) for f in ls_bus.FLAVOURS}, {"controller": {"stale_limit_ticks": 4}})
    quiet.advance(300)
    assert quiet.controller.fmu.get("q_ref_rad").tobytes() == noisy
    for fmu in opened:
        fmu.close()


def test_states_of_another_kind_are_refused(files: FmuSet, loop: LsBusLoop) -> None:
    alive = loop.controller.fmu.serialize()
    with FmuInstance(files.ls_bus("controller"), "controller") as dormant:
        dormant.initialize()
        state = dormant.deserialize(alive)
        with pytest.raises(FmuCallError, match="event mode"):
            dormant.set_state(state)
    with FmuInstance(files.fmu("controller", 3), "controller") as plain, pytest.raises(FmuCallError, match="product"):
        plain.deserialize(alive)


def test_an_fmu_without_terminals_is_refused_by_the_loop(files: FmuSet) -> None:
    with pytest.raises(FmuFileError, match="event mode is not offered"):
        open_loop({"controller": files.fmu("controller", 3), "plant": files.ls_bus("plant"),
                   "can_bus": files.ls_bus("can_bus")})  # fmt: skip


def stop_of(board: str) -> bytes:
    """A board's emergency stop as an operation."""
    from hoap2.can import library

    frames = can_table.load().frames
    layout = next(i for i, f in enumerate(frames) if f.name == f"stop_{board}")
    frame, raw = library.Frame(), (ctypes.c_int32 * 24)(1)
    assert library.load().hoap2_can_encode(layout, 1, raw, ctypes.byref(frame)) == 0
    data = bytes(frame.data[: frame.length])
    operation = frame.identifier.to_bytes(4, "little") + b"\0\1\0" + len(data).to_bytes(2, "little") + data
    return (0x11).to_bytes(4, "little") + (8 + len(operation)).to_bytes(4, "little") + operation


@pytest.mark.parametrize("sender", ["r_leg", "r_foot"])
def test_a_board_stops_the_others_on_its_bus_then_the_controller_the_other_bus(loop: LsBusLoop, sender: str) -> None:
    loop.advance(20)
    plant = loop.plant.fmu
    names = [j["name"] for j in load().robot["joints"]]
    position, damped = 1, 3
    arms = [names.index("r_elbow"), names.index("l_elbow")]
    assert (plant.get("drive_mode")[arms] == position).all()
    boards = ls_bus.terminals(can_table.load(), ls_bus.BUS).index("right_boards")
    give(loop.bus.take, boards, stop_of(sender))
    loop.bus.receive()
    loop.bus.update()
    loop.advance(1)
    assert list(plant.get("drive_mode")[arms]) == [damped, position], "the boards on its own bus heard it"
    loop.advance(1)
    assert (plant.get("drive_mode")[arms] == damped).all(), "the controller told the other bus"
