"""`frame`: any moment of a run as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    run: Annotated[str, typer.Argument(metavar="RUN", help="A run folder, or a scenario (its latest run in out/).")],
    t: Annotated[list[float], typer.Option("--t", "--time", metavar="SECONDS", help="Moment; several make a strip.")],
    out: Annotated[Path | None, typer.Option(metavar="FILE.png", help="Where; else in the run folder.")] = None,
    view: Annotated[str, typer.Option(help="quarter, side, front, back, top, feet, or pool (of soil).")] = "quarter",
    size: Annotated[str | None, typer.Option(metavar="WxH", help="Pixels of each picture.")] = None,
    overlays: Annotated[bool, typer.Option("--overlays/--no-overlays", help="CoM, CoP, capture point, steps.")] = True,
    force: Annotated[bool, typer.Option("--force", help="Overwrite the file.")] = False,
) -> int:
    """Draw a moment of a run as PNG (JPEG, WebP), and print the file's name."""
    from hoap2 import pictures, run_source

    folder = run_source.folder_of(run)
    path = out or folder / f"frame_{'_'.join(f'{moment:.3f}' for moment in t)}s_{view}.png"
    if len(t) == 1:
        pixels = pictures.parse_size(size or "1280x720")
        print(pictures.write_frame(folder, t[0], path, pixels, view, overlays, overwrite=force))
    else:
        pixels = pictures.parse_size(size or "320x480")
        print(pictures.strip(folder, t, path, pixels, view, overlays, overwrite=force))
    return 0
