"""The report's figures: what is drawn where, and that no run is too odd for them."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from hoap2 import metrics, parameters, plots, report, scenario, svg
from hoap2.axes import Axes, Patch, Stroke
from hoap2.signal_log import SignalLog, columns_of

SVG = "{http://www.w3.org/2000/svg}"


def parse(text: str) -> ElementTree.Element:
    """The figure, well-formed; inside of HTML its name space is implied."""
    return ElementTree.fromstring(text.replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', 1))


def points(data: str) -> list[np.ndarray]:
    """Path data of svg.path back to points, in grains; one array a piece of line."""
    pieces = []
    for piece in re.findall(r"M[^M]+", data):
        numbers = [int(n) for n in re.findall(r"-?\d+", piece.replace("h0", ""))]
        pieces.append(np.cumsum(np.reshape(numbers, (-1, 2)), axis=0))
    return pieces


def test_a_path_is_the_curve_to_a_grain():
    rng = np.random.default_rng(1)
    x, y = np.sort(rng.uniform(0, 600, 400)), rng.uniform(-50, 100, 400)
    for dots in (False, True):
        (found,) = points(svg.path(x, y, dots))
        assert np.abs(found / svg.GRAINS - np.column_stack((x, y))).max() <= 0.5 / svg.GRAINS + 1e-9


def test_values_that_are_not_finite_interrupt_the_line():
    y = np.array([np.nan, 1.0, 2.0, np.nan, np.nan, 5.0, np.inf, 7.0])
    lengths = [len(piece) for piece in points(svg.path(np.arange(8.0), y))]
    assert lengths == [2, 2, 2], "a point alone is a line of no length"
    assert svg.path(np.arange(3.0), np.full(3, np.nan)) == ""
    assert svg.path(np.ones(9), np.full(9, 2.0)) == "M20 40l0 0", "a place is written once"


@pytest.mark.parametrize(
    ("limits", "most", "written"),
    [
        ((0.0, 18.3), 9, ["0.0", "2.5", "5.0", "7.5", "10.0", "12.5", "15.0", "17.5"]),
        ((-0.16, 0.11), 6, ["\u22120.15", "\u22120.10", "\u22120.05", "0.00", "0.05", "0.10"]),
        ((-7.0, 7.0), 4, ["\u22125", "0", "5"]),
        ((0.0, 1.0), 5, ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]),
        ((999.9, 1000.3), 4, ["999.9", "1000.0", "1000.1", "1000.2", "1000.3"]),
        ((-3e11, 4e11), 3, ["\u2212250000000000", "0", "250000000000"]),
    ],
)
def test_ticks_are_round_and_inside(limits, most, written):
    found = svg.ticks(limits, most)
    assert [text for _, text in found] == written
    assert all(float(text.replace("\u2212", "-")) == pytest.approx(value, abs=1e-9) for value, text in found)


@pytest.mark.parametrize("noise", [0.0, 1e-13])
@pytest.mark.parametrize("value", [0.0, 1e-25, -3.5, 1e9])
def test_a_constant_has_a_range(value, noise):
    flat = Axes()
    flat.line(np.arange(5.0), value + noise * np.arange(5.0), Stroke())
    low, high = flat.own_limits()[1]
    assert low < value < high and all(len(text) < 14 for _, text in svg.ticks((low, high), 4))


def test_equal_axes_have_one_scale_and_show_everything():
    plan = Axes(equal=True)
    plan.patches.append(Patch(np.array([[0.0, 0.0], [400.0, 0.0], [400.0, 30.0]])))
    (x0, x1), (y0, y1) = plan.limits(600.0, 200.0)
    assert (x1 - x0) / 600.0 == pytest.approx((y1 - y0) / 200.0)
    assert x0 <= 0.0 and x1 >= 400.0 and y0 <= 0.0 and y1 >= 30.0


def test_shared_axes_show_the_same_range():
    one, other = Axes(), Axes()
    one.line(np.arange(2.0), np.array([0.0, 10.0]), Stroke())
    other.line(np.arange(2.0), np.array([-5.0, 1.0]), Stroke())
    one.share_y, other.share_y = other, one
    assert one.limits(100, 100)[1] == other.limits(100, 100)[1]
    assert one.limits(100, 100)[1][0] < -5.0 and one.limits(100, 100)[1][1] > 10.0


def test_curves_lie_inside_of_their_axes_and_on_their_values():
    t = np.linspace(0.0, 2.0, 50)
    rows = [Axes(y_label="a & b"), Axes(x_label="time (s)")]
    for k, each in enumerate(rows):
        each.line(t, (k + 1) * np.sin(t), Stroke("#d55e00"), "sine")
    figure = svg.Figure([[each] for each in rows], 300.0)
    root = parse(figure.svg("two <rows>"))
    assert root.get("aria-label") == "two <rows>"
    texts = [element.text for element in root.iter(SVG + "text")]
    assert texts.count("sine") == 2 and "a & b" in texts and "time (s)" in texts
    curves = [element.get("d") for group in root.iter(SVG + "g") if "scale" in group.get("transform", "")
              for element in group]  # fmt: skip
    for data, (each, box) in zip(curves, figure._boxes(), strict=True):
        (found,) = points(data)
        x, y = (found / svg.GRAINS).T
        assert x.min() == pytest.approx(box.left, abs=0.05) and x.max() == pytest.approx(box.right, abs=0.05)
        assert box.top < y.min() and y.max() < box.bottom and box.bottom < figure.height
        assert y[np.argmin(x)] > y.min() + 50.0, "up is up"
        assert np.interp(box.x(t), x, y) == pytest.approx(box.y(each.curves[0][1]), abs=0.06)


def test_thinning_keeps_every_peak():
    rng = np.random.default_rng(3)
    t, y = np.arange(20011.0), rng.normal(size=20011)
    y[[777, 15000]] = 50.0, -60.0
    some_t, some_y = plots.thin(t, y)
    assert some_y.max() == 50.0 and some_y.min() == -60.0 and len(some_y) < 2100
    assert (y[some_t.astype(int)] == some_y).all() and (np.diff(some_t) > 0).all()
    y[900:1500] = y[779] = np.nan
    some_t, some_y = plots.thin(t, y)
    assert np.nanmax(some_y) == 50.0 and np.nanmin(some_y) == -60.0
    assert np.isnan(some_y[(some_t > 930) & (some_t < 1470)]).all()


@pytest.fixture
def walk() -> scenario.Scenario:
    return scenario.load("floor-walk")


def log_of(ticks: int) -> SignalLog:
    """Noise on all signals, on two feet, with some steps."""
    log = SignalLog(columns_of("controller") + columns_of("plant"), ticks)
    log.count = ticks
    log.real[:], log.integer[:] = 0.01 * np.random.default_rng(5).normal(size=log.real.shape), 0
    log.column("c.step_index")[:] = np.arange(ticks) // 400
    return log


def figures(log: SignalLog, walk: scenario.Scenario) -> dict[str, ElementTree.Element]:
    run = plots.Run(log, walk)
    return {name: parse(getattr(plots, name)(run).svg(title)) for name, title, _ in report.FIGURES}


def test_every_figure_names_its_curves(walk):
    drawn = figures(log_of(2500), walk)
    labels = {name: {t.text for t in root.iter(SVG + "text")} for name, root in drawn.items()}
    assert {"truth", "as the robot senses it", "roll (deg)", "pitch (deg)", "time (s)"} <= labels["attitude"]
    assert {"CoP, truth", "CoM, truth", "CoM, plan (7.13)", "right, taken", "left, taken"} <= labels["plane"]
    assert {"CoP, truth", "CoP, reference", "CoM, plan", "CoM, truth"} <= labels["com_cop"]
    assert {"measured", "desired", "end of step"} <= labels["capture_point"]
    assert {"force cells", "right foot (N)", "left foot (N)"} <= labels["forces"]
    assert {f"{s} {j.replace('_', ' ')} (deg)" for s in "rl" for j in plots.LEG} <= labels["joints"]
    assert {j["name"].replace("_", " ") for j in parameters.table().robot["joints"]} <= labels["torques"]
    assert {"attitude (deg)", "CoP (mm)", "CoM (mm)"} <= labels["sensing"]
    marks = [p.get("d").count("M") for p in drawn["attitude"].iter(SVG + "path") if p.get("stroke-opacity") == "0.18"]
    assert marks == [6, 6], "a hair line at each step on both axes"


def test_a_fall_is_marked(walk):
    log = log_of(3000)
    log.block("p.true_chest_rpy_rad")[2000:, 1] = 1.0
    drawn = figures(log, walk)
    for name in ("attitude", "com_cop", "capture_point", "forces", "sensing"):
        assert "fell" in [t.text for t in drawn[name].iter(SVG + "text")], name
    run = plots.Run(log, walk)
    assert run.fall_s == pytest.approx(2.0) and run.until_fall() == metrics.fall_tick(log) == 2000


@pytest.mark.parametrize("ticks", [1, 2, 30])
def test_short_runs_have_all_figures(walk, ticks):
    assert len(figures(log_of(ticks), walk)) == 8


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_run_that_diverged_has_all_figures(walk):
    log = log_of(3000)
    log.real[2000:2310] *= 10.0 ** np.arange(310)[:, None]
    log.real[2310:] = np.nan
    for root in figures(log, walk).values():
        for element in root.iter():
            assert not any(word in value for value in element.attrib.values() for word in ("nan", "inf", "e+"))
