"""The command line: finds the command's module and runs it."""

from __future__ import annotations

import functools
import importlib
import sys
from collections.abc import Callable

from hoap2 import __version__
from hoap2.errors import UserError, nearest

# Name -> one line; the launcher shows the same list before anything is installed.
COMMANDS = {
    "list": "the scenarios, with what each one shows",
    "run": "run a scenario: summary, signals, report and video in a run folder",
    "frame": "a PNG of any moment of a run",
    "figure": "a figure of section 7.3 as the book lays it out, from a run",
    "study": "the sand walks over many seeds (sand), and over parameters (map)",
    "compare": "two runs side by side: one video, one page",
    "monitor": "a run as it happens, in the terminal or in the browser (--web)",
    "command": "ask something of a run that was started with --accept-commands",
    "replay": "publish a finished run again by LCM, for a monitor",
    "export": "a run for other tools: MCAP, CSV, Parquet, rerun",
    "plot": "signals of a run over time, as a picture",
    "diff": "where two runs part",
    "can": "the CAN buses between processes: dump, send, log, replay, scan",
    "bench": "what a tick costs in a whole run (run), beside MuJoCo (plant), its telemetry, CAN",
    "test": "build and run every test (--quick: below five minutes)",
    "generate": "rewrite the generated sources from hoap2.json and signals.toml",
    "fmu": "build or check the FMUs",
}
EXIT_INTERRUPTED = 130


def _report(error: UserError) -> int:
    from rich.console import Console

    console = Console(stderr=True, highlight=False, soft_wrap=True)
    console.print("[bold red]error:[/]", end=" ")
    console.print(error.message, markup=False)
    if error.hint:
        console.print(error.hint, markup=False)
    return error.exit_code


def _returning_exit_code(function: Callable) -> Callable:
    """The same command with its return value made the exit code."""

    @functools.wraps(function)
    def wrapped(*args, **kwargs):
        import typer

        raise typer.Exit(int(function(*args, **kwargs) or 0))

    return wrapped


def _run_module(name: str, arguments: list[str]) -> int:
    """Run commands/<name>.py with these arguments; the result is the exit code."""
    import typer

    module = importlib.import_module(f"hoap2.commands.{name}")
    app = getattr(module, "app", None)
    if app is None:
        app = typer.Typer(add_completion=False)
        app.command(context_settings=getattr(module, "CONTEXT_SETTINGS", {}))(module.command)
    for registered in (app.info, *app.registered_commands):
        settings = registered.context_settings if isinstance(registered.context_settings, dict) else {}
        registered.context_settings = {**settings, "help_option_names": ["-h", "--help"]}
    for registered in app.registered_commands:
        registered.callback = _returning_exit_code(registered.callback)
    try:
        app(args=arguments, prog_name=f"hoap2 {name}")
    except SystemExit as end:
        return int(end.code or 0)
    return 0


def _usage() -> str:
    width = max(map(len, COMMANDS))
    lines = [f"  {name:<{width}}  {text}" for name, text in COMMANDS.items()]
    return "Usage: hoap2 COMMAND [OPTIONS]\n\nCommands:\n" + "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    arguments = sys.argv[1:] if arguments is None else arguments
    name = arguments[0] if arguments else "--help"
    if name in ("-h", "--help", "help"):
        print(_usage())
        return 0
    if name == "--version":
        print(f"hoap2 {__version__}")
        return 0
    try:
        if name not in COMMANDS:
            raise UserError(f"unknown command '{name}'", nearest(name, COMMANDS) or f"commands: {' '.join(COMMANDS)}")
        return _run_module(name, arguments[1:])
    except UserError as error:
        return _report(error)
    except KeyboardInterrupt:
        return EXIT_INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
