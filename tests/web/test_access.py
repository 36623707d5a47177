"""Who may reach the web monitor: ports, addresses, tokens, foreign pages."""

from __future__ import annotations

import socket
import subprocess
from pathlib import Path

import aiohttp
import pytest
from aiohttp.test_utils import TestClient, TestServer
from hoap2.errors import UserError
from hoap2.monitor import access
from hoap2.monitor.runs import RunList
from hoap2.monitor.server import Monitor

TOKEN = "a token of some length"


def _monitor(page: Path, runs: Path) -> Monitor:
    (page / "assets").mkdir(parents=True, exist_ok=True)
    (page / "index.html").write_text("<!doctype html><title>page</title>")
    return Monitor(page, RunList(runs), "file:///nothing/here.lcm")  # no network at all


def _ask(tmp_path: Path, questions, token: str | None = None, local_only: bool = True):
    """Run a coroutine against a server in this process."""
    import asyncio

    async def all_of_it():
        monitor = _monitor(tmp_path / "page", tmp_path)
        async with TestClient(TestServer(monitor.application(token, local_only))) as client:
            return await questions(client)

    return asyncio.run(all_of_it())


def test_a_port_in_use_is_said_with_what_helps(hoap2_cli, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = hoap2_cli("monitor", "--web", "--port", port, "--lcm", "memq://", cwd=tmp_path)
    assert done.returncode == 2
    assert f"port {port} of 127.0.0.1 is in use" in done.stderr and "--port" in done.stderr


@pytest.mark.parametrize("host", ["0.0.0.0", "192.0.2.7", "::", "some-machine"])
def test_an_address_that_others_reach_needs_a_token(hoap2_cli, tmp_path: Path, host: str) -> None:
    done: subprocess.CompletedProcess = hoap2_cli("monitor", "--web", "--host", host, "--lcm", "memq://", cwd=tmp_path)
    assert done.returncode == 2 and "--token" in done.stderr


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.0.0.3"])
def test_this_machine_needs_none(host: str) -> None:
    access.check(host, None)


def test_a_short_token_is_refused() -> None:
    with pytest.raises(UserError, match="12 or more"):
        access.check("0.0.0.0", "secret")
    access.check("0.0.0.0", TOKEN)


def test_without_the_token_nothing_is_told(tmp_path: Path) -> None:
    async def questions(client):
        found = [(await client.get(path)).status for path in ("/", "/api/model", "/api/runs", "/assets/x.js", "/ws")]
        wrong = await client.get("/", params={"token": TOKEN + "x"})
        right = await client.get("/", params={"token": TOKEN}, allow_redirects=False)
        after = await client.get("/api/runs")  # with the cookie
        return found, wrong.status, right, after.status

    found, wrong, right, after = _ask(tmp_path, questions, TOKEN, local_only=False)
    assert found == [401] * 5 and wrong == 401 and after == 200
    assert right.status == 303 and TOKEN not in right.headers["Location"]
    assert "HttpOnly" in right.headers["Set-Cookie"] and "SameSite=Strict" in right.headers["Set-Cookie"]


def test_pages_from_elsewhere_are_refused(tmp_path: Path) -> None:
    async def questions(client):
        def own(headers):
            return client.get("/api/runs", headers=headers)

        host = f"127.0.0.1:{client.port}"
        foreign = {"Origin": "http://elsewhere.example"}
        headers = ({}, {"Origin": f"http://{host}"}, foreign, {"Host": "evil.example"})
        statuses = [(await own(each)).status for each in headers]
        try:
            await client.ws_connect("/ws", headers=foreign)
            statuses.append(101)
        except aiohttp.WSServerHandshakeError as error:
            statuses.append(error.status)
        return statuses

    assert _ask(tmp_path, questions) == [200, 200, 403, 403, 403]


def test_answers_let_the_page_load_nothing_from_outside(tmp_path: Path) -> None:
    async def questions(client):
        return (await client.get("/")).headers

    policy = _ask(tmp_path, questions)["Content-Security-Policy"]
    assert "default-src 'self'" in policy and "http" not in policy and "*" not in policy


def test_only_files_of_known_runs_are_served(tmp_path: Path) -> None:
    run = tmp_path / "walk" / "one"
    run.mkdir(parents=True)
    for name in ("signals.parquet", "run.toml", "report.html", "secret.txt"):
        (run / name).write_text(name)
    (tmp_path / "outside.txt").write_text("outside")

    async def questions(client):
        paths = ["walk/one/file/report.html", "walk/one/file/secret.txt", "walk/one/file/..%2F..%2F..%2Foutside.txt",
                 "..%2F..%2Fetc/file/report.html", "walk/two/track", "%2e%2e/one/track"]  # fmt: skip
        return [(await client.get(f"/api/runs/{path}")).status for path in paths]

    assert _ask(tmp_path, questions) == [200, 404, 404, 404, 404, 404]


COMMANDS = [
    ("no json", "not a command"),
    ("[]", "not a command"),
    ('{"command": "push", "name": "chest"}', "not a command"),
    ('{"command": "push", "name": "chest", "value": ["a"]}', "not a command"),
    ('{"command": "push", "name": "chest", "value": [NaN]}', "finite"),
    ('{"command": "push", "name": "chest", "value": [1e999]}', "finite"),
    ('{"command": "push", "name": "chest", "value": ' + str([0.0] * 99) + "}", "too long"),
    ('{"command": "walk", "name": "stop", "value": []}', "no live run"),
]


def test_what_is_no_command_is_refused_with_the_reason(tmp_path: Path) -> None:
    async def questions(client):
        answers = []
        async with client.ws_connect("/ws") as page:
            for text, _ in COMMANDS:
                await page.send_str(text)
                while (told := await page.receive_json())["kind"] != "answer":
                    pass
                answers.append(told)
        return answers

    for (text, reason), answer in zip(COMMANDS, _ask(tmp_path, questions)):
        assert answer["accepted"] is False and reason in answer["reason"], text
