"""Many runs at a time, each in a worker process; a stop request ends what is under way and starts no more."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import os
import signal
from collections.abc import Callable, Hashable, Mapping

from hoap2.errors import UserError
from hoap2.master import StopRequest

POLL_S = 0.2


def _start_worker() -> None:
    """Between runs a worker leaves Ctrl-C to its parent; during a run master.StopRequest listens."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_all(function: Callable, tasks: Mapping[Hashable, tuple], jobs: int, stop: StopRequest,
            finished: Callable[[Hashable, object, str | None], None], beat: Callable[[], None]) -> None:  # fmt: skip
    """Call function(*arguments) for each task, at most `jobs` at a time.

    finished(key, result, error) is called once for each task that was not cancelled, beat() several times a second.
    """
    if not tasks:
        return
    context = multiprocessing.get_context("spawn")
    workers = min(jobs, len(tasks))
    with concurrent.futures.ProcessPoolExecutor(workers, mp_context=context, initializer=_start_worker) as pool:
        waiting = {pool.submit(function, *arguments): key for key, arguments in tasks.items()}
        told = False
        while waiting:
            done, _ = concurrent.futures.wait(waiting, POLL_S, concurrent.futures.FIRST_COMPLETED)
            for future in done:
                key = waiting.pop(future)
                if not future.cancelled():
                    finished(key, *_outcome(future))
            beat()
            if stop.signal is not None and not told:
                told = True
                for future in waiting:
                    future.cancel()
                for child in multiprocessing.active_children():  # a terminal's Ctrl-C reached them, a kill did not
                    os.kill(child.pid, signal.SIGINT)


def _outcome(future: concurrent.futures.Future) -> tuple[object, str | None]:
    try:
        return future.result(), None
    except UserError as error:
        return None, str(error)
    except Exception as error:  # a worker that died takes its run along, not the study
        return None, f"{type(error).__name__}: {error}"
