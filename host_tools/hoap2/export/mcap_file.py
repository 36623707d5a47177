"""MCAP with JSON messages: signals by their names, events, and the robot in Foxglove's own schemas."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hoap2 import parameters
from hoap2.export import PICTURE_HZ, Order, missing_package, poses
from hoap2.generate import lcm_types
from hoap2.generate.tables import MESSAGES, Signal
from hoap2.signal_log import PREFIX
from hoap2.telemetry import log_file, types
from hoap2.telemetry.run_telemetry import LOG_NAME

TRUTH_TICKS = 10
NUMBER, TEXT = {"type": "number"}, {"type": "string"}
TIME = {"type": "object", "title": "time", "properties": {"sec": {"type": "integer"}, "nsec": {"type": "integer"}}}


def _xyz(*names: str) -> dict:
    return {"type": "object", "properties": {name: NUMBER for name in names}}


POSE = {"type": "object", "properties": {"position": _xyz("x", "y", "z"), "orientation": _xyz("x", "y", "z", "w")}}
TRANSFORMS = {"type": "object", "properties": {"transforms": {
    "type": "array", "items": {"type": "object", "properties": {
        "timestamp": TIME, "parent_frame_id": TEXT, "child_frame_id": TEXT, "translation": _xyz("x", "y", "z"),
    "rotation": _xyz("x", "y", "z", "w")}}}}}  # fmt: skip
CUBE = {"type": "object", "properties": {"pose": POSE, "size": _xyz("x", "y", "z"), "color": _xyz("r", "g", "b", "a")}}
SCENE = {"type": "object", "properties": {
    "deletions": {"type": "array", "items": {"type": "object"}},
    "entities": {"type": "array", "items": {"type": "object", "properties": {
        "timestamp": TIME, "frame_id": TEXT, "id": TEXT, "frame_locked": {"type": "boolean"},
        "cubes": {"type": "array", "items": CUBE}}}}}}  # fmt: skip
EVENT = {"type": "object", "properties": {"kind": TEXT, "text": TEXT, "tick": {"type": "integer"}}}


def write(wanted: Order, path: Path, _form: str) -> None:
    """Topics /state, /gait, /truth (100 Hz), /event, and /tf and /scene for the 3D panel."""
    try:
        from mcap.writer import CompressionType, Writer
    except ImportError:
        raise missing_package("mcap", "mcap") from None
    with path.open("wb") as file:
        writer = Writer(file, compression=CompressionType.ZSTD)
        writer.start(profile="", library="hoap2")
        topics = _Topics(writer)
        _signals(wanted, topics)
        _events(wanted, topics)
        _robot(wanted, topics)
        writer.finish()


class _Topics:
    """Registers a topic with its first message."""

    def __init__(self, writer) -> None:
        self.writer, self.channels = writer, {}
        self.tick_ns = parameters.table().tick_us * 1000

    def put(self, topic: str, schema: tuple[str, dict], tick: int, message: dict) -> None:
        if topic not in self.channels:
            schema_id = self.writer.register_schema(schema[0], "jsonschema", json.dumps(schema[1]).encode())
            self.channels[topic] = self.writer.register_channel(topic, "json", schema_id)
        t_ns = int(tick) * self.tick_ns
        self.writer.add_message(
            self.channels[topic], log_time=t_ns, publish_time=t_ns, data=json.dumps(message).encode()
        )


def _labels(signal: Signal) -> list[list[str]]:
    """Names of the elements along each dimension."""
    table = parameters.table()
    return [table.labels.get(axis) or [str(i + 1) for i in range(table.sizes[axis])] for axis in signal.size_names]


def _named(values: np.ndarray, labels: list[list[str]]):
    """Numbers under the names of their elements; what is not finite as null, which JSON can carry."""
    if labels:
        return {name: _named(part, labels[1:]) for name, part in zip(labels[0], values)}
    number = values.item()
    return number if math.isfinite(number) else None


def _schema(signals: list[Signal]) -> dict:
    def of(labels: list[list[str]], kind: str) -> dict:
        if not labels:
            return {"type": "integer" if kind == "int" else "number"}
        return {"type": "object", "properties": {name: of(labels[1:], kind) for name in labels[0]}}

    return {"type": "object", "properties": {
        s.name: of(_labels(s), s.kind) | {"description": f"{s.text} [{s.unit}]"} for s in signals}}  # fmt: skip


def _signals(wanted: Order, topics: _Topics) -> None:
    log, chosen, table = wanted.source.log, set(wanted.columns), parameters.table()
    total, done = len(MESSAGES) * log.count, 0
    for name in MESSAGES:
        signals = [s for s in lcm_types.carried(table, name)
                   if all(PREFIX[s.product] + e in chosen for e in table.element_names(s))]  # fmt: skip
        every = math.lcm(wanted.every, TRUTH_TICKS) if name == "truth" else wanted.every
        columns = [(s.name, _labels(s), log.block(PREFIX[s.product] + s.name).reshape(-1, *s.shape)) for s in signals]
        schema = (f"hoap2.{name}", _schema(signals))
        for tick in range(0, log.count, every) if signals else ():
            topics.put(f"/{name}", schema, tick, {n: _named(block[tick], labels) for n, labels, block in columns})
            if tick % 500 == 0:
                wanted.progress(done + tick, total)
        done += log.count


def _events(wanted: Order, topics: _Topics) -> None:
    """Of the LCM log, when there is one: beside the signals, or the source itself."""
    path = wanted.source.folder / LOG_NAME if wanted.source.path.suffix == ".parquet" else wanted.source.path
    if not path.is_file():
        return
    for event in log_file.LogFile(path):
        if event.channel == types.EVENT:
            message = types.decode(event.channel, event.data)
            topics.put("/event", ("hoap2.event", EVENT), message.tick,
                       {"kind": message.kind, "text": message.text, "tick": message.tick})  # fmt: skip


def _robot(wanted: Order, topics: _Topics) -> None:
    """Frames of the links over time, and once a box in each."""
    tick_s = parameters.table().tick_us / 1e6
    rows = np.arange(0, wanted.source.log.count, math.lcm(round(1.0 / PICTURE_HZ / tick_s), TRUTH_TICKS))
    links = poses.of_run(wanted.source.log, rows)
    if not links:
        return
    stamp = {"sec": 0, "nsec": 0}
    entities = [_entity(link, stamp) for link in links]
    topics.put("/scene", ("foxglove.SceneUpdate", SCENE), 0, {"deletions": [], "entities": entities})
    for k, tick in enumerate(rows):
        ns = int(tick) * topics.tick_ns
        stamp = {"sec": ns // 10**9, "nsec": ns % 10**9}
        topics.put(
            "/tf", ("foxglove.FrameTransforms", TRANSFORMS), tick, {"transforms": list(_transforms(links, k, stamp))}
        )


def _entity(link: poses.LinkPoses, stamp: dict) -> dict:
    middle, size = 0.5 * (link.box_min_L_m + link.box_max_L_m), link.box_max_L_m - link.box_min_L_m
    cube = {"pose": {"position": dict(zip("xyz", middle)), "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}},
            "size": dict(zip("xyz", size)), "color": {"r": 0.75, "g": 0.78, "b": 0.82, "a": 1.0}}  # fmt: skip
    return {"timestamp": stamp, "frame_id": link.name, "id": link.name, "frame_locked": True,
            "lifetime": {"sec": 0, "nsec": 0}, "metadata": [], "cubes": [cube]}  # fmt: skip


def _transforms(links: list[poses.LinkPoses], k: int, stamp: dict) -> Iterator[dict]:
    for link in links:
        w, x, y, z = link.quat_W[k].tolist()
        yield {"timestamp": stamp, "parent_frame_id": "world", "child_frame_id": link.name,
               "translation": dict(zip("xyz", link.pos_W_m[k].tolist())),
               "rotation": {"x": x, "y": y, "z": z, "w": w}}  # fmt: skip
