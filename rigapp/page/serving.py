"""Serve the page: socket, server, the thread that watches the rigs, and their shutdown."""

from __future__ import annotations

import asyncio
import socket
from asyncio.sslproto import SSLProtocol
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any, cast

import h11
import uvicorn
from prometheus_client import CONTENT_TYPE_LATEST
from starlette.applications import Starlette
from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from rigapp.config.errors import UnusableInput
from rigapp.page import fragments
from rigapp.page.access import HEAD_BYTES, Access, Gate, access_to, reset
from rigapp.page.metrics import Metrics, PageNumbers
from rigapp.page.rig import engine_named, engines_here
from rigapp.page.watch import Rigs, Watch
from rigapp.schema.wire import json_bytes

# Newest frames for every page: one slot per fragment, the newest replaces older ones.
#
# The state of a page is only which version of each slot was sent. While it does not read, new
# frames replace unsent ones; so a page costs the same whether it reads or not.

MOST_SLOTS = 200
"""Three per rig, and as many rigs as a page holds, with a margin."""


class Hub:
    """The newest frames; used from the server's event loop alone."""

    def __init__(self) -> None:
        self._slots: dict[str, tuple[int, bytes]] = {}
        self._version = 0
        self._changed = asyncio.Event()
        self._closed = False
        self.readers = 0

    def publish(self, frames: Mapping[str, bytes]) -> None:
        """Store frames by the names of their slots; unchanged ones are ignored."""
        for name, frame in frames.items():
            known = self._slots.get(name)
            if known is None and len(self._slots) >= MOST_SLOTS:
                continue
            if known is not None and known[1] == frame:
                continue
            self._version += 1
            self._slots[name] = (self._version, frame)
        self._wake()

    def close(self) -> None:
        """End every page."""
        self._closed = True
        self._wake()

    async def frames(self) -> AsyncIterator[bytes]:
        """Yield what is new for one page, all of it at once, until the hub is closed."""
        seen = 0
        self.readers += 1
        try:
            while not self._closed:
                changed = self._changed
                fresh = sorted(slot for slot in self._slots.values() if slot[0] > seen)
                if fresh:
                    seen = fresh[-1][0]
                    yield b"".join(frame for _, frame in fresh)
                else:
                    await changed.wait()
        finally:
            self.readers -= 1

    def _wake(self) -> None:
        self._changed.set()
        self._changed = asyncio.Event()


# Connections of browsers are bounded in number, in time for a request, in time for an answer.
#
# uvicorn bounds the size of a request's head. Here a connection that sends no complete request in
# ``REQUEST_S`` is dropped, and one that does not read what it was sent within ``READ_S``: its page
# fetches the newest when it connects again.

REQUEST_S = 10.0  # a telephone at the edge of its network takes three
READ_S = 15.0  # a screen that was locked for a moment continues
LOOK_S = 1.0
SEND_BYTES = 1 << 17
"""Send buffer of the system for unread bytes: plots of two rigs."""


class BoundedConnection(H11Protocol):
    """A connection with bounded times."""

    def __init__(self, gate: Gate, **options: Any) -> None:
        super().__init__(**options)
        self._gate = gate
        self._look_again: asyncio.TimerHandle | None = None
        self.requested_at = self._taken_at = self.loop.time()

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin; where there are too many, the one that has been silent for longest ends."""
        super().connection_made(transport)
        line = transport.get_extra_info("socket")
        line.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BYTES)
        self._gate.greeted(line.fileno())
        self._look()
        if len(self.connections) > self._gate.most:
            # The newest is among them; a connection with a request stays.
            silent = [
                connection
                for connection in self.connections
                if isinstance(connection, BoundedConnection)
                and connection.cycle is None
                and not connection.transport.is_closing()
            ]
            min(silent, key=lambda connection: connection.requested_at).drop()

    def connection_lost(self, exc: Exception | None) -> None:
        """End."""
        if self._look_again is not None:
            self._look_again.cancel()
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        """Answer an unreadable request; in the middle of another answer only close."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            super().send_400_response(msg)
        else:
            self.transport.close()

    def _look(self) -> None:
        """Drop the connection when it takes too long to send a request, or to read the answer."""
        now = self.loop.time()
        if self.cycle is not None and not self.cycle.response_complete:
            self.requested_at = now
        if self.transport.get_write_buffer_size() == 0:
            self._taken_at = now
        if now - self.requested_at > REQUEST_S or now - self._taken_at > READ_S:
            self.drop()
        else:
            self._look_again = self.loop.call_later(LOOK_S, self._look)

    def drop(self) -> None:
        """End the connection."""
        self._gate.dropped += 1
        reset(self.transport.get_extra_info("socket"))
        self.transport.abort()


MOST_PAGES = 100
"""Maximum number of open pages; a laboratory has fewer screens, and other connections stay free
for metrics."""

ALWAYS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self';"
    " img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""Headers of every answer: nothing from other sites, nothing for them, nothing is cached."""

_KINDS = {"css": "text/css", "js": "text/javascript", "svg": "image/svg+xml"}


def site(watch: Watch, hub: Hub, metrics: Metrics, access: Access) -> ASGIApp:
    """Return the application: every request passes the rules of access first."""
    assets = _assets()

    async def page(request: Request) -> Response:
        return Response(watch.page(), media_type="text/html")

    async def status(request: Request) -> Response:
        return Response(json_bytes({"rigs": watch.views}), media_type="application/json")

    async def health(request: Request) -> Response:
        if watch.well:
            return PlainTextResponse("ok\n")
        return PlainTextResponse("The page does not look at the rigs any more.\n", 503)

    async def numbers(request: Request) -> Response:
        return Response(metrics.text(), headers={"Content-Type": CONTENT_TYPE_LATEST})

    async def asset(request: Request) -> Response:
        name = request.path_params["name"]
        if name not in assets:
            return PlainTextResponse("There is nothing here.\n", 404)
        return Response(assets[name], media_type=_KINDS[name.rpartition(".")[2]])

    async def events(request: Request) -> Response:
        if hub.readers >= MOST_PAGES:
            sentence = f"{MOST_PAGES} pages are open already.\n"
            return PlainTextResponse(sentence, 503, {"Retry-After": "10"})
        news = hub.frames() if request.method == "GET" else _nothing()
        return StreamingResponse(news, media_type="text/event-stream")

    return _Door(
        Starlette(
            routes=[
                Route("/", page),
                Route("/api/status", status),
                Route("/events", events),
                Route("/metrics", numbers),
                Route("/healthz", health),
                Route("/assets/{name}", asset),
            ]
        ),
        access,
    )


async def _nothing() -> AsyncIterator[bytes]:
    """Yield nothing: the answer to HEAD."""
    return
    yield


def _assets() -> dict[str, bytes]:
    """Return the files of the page by name; all of them come with this package."""
    folder = resources.files("rigapp.page") / "assets"
    result = {path.name: path.read_bytes() for path in folder.iterdir()}
    result["page.css"] = fragments.style(result["page.css"].decode()).encode()
    return {name: text for name, text in result.items() if name.rpartition(".")[2] in _KINDS}


class _Door:
    """Apply the rules of access, and add the headers to every answer."""

    def __init__(self, inner: ASGIApp, access: Access) -> None:
        self._inner = inner
        self._access = access

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        async def guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(ALWAYS)
            await send(message)

        refusal = self._access.refusal(scope)
        if refusal is None:
            await self._inner(scope, receive, guarded)
            return
        answer = PlainTextResponse(f"{refusal.sentence}\n", refusal.status, dict(refusal.headers))
        await answer(scope, receive, guarded)


KEEP_S = 5  # a connection without a further request stays open for so long
RECORD_BYTES = 1 << 14  # the longest of TLS; asyncio's own choice is 256 kB a connection
END_S = 3  # limit for answers under way when the page ends


class PageServer(uvicorn.Server):
    """A server of the page, which begins and ends with its watching thread."""

    def __init__(self, access: Access, rigs: Callable[[], Rigs]) -> None:
        """Listen at once; raise UnusableInput where the address is not available."""
        SSLProtocol.max_size = RECORD_BYTES
        self.failure = ""
        self._hub = Hub()
        self._watch = Watch(rigs, self._fail)
        metrics = Metrics(lambda: self._watch.views, self._numbers)
        self._socket = _listening(access)
        host, port = self._socket.getsockname()[:2]
        self.address = f"{access.scheme}://{f'[{host}]' if ':' in host else host}:{port}/"
        super().__init__(
            uvicorn.Config(
                site(self._watch, self._hub, metrics, access),
                http=cast(type[asyncio.Protocol], partial(BoundedConnection, self._socket)),
                loop="asyncio",  # whose accept the gate overrides
                ws="none",
                lifespan="off",
                log_config=None,
                log_level="error",
                access_log=False,
                proxy_headers=False,
                server_header=False,
                timeout_keep_alive=KEEP_S,
                timeout_graceful_shutdown=END_S,
                h11_max_incomplete_event_size=HEAD_BYTES,
                ssl_certfile=access.certificate,
                ssl_keyfile=access.key,
            )
        )

    def serve_until_ended(self) -> None:
        """Serve until a signal, or until ``should_exit`` is set."""
        self.run([self._socket])

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to serve and to watch."""
        await super().startup(sockets)
        loop = asyncio.get_running_loop()

        def publish(frames: Mapping[str, bytes]) -> None:
            loop.call_soon_threadsafe(self._hub.publish, frames)

        self._watch.start(publish)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop watching, end every page, then the server."""
        await asyncio.to_thread(self._watch.close)
        self._hub.close()
        await super().shutdown(sockets)

    def _fail(self, sentence: str) -> None:
        self.failure = sentence
        self.should_exit = True

    def _numbers(self) -> PageNumbers:
        connections = len(self.server_state.connections)
        return PageNumbers(self._hub.readers, connections, self._socket.dropped)


def page_server(
    rigs: Sequence[Path],
    bind: str,
    token: Path | None = None,
    certificate: Path | None = None,
    key: Path | None = None,
) -> PageServer:
    """Return a server that listens; raise UnusableInput.

    rigs: rig files, or entries of engines elsewhere; none: every engine of this computer.
    """
    access = access_to(bind, token, certificate, key)
    named = {str(rig): engine_named(rig) for rig in rigs}
    return PageServer(access, (lambda: named) if named else engines_here)


def _listening(access: Access) -> Gate:
    family = socket.AF_INET6 if ":" in access.address else socket.AF_INET
    try:
        return Gate(socket.create_server((access.address, access.port), family=family, backlog=64))
    except OSError as error:
        raise UnusableInput(
            f"The page cannot listen at {access.address}:{access.port} ‹{error}›; choose another"
            " address or port by --bind."
        ) from error
