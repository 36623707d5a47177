"""The web server of the monitor: the page, the runs, and a WebSocket with what happens live."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import json
import math
import signal
import socket
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from aiohttp import WSMsgType, web

from hoap2 import runfolder
from hoap2.errors import UserError
from hoap2.monitor import access, model, track
from hoap2.monitor.live import LiveHub
from hoap2.monitor.runs import RunList

STATUS_PERIOD_S = 0.5
MAX_WAITING = 60  # blocks that wait for a slow page; then it starts afresh with what is there
MAX_MESSAGE = 4096
FILES = {"report.html", "video.mp4", "snapshots.png", "summary.json", "run.toml"}


class Page:
    """One open page: its WebSocket and what waits to be sent."""

    def __init__(self, socket_: web.WebSocketResponse) -> None:
        self.socket = socket_
        self.queue: asyncio.Queue[dict | bytes] = asyncio.Queue(MAX_WAITING)
        self.late = 0  # how often it fell behind

    def offer(self, block: dict | bytes) -> None:
        """Never waits: a page that does not keep up loses what waited and is told everything again."""
        with contextlib.suppress(asyncio.QueueFull):
            self.queue.put_nowait(block)
            return
        while not self.queue.empty():
            self.queue.get_nowait()
        self.late += 1
        self.queue.put_nowait({"kind": "late", "times": self.late})


class Monitor:
    """The application and its hub."""

    def __init__(self, page_dir: Path, runs: RunList, url: str | None) -> None:
        self.page_dir, self.runs = page_dir, runs
        self._pages: set[Page] = set()
        self._loop: asyncio.AbstractEventLoop | None = None
        self.hub = LiveHub(url, self._from_hub)
        self.read_run = lru_cache(maxsize=3)(lambda what, folder, changed: what(folder))

    def application(self, token: str | None, local_only: bool) -> web.Application:
        """Routes and start-up."""
        app = web.Application(middlewares=[access.middleware(token, local_only), _user_errors])
        app.router.add_get("/", self._index)
        app.router.add_get("/ws", self._websocket)
        app.router.add_get("/api/model", self._model)
        app.router.add_get("/api/mesh", self._mesh)
        app.router.add_get("/api/runs", self._runs)
        app.router.add_get("/api/runs/{group}/{name}/track", self._track)
        app.router.add_get("/api/runs/{group}/{name}/soil", self._soil)
        app.router.add_get("/api/runs/{group}/{name}/file/{file}", self._file)
        app.router.add_static("/assets/", self.page_dir / "assets")
        app.cleanup_ctx.append(self._running)
        return app

    async def _running(self, _app: web.Application):
        self._loop = asyncio.get_running_loop()
        self.hub.start()
        ticker = asyncio.create_task(self._tick())
        yield
        ticker.cancel()
        for page in list(self._pages):
            await page.socket.close(code=1001, message=b"the monitor ends")
        await asyncio.to_thread(self.hub.close)

    # ------------------------------------------------------------ live

    def _from_hub(self, block: dict | bytes) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has just ended
            self._loop.call_soon_threadsafe(self._spread, block)

    def _spread(self, block: dict | bytes) -> None:
        for page in self._pages:
            page.offer(block)

    async def _tick(self) -> None:
        while True:
            self._spread(self.hub.status())
            await asyncio.sleep(STATUS_PERIOD_S)

    async def _websocket(self, request: web.Request) -> web.WebSocketResponse:
        answer = web.WebSocketResponse(heartbeat=10.0, max_msg_size=MAX_MESSAGE)
        await answer.prepare(request)
        page = Page(answer)
        for block in self.hub.hello():
            page.offer(block)
        self._pages.add(page)
        sender = asyncio.create_task(self._send(page))
        try:
            async for message in answer:
                if message.type == WSMsgType.TEXT:
                    page.offer(self._command(message.data))
        finally:
            self._pages.discard(page)
            sender.cancel()
        return answer

    async def _send(self, page: Page) -> None:
        with contextlib.suppress(ConnectionError):
            while True:
                block = await page.queue.get()
                if isinstance(block, bytes):
                    await page.socket.send_bytes(block)
                    continue
                await page.socket.send_str(json.dumps(runfolder.jsonable(block)))
                if block["kind"] == "late":
                    for again in self.hub.hello():
                        page.offer(again)

    def _command(self, text: str) -> dict:
        """Send on what the page asks for; what cannot be a command is refused here, the rest is the run's to judge."""
        sent = {"kind": "answer", "accepted": False, "own": True}
        try:
            asked = json.loads(text)
            kind, name = str(asked["command"]), str(asked["name"])
            value = [float(v) for v in asked["value"]]
            if len(value) > 16 or len(kind) > 40 or len(name) > 80 or not all(map(math.isfinite, value)):
                raise ValueError("too long, or not a finite number")
        except (ValueError, TypeError, KeyError, OverflowError) as error:
            return sent | {"reason": f"not a command: {error}", "command": "?", "name": "", "value": []}
        try:
            return self.hub.command(kind, name, value, "web")
        except UserError as error:
            reason = error.message + (f"; {error.hint}" if error.hint else "")
            return sent | {"reason": reason, "command": kind, "name": name, "value": value}

    # ------------------------------------------------------------ what lies still

    async def _index(self, _request: web.Request) -> web.StreamResponse:
        return web.FileResponse(self.page_dir / "index.html")

    async def _model(self, _request: web.Request) -> web.Response:
        return web.json_response(runfolder.jsonable(model.document()))

    async def _mesh(self, request: web.Request) -> web.Response:
        return _block(await asyncio.to_thread(model.mesh, request.query.get("coarse") == "1"))

    async def _runs(self, _request: web.Request) -> web.Response:
        entries = await asyncio.to_thread(self.runs.entries)
        return web.json_response(runfolder.jsonable({"root": str(self.runs.root), "runs": entries}))

    def _folder(self, request: web.Request) -> Path:
        return self.runs.folder(f"{request.match_info['group']}/{request.match_info['name']}")

    async def _of_run(self, request: web.Request, what: Callable[[Path], bytes]) -> web.Response:
        folder = self._folder(request)
        changed = (folder / "signals.parquet").stat().st_mtime_ns
        return _block(await asyncio.to_thread(self.read_run, what, folder, changed))

    async def _track(self, request: web.Request) -> web.Response:
        return await self._of_run(request, track.of_run)

    async def _soil(self, request: web.Request) -> web.Response:
        return await self._of_run(request, track.soil_of_run)

    async def _file(self, request: web.Request) -> web.StreamResponse:
        name = request.match_info["file"]
        path = self._folder(request) / name
        if name not in FILES or not path.is_file():
            raise web.HTTPNotFound(text=f"this run has no {name}\n")
        return web.FileResponse(path)


def _block(data: bytes) -> web.Response:
    return web.Response(body=data, content_type="application/octet-stream")


@web.middleware
async def _user_errors(request: web.Request, handler: access.Handler) -> web.StreamResponse:
    """An error that is the user's to mend, as the page shows it."""
    try:
        return await handler(request)
    except UserError as error:
        return web.json_response({"error": error.message, "hint": error.hint}, status=404)


def _listen(host: str, port: int) -> socket.socket:
    """A listening socket, or an error that says what to do."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        return socket.create_server((host, port), family=family)
    except (OSError, OverflowError) as error:
        if getattr(error, "errno", None) == errno.EADDRINUSE:
            raise UserError(f"port {port} of {host} is in use", "is a monitor running already? else give another one: "
                            f"--port {port + 1}, or --port 0 for any that is free") from None  # fmt: skip
        raise UserError(f"cannot listen on {host}, port {port}: {error}") from None


async def _serve(monitor: Monitor, listening: socket.socket, token: str | None, local_only: bool,
                 started: Callable[[], None]) -> None:  # fmt: skip
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, stop.set)
    runner = web.AppRunner(monitor.application(token, local_only), access_log=None, shutdown_timeout=2.0)
    await runner.setup()
    try:
        await web.SockSite(runner, listening).start()
        started()
        await stop.wait()
    finally:
        await runner.cleanup()


def serve(page_dir: Path, runs: Path, host: str, port: int, token: str | None, url: str | None,
          say: Callable[[str], None]) -> None:  # fmt: skip
    """Serve until SIGINT or SIGTERM. say(address) is called once it can be opened."""
    access.check(host, token)
    with _listen(host, port) as listening:
        shown = f"[{host}]" if ":" in host else host
        address = f"http://{shown}:{listening.getsockname()[1]}/"
        monitor = Monitor(page_dir, RunList(runs), url)
        asyncio.run(_serve(monitor, listening, token, access.is_loopback(host), lambda: say(address)))
