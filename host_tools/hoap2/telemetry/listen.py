"""A listener: the last message of each channel, and counters of what did not arrive or should not have."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from hoap2.telemetry import transport, types

QUEUE = 4000  # messages of a channel that may wait; later ones are lost, and counted as such
FOREIGN_CHANNELS = 20  # names of strangers that are kept
RUNS = 8  # runs that are followed on one channel


@dataclass
class Counter:
    """What came on one channel.

    lost: gaps in the sequence numbers of a run. replayed: numbers that had been there already.
    malformed: messages of ours that were cut or damaged. foreign: of another type, version or sender.
    """

    received: int = 0
    lost: int = 0
    replayed: int = 0
    malformed: int = 0
    foreign: int = 0
    _next: dict[int, int] = field(default_factory=dict, repr=False)  # run -> sequence number that comes next
    _back: dict[int, int] = field(default_factory=dict, repr=False)  # run -> next number of a stream that went back

    def takes(self, run_id: int, sequence: int) -> bool:
        """Count a message; False when it is a repetition.

        One that starts at 0 again, or goes on where the last repetition ended, is a run that is played again.
        """
        expected = self._next.pop(run_id, None)
        if expected is not None and 0 < sequence < expected and self._back.get(run_id) != sequence:
            self._next[run_id] = expected
            self._back[run_id] = sequence + 1
            self.replayed += 1
            return False
        if expected is not None and sequence > expected:
            self.lost += sequence - expected
        self._back.pop(run_id, None)
        self._next[run_id] = sequence + 1
        if len(self._next) > RUNS:
            oldest = next(iter(self._next))
            del self._next[oldest]
            self._back.pop(oldest, None)
        self.received += 1
        return True


class Latest(Mapping):
    """Channel -> last message; decoded when it is asked for."""

    def __init__(self) -> None:
        self._data: dict[str, bytes] = {}
        self._decoded: dict[str, object] = {}

    def put(self, channel: str, data: bytes, message: object | None) -> None:
        self._data[channel] = data
        if message is None:
            self._decoded.pop(channel, None)
        else:
            self._decoded[channel] = message

    def __getitem__(self, channel: str):
        if channel not in self._decoded:
            self._decoded[channel] = types.decode(channel, self._data[channel])
        return self._decoded[channel]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)


class Listener:
    """Listens on one LCM URL. `poll` handles what has come, in the thread that calls it.

    url: None is LCM_DEFAULT_URL or the default. channels: names, or None for all. on_message(channel, message) is
    called for each good message of the channels handed_on (None: all). Of the other channels only the last message is
    decoded, when it is asked for.
    """

    def __init__(self, url: str | None = None, channels: Iterable[str] | None = None,
                 on_message: Callable[[str, object], None] | None = None,
                 handed_on: Iterable[str] | None = None) -> None:  # fmt: skip
        self.url = transport.url_or_default(url)
        self.latest = Latest()
        self.counters: dict[str, Counter] = {}
        self.last_s: dict[str, float] = {}  # channel -> time.monotonic() of its last good message
        self.on_message = on_message
        self._handed_on = frozenset(types.CHANNELS if handed_on is None else handed_on)
        self._handled = 0
        types.bindings()
        self._lcm = transport.connect(self.url)
        wanted = [f"{types.PREFIX}.*"] if channels is None else list(channels)
        self._subscriptions = [self._lcm.subscribe(name, self._take) for name in wanted]
        for subscription in self._subscriptions:
            subscription.set_queue_capacity(QUEUE)

    def fileno(self) -> int:
        """Readable when `poll` has something to do."""
        return self._lcm.fileno()

    def poll(self, timeout_s: float = 0.0) -> int:
        """Handle all that is there; wait at most timeout_s for the first message. Returns how many came."""
        self._handled = 0
        end = time.monotonic() + timeout_s
        wait = timeout_s
        while self._lcm.handle_timeout(max(0, round(1000 * wait))) > 0:
            if self._handled >= QUEUE:  # a flood: the caller gets its turn
                break
            wait = 0.0 if self._handled else max(0.0, end - time.monotonic())
        return self._handled

    def publish(self, channel: str, message) -> None:
        """Send a message."""
        self._lcm.publish(channel, message.encode())

    @property
    def other_schema(self) -> bool:
        """Whether the last run told of was made with another table of signals: its words may mean something else."""
        run = self.latest.get(types.RUN)
        return run is not None and run.schema_hash != run.SCHEMA_HASH

    def close(self) -> None:
        """Stop listening."""
        for subscription in self._subscriptions:
            self._lcm.unsubscribe(subscription)
        self._subscriptions = []

    def __enter__(self) -> Listener:
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def _counter(self, channel: str) -> Counter:
        if channel not in self.counters and channel not in types.CHANNELS and len(self.counters) > FOREIGN_CHANNELS:
            channel = "other"
        return self.counters.setdefault(channel, Counter())

    def _take(self, channel: str, data: bytes) -> None:
        self._handled += 1
        counter = self._counter(channel)
        try:
            types.check(channel, data)
            if channel == types.COMMAND:
                counter.received += 1
            elif not counter.takes(*types.header(data)[:2]):
                return
        except types.Foreign:
            counter.foreign += 1
            return
        except types.Malformed:
            counter.malformed += 1
            return
        wanted = self.on_message is not None and channel in self._handed_on
        message = types.decode(channel, data) if wanted else None
        self.latest.put(channel, data, message)
        self.last_s[channel] = time.monotonic()
        if wanted:
            self.on_message(channel, message)
