"""The master on scripted products: order of the exchange, early ends, what is logged."""

from __future__ import annotations

import os
import signal

import numpy as np
import pytest

from hoap2 import master, wiring
from hoap2.errors import UserError
from hoap2.signal_log import Column, read
from sides import FakeSide, falling_plant, standing_plant, stepping_controller


def run(controller, plant, ticks, stop=None, after_fall_s=1.0, progress=None):
    return master.run(controller, plant, ticks, after_fall_s, stop or master.StopRequest(),
                      master.Company(progress))  # fmt: skip


def echo(name_in: str, name_out: str):
    """A script whose output is what the input was in the step, plus one."""

    def script(side: FakeSide, tick: int) -> None:
        index = [c.name for c in side.inputs if c.kind == "real"].index(name_in)
        side.put(name_out, side.real_in[index] + 1.0)

    return script


def test_jacobi_exchange_takes_one_tick_each_way():
    controller = FakeSide("controller", echo("gyro_S_rad_s.x", "tau_ff_Nm"))
    plant = standing_plant(echo("r_hip_yaw.tau_ff_Nm", "gyro_S_rad_s"))
    outcome = run(controller, plant, 6)
    tau, gyro = outcome.log.column("c.r_hip_yaw.tau_ff_Nm"), outcome.log.column("p.gyro_S_rad_s.x")
    # Both step from the values of the last point: neither sees the other's new one in the same tick.
    assert tau.tolist() == gyro.tolist() == [0, 1, 2, 3, 4, 5, 6]


def test_all_connections_of_the_table_carry_their_own_signal():
    rng = np.random.default_rng(1)
    controller, plant = FakeSide("controller"), standing_plant()
    for side in (controller, plant):
        side.real_out[:] = rng.normal(size=side.real_out.size)
        side.int_out[:] = 0
    plant.put("true_chest_rpy_rad", 0.0)
    run(controller, plant, 1)
    for source, target in ((controller, plant), (plant, controller)):
        sent = dict(zip([c.name for c in source.outputs if c.kind == "real"], source.real_out))
        open_ones = {c.name for c in target.inputs} - {c.name for c in source.outputs}
        for column, value in zip([c for c in target.inputs if c.kind == "real"], target.real_in):
            assert value == (0.0 if column.name in open_ones else sent[column.name])


class RowSide(FakeSide):
    """Takes and gives rows of the log as an FMU does; counts them."""

    def reads_into(self, real, integer):
        def read(k):
            real[k], integer[k] = self.real_out, self.int_out

        return read

    def writes_from(self, real, integer):
        assert all(rows.strides[1] == rows.itemsize for rows in (real, integer) if rows.shape[1] > 1)
        self.rows_taken = 0

        def write(k):
            self.real_in[: real.shape[1]], self.int_in[: integer.shape[1]] = real[k], integer[k]
            self.rows_taken += 1

        return write

    def get_outputs(self):
        raise AssertionError("rows are read instead")


def noisy(side: FakeSide, tick: int) -> None:
    """Outputs that depend on all that the side was given."""
    phase = np.arange(side.real_out.size) + side.real_in @ np.cos(np.arange(side.real_in.size)) + side.int_in.sum()
    side.real_out[:] = 0.1 * np.sin(phase)
    side.int_out[:] = np.arange(side.int_out.size) * (tick % 7)
    if any(c.name == "other_contacts" for c in side.outputs):
        side.put("other_contacts", 0)


def test_sides_that_take_rows_get_the_same_values_as_those_that_take_copies():
    copied = run(FakeSide("controller", noisy), FakeSide("plant", noisy), 40).log
    sides = RowSide("controller", noisy), RowSide("plant", noisy)
    direct = run(*sides, 40).log
    assert copied.count == direct.count == 41 and np.ptp(direct.real[:, :100], axis=0).all()
    assert copied.real.tobytes() == direct.real.tobytes() and copied.integer.tobytes() == direct.integer.tobytes()
    assert sides[0].rows_taken == sides[1].rows_taken == 40


def test_outputs_in_another_order_reach_their_inputs():
    rng = np.random.default_rng(4)
    controller, plant = RowSide("controller"), RowSide("plant")
    plant.real_out[:] = rng.normal(size=plant.real_out.size)
    plant.put("true_chest_rpy_rad", 0.0)
    reals = [c for c in plant.outputs if c.kind == "real"]
    order = rng.permutation(len(reals))
    plant.outputs = [reals[i] for i in order] + [c for c in plant.outputs if c.kind == "int"]
    plant.real_out[:] = plant.real_out[order]
    outcome = run(controller, plant, 3)
    sent = dict(zip([c.name for c in plant.outputs], plant.real_out))
    assert outcome.error is None and not hasattr(controller, "rows_taken") and plant.rows_taken == 3
    driven = [c for c in controller.inputs if c.kind == "real" and c.name in sent]
    assert len(driven) > 30 and controller.real_in[: len(driven)].tolist() == [sent[c.name] for c in driven]
    assert not controller.real_in[len(driven) :].any()


def test_an_input_without_a_source_keeps_its_value():
    controller, plant = RowSide("controller"), FakeSide("plant")
    driven = [c for c in controller.inputs if c.name in {o.name for o in plant.outputs}]
    operators = [c for c in controller.inputs if c not in driven]
    controller.inputs = [Column("wind_m_s", "m/s", "real"), *driven, *operators]
    controller.real_in = np.full(controller.real_in.size + 1, 5.0)
    real, integer = np.ones((2, plant.real_out.size)), np.ones((2, plant.int_out.size), dtype=np.int32)
    wiring.writer(plant, controller, real, integer)(1)
    count = sum(c.kind == "real" for c in driven)
    assert controller.real_in.tolist() == [5.0] + [1.0] * count + [5.0] * (controller.real_in.size - 1 - count)


def test_timing_adds_up():
    timing = run(stepping_controller(), standing_plant(), 25).timing
    summary = timing.summary()
    parts_s = sum(sum(ns[: timing.ticks]) for ns in timing.ns.values()) / 1e9
    assert 0.0 < parts_s <= summary["loop_s"] and all(min(ns) > 0 for ns in timing.ns.values())
    steps_s = sum(sum(timing.ns[part]) for part in ("controller", "plant")) / 1e9
    assert summary["exchange_and_log_us"] * 25 / 1e6 == pytest.approx(summary["loop_s"] - steps_s)


def test_row_k_holds_tick_k_and_the_last_state_is_logged():
    outcome = run(stepping_controller(), standing_plant(lambda side, tick: side.put("plant_tick", tick)), 25)
    assert outcome.log.count == 26 and outcome.log.column("p.plant_tick").tolist() == list(range(26))
    assert outcome.timing.ticks == 25 and outcome.error is None and not outcome.interrupted


@pytest.mark.parametrize("start_tick", [100, 101, 107])
@pytest.mark.parametrize("after_fall_s", [0.0, 0.015, 0.05, 0.137, 1.0])
def test_a_run_ends_a_while_after_the_fall(start_tick, after_fall_s):
    outcome = run(stepping_controller(), falling_plant(start_tick, rate_rad_s=10.0), 3000, after_fall_s=after_fall_s)
    fall = start_tick + int(np.floor(np.pi / 4 / 0.01)) + 1
    late = outcome.log.count - 1 - (fall + round(after_fall_s * 1000))
    assert 0 <= late <= master.HOUSEKEEPING_TICKS, "the fall is looked for every few ticks"
    if after_fall_s > 0.01:
        assert late == 0, "but the end is counted from the tick of the fall"


def test_a_contact_of_one_tick_is_seen():
    plant = standing_plant(lambda side, tick: side.put("other_contacts", int(tick == 123)))
    assert run(stepping_controller(), plant, 3000).log.count == 123 + 1000 + 1


def test_an_error_in_mid_run_keeps_what_was_simulated():
    def fail(side: FakeSide, tick: int) -> None:
        if tick == 50:
            raise ValueError("the floor opened")

    outcome = run(stepping_controller(), standing_plant(fail), 1000)
    assert "the floor opened" in outcome.error and "0.049 s" in outcome.error
    assert outcome.log.count == 50 and not outcome.interrupted


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_run(number):
    before = signal.getsignal(number)
    plant = standing_plant(lambda side, tick: os.kill(os.getpid(), number) if tick == 200 else None)
    with master.StopRequest() as stop:
        outcome = run(stepping_controller(), plant, 100000, stop)
    assert outcome.interrupted and 200 <= outcome.log.count - 1 <= 200 + master.HOUSEKEEPING_TICKS
    assert signal.getsignal(number) is before


def test_an_input_that_nobody_drives_is_an_error():
    controller, plant = stepping_controller(), standing_plant()
    controller.inputs = [*controller.inputs, Column("wind_m_s", "m/s", "real")]
    with pytest.raises(UserError, match="the plant has no output .* wind_m_s"):
        run(controller, plant, 10)


def test_the_operators_inputs_need_no_source_and_stay_as_they_are():
    """On the copying way too; a side without them is as good."""
    controller, plant = stepping_controller(), standing_plant()
    at = [c.name for c in controller.inputs if c.kind == "real"].index("step_turn_request_rad")
    controller.real_in[at] = 0.125
    assert run(controller, plant, 20).error is None
    assert controller.real_in[at] == 0.125
    plant = standing_plant()
    plant.inputs = [c for c in plant.inputs if not c.name.startswith("push_now")]
    assert run(stepping_controller(), plant, 20).error is None


def test_progress_is_told():
    seen = []
    run(stepping_controller(), standing_plant(), 50, progress=lambda log: seen.append(log.count))
    assert seen[0] == 1 and seen[-1] == 51


def test_parquet_keeps_every_bit_and_the_units(tmp_path):
    import pyarrow
    import pyarrow.parquet

    rng = np.random.default_rng(2)
    plant = standing_plant()
    plant.script = lambda side, tick: side.put("gyro_S_rad_s", rng.normal(size=3))
    log = run(stepping_controller(), plant, 300).log
    log.write(tmp_path / "signals.parquet")
    table = pyarrow.parquet.read_table(tmp_path / "signals.parquet")
    assert table.column_names[0] == "t_s" and table["t_s"][250].as_py() == 0.25
    field = table.schema.field("p.r_knee.true_tau_Nm")
    assert field.metadata[b"unit"] == b"N.m" and field.type == pyarrow.float64()
    assert table.schema.field("c.mode").type == pyarrow.int32()
    assert all(b"unit" in f.metadata for f in table.schema)
    packed = pyarrow.parquet.ParquetFile(tmp_path / "signals.parquet").metadata.row_group(0).column(1)
    assert packed.compression == "ZSTD"
    again = read(tmp_path / "signals.parquet")
    assert np.array_equal(again.real, log.real[: log.count]) and np.array_equal(again.integer, log.integer[: log.count])
