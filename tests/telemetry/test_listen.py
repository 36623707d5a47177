"""The listener: what it makes of lost, repeated, cut and foreign messages. Everything within one process (memq)."""

from __future__ import annotations

import pytest

from hoap2.errors import UserError
from hoap2.telemetry import transport, types
from hoap2.telemetry.listen import Listener

RUN, OTHER_RUN = 7, 8


@pytest.fixture
def listener():
    with Listener("memq://") as made:
        yield made


def gait(sequence: int, run_id: int = RUN):
    message = types.bindings().gait_t()
    message.run_id, message.sequence = run_id, sequence
    message.tick, message.time_us = sequence, 1000 * sequence
    message.com_ref_W_m[2] = 0.25 + sequence
    return message


def run_message():
    message = types.bindings().run_t()
    message.run_id, message.scenario, message.run_toml = RUN, "floor-walk", "a = 1\n" * 50
    return message


def send(listener: Listener, channel: str, *items) -> None:
    for item in items:
        listener._lcm.publish(channel, item if isinstance(item, bytes) else item.encode())
        listener.poll(0.0)


def counts(listener: Listener, channel: str) -> tuple[int, ...]:
    c = listener.counters[channel]
    return c.received, c.lost, c.replayed, c.malformed, c.foreign


def test_messages_arrive_in_order_and_whole():
    seen = []
    with Listener(
        "memq://", [types.GAIT], lambda channel, message: seen.append((channel, message.sequence))
    ) as listener:
        send(listener, types.GAIT, gait(0), gait(1), gait(2))
        send(listener, types.RUN, run_message())  # not asked for
    assert seen == [(types.GAIT, 0), (types.GAIT, 1), (types.GAIT, 2)]
    assert counts(listener, types.GAIT) == (3, 0, 0, 0, 0)
    assert listener.latest[types.GAIT].com_ref_W_m[2] == 2.25 and list(listener.latest) == [types.GAIT]


def test_a_gap_is_counted_for_each_run_by_itself(listener: Listener):
    send(listener, types.GAIT, gait(5), gait(100, OTHER_RUN), gait(6), gait(9), gait(101, OTHER_RUN))
    assert counts(listener, types.GAIT) == (5, 2, 0, 0, 0)  # who comes late has lost nothing


def test_repetitions_are_not_delivered(listener: Listener):
    send(listener, types.GAIT, gait(0), gait(1), gait(2), gait(3), gait(1), gait(4))
    assert counts(listener, types.GAIT) == (5, 0, 1, 0, 0)
    assert listener.latest[types.GAIT].sequence == 4


@pytest.mark.parametrize("start, taken", [(0, 3), (4, 2)])
def test_a_run_that_is_played_again_is_followed(listener: Listener, start: int, taken: int):
    send(listener, types.GAIT, *(gait(i) for i in range(10)))
    send(listener, types.GAIT, *(gait(i) for i in range(start, start + 3)))
    assert counts(listener, types.GAIT) == (10 + taken, 0, 3 - taken, 0, 0)
    assert listener.latest[types.GAIT].sequence == start + 2


@pytest.mark.parametrize("message, channel", [(gait, types.GAIT), (lambda _: run_message(), types.RUN)])
def test_every_cut_and_every_tail_is_malformed_or_foreign(listener: Listener, message, channel: str):
    data = message(0).encode()
    for length in range(len(data)):
        send(listener, channel, data[:length])
    send(listener, channel, data + b"\0")
    assert counts(listener, channel) == (0, 0, 0, len(data) - 8 + 1, 8)
    assert not listener.latest


def test_lengths_that_lie_are_malformed(listener: Listener):
    command = types.bindings().command_t()
    command.kind, command.n, command.value = "push", 3, [1.0, 2.0, 3.0]
    data = command.encode()
    at = data.index(b"push") - 4
    for lie in (b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\0\0\0\0", b"\0\0\0\1"):
        send(listener, types.COMMAND, data[:at] + lie + data[at + 4 :])
    for lie in (-1, 2, 4, 2**31 - 1):
        at = len(data) - 8 * 3 - 5 - 4  # n, before its three numbers and the empty sender
        send(listener, types.COMMAND, data[:at] + lie.to_bytes(4, "big", signed=True) + data[at + 4 :])
    send(listener, types.COMMAND, data)
    assert counts(listener, types.COMMAND) == (1, 0, 0, 8, 0)


def test_strangers_are_counted_and_change_nothing(listener: Listener):
    send(listener, types.STATE, gait(0), b"", b"LCM_SELF_TEST and more", run_message())
    send(listener, "HOAP2_NOBODY", b"hello")
    assert counts(listener, types.STATE) == (0, 0, 0, 0, 4)
    assert counts(listener, "HOAP2_NOBODY") == (0, 0, 0, 0, 1)
    for i in range(100):
        send(listener, f"HOAP2_X{i}", b"spam")
    assert len(listener.counters) < 30 and sum(c.foreign for c in listener.counters.values()) == 105


def test_a_run_of_another_schema_is_told(listener: Listener):
    message = run_message()
    assert not listener.other_schema
    for schema, other in ((message.SCHEMA_HASH, False), (message.SCHEMA_HASH + 1, True)):
        message.schema_hash, message.sequence = schema, message.sequence + 1
        send(listener, types.RUN, message)
        assert listener.other_schema is other


@pytest.mark.parametrize("url, said", [("udp://1.2.3.4", "not an LCM URL"), ("udpm://10.0.0.1:7667", "not a multicast"),
                                       ("udpm://239.255.76.67:x", "not an LCM URL"), ("7667", "not an L")])  # fmt: skip
def test_a_wrong_url_is_named(url: str, said: str):
    with pytest.raises(UserError, match=said) as raised:
        transport.check_url(url)
    assert "udpm://239.255.76.67:7667?ttl=0" in raised.value.hint
