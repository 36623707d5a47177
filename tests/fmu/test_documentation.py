"""The examples that the documentation shows do run."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
from lxml import html


@pytest.mark.parametrize("product", ["controller", "plant"])
def test_examples_of_the_page_in_the_fmu(build_dir: Path, product: str, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = build_dir / "fmu"
    with zipfile.ZipFile(folder / f"hoap2_{product}_fmi3.fmu") as archive:
        page = html.fromstring(archive.read("documentation/index.html"))
        assert archive.read("documentation/" + page.xpath("//img/@src")[0]).startswith(b"\x89PNG")
    monkeypatch.chdir(folder)
    examples = re.split(r"\n\n", page.xpath("string(//pre)"))
    assert len(examples) == 2
    for example in examples:
        scope: dict = {}
        exec(example, scope)
        result = scope["result"]
        assert len(result) == 1001 and result["time"][-1] == pytest.approx(1.0)
        assert all(np.all(np.isfinite(result[name])) for name in result.dtype.names)


def test_example_of_the_guide(repo_root: Path, build_dir: Path, capsys: pytest.CaptureFixture) -> None:
    text = (repo_root / "docs" / "fmu.md").read_text()
    example = re.search(r"```python\n(.*?)```", text, re.S).group(1)
    exec(example.replace("build/release", str(build_dir)), {})
    com = [float(x) for x in capsys.readouterr().out.strip("[] \n").split()]
    assert len(com) == 3 and 0.2 < com[2] < 0.3
