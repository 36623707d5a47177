"""Every check of `./hoap2 fmu check`, each as a test of its own."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from hoap2.fmu import check as fmu_check
from hoap2.fmu.build import FmuSet
from hoap2.fmu.check import Check, CheckFailed, Context
from hoap2.fmu.check_importers import fmutool

SLOW = {"built from its sources"}
CHECKS = fmu_check.all_checks(quick=False)


@pytest.fixture(scope="module")
def context(build_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Context:
    files = FmuSet(build_dir / "fmu")
    files.require()
    return Context(files, tmp_path_factory.mktemp("check"))


@pytest.mark.parametrize(
    "check",
    [pytest.param(c, id=f"{c.name}: {c.subject}", marks=[pytest.mark.slow] if c.name in SLOW else []) for c in CHECKS],
)
def test_check(check: Check, context: Context) -> None:
    assert check.run(context)


def test_a_check_that_breaks_is_a_failure_and_the_others_go_on(
    context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    def explode(_: Context) -> str:
        raise RuntimeError("boom")

    monkeypatch.setattr(
        fmu_check, "all_checks", lambda quick: [Check("first", "x", explode), Check("second", "x", lambda c: "fine")]
    )
    first, second = fmu_check.run_checks(context)
    assert not first.ok and "boom" in first.detail
    assert second.ok and second.detail == "fine"


def test_fmutool_finds_a_wrong_description(context: Context, tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.fmu"
    with zipfile.ZipFile(context.files.ls_bus("can_bus")) as good, zipfile.ZipFile(wrong, "w") as bad:
        for name in good.namelist():
            text = good.read(name)
            bad.writestr(name, text.replace(b'causality="input"', b'causality="nonsense"'))
    with pytest.raises(CheckFailed, match="nonsense"):
        fmutool(wrong)
