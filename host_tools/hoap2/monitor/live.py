"""A run as it happens: listens to LCM in a thread of its own and keeps what a page that comes late must know.

Nothing here can hold up a run: the listener only reads, and what the pages do not fetch in time is dropped for them.
"""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable
from dataclasses import asdict

import numpy as np

from hoap2.errors import UserError
from hoap2.monitor import track
from hoap2.monitor.live_run import LiveRun, feet, rows_block, toml
from hoap2.monitor.live_soil import LiveSoil
from hoap2.telemetry import types
from hoap2.telemetry.listen import Listener

SILENT_S = 1.0  # without a message this long a run that has not ended is called silent
ANSWER_S = 2.0
RETRY_S = 3.0
HANDED_ON = (types.TRUTH, types.HEALTH, types.EVENT, types.RUN, types.ANSWER)


class LiveHub:
    """The run on an LCM URL, for any number of pages.

    send(block) is called from the hub's thread with what all pages are to get: a dict (JSON) or bytes (track.pack).
    """

    def __init__(self, url: str | None, send: Callable[[dict | bytes], None]) -> None:
        self._url, self._send = url, send
        self._lock = threading.RLock()
        self._stop = threading.Event()
        self._listener: Listener | None = None
        self._run: LiveRun | None = None
        self._heard_s = 0.0
        self._new_rows: list[tuple[float, np.ndarray]] = []
        self._pending: dict[int, tuple[float, dict]] = {}
        self._followed = 0  # runs so far
        self._next_id = random.getrandbits(40) << 20
        self.problem = ""
        self._places = _places()
        self._thread = threading.Thread(target=self._listen, name="live", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        """End the thread."""
        self._stop.set()
        self._thread.join(timeout=3.0)

    # ------------------------------------------------------------ for the pages

    def hello(self) -> list[dict | bytes]:
        """What a page that has just come needs to show the same as the others."""
        with self._lock:
            run = self._run
            blocks: list[dict | bytes] = [self.status()]
            if run is None:
                return blocks
            blocks += [self._run_block(run), *run.answers]
            if run.soil is not None:
                blocks.append(run.soil.whole())
            if run.rows:
                blocks.append(rows_block(list(run.rows), run.key))
            return blocks

    def status(self) -> dict:
        """How the connection and the run are."""
        with self._lock:
            run, silent_s = self._run, time.monotonic() - self._heard_s
            if self.problem:
                state = "off"
            elif run is None:
                state = "waiting"
            else:
                state = "ended" if run.ended else ("silent" if silent_s > SILENT_S else "live")
            return {
                "kind": "status", "state": state, "problem": self.problem, "silent_s": silent_s if run else None,
                "url": self._listener.url if self._listener else self._url, "health": self._health(),
                "counters": self._counters(), "run_id": run.key if run else None,
            }  # fmt: skip

    def command(self, kind: str, name: str, value: list[float], sender: str) -> dict:
        """Send a command to the run; the answer follows as a block of its own. An error when none can come."""
        with self._lock:
            run = self._run
            if self._listener is None or run is None:
                raise UserError("there is no live run",
                                "start one: ./hoap2 run floor-walk --realtime --accept-commands")  # fmt: skip
            if run.ended:
                raise UserError("the run has ended")
            if run.document is not None and not run.document["accepts_commands"]:
                raise UserError("this run takes no commands", "start it with --accept-commands")
            self._next_id += 1
            message = types.type_of(types.COMMAND)()
            message.run_id, message.command_id = run.run_id, self._next_id
            message.kind, message.name, message.sender = kind, name, sender
            message.n, message.value = len(value), value
            block = {"kind": "sent", "command_id": str(self._next_id), "command": kind, "name": name, "value": value}
            self._pending[self._next_id] = (time.monotonic(), block)
            self._listener.publish(types.COMMAND, message)
            return block

    # ------------------------------------------------------------ the thread

    def _listen(self) -> None:
        while not self._stop.is_set():
            try:
                with Listener(self._url, on_message=self._take, handed_on=HANDED_ON) as listener:
                    with self._lock:
                        self._listener, self.problem = listener, ""
                    self._follow(listener)
            except UserError as error:
                with self._lock:
                    self._listener, self.problem = None, error.message + (f"\n{error.hint}" if error.hint else "")
            except OSError as error:  # a log that was played to its end, a network that went away
                with self._lock:
                    self._listener, self.problem = None, f"the connection ended: {error}"
            self._stop.wait(RETRY_S)

    def _follow(self, listener: Listener) -> None:
        while not self._stop.is_set():
            listener.poll(0.04)
            with self._lock:
                self._flush()
            self._stop.wait(0.03)  # so that several rows go in one block

    def _flush(self) -> None:
        run = self._run
        if self._new_rows and run is not None:
            self._send(rows_block(self._new_rows, run.key))
            self._new_rows = []
            if run.soil is not None and (block := run.soil.changes()) is not None:
                self._send(block)
        now = time.monotonic()
        for key in [k for k, (sent_s, _) in self._pending.items() if now - sent_s > ANSWER_S]:
            _, sent = self._pending.pop(key)
            self._send(sent | {"kind": "answer", "accepted": False, "reason": f"no answer within {ANSWER_S:g} s"})

    def _take(self, channel: str, message) -> None:
        with self._lock:
            if not self._is_followed(channel, message):
                return
            self._heard_s = time.monotonic()
            handler = {types.TRUTH: self._truth, types.EVENT: self._event, types.RUN: self._run_told,
                       types.ANSWER: self._answer, types.HEALTH: self._health_told}[channel]  # fmt: skip
            handler(self._run, message)

    def _is_followed(self, channel: str, message) -> bool:
        """Whether the message is of the run that the pages show; a new run takes over from one that is over."""
        run = self._run
        again = run is not None and run.ended and channel == types.RUN and message.state == message.RUNNING
        if run is not None and run.run_id == message.run_id and not again:
            return True
        if run is not None and not run.ended and time.monotonic() - self._heard_s < SILENT_S:
            return False
        if channel == types.ANSWER:
            return False
        self._followed += 1
        self._run = LiveRun(message.run_id, f"{message.run_id}-{self._followed}")
        self._new_rows = []
        self._send(self._run_block(self._run))
        return True

    def _run_told(self, run: LiveRun, message) -> None:
        run.ended = run.ended or message.state == message.ENDED
        if run.document is not None:
            return
        values = toml(message.run_toml)
        plant = values.get("plant", {})
        run.document = {
            "scenario": message.scenario, "title": message.title, "seed": message.seed, "sensors": message.sensors,
            "version": message.version, "duration_s": message.duration_s, "folder": message.folder,
            "accepts_commands": bool(message.accepts_commands),
            "same_schema": message.schema_hash == message.SCHEMA_HASH,
            "terrain": track.terrain(plant), "pushes": track.pushes(plant), "soil": plant.get("ground") == "soil",
            "controller": values.get("controller", {}),
        }  # fmt: skip
        self._send(self._run_block(run))
        if run.document["soil"]:
            run.soil = LiveSoil(plant)
            self._send(run.soil.whole())

    def _run_block(self, run: LiveRun) -> dict:
        return {
            "kind": "run", "run_id": run.key, "document": run.document, "steps": list(run.steps),
            "start_feet": run.start_feet, "events": list(run.events), "ended": run.ended,
        }  # fmt: skip

    def _health_told(self, run: LiveRun, message) -> None:
        if message.state == message.ENDED:
            run.ended = True

    def _event(self, run: LiveRun, message) -> None:
        event = {"t_s": message.time_us / 1e6, "event": message.kind, "text": message.text}
        run.events.append(event)
        if message.kind == "run_ended":
            run.ended = True
        self._send({"kind": "event", **event})

    def _answer(self, run: LiveRun, message) -> None:
        _, sent = self._pending.pop(message.command_id, (0.0, None))
        answer = {
            "kind": "answer", "command_id": str(message.command_id), "accepted": bool(message.accepted),
            "reason": message.reason, "command": message.kind, "name": message.name, "value": list(message.value),
            "own": sent is not None, "t_s": message.time_us / 1e6,
        }  # fmt: skip
        run.answers.append(answer)
        self._send(answer)

    def _truth(self, run: LiveRun, message) -> None:
        row = np.full(track.width(), np.nan, dtype=np.float32)
        sources = {types.TRUTH: message}
        for channel in (types.STATE, types.GAIT):
            latest = self._listener.latest.get(channel)
            if latest is not None and latest.run_id == run.run_id:
                sources[channel] = latest
        for entry, channel in self._places:
            if channel in sources:
                row[entry.first : entry.first + entry.count] = np.ravel(getattr(sources[channel], entry.name))
        t_s = message.time_us / 1e6
        run.rows.append((t_s, row))
        self._new_rows.append((t_s, row))
        if not run.start_feet:
            run.start_feet = feet(message)
            self._send({"kind": "start_feet", "start_feet": run.start_feet})
        if types.GAIT in sources:
            if (step := run.note_step(t_s, sources[types.GAIT])) is not None:
                self._send({"kind": "step", "step": step})
        if run.soil is not None:
            run.soil.move(message)

    def _health(self) -> dict | None:
        message = self._listener.latest.get(types.HEALTH) if self._listener else None
        if message is None or self._run is None or message.run_id != self._run.run_id:
            return None
        return {name: getattr(message, name) for name in (
            "tick", "controller_us", "controller_max_us", "plant_us", "plant_max_us", "telemetry_us", "lag_us",
            "real_time_factor", "overruns", "published", "dropped", "decimated", "fault", "paced", "state",
        )}  # fmt: skip

    def _counters(self) -> dict:
        if self._listener is None:
            return {}
        return {name: {k: v for k, v in asdict(counter).items() if not k.startswith("_")}
                for name, counter in dict(self._listener.counters).items()}  # fmt: skip


def _places() -> list[tuple[track.Entry, str]]:
    """The channel that carries each signal of a row."""
    samples = {channel: types.type_of(channel)() for channel in (types.TRUTH, types.GAIT, types.STATE)}
    return [(entry, next(channel for channel, message in samples.items() if hasattr(message, entry.name)))
            for entry in track.layout()]  # fmt: skip
