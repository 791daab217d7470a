"""Serve the page: the socket, the server, the thread that looks at the rigs, and their end."""

from __future__ import annotations

import asyncio
import socket
from asyncio.sslproto import SSLProtocol
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import cast

import uvicorn

from rigapp.config.errors import UnusableInput
from rigapp.page.access import HEAD_BYTES, Access, access_to
from rigapp.page.connections import BoundedConnection
from rigapp.page.gate import Gate
from rigapp.page.hub import Hub
from rigapp.page.metrics import Metrics, PageNumbers
from rigapp.page.rig import engine_named, engines_here
from rigapp.page.site import site
from rigapp.page.watch import Rigs, Watch

KEEP_S = 5  # so long stays a connection open that asks nothing more
RECORD_BYTES = 1 << 14  # the longest of TLS; asyncio's own choice is 256 kB a connection
END_S = 3  # so long may answers under way take when the page ends


class PageServer(uvicorn.Server):
    """A server of the page, which begins and ends with its watching thread."""

    def __init__(self, access: Access, rigs: Callable[[], Rigs]) -> None:
        """Listen at once; raise UnusableInput where the address cannot be had."""
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

    def serve_until_asked(self) -> None:
        """Serve until a signal, or ``should_exit``, asks for the end."""
        self.run([self._socket])

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Begin to serve and to look."""
        await super().startup(sockets)
        loop = asyncio.get_running_loop()

        def publish(frames: Mapping[str, bytes]) -> None:
            loop.call_soon_threadsafe(self._hub.publish, frames)

        self._watch.start(publish)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Look no more, let every page end, then the server."""
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
