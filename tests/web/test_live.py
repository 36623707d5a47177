"""The hub of the live pages, fed with the messages of a run's log; no browser, no network."""

from __future__ import annotations

import json
import struct
import time
from pathlib import Path

import lcm
import numpy as np
import pytest
from hoap2 import recording, soil_replay
from hoap2.errors import UserError
from hoap2.monitor import live, live_run, track
from hoap2.telemetry import types

from test_track import unpack


class Fed:
    """A hub whose listener is a list of messages."""

    def __init__(self) -> None:
        self.sent: list = []
        self.hub = live.LiveHub("memq://", self.sent.append)
        self.latest: dict = {}
        self.counters: dict = {}
        self.url = "memq://"
        self.published: list = []
        self.hub._listener = self

    def publish(self, channel: str, message) -> None:
        self.published.append((channel, message))

    def feed(self, channel: str, data: bytes) -> None:
        message = types.decode(channel, data)
        self.latest[channel] = message
        if channel in live.HANDED_ON:
            self.hub._take(channel, message)

    def blocks(self, kind: str) -> list:
        """What was sent of one kind: dicts, or (header, arrays)."""
        found = [b if isinstance(b, dict) else unpack(b) for b in self.sent]
        return [b for b in found if (b if isinstance(b, dict) else b[0])["kind"] == kind]


def _log(run: Path) -> list[tuple[str, bytes]]:
    return [(event.channel, event.data) for event in lcm.EventLog(str(run / "telemetry.lcm"))]


@pytest.fixture(scope="module")
def messages(sand_run: Path) -> list[tuple[str, bytes]]:
    return _log(sand_run)


def _play(messages, fed: Fed, first: int = 0) -> Fed:
    for number, (channel, data) in enumerate(messages[first:]):
        fed.feed(channel, data)
        if number % 150 == 0:
            fed.hub._flush()
    fed.hub._flush()
    return fed


def test_rows_steps_and_soil_are_those_of_the_finished_run(messages, sand_run: Path) -> None:
    fed = _play(messages, Fed())
    run = recording.load(sand_run)
    t_s = np.concatenate([arrays["t_s"] for _, arrays in fed.blocks("rows")])
    rows = np.concatenate([arrays["rows"] for _, arrays in fed.blocks("rows")]).reshape(len(t_s), -1)
    assert np.all(np.diff(t_s) > 0.0) and t_s[-1] == pytest.approx(run.end_s, abs=0.011)
    entry = {e.name: e for e in track.layout()}
    ticks = np.round(t_s * 1000).astype(int)
    for name in ("true_base_pos_W_m", "true_foot_pos_W_m", "true_q_rad"):
        e = entry[name]
        np.testing.assert_allclose(rows[:, e.first : e.first + e.count], run.signal[name][ticks], atol=1e-6)
    told = [block["step"] for block in fed.blocks("step")]
    wanted = [step for step in run.steps if step.last < ticks[-1]]
    assert len(wanted) >= 2 and [s["number"] for s in told] == [step.number for step in wanted]
    assert [s["left"] for s in told] == [step.left for step in wanted]
    for step, shown in zip(wanted, told):
        landed = run.signal["footprint_W_m_rad"][step.last]
        assert (shown["x"], shown["y"], shown["yaw"]) == pytest.approx(landed, abs=2e-4)
    height = fed.blocks("soil")[0][1]["base"].copy()
    for _, arrays in fed.blocks("soil") + fed.blocks("soil_changes"):
        height[arrays["cells"]] = arrays["heights"]
    with soil_replay.SoilReplay(run) as pool:
        surface = pool.surface(run.row(fed.blocks("soil_changes")[-1][1]["t_s"][0]))
    off = np.abs(height - surface.height_m.ravel())[surface.change_m.ravel() < -1e-3]
    # poses each 10 ms instead of each 1 ms: a few cells at the edge of a sole come out otherwise
    assert len(off) > 500 and np.mean(off) < 3e-5 and np.quantile(off, 0.99) < 3e-4
    assert np.median(off) < 1.5e-6, "without straight lines between the poses it is 2e-6"


def test_a_page_that_comes_late_is_told_the_same(messages) -> None:
    fed = _play(messages, Fed())
    hello = [b if isinstance(b, dict) else unpack(b) for b in fed.hub.hello()]
    kinds = [b["kind"] if isinstance(b, dict) else b[0]["kind"] for b in hello]
    assert kinds == ["status", "run", "soil", "rows"]
    run = hello[1]
    assert run["steps"] == [b["step"] for b in fed.blocks("step")] and run["document"]["scenario"] == "sand-walk-lpc"
    assert [e["text"] for e in run["events"]] == [e["text"] for e in fed.blocks("event")]
    assert run["ended"] and hello[0]["state"] == "ended"
    height = hello[2][1]["base"].copy()
    height[hello[2][1]["cells"]] = hello[2][1]["heights"]
    wanted = fed.blocks("soil")[0][1]["base"].copy()
    for _, arrays in fed.blocks("soil_changes"):
        wanted[arrays["cells"]] = arrays["heights"]
    np.testing.assert_array_equal(height, wanted)
    sent = np.concatenate([arrays["t_s"] for _, arrays in fed.blocks("rows")])
    np.testing.assert_array_equal(hello[3][1]["t_s"], sent[-live_run.BACKLOG_ROWS :])
    json.dumps([b for b in hello if isinstance(b, dict)], allow_nan=False)


def test_a_monitor_that_comes_late_shows_what_is_still_to_come(messages) -> None:
    half = len(messages) // 2
    fed = _play(messages, Fed(), half)
    assert fed.blocks("rows") and fed.blocks("rows")[0][1]["t_s"][0] > 1.0
    assert all(np.isfinite(arrays["rows"].reshape(len(arrays["t_s"]), -1)[1:, 0]).all()
               for _, arrays in fed.blocks("rows"))  # fmt: skip


def test_another_run_takes_over_only_when_the_first_is_over(messages) -> None:
    other = struct.pack(">q", 4242)
    fed = Fed()
    truths = [data for channel, data in messages if channel == types.TRUTH]
    fed.feed(types.TRUTH, truths[0])
    fed.feed(types.TRUTH, truths[1][:8] + other + truths[1][16:])
    own = types.header(truths[0])[0]
    assert fed.hub._run.run_id == own, "two at a time: the first is followed"
    fed.hub._heard_s = time.monotonic() - 2 * live.SILENT_S
    assert fed.hub.status()["state"] == "silent"
    fed.feed(types.TRUTH, truths[2][:8] + other + truths[2][16:])
    assert fed.hub._run.run_id == 4242 and fed.hub.status()["state"] == "live"


def test_a_run_that_is_played_again_starts_afresh(messages) -> None:
    fed = _play(messages, Fed())
    first = fed.hub._run
    _play(messages, fed)
    assert first.ended and fed.hub._run.run_id == first.run_id and fed.hub._run.key != first.key
    assert [s["number"] for s in fed.hub._run.steps] == [s["number"] for s in first.steps]
    assert len({b[0]["run_id"] for b in fed.blocks("rows")}) == 2


def test_a_command_without_an_answer_is_told(messages, monkeypatch) -> None:
    fed = Fed()
    with pytest.raises(UserError, match="no live run"):
        fed.hub.command("walk", "start", [], "test")
    channel, data = next(m for m in messages if m[0] == types.TRUTH)
    fed.feed(channel, data)
    sent = fed.hub.command("push", "chest", [1.0, 2.0, 0.0, 0.1], "test")
    (channel, message), own = fed.published[-1], types.header(data)[0]
    assert channel == types.COMMAND and (message.run_id, message.kind, message.name) == (own, "push", "chest")
    assert list(types.decode(channel, message.encode()).value) == [1.0, 2.0, 0.0, 0.1]
    monkeypatch.setattr(live, "ANSWER_S", 0.0)
    fed.hub._flush()
    (answer,) = fed.blocks("answer")
    assert answer["command_id"] == sent["command_id"] and not answer["accepted"] and "no answer" in answer["reason"]
    fed.hub._flush()
    assert len(fed.blocks("answer")) == 1
