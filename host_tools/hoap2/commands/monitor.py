"""`monitor`: what a run does, in the terminal or in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

DEFAULT_PORT = 8720


def command(
    web: Annotated[
        bool, typer.Option("--web", help="A page for the browser: 3D view, plots, commands, replay.")
    ] = False,
    lcm: Annotated[
        str | None, typer.Option("--lcm", metavar="URL", help="Where the run publishes; else LCM_DEFAULT_URL.")
    ] = None,
    once: Annotated[bool, typer.Option("--once", help="Print one picture in the terminal and end.")] = False,
    port: Annotated[int, typer.Option(min=0, max=65535, help="--web: port of the page; 0 is any.")] = DEFAULT_PORT,
    host: Annotated[
        str, typer.Option(metavar="ADDRESS", help="--web: address to serve on; one that others reach needs --token.")
    ] = "127.0.0.1",
    token: Annotated[
        str | None, typer.Option(metavar="TEXT", help="--web: what a browser must give: http://...:8720/?token=TEXT")
    ] = None,
    runs: Annotated[
        Path, typer.Option(metavar="FOLDER", help="--web: where the finished runs are (FOLDER/<scenario>/<name>).")
    ] = Path("out"),
) -> int:
    """Watch a run that was started with --realtime (or --lcm URL); with --web replay finished runs as well.

    It changes nothing in the run, and may come late, end and come again. q or Ctrl-C ends it. Exit code of --once: 1
    when no run is heard.
    """
    from hoap2.errors import UserError

    if web and once:
        raise UserError("give either --web or --once, not both")
    if web:
        return _web(lcm, port, host, token, runs)
    return _terminal(lcm, once)


def _terminal(url: str | None, once: bool) -> int:
    from rich.console import Console

    from hoap2.errors import UserError
    from hoap2.monitor import terminal

    console = Console(highlight=False)
    if once:
        return terminal.once(url, console, timeout_s=3.0)
    if not console.is_terminal:
        raise UserError("the monitor needs a terminal", "--once prints one picture, --web is for the browser")
    return terminal.watch(url, console)


def _web(url: str | None, port: int, host: str, token: str | None, runs: Path) -> int:
    from rich.console import Console

    from hoap2.monitor import page, server

    console = Console(stderr=True, highlight=False, soft_wrap=True)

    def say(address: str) -> None:
        shown = address + (f"?token={token}" if token else "")
        console.print(f"monitor: {shown}   (Ctrl-C ends it; finished runs from {runs.resolve()})", markup=False)

    server.serve(page.folder(), runs, host, port, token, url, say)
    return 0
