"""The monitor's page beside a paced run, in headless Chromium: pictures a second, memory, what was lost."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from hoap2.errors import UserError

CHROMIUM = Path("/usr/bin/chromium")
# As on a machine without a graphics card: everything by the processor, WebGL too, nothing else by way of WebGL.
ARGUMENTS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox",
             "--disable-gpu-rasterization", "--disable-accelerated-2d-canvas", "--disable-gpu-compositing"]  # fmt: skip
SIZE = {"width": 1600, "height": 900}
WARM_UP_S = 15.0
PERIOD_S = 5.0
START_S = 60.0
LONGEST_RUN_S = 600.0
WALK = ("run", "floor-walk", "--realtime", "--no-video", "--set", "controller.steps_forward=1000")


@contextmanager
def _process(arguments: list[str], log: Path) -> Iterator[subprocess.Popen]:
    with log.open("w") as out:
        process = subprocess.Popen([sys.executable, "-m", "hoap2.cli", *arguments], stdout=out, stderr=out,
                                   stdin=subprocess.DEVNULL, cwd=log.parent)  # fmt: skip
        try:
            yield process
        finally:
            process.terminate()
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _address(process: subprocess.Popen, log: Path) -> str:
    end = time.monotonic() + START_S
    while time.monotonic() < end and process.poll() is None:
        words = log.read_text().split()
        if "monitor:" in words:
            return words[words.index("monitor:") + 1]
        time.sleep(0.1)
    raise UserError(f"the monitor did not start: {log.read_text().strip()}")


def _browser(others: list[int]) -> tuple[float, float]:
    """Memory (MB, each page of it once) and processor time (s) of this process' children but the others."""
    total_kb, ticks, waiting = 0, 0, [os.getpid()]
    while waiting:
        number = waiting.pop()
        try:
            for task in Path(f"/proc/{number}/task").iterdir():
                waiting += [int(c) for c in (task / "children").read_text().split() if int(c) not in others]
            if number == os.getpid():
                continue
            lines = Path(f"/proc/{number}/smaps_rollup").read_text().splitlines()
            total_kb += next(int(line.split()[1]) for line in lines if line.startswith("Pss:"))
            ticks += sum(map(int, Path(f"/proc/{number}/stat").read_text().rsplit(")", 1)[1].split()[11:13]))
        except (OSError, StopIteration):
            continue  # it has just ended
    return total_kb / 1024, ticks / os.sysconf("SC_CLK_TCK")


def _heap_mb(session) -> float:
    """JavaScript objects that are in use, after a collection."""
    session.send("HeapProfiler.collectGarbage")
    return session.send("Runtime.getHeapUsage")["usedSize"] / 2**20


def _watch(page, session, seconds: float, others: list[int], status: Callable[[str], None]) -> list[dict]:
    """Samples, one each PERIOD_S."""
    samples: list[dict] = []
    started = before_s = time.monotonic()
    before, busy_before_s = page.evaluate("monitor.probe"), _browser(others)[1]
    while time.monotonic() - started < seconds:
        page.wait_for_timeout(1000 * PERIOD_S)
        probe, now = page.evaluate("monitor.probe"), time.monotonic()
        memory_mb, busy_s = _browser(others)
        samples.append({
            "at_s": now - started, "pictures_1_s": (probe["pictures"] - before["pictures"]) / (now - before_s),
            "shown_1_s": (probe["last"] - before["last"]) / (now - before_s), "tier": probe["tier"],
            "heap_mb": _heap_mb(session), "browser_mb": memory_mb,
            "browser_cores": (busy_s - busy_before_s) / (now - before_s), "lost": probe["lost"],
        })  # fmt: skip
        before, before_s, busy_before_s = page.evaluate("monitor.probe"), time.monotonic(), _browser(others)[1]
        status(f"{samples[-1]['at_s']:.0f} of {seconds:.0f} s: {samples[-1]['pictures_1_s']:.0f} pictures a second")
    return samples


def run(seconds: float, url: str | None, status: Callable[[str], None]) -> dict:
    """The figures of `bench page`; every sample is in `samples`."""
    from playwright.sync_api import sync_playwright

    if not CHROMIUM.exists():
        raise UserError(f"there is no {CHROMIUM}", "sudo apt-get install --no-install-recommends chromium", 3)
    lcm = ["--lcm", url] if url else []
    with tempfile.TemporaryDirectory() as folder:
        logs = [Path(folder) / name for name in ("monitor.log", "run.log")]
        duration = f"{min(LONGEST_RUN_S, seconds + WARM_UP_S + START_S):.0f}"
        with _process(["monitor", "--web", "--port", "0", *lcm], logs[0]) as monitor, sync_playwright() as driver:
            address = _address(monitor, logs[0])
            browser = driver.chromium.launch(executable_path=str(CHROMIUM), headless=True, args=ARGUMENTS)
            page = browser.new_page(viewport=SIZE)
            page.goto(address)
            page.wait_for_selector("body.ready", timeout=60_000)
            with _process([*WALK, "--duration", duration, *lcm], logs[1]) as walk:
                status("waiting for the run")
                end = time.monotonic() + START_S
                while page.evaluate("monitor.probe.rows") == 0:
                    if walk.poll() is not None or time.monotonic() > end:
                        raise UserError(f"the page shows no run: {logs[1].read_text().strip()}")
                    page.wait_for_timeout(200)
                page.wait_for_timeout(1000 * WARM_UP_S)
                session = page.context.new_cdp_session(page)
                samples = _watch(page, session, seconds, [monitor.pid, walk.pid], status)
            browser.close()
    return _document(seconds, samples)


def _document(seconds: float, samples: list[dict]) -> dict:
    def middle(name: str, part: list[dict]) -> float:
        return statistics.median(sample[name] for sample in part)

    third = max(1, len(samples) // 3)
    return {
        "seconds": seconds, "pictures_1_s": middle("pictures_1_s", samples),
        "pictures_least_1_s": min(s["pictures_1_s"] for s in samples), "shown_1_s": middle("shown_1_s", samples),
        "tier": samples[-1]["tier"],
        "browser_cores": middle("browser_cores", samples),
        "heap_mb": {"first": middle("heap_mb", samples[:third]), "last": middle("heap_mb", samples[-third:])},
        "browser_mb": {"first": middle("browser_mb", samples[:third]), "last": middle("browser_mb", samples[-third:])},
        "lost": samples[-1]["lost"], "samples": samples,
    }  # fmt: skip


def show(document: dict) -> None:
    """The figures for people."""
    from rich.console import Console

    console = Console(highlight=False)
    heap, browser = document["heap_mb"], document["browser_mb"]
    console.print(f"{document['seconds']:.0f} s beside a paced run, WebGL by the processor, quality {document['tier']}")
    console.print(f"pictures a second: median {document['pictures_1_s']:.1f}, least {document['pictures_least_1_s']:.1f}; "
                  f"the browser keeps {document['browser_cores']:.2f} cores busy")  # fmt: skip
    console.print(f"simulated time shown a second: {document['shown_1_s']:.3f} s; messages lost: {document['lost']}")
    console.print(f"JavaScript heap after a collection: {heap['first']:.1f} MB in the first third, "
                  f"{heap['last']:.1f} MB in the last")  # fmt: skip
    console.print(f"browser, all processes: {browser['first']:.0f} MB, {browser['last']:.0f} MB")
