"""The addresses of an engine and access to them: by Unix sockets freely, to ports by key.

Every account of a computer reaches its ports, those of loopback too. So each viewer of a port needs
a CurveZMQ key pair whose public half lies in the engine's folder of authorised viewers; the
viewers of the engine's own user are authorised by the engine itself.

Keys lie in ``keys`` in the lasting folder (see ``registry``): ``server.key_secret``,
``viewer.key_secret`` (both readable by their owner alone) and ``authorised/*.key``. A key that is
put into or taken out of that folder counts at once for viewers that attach from then on.
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
    """The address where an engine listens; port 0 lets the system choose.

    remote: viewers on other computers are expected.
    """

    address: str
    port: int
    remote: bool

    def endpoints(self) -> tuple[str, str]:
        """Return the addresses for commands and snapshots: a port and the next one."""
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

    A wildcard is refused: viewers could not take the address from the entry, and it would open
    unintended interfaces.
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
    """Return the address of one interface by its number, or "localhost"; raise UnusableInput.

    option: its name, for the sentence.
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
    """Return the engine's key pair, made when missing; raise UnusableInput when it is not private.

    folder: the lasting one.
    """
    return _keys(folder, "server")


def viewer_keys(folder: Path) -> KeyPair:
    """Return this user's key pair as a viewer, made when missing; raise UnusableInput."""
    return _keys(folder, "viewer")


def authorised_folder(folder: Path) -> Path:
    """Return the folder of the public keys that may attach, made when missing."""
    return private_folder(private_folder(folder / "keys") / "authorised")


def authorise_own_viewer(folder: Path) -> None:
    """Let viewers of this user on this computer attach; they could read the server's key anyway."""
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
    """Let only authorised viewers attach to the sockets of one context (ZAP, CurveZMQ)."""

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
        """Make a socket that is not bound yet require an authorised key."""
        socket.curve_publickey = self._keys.public
        socket.curve_secretkey = self._keys.secret
        socket.curve_server = True
        socket.zap_domain = DOMAIN.encode()
        # Without this, a socket whose authenticator has died would accept every viewer.
        socket.setsockopt(zmq.ZAP_ENFORCE_DOMAIN, 1)

    def callback(self, domain: str, key: bytes) -> bool:
        """Return whether a viewer's public key is authorised (called by the authenticator)."""
        return key in _public_keys(self._authorised)

    def close(self) -> None:
        """Stop the authenticator: no viewer is accepted any more."""
        self._authenticator.stop()


def present_keys(socket: Socket, server_key: str, keys: KeyPair) -> None:
    """Make a viewer's socket that is not connected yet send its key and require the server's."""
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
    """Make a key pair; the secret is private from its first byte on."""
    before = os.umask(0o077)
    try:
        zmq.auth.create_certificates(folder, name)
    finally:
        os.umask(before)
