"""What the page answers: itself, its numbers, its news, its metrics, and no to all else."""

from __future__ import annotations

from collections.abc import AsyncIterator
from importlib import resources

from prometheus_client import CONTENT_TYPE_LATEST
from starlette.applications import Starlette
from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from rigapp.page import fragments
from rigapp.page.access import Access
from rigapp.page.hub import Hub
from rigapp.page.metrics import Metrics
from rigapp.page.watch import Watch
from rigapp.schema.wire import json_bytes

MOST_PAGES = 100
"""Open pages; a laboratory has fewer screens, and the connections that are left ask for numbers."""

ALWAYS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self';"
    " img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""Headers of every answer: nothing from elsewhere, nothing for others, nothing is kept."""

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
    found = {one.name: one.read_bytes() for one in folder.iterdir()}
    found["page.css"] = fragments.style(found["page.css"].decode()).encode()
    return {name: text for name, text in found.items() if name.rpartition(".")[2] in _KINDS}


class _Door:
    """Refuse what the rules of access refuse, and give every answer its headers."""

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
