"""FmuInstance: parameters, arrays, errors, what reaches the log and the standard output."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from hoap2.fmu.archive import FmuArchive, FmuCallError, FmuFileError, FmuVariableError
from hoap2.fmu.build import FmuSet
from hoap2.fmu.instance import FmuInstance
from hoap2.generate.tables import load

FLAVOURS = [(product, version) for product in ("controller", "plant") for version in (2, 3)]


@pytest.fixture(scope="module")
def files(build_dir: Path) -> FmuSet:
    found = FmuSet(build_dir / "fmu")
    found.require()
    return found


def open_fmu(files: FmuSet, product: str, version: int, **options) -> FmuInstance:
    return FmuInstance(files.fmu(product, version), **options)


def rewritten(source: Path, target: Path, old: str, new: str) -> Path:
    """The FMU with a piece of its model description replaced."""
    with zipfile.ZipFile(source) as original, zipfile.ZipFile(target, "w") as copy:
        for name in original.namelist():
            content = original.read(name)
            if name == "modelDescription.xml":
                assert old.encode() in content
                content = content.replace(old.encode(), new.encode())
            copy.writestr(name, content)
    return target


@pytest.mark.parametrize(("product", "version"), FLAVOURS)
def test_slices_cover_the_arrays_in_the_order_of_the_table(files: FmuSet, product: str, version: int) -> None:
    table = load()
    with open_fmu(files, product, version) as fmu:
        fmu.initialize()
        assert fmu.product == product
        for group, slices, arrays in (
            ("input", fmu.input_slices, (fmu.inputs_real, fmu.inputs_int)),
            ("output", fmu.output_slices, (fmu.outputs_real, fmu.outputs_int)),
        ):
            for kind, array in zip(("real", "int"), arrays, strict=True):
                rows = [s for s in table.select(product, group) if s.kind == kind]
                ends = np.cumsum([s.count for s in rows])
                assert [slices[s.name].stop for s in rows] == list(ends)
                assert array.size == (ends[-1] if rows else 0)


@pytest.mark.parametrize(("product", "version"), FLAVOURS)
def test_start_values_are_the_defaults_of_the_table(files: FmuSet, product: str, version: int) -> None:
    with open_fmu(files, product, version) as fmu:
        fmu.initialize()
        for s in load().signals:
            if s.product == product and s.group != "output":
                assert fmu.get(s.name).reshape(-1).tolist() == list(s.default), s.name
        for s in load().select(product, "input"):
            array = fmu.inputs_real if s.kind == "real" else fmu.inputs_int
            assert array[fmu.input_slices[s.name]].tolist() == list(s.default)


@pytest.mark.parametrize(("product", "version"), FLAVOURS)
def test_rows_carry_what_the_arrays_carry(files: FmuSet, product: str, version: int) -> None:
    """Rows inside of wider arrays, as the log's are; what stands beside them stays."""
    with open_fmu(files, product, version) as fmu, open_fmu(files, product, version) as other:
        for each in (fmu, other):
            each.initialize()
        given = (np.full((3, fmu.inputs_real.size + 5), 0.25),
                 np.full((3, fmu.inputs_int.size + 5), 1, dtype=np.int32))  # fmt: skip
        found = (np.full((3, fmu.outputs_real.size + 5), np.nan),
                 np.full((3, fmu.outputs_int.size + 5), -7, dtype=np.int32))  # fmt: skip
        write = fmu.writes_from(*(a[:, 2:-3] for a in given))
        read = fmu.reads_into(*(a[:, 2:-3] for a in found))
        step = fmu.stepper()
        for k in (1, 2):
            given[0][k] *= k
            other.inputs_real[:], other.inputs_int[:] = given[0][k, 2:-3], given[1][k, 2:-3]
            other.write()
            other.step()
            other.read()
            write(k)
            step()
            read(k)
            assert found[0][k, 2:-3].tobytes() == other.outputs_real.tobytes()
            assert found[1][k, 2:-3].tobytes() == other.outputs_int.tobytes()
        assert fmu.tick == other.tick == 2 and fmu.serialize() == other.serialize()
        assert np.isnan(found[0][0]).all() and (found[1][0] == -7).all()
        for a, rest in ((found[0], np.isnan), (found[1], lambda x: x == -7)):
            assert rest(a[:, :2]).all() and rest(a[:, -3:]).all()


@pytest.mark.parametrize(("product", "version"), FLAVOURS)
def test_rows_of_the_driven_inputs_leave_the_operators_alone(files: FmuSet, product: str, version: int) -> None:
    """Narrower rows set the first inputs; the ones behind keep what set_input gave them."""
    table = load()
    rows = table.select(product, "input")
    driven = {k: sum(s.count for s in rows if s.kind == k and not s.operator) for k in ("real", "int")}
    asked = {"controller": ("step_length_request_m", 0.02), "plant": ("push_now_force_W_N", [0.0, 3.0, 0.0])}[product]
    with open_fmu(files, product, version) as fmu, open_fmu(files, product, version) as other:
        for each in (fmu, other):
            each.initialize()
            each.set_input(*asked)
        real, integer = fmu.inputs_real[: driven["real"]].copy(), fmu.inputs_int[: driven["int"]].copy()
        fmu.writes_from(real[None, :], integer[None, :])(0)
        other.write()
        for each in (fmu, other):
            each.step(3)
            assert each.get(asked[0]).reshape(-1).tolist() == np.atleast_1d(asked[1]).tolist()
        assert fmu.serialize() == other.serialize()
        with pytest.raises(ValueError, match="no whole rows"):
            fmu.writes_from(real[None, :-1], integer[None, :])
        with pytest.raises(FmuVariableError, match="no input push_nw"):
            fmu.set_input("push_nw", 1.0)


def test_rows_that_fmi_cannot_take_are_refused(files: FmuSet) -> None:
    with open_fmu(files, "plant", 3) as fmu:
        reals, ints = fmu.outputs_real.size, fmu.outputs_int.size
        integer = np.zeros((2, ints), dtype=np.int32)
        for real in (
            np.zeros((2, reals + 1)),
            np.zeros((2, 2 * reals))[:, ::2],
            np.zeros((2, reals), dtype=np.float32),
            np.zeros(reals),
        ):
            with pytest.raises(ValueError, match=f"rows of {reals} neighbouring float64"):
                fmu.reads_into(real, integer)


def test_a_refused_step_of_the_stepper_is_told(files: FmuSet) -> None:
    with open_fmu(files, "plant", 3) as fmu:
        fmu.initialize(stop_time_s=0.002)
        step = fmu.stepper()
        step()
        step()
        with pytest.raises(FmuCallError, match="refused DoStep at 0.002 s.*stop time"):
            step()
        assert fmu.tick == 2


@pytest.mark.parametrize("version", [2, 3])
def test_parameters_by_row_by_element_and_broadcast(files: FmuSet, version: int) -> None:
    with open_fmu(files, "plant", version) as fmu:
        fmu.set_parameters(
            {
                "friction_mu": 0.5,
                "cell_gain": 1.05,
                "push_link": list(range(8)),
                "seed": 7,
                "start_pos_W_m": np.array([3.0, -2.0]),
                "r_knee.start_posture_rad": 0.7,
                "l_knee.start_posture_rad": 0.71,
                "block_size_m[2].y": 0.3,
            }
        )
        fmu.initialize()
        posture = dict(zip(load().labels["joint"], fmu.get("start_posture_rad"), strict=True))
        assert (posture["r_knee"], posture["l_knee"]) == (0.7, 0.71)
        assert fmu.get("cell_gain").tolist() == [1.05] * 8
        assert fmu.get("push_link").tolist() == list(range(8))
        assert (fmu.get("friction_mu"), fmu.get("seed")) == (0.5, 7)
        assert fmu.get("block_size_m").shape == (16, 3) and fmu.get("block_size_m")[1, 1] == 0.3
        assert np.allclose(fmu.get("true_base_pos_W_m")[:2], [3.0, -2.0], atol=0.05)


@pytest.mark.parametrize("version", [2, 3])
def test_wrong_parameters_are_named(files: FmuSet, version: int) -> None:
    with open_fmu(files, "controller", version) as fmu:
        for values, text in (
            ({"step_lenght_m": 0.02}, "did you mean step_length_m"),
            ({"posture_rad": [1.0, 2.0]}, "25 elements, 2"),
            ({"steps_forward": 2.5}, "integer"),
            ({"step_length_m": "long"}, "not a number"),
        ):
            with pytest.raises(FmuVariableError, match=text):
                fmu.set_parameters(values)
        fmu.initialize()
        with pytest.raises(FmuCallError, match="step_length_m is fixed"):
            fmu.set_parameters({"step_length_m": 0.01})
        fmu.set_parameters({"tpcc_kp_1_s2": 25.0})
        assert fmu.get("tpcc_kp_1_s2") == 25.0


def test_a_tuned_gain_reaches_the_walk(files: FmuSet) -> None:
    """The tunable parameter is used by the model, not only stored."""
    ends = []
    for gain in (20.0, 60.0):
        with open_fmu(files, "controller", 3) as fmu:
            fmu.initialize()
            fmu.set_parameters({"tpcc_kp_1_s2": gain})
            for tick in range(3000):
                fmu.inputs_real[fmu.input_slices["cell_force_N"]] = [9.0, 8.0, 7.0, 8.0, 8.0, 9.0, 12.0, 8.0]
                fmu.inputs_int[fmu.input_slices["sensor_tick"]] = tick
                fmu.write()
                fmu.step()
            fmu.read()
            assert fmu.outputs_int[fmu.output_slices["fault"]] == 0
            ends.append(fmu.outputs_real[fmu.output_slices["tpcc_shift_W_m"]].copy())
    assert np.abs(ends[0] - ends[1]).max() > 1e-5


@pytest.mark.parametrize(("product", "version"), FLAVOURS)
def test_log_only_when_on_and_nothing_on_stdout(
    files: FmuSet, product: str, version: int, capfd: pytest.CaptureFixture
) -> None:
    for logging in (True, False):
        with open_fmu(files, product, version, logging=logging) as fmu:
            fmu.initialize()
            fmu.step()
            with pytest.raises(FmuCallError):
                fmu.call("DoStep", *fmu.step_arguments(fmu.time_s, 0.0005))
            assert bool(fmu.log) == logging
            assert {category for _, category, _ in fmu.log} <= {"logStatusError", "logEvents"}
    captured = capfd.readouterr()
    assert captured.out == "" and captured.err == ""


def test_stop_time_is_kept(files: FmuSet) -> None:
    with open_fmu(files, "plant", 3) as fmu:
        fmu.initialize(stop_time_s=0.01)
        fmu.step(10)
        with pytest.raises(FmuCallError, match="stop time"):
            fmu.step()


@pytest.mark.parametrize("version", [2, 3])
def test_start_time_may_be_anything(files: FmuSet, version: int) -> None:
    """Integer ticks inside: a late start gives the same outputs."""
    found = []
    for start_s in (0.0, 1234.567):
        with open_fmu(files, "plant", version) as fmu:
            fmu.initialize(start_time_s=start_s)
            for _ in range(50):
                fmu.step()
            fmu.read()
            found.append(fmu.outputs_real.tobytes() + fmu.outputs_int.tobytes())
            assert fmu.time_s == pytest.approx(start_s + 0.05, abs=1e-12)
    assert found[0] == found[1]


def test_state_belongs_to_time_and_tick(files: FmuSet) -> None:
    with open_fmu(files, "plant", 2) as fmu, open_fmu(files, "plant", 2) as other:
        fmu.initialize()
        fmu.step(30)
        block = fmu.serialize()
        state = other.deserialize(block)
        other.set_state(state)
        state.release()
        assert other.tick == 30
        fmu.step()
        other.step()
        assert fmu.serialize() == other.serialize()


def test_states_are_freed_with_their_instance_and_stay_with_it(files: FmuSet) -> None:
    with open_fmu(files, "plant", 3) as fmu, open_fmu(files, "plant", 3) as other:
        fmu.initialize()
        kept, released = fmu.get_state(), fmu.get_state()
        released.release()
        released.release()
        with pytest.raises(FmuCallError, match="released"):
            fmu.set_state(released)
        with pytest.raises(FmuCallError, match="another instance"):
            other.set_state(kept)
        assert fmu.states == [kept]
        fmu.close()
        assert fmu.states == [] and not kept.pointer


def test_other_fmi_versions_and_kinds_are_refused(files: FmuSet, tmp_path: Path) -> None:
    good = files.fmu("plant", 3)
    with pytest.raises(FmuFileError, match=r"FMI 1\.0"):
        FmuArchive(rewritten(good, tmp_path / "v1.fmu", 'fmiVersion="3.0"', 'fmiVersion="1.0"'))
    with pytest.raises(FmuFileError, match="Co-Simulation"):
        FmuArchive(rewritten(good, tmp_path / "me.fmu", "CoSimulation", "ModelExchange"))
    with pytest.raises(FmuFileError, match="cannot be started"):
        token = FmuArchive(good).description.instantiationToken
        FmuInstance(rewritten(good, tmp_path / "token.fmu", token, "{0}"))
    with pytest.raises(FmuVariableError, match="neither a controller nor a plant"):
        FmuArchive(rewritten(good, tmp_path / "names.fmu", 'name="q_enc_rad"', 'name="q_encoder_rad"'))
    with pytest.raises(FmuVariableError, match="has no output q_enc_rad"):
        FmuArchive(rewritten(good, tmp_path / "names2.fmu", 'name="q_enc_rad"', 'name="q_encoder_rad"'), "plant")
    with pytest.raises(FmuFileError, match="no such file"):
        FmuArchive(tmp_path / "nothing.fmu")
    with pytest.raises(FmuFileError, match="folder"):
        FmuArchive(tmp_path)


def test_unpacked_files_are_removed(files: FmuSet) -> None:
    fmu = open_fmu(files, "controller", 3)
    folder = fmu.archive.folder
    assert folder.exists()
    fmu.initialize()
    fmu.terminate()
    assert not folder.exists()
    with pytest.raises(FmuCallError, match="closed"):
        fmu.call("Reset")
