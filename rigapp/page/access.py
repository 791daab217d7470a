"""Who may ask the page, and how much: loopback freely, others with a token over TLS.

What is refused is refused here, before anything else of the page hears of it.
"""

from __future__ import annotations

import hmac
import re
import ssl
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
"""Of a request's head, as browsers and servers are used to."""
LONGEST_TARGET = 1024
"""Bytes of path and query: the page's own are shorter than thirty."""
SHORTEST_TOKEN = 24
"""Characters: 64 random ones give four bits each; nobody tries 2^96 of them."""
METHODS = ("GET", "HEAD")

_LOOPBACK_HOST = re.compile(rb"(?i:localhost|127(?:\.\d{1,3}){3}|\[::1\])(?::\d{1,5})?")


@dataclass(frozen=True, slots=True)
class Refusal:
    """An answer that is no."""

    status: int
    sentence: str
    headers: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Access:
    """Where the page listens and who may ask. token: empty where none is asked for."""

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
        """Return why a request (an ASGI scope) is refused, None where it is not."""
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
        # A page of elsewhere whose name was made to mean this computer must not read this one.
        if self.loopback and not _LOOPBACK_HOST.fullmatch(named.get(b"host", b"localhost")):
            return _refused(421, "Ask this page by localhost or 127.0.0.1.")
        if self.token and not self._knows(named.get(b"authorization", b"")):
            challenge = 'Basic realm="rigapp", charset="UTF-8"'
            return _refused(
                401, "Give the token as the password.", **{"WWW-Authenticate": challenge}
            )
        return None

    def _knows(self, shown: bytes) -> bool:
        """Tell whether an Authorization header carries the token, as bearer or as password."""
        kind, _, secret = shown.partition(b" ")
        if kind.lower() == b"basic":
            try:
                secret = b64decode(secret, validate=True).partition(b":")[2]
            except NotBase64:
                return False
        elif kind.lower() != b"bearer":
            return False
        return hmac.compare_digest(secret, self.token)


def access_to(bind: str, token: Path | None, certificate: Path | None, key: Path | None) -> Access:
    """Return the rules of a page; raise UnusableInput for one that would be open to others.

    bind: ADDRESS:PORT, port 0 lets the system choose. token: file of mode 0600. certificate, key:
    PEM files; the key is private, too.
    """
    found = re.fullmatch(r"(?:\[([^\]]+)\]|([^:/]+)):(\d{1,5})", bind)
    if found is None or int(found[3]) > 65535:
        raise UnusableInput(f"--bind {bind}: give ADDRESS:PORT, for example 127.0.0.1:8750.")
    address = interface_address(f"--bind {bind}", found[1] or found[2])
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
    return Access(str(address), int(found[3]), address.is_loopback, secret, certificate, key)


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
    """Raise UnusableInput unless a certificate and its private key can be used."""
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
