"""`compare`: two finished runs side by side."""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer


def command(
    first: Annotated[Path, typer.Argument(metavar="RUN", help="A run folder.")],
    second: Annotated[Path, typer.Argument(metavar="RUN", help="Another run folder.")],
    out: Annotated[
        str | None, typer.Option(metavar="NAME", help="Name of the folder in out/compare/, or a path.")
    ] = None,
    video: Annotated[
        bool, typer.Option("--video/--no-video", help="Render compare.mp4, both runs at the same time.")
    ] = True,
    json: Annotated[bool, typer.Option("--json", help="Print compare.json on standard output.")] = False,
) -> int:
    """Compare two runs: one video with both at the same time, one page with verdicts, curves and differences.

    The video lasts as long as the longer run; the other one's last picture is held and says how it ended.
    """
    from rich.console import Console

    from hoap2 import compare
    from hoap2.runfolder import jsonable

    found, code = compare.run(first, second, out, video, Console(stderr=True, highlight=False))
    if json:
        print(json_module.dumps(jsonable(found), indent=2, ensure_ascii=False))
    else:
        compare.show(found, Console(highlight=False))
    return code
