"""`run`: a scenario, once or over seeds."""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer


def command(
    scenario: Annotated[str, typer.Argument(metavar="SCENARIO", help="A name of `list`, or the path of a .toml file.")],
    overrides: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="A.B=VALUE", help="Override a value, e.g. controller.step_length_m=0.02."),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Draw disturbances and noise from this seed; 0 is nominal.")] = 0,
    seeds: Annotated[str | None, typer.Option(metavar="RANGE", help="A study over seeds: 1-20 or 1,3,5-7.")] = None,
    sensors: Annotated[str | None, typer.Option(metavar="ideal|hoap2", help="Sensor preset.")] = None,
    link: Annotated[
        str | None, typer.Option(metavar="direct|can|ls-bus", help="How controller and plant are connected.")
    ] = None,
    duration: Annotated[float | None, typer.Option(metavar="SECONDS", help="Simulated time.")] = None,
    out: Annotated[
        str | None, typer.Option(metavar="NAME", help="Name of the run folder in out/<scenario>/, or a path.")
    ] = None,
    controller: Annotated[Path | None, typer.Option(metavar="X.fmu", help="Another controller FMU.")] = None,
    plant: Annotated[Path | None, typer.Option(metavar="Y.fmu", help="Another plant FMU.")] = None,
    fmi: Annotated[int, typer.Option(min=2, max=3, help="FMI version of the built FMUs.")] = 3,
    video: Annotated[bool, typer.Option("--video/--no-video", help="Render video.mp4 after the run.")] = True,
    realtime: Annotated[bool, typer.Option("--realtime", help="Keep to the wall clock, and publish live.")] = False,
    lcm: Annotated[
        str | None,
        typer.Option(metavar="URL", help="Publish live there: udpm://, memq://, file://; `off` with --realtime."),
    ] = None,
    telemetry: Annotated[
        bool, typer.Option("--telemetry/--no-telemetry", help="Write telemetry.lcm (2 MB a simulated second).")
    ] = True,
    accept_commands: Annotated[
        bool, typer.Option("--accept-commands", help="Let a monitor or `./hoap2 command` steer the run.")
    ] = False,
    jobs: Annotated[int, typer.Option(min=1, max=256, help="Runs at a time of a study.")] = 2,
    json: Annotated[bool, typer.Option("--json", help="Print summary.json (study.json) on standard output.")] = False,
) -> int:
    """Run a scenario; leaves summary, signals, telemetry.lcm, run.toml, report and video in a run folder.

    Exit code: 0 all bounds met, 1 a bound missed or the run failed, 2 bad input, 130 stopped by Ctrl-C (the run
    folder is complete and marked as interrupted).
    """
    from rich.console import Console

    from hoap2 import scenario as scenario_module
    from hoap2 import seeds as seeds_module
    from hoap2 import runner, study, tables_shown
    from hoap2.errors import UserError
    from hoap2.products import Choice
    from hoap2.telemetry import options

    wanted = options.Options(realtime, lcm, telemetry, accept_commands)
    overrides = [*(overrides or ()), *([f"scenario.link={link}"] if link else [])]
    request = study.Request(scenario, tuple(overrides), sensors, duration, Choice(controller, plant, fmi), video,
                            wanted)  # fmt: skip
    console = Console(stderr=True, highlight=False)
    if seeds is not None:
        if seed:
            raise UserError("give either --seed or --seeds, not both")
        if realtime or lcm is not None or accept_commands:
            raise UserError("a study is not live", "give --realtime, --lcm and --accept-commands to single runs")
        result = study.run_study(request, seeds_module.parse_range(seeds), out, jobs, console, show=not json)
        if json:
            print(json_module.dumps(result.document, indent=2, ensure_ascii=False))
        return result.exit_code
    loaded = scenario_module.load(scenario, overrides, sensors, duration)
    seeds_module.apply(loaded, seed)
    summary = study.run_one(request, loaded, out, console)
    if json:
        print(json_module.dumps(summary, indent=2, ensure_ascii=False))
    else:
        tables_shown.show_summary(summary, Console(highlight=False))
    return runner.exit_code(summary)
