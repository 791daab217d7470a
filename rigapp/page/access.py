"""Rules of access to the page: loopback is free, others need a token over TLS.

Requests are refused here, before any other code of the page.
"""

from __future__ import annotations

import errno
import gc
import hmac
import os
import re
import socket
import ssl
import struct
import sys
from base64 import b64decode
from binascii import Error as NotBase64
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.process.private import read_secret
from rigapp.service.security import interface_address

MOST_HEADERS = 64
"""A browser sends about twenty."""
HEAD_BYTES = 16384
"""Of a request's head, a usual limit of browsers and servers."""
LONGEST_TARGET = 1024
"""Bytes of path and query: the page's own are shorter than thirty."""
SHORTEST_TOKEN = 24
"""Characters: 64 random ones give four bits each; 2^96 cannot be searched."""
METHODS = ("GET", "HEAD")

_LOOPBACK_HOST = re.compile(rb"(?i:localhost|127(?:\.\d{1,3}){3}|\[::1\])(?::\d{1,5})?")


@dataclass(frozen=True, slots=True)
class Refusal:
    """The answer to a refused request."""

    status: int
    sentence: str
    headers: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Access:
    """Where the page listens and the rules of access. token: empty where none is required."""

    address: str
    port: int
    loopback: bool
    token: bytes = b""
    certificate: Path | None = None
    key: Path | None = None

    @property
    def scheme(self) -> str:
        """Return the first part of the page's address."""
        return "https" if self.certificate is not None else "http"

    def refusal(self, scope: Mapping[str, Any]) -> Refusal | None:
        """Return the refusal of a request (an ASGI scope), None if it is allowed."""
        headers: list[tuple[bytes, bytes]] = scope["headers"]
        if len(headers) > MOST_HEADERS or sum(map(len, sum(headers, ()))) > HEAD_BYTES:
            return _refused(
                431, f"A request has at most {MOST_HEADERS} headers and {HEAD_BYTES} bytes of them."
            )
        if len(scope["raw_path"]) + len(scope["query_string"]) > LONGEST_TARGET:
            return _refused(414, f"An address has at most {LONGEST_TARGET} characters.")
        if scope["method"] not in METHODS:
            return _refused(405, "This page only shows.", Allow=", ".join(METHODS))
        named = dict(headers)
        if named.get(b"content-length", b"0").strip(b"0") or b"transfer-encoding" in named:
            return _refused(413, "This page takes nothing in.")
        # A foreign page whose name resolves to this computer (DNS rebinding) must not read it.
        if self.loopback and not _LOOPBACK_HOST.fullmatch(named.get(b"host", b"localhost")):
            return _refused(421, "Ask this page by localhost or 127.0.0.1.")
        if self.token and not self._has_token(named.get(b"authorization", b"")):
            challenge = 'Basic realm="rigapp", charset="UTF-8"'
            return _refused(
                401, "Give the token as the password.", **{"WWW-Authenticate": challenge}
            )
        return None

    def _has_token(self, header: bytes) -> bool:
        """Return whether an Authorization header carries the token, as bearer or as password."""
        kind, _, secret = header.partition(b" ")
        if kind.lower() == b"basic":
            try:
                secret = b64decode(secret, validate=True).partition(b":")[2]
            except NotBase64:
                return False
        elif kind.lower() != b"bearer":
            return False
        return hmac.compare_digest(secret, self.token)


def access_to(bind: str, token: Path | None, certificate: Path | None, key: Path | None) -> Access:
    """Return the rules of a page; raise UnusableInput if it would be open to others.

    bind: ADDRESS:PORT, port 0 lets the system choose. token: file of mode 0600. certificate, key:
    PEM files; the key is private, too.
    """
    result = re.fullmatch(r"(?:\[([^\]]+)\]|([^:/]+)):(\d{1,5})", bind)
    if result is None or int(result[3]) > 65535:
        raise UnusableInput(f"--bind {bind}: give ADDRESS:PORT, for example 127.0.0.1:8750.")
    address = interface_address(f"--bind {bind}", result[1] or result[2])
    if (certificate is None) != (key is None):
        raise UnusableInput("--certificate and --key belong together; give both.")
    if not address.is_loopback and (token is None or certificate is None):
        raise UnusableInput(
            f"--bind {bind}: beyond this computer the page is shown only with a token and over TLS;"
            " give --token, --certificate and --key."
        )
    if certificate is not None and key is not None:
        _check_pair(certificate, key)
    secret = _token(token) if token is not None else b""
    return Access(str(address), int(result[3]), address.is_loopback, secret, certificate, key)


def _token(path: Path) -> bytes:
    """Return the token of a file; raise UnusableInput."""
    token = read_secret(path).strip()
    if len(token) < SHORTEST_TOKEN or not re.fullmatch(rb"[\x21-\x7e]+", token):
        raise UnusableInput(
            f"{path}: a token is one line of at least {SHORTEST_TOKEN} letters and digits; make one"
            " by: python3 -c 'import secrets; print(secrets.token_urlsafe())'."
        )
    return token


def _check_pair(certificate: Path, key: Path) -> None:
    """Raise UnusableInput unless a certificate and its private key are usable."""
    read_secret(key)
    try:
        ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(certificate, key, _no_password)
    except (OSError, ValueError) as error:
        raise UnusableInput(
            f"{certificate}, {key}: cannot be used as certificate and key ‹{error}›."
        ) from error


def _no_password() -> str:
    raise ValueError("the key has a password; give one without, readable by you alone")


def _refused(status: int, sentence: str, **headers: str) -> Refusal:
    return Refusal(status, sentence, {**headers, "Connection": "close"})


# Accept connections within bounds that include the handshake.
#
# The server counts a connection when its protocol begins, which over TLS is after the handshake.
# Silent connections would take one descriptor after the other until none is left, not even for the
# engines. Here the oldest one in its handshake is dropped for the newest: a real handshake is done
# within a moment, however many wait.

MOST_CONNECTIONS = 128
"""Maximum number of connections, each at most SEND_BYTES twice; the system allows 1024 open
files."""
MOST_GREETING = 64
"""In the handshake, each for some 50 ms: as many telephones may return after a power cut."""
ENDS_HELD = 64
"""Ended connections between garbage collections. A failed handshake leaves a cycle of some 70 kB,
in a hundred small objects: Python's own collections come after thousands."""
SHARE = 4
"""Divisor of the system's limit of open files: one part is for connections, the others for
engines."""


def reset(line: Any) -> None:
    """End a connection at once; else the system stores unread bytes for minutes."""
    line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))


class Gate(socket.socket):
    """A listening socket with bounds; ``dropped`` counts the connections it ended."""

    def __init__(self, listening: socket.socket) -> None:
        """Take over a listening socket."""
        super().__init__(listening.family, listening.type, fileno=listening.detach())
        self.dropped = 0
        allowed = _allowed_files()
        self.most = min(MOST_CONNECTIONS, allowed // SHARE)
        self._most_greeting = min(MOST_GREETING, allowed // (2 * SHARE))
        self._greeting: dict[int, Guest] = {}
        self._ends = self._in_a_row = 0
        self._spare = os.open(os.devnull, os.O_RDONLY)

    def accept(self) -> tuple[socket.socket, Any]:
        """Return the next connection; raise ConnectionAbortedError at the limit.

        After some, raise BlockingIOError as if there were no more: asyncio would accept all waiting
        ones, two thousand, before it handles the first.
        """
        self._in_a_row += 1
        if self._in_a_row > self._most_greeting:
            self._in_a_row = 0
            raise BlockingIOError
        try:
            descriptor, peer = self._accept()  # type: ignore[attr-defined]
        except OSError as error:
            if error.errno in (errno.EMFILE, errno.ENFILE):
                self._reject_next()
                raise ConnectionAbortedError from error
            raise
        guest = Guest(self, descriptor)
        self._greeting[descriptor] = guest
        if len(self._greeting) > self._most_greeting:
            self.dropped += 1
            oldest = next(iter(self._greeting.values()))
            del self._greeting[oldest.fileno()]
            oldest.let_go()
        return guest, peer

    def greeted(self, descriptor: int) -> None:
        """Register that the protocol of a connection has begun, which has its own limits."""
        self._greeting.pop(descriptor, None)

    def gone(self, guest: Guest) -> None:
        """Register that a connection is closed."""
        if self._greeting.get(guest.fileno()) is guest:
            del self._greeting[guest.fileno()]
        self._ends += 1
        if self._ends >= ENDS_HELD:
            self._ends = self._in_a_row = 0
            gc.collect()

    def close(self) -> None:
        """Accept no more."""
        if self._spare >= 0:
            os.close(self._spare)
            self._spare = -1
        super().close()

    def _reject_next(self) -> None:
        """Accept a connection with the spare descriptor and close it; else it would wait."""
        self.dropped += 1
        os.close(self._spare)
        try:
            descriptor, _ = self._accept()  # type: ignore[attr-defined]
            os.close(descriptor)
        except OSError:
            pass
        finally:
            self._spare = os.open(os.devnull, os.O_RDONLY)


class Guest(socket.socket):
    """An accepted connection that reports its end to the gate."""

    def __init__(self, gate: Gate, descriptor: int) -> None:
        super().__init__(gate.family, gate.type, gate.proto, fileno=descriptor)
        self._gate = gate

    def close(self) -> None:
        """Close, and report the end to the gate."""
        self._gate.gone(self)
        super().close()

    def let_go(self) -> None:
        """End a connection while the server reads from it, which then closes it."""
        reset(self)
        self.shutdown(socket.SHUT_RDWR)


def _allowed_files() -> int:
    """Return how many files the system lets this process open."""
    if sys.platform == "win32":
        return 8192
    import resource

    return resource.getrlimit(resource.RLIMIT_NOFILE)[0]
