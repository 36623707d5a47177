"""Controller and plant without FMI: signals by name, errors, save and restore, equality with the FMUs."""

from __future__ import annotations

import os

import numpy as np
import pytest

import hoap2
from hoap2 import Controller, Plant, exchange
from hoap2.binding import Signals
from hoap2.errors import UserError
from hoap2.parameters import table


def walk(controller: Controller, plant: Plant, ticks: int) -> np.ndarray:
    """The joint references and true joint angles of each tick, (ticks, 50)."""
    rows = np.empty((ticks, 50))
    for k in range(ticks):
        exchange(controller, plant)
        controller.step()
        plant.step()
        rows[k, :25], rows[k, 25:] = controller.outputs.q_ref_rad, plant.outputs.true_q_rad
    return rows


@pytest.fixture
def pair() -> tuple[Controller, Plant]:
    return (Controller(behaviour="walk_cp", calibrate_s=0.2, steps_forward=4, steps_in_place=0),
            Plant(seed=7))


def test_struct_layout_is_the_table(pair):
    for product, name in zip(pair, ("controller", "plant")):
        for block, group in ((product.inputs, "input"), (product.outputs, "output"), (product.parameters, "parameter")):
            rows = table().select(name, group)
            assert list(block) == [s.name for s in rows]
            for s in rows:
                view = block.view(s.name)
                assert view.shape == s.shape and view.dtype == (np.float64 if s.kind == "real" else np.int32)


def test_defaults_and_parameters_by_name():
    plant = Plant(friction_mu=0.4, start_pos_W_m=np.array([1.0, -2.0]), sensor_preset="ideal")
    assert plant.parameters.friction_mu == 0.4 and plant.parameters.sensor_preset == 0
    assert np.allclose(plant.outputs.true_base_pos_W_m[:2], [1.0, -2.0], atol=0.02)
    assert plant.parameters.gravity_m_s2 == 9.81


def test_unknown_names_say_the_nearest(pair):
    controller, plant = pair
    with pytest.raises(UserError, match="step_length_m"):
        Controller(step_lenght_m=0.02)
    with pytest.raises(UserError, match="range"):
        Controller(step_length_m=5.0)
    with pytest.raises(AttributeError, match="q_ref_rad"):
        controller.outputs.q_ref
    with pytest.raises(AttributeError, match="q_enc_rad"):
        controller.inputs.q_en_rad = 0.0
    with pytest.raises(ValueError):
        controller.inputs.q_enc_rad = np.zeros(24)
    with pytest.raises(AttributeError):
        hoap2.nothing_of_that_name
    assert "rad" in controller.outputs.describe("pitch_est_rad")


def test_inputs_are_views(pair):
    controller, _ = pair
    controller.inputs.q_enc_rad[:] = 0.25
    assert (controller.inputs.view("q_enc_rad") == 0.25).all()
    controller.inputs.sensor_tick = 3
    assert controller.inputs.sensor_tick == 3
    real, integer = controller.inputs.flat()
    assert (real[:25] == 0.25).all() and integer[0] == 3


def test_exchange_connects_equal_names(pair):
    controller, plant = pair
    walk(controller, plant, 20)
    exchange(controller, plant)
    assert (controller.inputs.q_enc_rad == plant.outputs.q_enc_rad).all()
    assert (plant.inputs.q_ref_rad == controller.outputs.q_ref_rad).all()
    assert (plant.inputs.drive_mode == controller.outputs.drive_mode).all()
    assert plant.time_s == pytest.approx(0.02) and controller.time_s == pytest.approx(0.02)


def test_save_and_restore_continue_bit_for_bit(pair):
    controller, plant = pair
    walk(controller, plant, 1600)
    assert controller.outputs.step_index >= 1  # in mid-walk
    saved = controller.save(), plant.save()
    outputs = controller.outputs.to_dict(), plant.outputs.to_dict()
    first = walk(controller, plant, 300)
    controller.restore(saved[0])
    plant.restore(saved[1])
    for product, before in zip((controller, plant), outputs):
        for name, value in before.items():
            assert np.array_equal(product.outputs.view(name), value, equal_nan=True), name
    assert walk(controller, plant, 300).tobytes() == first.tobytes()


def test_a_state_moves_to_another_instance(pair):
    controller, plant = pair
    walk(controller, plant, 400)
    other, other_plant = Controller(), Plant()
    other.restore(controller.save())
    other_plant.restore(plant.save())
    assert walk(other, other_plant, 100).tobytes() == walk(controller, plant, 100).tobytes()


def test_wrong_state_is_refused(pair):
    for product in pair:
        with pytest.raises(UserError, match="not a state"):
            product.restore(b"short")


def test_tune_changes_tunable_parameters_only(pair):
    controller, _ = pair
    controller.tune(tpcc_kp_1_s2=10.0)
    assert controller.parameters.tpcc_kp_1_s2 == 10.0
    with pytest.raises(UserError, match="cannot change"):
        controller.tune(step_width_m=0.08)
    with pytest.raises(UserError, match="range"):
        controller.tune(tpcc_kp_1_s2=-1.0)


def test_bad_plant_input_is_an_error_and_keeps_the_state(pair):
    controller, plant = pair
    walk(controller, plant, 10)
    before = plant.save()
    plant.inputs.q_ref_rad[3] = np.nan
    with pytest.raises(UserError, match="plant: "):
        plant.step()
    assert plant.save() == before


def test_a_library_of_another_table_is_noticed():
    block = Signals(table().select("controller", "input"))
    block.check_guard("x.so")
    block._guard[0] = 0
    with pytest.raises(UserError, match="another signals.toml"):
        block.check_guard("x.so")


def test_no_library_is_said(tmp_path):
    (tmp_path / "broken.so").write_bytes(b"nothing")
    with pytest.raises(UserError, match="cannot load"):
        Controller(library=tmp_path / "broken.so")


def test_a_library_older_than_its_table_is_refused(tmp_path, monkeypatch):
    library = tmp_path / "sim" / "libhoap2_plant.so"
    library.parent.mkdir()
    library.write_bytes(b"")
    os.utime(library, (1e9, 1e9))
    monkeypatch.setenv("HOAP2_BUILD_DIR", str(tmp_path))
    with pytest.raises(UserError, match="older than .*plant_signals.h"):
        Plant()
