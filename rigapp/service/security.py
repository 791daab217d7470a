"""Addresses of an engine and access to them: Unix sockets without keys, ports with keys.

Every account of a computer can reach its ports, loopback included. Each viewer of a port therefore
needs a CurveZMQ key pair whose public key is in the engine's folder of authorised viewers; viewers
of the engine's own user are authorised by the engine.

Keys are in ``keys`` in the lasting folder (see ``registry``): ``server.key_secret``,
``viewer.key_secret`` (both readable by their owner only) and ``authorised/*.key``. Adding or
removing a key there takes effect immediately for viewers that attach afterwards.
"""

from __future__ import annotations

import ipaddress
import os
import re
from pathlib import Path
from typing import Any

import msgspec
import zmq
import zmq.auth
from zmq.auth.thread import ThreadAuthenticator

from rigapp.config.errors import UnusableInput
from rigapp.process.private import open_to_others, private_folder

DOMAIN = "rigapp"
OWN = "this-computer.key"

Address = ipaddress.IPv4Address | ipaddress.IPv6Address
Context = zmq.Context[Any]
Socket = zmq.Socket[Any]


class Bind(msgspec.Struct, frozen=True):
    """Address on which an engine listens; port 0: chosen by the system.

    remote: whether viewers on other computers are expected.
    """

    address: str
    port: int
    remote: bool

    def endpoints(self) -> tuple[str, str]:
        """Return the addresses for commands and snapshots: the port and the next one."""
        host = f"[{self.address}]" if ":" in self.address else self.address
        if self.port == 0:
            return f"tcp://{host}:*", f"tcp://{host}:*"
        return f"tcp://{host}:{self.port}", f"tcp://{host}:{self.port + 1}"


class KeyPair(msgspec.Struct, frozen=True):
    """A CurveZMQ key pair, Z85."""

    public: bytes
    secret: bytes


def parse_bind(text: str) -> Bind:
    """Return the address of ``--bind tcp://ADDRESS:PORT``; raise UnusableInput.

    A wildcard is refused: viewers could not use it as an address, and it would open unintended
    interfaces.
    """
    parts = re.fullmatch(r"tcp://(?:\[([^\]]+)\]|([^:/]+)):(\d{1,5})", text)
    if parts is None:
        raise UnusableInput("--bind {}: give tcp://ADDRESS:PORT.", text)
    address, port = interface_address(f"--bind {text}", parts[1] or parts[2]), int(parts[3])
    if port > 65534:
        raise UnusableInput(
            "--bind {}: the port and the next one are used; give at most 65534.", text
        )
    return Bind(str(address), port, remote=not address.is_loopback)


def interface_address(option: str, name: str) -> Address:
    """Return the numeric address of an interface, or "localhost"; raises UnusableInput.

    option: name of the option, for the sentence.
    """
    try:
        address = ipaddress.ip_address("127.0.0.1" if name == "localhost" else name)
    except ValueError as error:
        raise UnusableInput(
            "{}: {} is not an IP address; give the number of one interface.", option, name
        ) from error
    if address.is_unspecified:
        raise UnusableInput("{}: name the address of one interface, not all of them.", option)
    return address


def server_keys(folder: Path) -> KeyPair:
    """Return the engine's key pair, created if missing; raises UnusableInput if it is not private.

    folder: the lasting folder.
    """
    return _keys(folder, "server")


def viewer_keys(folder: Path) -> KeyPair:
    """Return this user's key pair as a viewer, created if missing; raises UnusableInput."""
    return _keys(folder, "viewer")


def authorised_folder(folder: Path) -> Path:
    """Return the folder of authorised public keys, created if missing."""
    return private_folder(private_folder(folder / "keys") / "authorised")


def authorise_own_viewer(folder: Path) -> None:
    """Authorise viewers of this user on this computer, who can read the server's key anyway."""
    path = authorised_folder(folder) / OWN
    viewer_keys(folder)
    path.write_bytes((folder / "keys" / "viewer.key").read_bytes())


def require_viewers(folder: Path, bind: Bind) -> None:
    """Raise UnusableInput unless a viewer of another computer is authorised."""
    authorised = authorised_folder(folder)
    server_keys(folder)
    if any(path.name != OWN for path in authorised.glob("*.key")):
        return
    raise UnusableInput(
        "--bind {}: beyond this computer only authorised viewers may attach, and there"
        " is none; put the public key of each (its keys/viewer.key) into {}.",
        bind.address,
        authorised,
    )


class KeyCheck:
    """Restrict the sockets of one context to authorised viewers (ZAP, CurveZMQ)."""

    def __init__(self, context: Context, folder: Path) -> None:
        """Start the authenticator; must come before the sockets are bound."""
        self._authorised = authorised_folder(folder)
        self._keys = server_keys(folder)
        self._authenticator = ThreadAuthenticator(context)
        self._authenticator.start()
        self._authenticator.configure_curve_callback(DOMAIN, self)

    @property
    def public_key(self) -> str:
        """Return the server's public key, which viewers need."""
        return self._keys.public.decode()

    def protect(self, socket: Socket) -> None:
        """Make a socket require an authorised key; to be called before it is bound."""
        socket.curve_publickey = self._keys.public
        socket.curve_secretkey = self._keys.secret
        socket.curve_server = True
        socket.zap_domain = DOMAIN.encode()
        # Otherwise a socket whose authenticator has failed would accept every viewer.
        socket.setsockopt(zmq.ZAP_ENFORCE_DOMAIN, 1)

    def callback(self, domain: str, key: bytes) -> bool:
        """Return whether a viewer's public key is authorised (called by the authenticator)."""
        return key in _public_keys(self._authorised)

    def close(self) -> None:
        """Stop the authenticator: no further viewer is accepted."""
        self._authenticator.stop()


def present_keys(socket: Socket, server_key: str, keys: KeyPair) -> None:
    """Set a viewer's keys and the required server key on a socket, before it connects."""
    socket.curve_publickey = keys.public
    socket.curve_secretkey = keys.secret
    socket.curve_serverkey = server_key.encode()


def _public_keys(folder: Path) -> set[bytes]:
    """Return the public keys of a folder; other files are ignored."""
    result = set()
    for path in folder.glob("*.key"):
        try:
            result.add(zmq.auth.load_certificate(path)[0])
        except (OSError, ValueError):
            continue
    return result


def _keys(folder: Path, name: str) -> KeyPair:
    keys = private_folder(folder / "keys")
    path = keys / f"{name}.key_secret"
    if not path.exists():
        _make(keys, name)
    if open_to_others(path.stat()):
        raise UnusableInput(
            "{}: others can read this secret key; delete it, or chmod 600 it.", path
        )
    try:
        public, secret = zmq.auth.load_certificate(path)
    except (OSError, ValueError) as error:
        raise UnusableInput("{}: is no key pair ‹{}›; delete it.", path, error) from error
    if secret is None:
        raise UnusableInput("{}: holds no secret key; delete it.", path)
    return KeyPair(public, secret)


def _make(folder: Path, name: str) -> None:
    """Create a key pair; the secret file is private before its first byte."""
    before = os.umask(0o077)
    try:
        zmq.auth.create_certificates(folder, name)
    finally:
        os.umask(before)
