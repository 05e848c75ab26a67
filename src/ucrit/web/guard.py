"""Who may ask: requests to this machine's own name, from this server's own page, of bounded size.

A server on the loopback address is within reach of every page that the visitor has open. A page elsewhere may point
its own name at this address (DNS rebinding), which the Host header tells, or post to it, which Origin tells.
"""

from __future__ import annotations

import ipaddress
import json
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

MAX_BODY = 256 * 1024
"""Bytes of a request's body; the largest vehicle file that is shipped has 4 kB."""

HEADERS = {
    b"content-security-policy": b"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    b"connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    b"x-content-type-options": b"nosniff",
    b"referrer-policy": b"no-referrer",
    b"cross-origin-resource-policy": b"same-origin",
    b"cross-origin-opener-policy": b"same-origin",
    b"cache-control": b"no-store",
}


class TooLargeError(Exception):
    """A body that goes on after `MAX_BODY` bytes."""


class Guard:
    """Refuse what does not come from the page, and send the headers that keep the page to itself.

    Parameters
    ----------
    app
        What answers the requests that are let through.
    host
        Name or address that is served; names other than this one and the loopback's are refused.
    """

    def __init__(self, app: App, host: str) -> None:
        self.app, self.host = app, host.lower()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] == "lifespan":
            return await self.app(scope, receive, send)
        if scope["type"] != "http":
            return await send({"type": "websocket.close", "code": 1008})
        headers = {name.lower(): value.decode("latin-1") for name, value in scope["headers"]}
        refusal = self.refusal(headers)
        if refusal:
            return await _refuse(_with_headers(send), *refusal)
        return await self.app(scope, _bounded(receive), _with_headers(send))

    def refusal(self, headers: dict[bytes, str]) -> tuple[int, str] | None:
        """Return status and sentence for a request that is turned away."""
        host = headers.get(b"host", "")
        if not self._is_own(host):
            return 421, f"this server does not answer to the name '{host[:100]}'"
        origin = headers.get(b"origin")
        if origin is not None and origin.lower() != f"http://{host.lower()}":
            return 403, "requests of pages from elsewhere are refused"
        length = headers.get(b"content-length", "0")
        if not length.isdecimal() or len(length) > 12 or int(length) > MAX_BODY:
            return 413, f"a request may have {MAX_BODY // 1024} kB, not more"
        return None

    def _is_own(self, host: str) -> bool:
        """Tell whether a Host header names this server: an address cannot be pointed elsewhere, a name can."""
        name = host.lower()
        name = name[1 : name.find("]")] if name.startswith("[") else name.partition(":")[0]
        if name in ("localhost", self.host):
            return bool(name)
        try:
            address = ipaddress.ip_address(name)
        except ValueError:
            return False
        return address.is_loopback or not is_loopback(self.host)


def is_loopback(host: str) -> bool:
    """Tell whether a name or address is this machine's own, out of reach of others.

    >>> is_loopback("127.0.0.1"), is_loopback("localhost"), is_loopback("0.0.0.0")
    (True, True, False)
    """
    if host.lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def _bounded(receive: Receive) -> Receive:
    """Count the body while it comes in: a length need not be announced, and need not be true."""
    seen = 0

    async def counted() -> Message:
        nonlocal seen
        message = await receive()
        seen += len(message.get("body", b""))
        if seen > MAX_BODY:
            raise TooLargeError
        return message

    return counted


def _with_headers(send: Send) -> Send:
    async def wrapped(message: Message) -> None:
        if message["type"] == "http.response.start":
            own = [(name, value) for name, value in message.get("headers", []) if name.lower() not in HEADERS]
            message = {**message, "headers": [*own, *HEADERS.items()]}
        await send(message)

    return wrapped


async def _refuse(send: Send, status: int, sentence: str) -> None:
    body = json.dumps({"error": sentence}).encode()
    headers = [(b"content-type", b"application/json"), (b"content-length", str(len(body)).encode())]
    await send({"type": "http.response.start", "status": status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
