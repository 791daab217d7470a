"""A real mail server and a real HTTP receiver on loopback, that can be down, refuse and hang."""

from __future__ import annotations

import json
import socket
import threading
import time
from collections.abc import Callable
from email import message_from_bytes
from email.policy import default as email_policy
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from aiosmtpd.controller import Controller
from patience import PATIENCE_S


def until(condition: Callable[[], Any], what: str) -> None:
    """Wait for a condition."""
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, f"not within {PATIENCE_S:g} s: {what}"
        time.sleep(0.02)


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


class MailServer:
    """An SMTP server that can be taken down and brought back on the same port."""

    def __init__(self) -> None:
        self.port = free_port()
        self.subjects: list[str] = []
        self.bodies: list[str] = []
        self.refuses = False
        self._controller: Controller | None = None

    async def handle_DATA(self, server: Any, session: Any, envelope: Any) -> str:
        if self.refuses:
            return "451 4.3.2 Try again later"
        mail = message_from_bytes(envelope.content, policy=email_policy)
        self.subjects.append(str(mail["Subject"]))
        part = mail.get_body(("plain",))
        self.bodies.append(part.get_content() if part is not None else "")
        return "250 OK"

    def up(self) -> None:
        self._controller = Controller(self, hostname="127.0.0.1", port=self.port)
        self._controller.start()

    def down(self) -> None:
        if self._controller is not None:
            self._controller.stop()
            self._controller = None

    @property
    def url(self) -> str:
        return f"mailto://127.0.0.1:{self.port}?from=rig@example.org&to=ada@example.org"


class Receiver:
    """An HTTP server that keeps what is posted; answer: how it answers, ``hang`` for not at all."""

    def __init__(self) -> None:
        self.answer: int | str = 200
        self.heads: list[str] = []
        self.bodies: list[dict[str, Any]] = []
        self.pings: list[float] = []
        self.tries = 0
        self._let_go = threading.Event()
        receiver = self

        class Handler(BaseHTTPRequestHandler):
            def _respond(self) -> None:
                receiver.tries += 1
                if receiver.answer == "hang":
                    receiver._let_go.wait(PATIENCE_S)
                    return
                assert isinstance(receiver.answer, int)
                if self.command == "POST":
                    body = self.rfile.read(int(self.headers["Content-Length"]))
                    if receiver.answer == 200:
                        receiver.heads.append(f"{self.path} {self.headers}")
                        receiver.bodies.append(json.loads(body))
                elif receiver.answer == 200:
                    receiver.heads.append(f"{self.path} {self.headers}")
                    receiver.pings.append(time.monotonic())
                self.send_response(receiver.answer)
                self.send_header("Content-Length", "0")
                self.end_headers()

            do_GET = do_POST = _respond

            def log_message(self, *_: Any) -> None:
                pass

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._server.daemon_threads = True
        self.port = self._server.server_port
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    @property
    def titles(self) -> list[str]:
        return [str(body["title"]) for body in self.bodies]

    def close(self) -> None:
        self._let_go.set()
        self._server.shutdown()
        self._server.server_close()
