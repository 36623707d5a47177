"""The figures of section 7.3 that can be made, what the book says of each, and which run each needs."""

from __future__ import annotations

from dataclasses import dataclass

from hoap2.errors import UserError


@dataclass(frozen=True)
class BookFigure:
    """number and title as in the book; the scenario whose run it shows; what a run must be to be shown by it."""

    number: str
    title: str
    scenario: str
    soil: bool | None = None  # None: any ground
    landing_control: bool | None = None


FIGURES = {
    each.number: each
    for each in (
        BookFigure("7.8", "Design of reference ZMP trajectories", "floor-walk", None, False),
        BookFigure("7.10", "Walking on a floor without landing position control", "floor-walk", False, False),
        BookFigure("7.11", "Walking on sand without landing position control", "sand-walk", True, False),
        BookFigure("7.12", "Walking on sand with landing position control", "sand-walk-lpc", True, True),
        BookFigure("7.13", "Walking on a hard floor with landing position control", "floor-walk-lpc", False, True),
    )
}


def find(number: str) -> BookFigure:
    """A figure by its number; the error names all there are."""
    found = FIGURES.get(number.lower().removeprefix("fig.").removeprefix("figure").strip())
    if found is None:
        raise UserError(f"figure {number} cannot be made", f"known: {', '.join(FIGURES)}")
    return found


def check(figure: BookFigure, walk) -> None:
    """UserError when the run is not what the figure shows."""
    if not walk.step_ticks:
        raise UserError(f"figure {figure.number} shows a walk", f"{walk.folder} holds no step")
    for wanted, real, words in (
        (figure.soil, walk.on_soil, ("the rigid floor", "soil")),
        (
            figure.landing_control,
            walk.controls_landing,
            ("without landing position control", "with landing position control"),
        ),
    ):
        if wanted is not None and wanted != real:
            raise UserError(f"figure {figure.number} shows a walk {_on(words[wanted])}",
                            f"the run in {walk.folder} is one {_on(words[real])}")  # fmt: skip


def _on(words: str) -> str:
    return words if words.startswith("with") else f"on {words}"
