"""An engine that is served for real and whose snapshots are made by hand; a page in a thread."""

from __future__ import annotations

import json
import re
import socket
import ssl
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from http.client import HTTPConnection, HTTPSConnection
from pathlib import Path
from typing import Any

import msgspec
import psutil
from patience import PATIENCE_S
from snapshots import make_snapshot

from rigapp.page.serving import page_server
from rigapp.schema.messages import Reply, Request, Snapshot
from rigapp.service.registry import EngineEntry, announce, withdraw
from rigapp.service.server import Server

TOKEN = "q7Zp0x_Ww3vYb2Rk9LmN5tGhJ1sDfCaE"  # noqa: S105 - of these tests


def eventually(condition: Callable[[], object], what: str) -> None:
    """Wait until something is so."""
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, f"waited in vain for: {what}"
        time.sleep(0.02)


class ServedEngine:
    """A server of snapshots with a process of its own to be named by; counts what it is asked."""

    def __init__(self, rig: Path, /, **status: Any) -> None:
        self.requests: list[str] = []
        self.status = {"rig": rig.stem, "file": "", **status}
        self._process = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
        self.pid = self._process.pid
        self._whole = True
        self._server = Server(
            self._answer,
            self._snapshot,
            "tcp://127.0.0.1:*",
            "tcp://127.0.0.1:*",
            on_viewers=self._seen,
        )
        self._server.start()
        self.entry = EngineEntry(
            self.pid, self._server.commands, self._server.stream, str(rig.resolve()), time.time()
        )
        announce(self.entry)

    @property
    def viewers(self) -> int:
        """Return how many connections there are to the stream of snapshots."""
        port = int(self._server.stream.rpartition(":")[2])
        return sum(
            one.laddr.port == port and one.status == psutil.CONN_ESTABLISHED
            for one in psutil.Process().net_connections("tcp")
        )

    def say(self, **status: Any) -> None:
        """Change what the engine tells, and tell all of it."""
        self.status |= status
        self._whole = True

    def close(self) -> None:
        """End as a killed engine does: its entry goes with its process."""
        self._server.close()
        self._process.communicate()
        withdraw(self.pid)

    def _seen(self, watched: bool) -> None:
        self._whole = watched

    def _answer(self, request: Request) -> Reply:
        self.requests.append(request.verb)
        return Reply(ok=True)

    def _snapshot(self) -> Snapshot:
        whole, self._whole = self._whole, False
        one = make_snapshot(engine_pid=self.pid, **self.status)
        if whole:
            return one
        return msgspec.structs.replace(
            one, rows=b"", predictions=b"", cycle=None, prediction=None, first_row=0
        )


class OpenPage:
    """A page that is served in a thread of this process."""

    def __init__(self, rigs: Sequence[Path], bind: str = "127.0.0.1:0", *given: Path) -> None:
        self.server = page_server(rigs, bind, *given)
        self._certificate = given[1] if len(given) > 1 else None
        self.port = int(re.search(r":(\d+)/$", self.server.address)[1])  # type: ignore[index]
        self._thread = threading.Thread(target=self.server.serve_until_ended, name="page server")
        self._thread.start()
        eventually(lambda: self.server.started, "the page serves")

    def get(
        self, path: str, method: str = "GET", **headers: str
    ) -> tuple[int, dict[str, str], str]:
        """Ask for something; return status, headers and text."""
        if self._certificate is not None:
            trusting = ssl.create_default_context(cafile=self._certificate)
            line: HTTPConnection = HTTPSConnection(
                "127.0.0.1", self.port, timeout=PATIENCE_S, context=trusting
            )
        else:
            line = HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE_S)
        try:
            line.request(method, path, headers=headers)
            answer = line.getresponse()
            named = {name.lower(): value for name, value in answer.getheaders()}
            return answer.status, named, answer.read().decode()
        finally:
            line.close()

    def rigs(self) -> list[dict[str, Any]]:
        """Return what the page knows of its rigs."""
        return json.loads(self.get("/api/status")[2])["rigs"]  # type: ignore[no-any-return]

    def sees(self, condition: Callable[[list[dict[str, Any]]], object], what: str) -> None:
        """Wait until what is known of the rigs is so."""
        eventually(lambda: condition(self.rigs()), what)

    def shows(self, text: str) -> None:
        """Wait until the page holds a text."""
        eventually(lambda: text in self.get("/")[2], f"the page shows {text!r}")

    def open_events(self, receive_bytes: int = 0) -> socket.socket:
        """Open the stream of news as a browser does; receive_bytes: of the system's buffer."""
        line = socket.socket()
        if receive_bytes:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
        line.settimeout(PATIENCE_S)
        line.connect(("127.0.0.1", self.port))
        line.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        return line

    def close(self) -> None:
        """End the page."""
        self.server.should_exit = True
        self._thread.join(PATIENCE_S)
        assert not self._thread.is_alive(), "the page did not end"


def heard(line: socket.socket, word: bytes) -> bytes:
    """Read from a stream until a word comes; return what came."""
    got = b""
    while word not in got:
        more = line.recv(65536)
        assert more, f"the stream ended before {word!r}: {got[-200:]!r}"
        got += more
    return got
