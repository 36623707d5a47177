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

    It changes nothing in the run, and may come late, end and come again. Ctrl-C ends it.
    """
    from hoap2.errors import UserError

    if web:
        return _web(lcm, port, host, token, runs)
    raise UserError("the monitor in the terminal is not there yet", "give --web")


def _web(url: str | None, port: int, host: str, token: str | None, runs: Path) -> int:
    from rich.console import Console

    from hoap2.monitor import page, server

    console = Console(stderr=True, highlight=False, soft_wrap=True)

    def say(address: str) -> None:
        shown = address + (f"?token={token}" if token else "")
        console.print(f"monitor: {shown}   (Ctrl-C ends it; finished runs from {runs.resolve()})", markup=False)

    server.serve(page.folder(), runs, host, port, token, url, say)
    return 0
