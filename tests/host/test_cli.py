"""The command line without the launcher: help, nearest names, exit codes."""

from __future__ import annotations

import sys
import types

import pytest

from hoap2 import cli
from hoap2.errors import UserError, nearest


def test_help_lists_every_command(capsys):
    assert cli.main(["--help"]) == 0
    text = capsys.readouterr().out
    assert all(f"  {name} " in text for name in cli.COMMANDS)


@pytest.mark.parametrize("name", sorted(cli.COMMANDS))
def test_every_command_has_help(name, capsys):
    assert cli.main([name, "--help"]) == 0
    assert f"hoap2 {name}" in capsys.readouterr().out


@pytest.mark.parametrize("name", sorted(set(cli.COMMANDS) - {"test"}))  # test passes them on to pytest
def test_unknown_option_is_bad_usage(name, capsys):
    assert cli.main([name, "--no-such-option"]) == 2
    assert "--no-such-option" in capsys.readouterr().err


def test_unknown_command(capsys):
    assert cli.main(["lst"]) == 2
    assert "did you mean 'list'?" in capsys.readouterr().err


@pytest.fixture
def fake_command(monkeypatch):
    """A command `bench` that does what the test says."""

    def install(function):
        module = types.ModuleType("hoap2.commands.bench")
        module.command = function
        monkeypatch.setitem(sys.modules, "hoap2.commands.bench", module)

    return install


def test_return_value_is_the_exit_code(fake_command):
    for value, code in ((None, 0), (0, 0), (1, 1), (3, 3)):
        fake_command(lambda value=value: value)
        assert cli.main(["bench"]) == code


def test_user_error_is_one_message_and_its_code(fake_command, capsys):
    def refuse():
        raise UserError("no [such] thing", "try another", exit_code=3)

    fake_command(refuse)
    assert cli.main(["bench"]) == 3
    text = capsys.readouterr().err
    assert "no [such] thing" in text and "try another" in text and "Traceback" not in text


def test_ctrl_c_ends_with_130(fake_command):
    def interrupted():
        raise KeyboardInterrupt

    fake_command(interrupted)
    assert cli.main(["bench"]) == 130


def test_nearest():
    assert nearest("step_lenght_m", ["step_length_m", "step_width_m"]) == "did you mean 'step_length_m'?"
    assert nearest("zzz", ["step_length_m"]) == ""


def test_command_line_in_a_process(hoap2_cli):
    done = hoap2_cli("generate", "--check")
    assert done.returncode == 0, done.stdout + done.stderr
    assert hoap2_cli("nonsense").returncode == 2
