"""The benchmark of the telemetry runs and tells what it promises; its figures are not judged."""

from __future__ import annotations

from hoap2.bench import telemetry as benchmark


def test_every_sink_and_both_loops_are_measured():
    said: list[str] = []
    found = benchmark.run(1, 3.0, said.append)
    assert found["loop"]["equal"] and len(found["loop"]["ratios"]) == 5 and found["ticks"] == 3000
    assert found["sinks"]["log"]["logged"] > 6600 and found["sinks"]["memq"]["published"] > 6600
    for name in ("udpm", "udpm, a listener"):
        if name in found["sinks"]:  # where there are network namespaces
            row = found["sinks"][name]
            assert row["published"] > 6600 and row["dropped"] == 0
            assert 0 < row["us"] and 0 < row["sender_us"]
    assert said
