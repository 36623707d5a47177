"""Who may use the page: this machine alone, or with --host whoever has the token."""

from __future__ import annotations

import hmac
import ipaddress
from collections.abc import Awaitable, Callable
from urllib.parse import urlsplit

from aiohttp import web

from hoap2.errors import UserError

COOKIE = "hoap2_monitor"
MIN_TOKEN = 12
# All that the page needs comes from this server.
POLICY = ("default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; "
          "frame-ancestors 'none'; base-uri 'none'; form-action 'none'")  # fmt: skip
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


def is_loopback(host: str) -> bool:
    """Whether only this machine reaches an address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


def check(host: str, token: str | None) -> None:
    """Raise UserError for an address that others reach, unless a token guards it."""
    if token is not None and len(token) < MIN_TOKEN:
        raise UserError(f"the token has {len(token)} characters", f"give it {MIN_TOKEN} or more")
    if not is_loopback(host) and token is None:
        raise UserError(f"--host {host} lets other machines see the run and push the robot",
                        "add --token TEXT, which they must give; or leave --host away: 127.0.0.1")  # fmt: skip


def middleware(token: str | None, local_only: bool):
    """Checks each request: the token if there is one, and that no foreign page sends it."""

    @web.middleware
    async def checked(request: web.Request, handler: Handler) -> web.StreamResponse:
        # A page from elsewhere can make a browser call this server; its Origin, or its Host name, tells.
        host = urlsplit("//" + (request.host or "")).hostname or ""
        if local_only and not is_loopback(host):
            raise web.HTTPForbidden(text=f"{host} is not this machine\n")
        origin = request.headers.get("Origin")
        if origin is not None and urlsplit(origin).netloc != request.host:
            raise web.HTTPForbidden(text="a page from elsewhere may not use this monitor\n")
        if token is not None:
            given = request.query.get("token")
            if given is not None and hmac.compare_digest(given.encode(), token.encode()):
                answer = web.HTTPSeeOther(request.path)
                answer.set_cookie(COOKIE, token, httponly=True, samesite="Strict")
                raise answer
            if not hmac.compare_digest(request.cookies.get(COOKIE, "").encode(), token.encode()):
                raise web.HTTPUnauthorized(text="this monitor asks for its token: open http://HOST:PORT/?token=TEXT\n")
        answer = await handler(request)
        if not answer.prepared:
            answer.headers["Content-Security-Policy"] = POLICY
            answer.headers["X-Content-Type-Options"] = "nosniff"
            answer.headers["Referrer-Policy"] = "no-referrer"
            answer.headers.setdefault("Cache-Control", "no-store")
        return answer

    return checked
