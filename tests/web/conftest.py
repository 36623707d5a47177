"""What the tests of the monitor's page share: a network of their own, runs, servers, browsers."""

from __future__ import annotations

import contextlib
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hoap2.bench.page import ARGUMENTS, CHROMIUM

CLI = [sys.executable, "-m", "hoap2.cli"]


def wait_until(condition: Callable[[], object], timeout_s: float = 60.0, what: str = "it") -> object:
    """The first true value of the condition; an error when there is none in time."""
    end = time.monotonic() + timeout_s
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.1)
    raise AssertionError(f"{what} did not happen within {timeout_s:g} s")


class Network:
    """A network with nothing but loopback, in which multicast stays. Lives as long as its holder process."""

    def __init__(self, unshare: list[str]) -> None:
        script = "ip link set lo up && ip route add 224.0.0.0/4 dev lo && echo up && exec sleep infinity"
        self._holder = subprocess.Popen([*unshare, "bash", "-c", script], stdout=subprocess.PIPE, text=True)
        assert self._holder.stdout.readline() == "up\n"
        user = ["--preserve-credentials", "--user"] if "--map-root-user" in unshare else []
        self.enter = ["nsenter", "--target", str(self._holder.pid), *user, "--net"]

    def close(self) -> None:
        self._holder.kill()
        self._holder.wait()
        self._holder.stdout.close()


@pytest.fixture(scope="session")
def network() -> Iterator[Network]:
    root = subprocess.run(["id", "-u"], capture_output=True, text=True).stdout.strip() == "0"
    unshare = ["unshare", "--net"] if root else ["unshare", "--map-root-user", "--net"]
    if not all(map(shutil.which, ("unshare", "nsenter", "ip"))) or subprocess.run([*unshare, "true"]).returncode:
        pytest.skip("no network namespaces here")
    made = Network(unshare)
    yield made
    made.close()


class Process:
    """A command in the network, its output kept."""

    def __init__(self, network: Network, arguments: list, log: Path, cwd: Path) -> None:
        self.log = log
        with log.open("w") as out:
            self.process = subprocess.Popen([*network.enter, *map(str, arguments)], stdout=out, stderr=out,
                                            stdin=subprocess.DEVNULL, cwd=cwd)  # fmt: skip

    def wait_for(self, pattern: str, timeout_s: float = 60.0) -> re.Match:
        def found():
            assert self.process.poll() is None or re.search(pattern, self.log.read_text()), self.log.read_text()
            return re.search(pattern, self.log.read_text())

        return wait_until(found, timeout_s, pattern)

    def end(self, number: int = signal.SIGTERM, timeout_s: float = 90.0) -> int:
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.send_signal(number)
        return self.process.wait(timeout_s)


@pytest.fixture
def start(network: Network, tmp_path: Path) -> Iterator[Callable[..., Process]]:
    """start("run", "floor-walk", ...): the command line in the network, in tmp_path."""
    started: list[Process] = []

    def call(*arguments) -> Process:
        log = tmp_path / f"process-{len(started)}.log"
        started.append(Process(network, [*CLI, *arguments], log, tmp_path))
        return started[-1]

    yield call
    for process in started:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.end(signal.SIGKILL, 10.0)


@pytest.fixture(scope="session")
def sand_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The first steps of a walk on sand: `<folder>/sand-walk-lpc/first`."""
    folder = tmp_path_factory.mktemp("runs")
    done = subprocess.run([*CLI, "run", "sand-walk-lpc", "--duration", "3.5", "--no-video",
                           "--out", folder / "sand-walk-lpc" / "first"], capture_output=True, text=True)  # fmt: skip
    assert (folder / "sand-walk-lpc" / "first" / "signals.parquet").is_file(), done.stderr
    return folder / "sand-walk-lpc" / "first"


@pytest.fixture
def monitor(start: Callable[..., Process], sand_run: Path) -> Callable[..., tuple[Process, str]]:
    """monitor(): a web monitor of that run's folder, and its address."""

    def call(*options) -> tuple[Process, str]:
        process = start("monitor", "--web", "--port", 0, "--runs", sand_run.parents[1], *options)
        return process, process.wait_for(r"monitor: (http://\S+)")[1]

    return call


class Page:
    """The page in a browser, asked by what it tells of itself."""

    def __init__(self, page) -> None:
        self.page = page
        self.errors: list[str] = []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda message: message.type == "error" and self.errors.append(message.text))

    def open(self, address: str) -> None:
        self.page.goto(address)
        self.page.wait_for_selector("body.ready", timeout=60_000)

    def probe(self) -> dict:
        return self.page.evaluate("monitor.probe")

    def until(self, condition: Callable[[dict], object], what: str, timeout_s: float = 60.0) -> dict:
        def holds():
            probe = self.probe()
            self.page.wait_for_timeout(100)
            return probe if condition(probe) else None

        return wait_until(holds, timeout_s, what)

    def text(self, selector: str) -> str:
        return self.page.inner_text(selector)


@pytest.fixture(scope="session")
def chromium(network: Network, tmp_path_factory: pytest.TempPathFactory) -> Iterator:
    """Debian's Chromium in the network."""
    playwright = pytest.importorskip("playwright.sync_api")
    if not CHROMIUM.exists():
        pytest.skip("no chromium here")
    program = tmp_path_factory.mktemp("browser") / "chromium"
    program.write_text(f'#!/bin/sh\nexec {" ".join(network.enter)} {CHROMIUM} "$@"\n')
    program.chmod(0o755)
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=str(program), headless=True, args=ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture
def page(chromium) -> Iterator[Page]:
    opened = chromium.new_page(viewport={"width": 1280, "height": 760})
    made = Page(opened)
    yield made
    opened.close()
    assert made.errors == []
