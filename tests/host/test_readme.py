"""What the README shows works: its links, its commands, its Python."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from hoap2 import cli, parameters
from hoap2.can import parameters as can_parameters


@pytest.fixture
def readme(repo_root: Path) -> str:
    return (repo_root / "README.md").read_text()


def test_links_lead_somewhere(readme: str, repo_root: Path):
    links = re.findall(r"\]\((?!http)([^)#]+)\)", readme)
    assert len(links) > 3
    assert [link for link in links if not (repo_root / link).exists()] == []


def test_commands_and_parameters_exist(readme: str):
    commands = set(re.findall(r"\./hoap2 ([a-z]+)", readme))
    assert "run" in commands and commands <= set(cli.COMMANDS)
    for table, name in re.findall(r"--set (\w+)\.(\w+)=", readme):
        assert name in (can_parameters.known() if table == "can" else parameters.known(table))


def test_the_python_example_walks(readme: str):
    [code] = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    names: dict = {}
    exec(re.sub(r"^  ", "", code, flags=re.MULTILINE), names)
    assert names["controller"].outputs.step_index >= 3
    assert names["plant"].outputs.true_com_W_m[2] > 0.2
