"""Sockets between the program and a process that it started."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import zmq

KEY = "RIGAPP_LINK_KEY"
LONGEST_ADDRESS = 100
"""Characters; systems take names of sockets of about 107 bytes."""


def link_address(folder: Path, name: str) -> str:
    """Return where to bind: a Unix socket, or a port of loopback where none can be."""
    address = f"ipc://{folder}/{name}"
    if sys.platform == "win32" or len(address) > LONGEST_ADDRESS:
        return "tcp://127.0.0.1:*"
    return address


def bind_link(socket: zmq.Socket[bytes], address: str) -> tuple[str, dict[str, str]]:
    """Bind a socket and return its endpoint and the environment for the process that connects.

    Every account of the computer reaches a port of loopback. There the link is encrypted (CurveZMQ)
    with a key that only this environment holds: without it no handshake succeeds. A command line
    would show it to other accounts.
    """
    environment = dict(os.environ)
    if address.startswith("tcp:"):
        public, secret = zmq.curve_keypair()
        socket.curve_publickey, socket.curve_secretkey = public, secret
        socket.curve_server = True
        environment[KEY] = public.decode()
    socket.bind(address)
    return socket.getsockopt_string(zmq.LAST_ENDPOINT), environment


def connect_link(socket: zmq.Socket[bytes], endpoint: str) -> None:
    """Connect the socket of a started process, with the key of its environment where it has one."""
    key = os.environ.pop(KEY, "")
    if key:
        socket.curve_publickey, socket.curve_secretkey = zmq.curve_keypair()
        socket.curve_serverkey = key.encode()
    socket.connect(endpoint)
