"""Child processes of the program: start, messages, restarts, error output, end.

The program holds a ``Child``, or a ``MessageChild`` if both exchange MessagePack records; the
started process holds its ``Parent``. A child's standard error is kept for the message that reports
its failure.
"""

from __future__ import annotations

import itertools
import os
import select
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO, TypeVar

import zmq

from rigapp.process.ending import Background
from rigapp.schema.wire import decode, encode

Record = TypeVar("Record")

KEY = "RIGAPP_LINK_KEY"
LONGEST_ADDRESS = 100
"""Characters; systems limit names of sockets to about 107 bytes."""
LONGEST_MESSAGE = 64 * 2**20
"""Bytes; a revolution or a checkpoint has less than one MiB. ZeroMQ drops longer messages, and a
damaged length in a frame must not make the program allocate gigabytes."""
SEND_MS = 1000
LAST_WORDS = 4096
"""Bytes of standard error that are searched for the reason of a failure."""
LONGEST_PAUSE_S = 60.0
_HEAD = 4
_READ_SIZE = 65536
_POLL_S = 0.1
"""Maximum delay until a waiting program notices that its child has ended."""
_numbers = itertools.count()


def module_command(module: str, *arguments: object) -> list[str]:
    """Return the command line that runs a module of the program.

    ``-P`` removes the working folder from the import path: a user's ``signal.py`` or ``model.py``
    there would be imported instead of Python's or the program's module.
    """
    return [sys.executable, "-P", "-m", module, *map(str, arguments)]


class Child:
    """A module of the program that runs as a separate process."""

    def __init__(
        self,
        module: str,
        *arguments: object,
        pipes: bool = False,
        log: Path | None = None,
        environment: dict[str, str] | None = None,
        folder: Path | None = None,
    ) -> None:
        """Start the module.

        In a new session: Ctrl-C at the terminal goes to the parent only, which controls the child.
        pipes: with ``stdin`` and ``stdout`` for the program. log: file for standard output and
        error. environment, folder (to work in): instead of the program's.
        """
        self._log: IO[bytes] = (
            tempfile.TemporaryFile() if log is None else log.open("w+b")  # noqa: SIM115
        )
        output = self._log if log is not None else subprocess.DEVNULL
        self._process = subprocess.Popen(
            module_command(module, *arguments),
            stdin=subprocess.PIPE if pipes else subprocess.DEVNULL,
            stdout=subprocess.PIPE if pipes else output,
            stderr=self._log,
            env=environment,
            cwd=folder,
            start_new_session=True,
        )

    @property
    def pid(self) -> int:
        """Return the process id."""
        return self._process.pid

    @property
    def status(self) -> int | None:
        """Return the exit status, None while the process is running."""
        return self._process.poll()

    @property
    def running(self) -> bool:
        """Return whether the process is running."""
        return self.status is None

    @property
    def stdin(self) -> IO[bytes]:
        """Return the pipe to the standard input."""
        assert self._process.stdin is not None
        return self._process.stdin

    @property
    def stdout(self) -> IO[bytes]:
        """Return the pipe from the standard output."""
        assert self._process.stdout is not None
        return self._process.stdout

    def wait(self, timeout: float | None = None) -> int:
        """Wait for the process to end and return its exit status; raise TimeoutExpired."""
        return self._process.wait(timeout)

    def leave(self) -> None:
        """Detach the process; a thread collects its exit status, to avoid a zombie."""
        self._log.close()
        Background(self._process.wait, f"end of process {self.pid}")

    def messages(self) -> str:
        """Return the end of the standard error of an ended process."""
        size = self._log.seek(0, os.SEEK_END)
        self._log.seek(max(0, size - LAST_WORDS))
        return self._log.read().decode(errors="replace").strip()

    def last_words(self) -> str:
        """Return the last line on standard error, which names the error of a Python program."""
        return self.messages().rpartition("\n")[2]

    def read_line(self, timeout_s: float) -> bytes:
        """Return one line from ``stdout``; raise TimeoutError, BrokenPipeError at its end."""
        descriptor = self.stdout.fileno()
        deadline = time.monotonic() + timeout_s
        line = b""
        while not line.endswith(b"\n"):
            left = deadline - time.monotonic()
            if left <= 0.0 or not select.select([descriptor], [], [], left)[0]:
                raise TimeoutError(f"no line within {timeout_s:g} s")
            part = os.read(descriptor, _READ_SIZE)
            if not part or len(line) > LONGEST_MESSAGE:
                raise BrokenPipeError("the output has ended")
            line += part
        return line

    def kill(self) -> None:
        """Kill the process; its pipes stay open for reading the rest."""
        self._process.kill()

    def close(self, grace_s: float = 0.0) -> None:
        """End the process, and kill it after ``grace_s``; safe to call twice."""
        if grace_s:
            self._process.terminate()
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(grace_s)
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._log):
            if stream is not None:
                with suppress(OSError):
                    stream.close()


class MessageChild(Child):
    """A child that exchanges records with the program; for the thread that started it.

    Raises zmq.ZMQError if the socket fails.
    """

    def __init__(
        self, module: str, folder: Path, name: str, environment: dict[str, str] | None = None
    ) -> None:
        """Start the module with the arguments of ``Parent``.

        folder, name: folder of the socket, and prefix of its file name.
        """
        self._context = zmq.Context()
        self._socket = _new_socket(self._context)
        self._address = link_address(folder, f"{name}-{os.getpid()}-{next(_numbers):x}")
        try:
            endpoint, own = bind_link(self._socket, self._address)
            own = (environment or {}) | own
            super().__init__(module, endpoint, os.getpid(), environment=own)
        except BaseException:
            self._close_socket()
            raise

    def send(self, record: object) -> bool:
        """Send a record; False if the child is not connected yet, or its queue is full."""
        if not self._socket.poll(0, zmq.POLLOUT):
            return False
        self._socket.send(encode(record), zmq.NOBLOCK)
        return True

    def receive(self, kind: type[Record], timeout_s: float = 0.0) -> Record | None:
        """Return the next record; None on time-out, or if the child has ended."""
        deadline = time.monotonic() + timeout_s
        while True:
            # Checked before the socket: the child's last message arrives before its end.
            running = self.running
            if self._socket.poll(int(1000 * min(timeout_s, _POLL_S))):
                return decode(self._socket.recv(), kind)
            if not running or time.monotonic() >= deadline:
                return None

    def close(self, grace_s: float = 0.0) -> None:
        """Close the socket and end the process."""
        self._close_socket()
        super().close(grace_s)

    def leave(self) -> None:
        """Close the socket and detach the process."""
        self._close_socket()
        super().leave()

    def _close_socket(self) -> None:
        self._context.destroy(linger=0)
        if self._address.startswith("ipc://"):
            Path(self._address.removeprefix("ipc://")).unlink(missing_ok=True)


class Parent:
    """The program that started this process, with a socket to it."""

    def __init__(self, arguments: list[str]) -> None:
        """Connect; arguments: endpoint and process id, from ``MessageChild``."""
        self.pid = int(arguments[1])
        self._context = zmq.Context()
        self._socket = _new_socket(self._context)
        connect_link(self._socket, arguments[0])

    @property
    def alive(self) -> bool:
        """Return whether the program still runs: otherwise this process has another parent."""
        return os.getppid() == self.pid

    def receive(self, kind: type[Record], timeout_s: float = 0.0) -> Record | None:
        """Return the next record, None on time-out."""
        if not self._socket.poll(int(1000 * timeout_s)):
            return None
        return decode(self._socket.recv(), kind)

    def wait_for(self, kind: type[Record]) -> Record | None:
        """Return the next record, None if the program ends first."""
        record = None
        while record is None and self.alive:
            record = self.receive(kind, 0.2)
        return record

    def send(self, record: object) -> None:
        """Send a record; no error if the program has just ended."""
        with suppress(zmq.ZMQError):
            self._socket.send(encode(record))

    def close(self, linger_s: float = 0.0) -> None:
        """Close the socket, after ``linger_s`` for undelivered records."""
        self._context.destroy(linger=int(1000 * linger_s))


class Restarts:
    """Count the consecutive failed children, and compute the pause before the next start.

    The pause doubles with each failure: a child that fails at once must not keep a processor busy.
    """

    def __init__(self, pause_s: float, attempts: int) -> None:
        self._pause_s, self._attempts = pause_s, attempts
        self._failed = 0

    def started(self) -> None:
        """Count a child as failed until ``succeeded`` is called."""
        self._failed += 1

    def succeeded(self) -> None:
        """Reset the count."""
        self._failed = 0

    @property
    def exhausted(self) -> bool:
        """Return whether no further child should be started."""
        return self._failed >= self._attempts

    @property
    def pause_s(self) -> float:
        """Return the pause before the next start."""
        return min(LONGEST_PAUSE_S, self._pause_s * 2.0**self._failed)


def write_frame(stream: IO[bytes], data: bytes) -> None:
    """Write a message to a pipe: its length in four bytes, little-endian, then the message."""
    stream.write(len(data).to_bytes(_HEAD, "little") + data)
    stream.flush()


def read_frames(stream: IO[bytes]) -> Iterator[bytes]:
    """Yield the messages of a pipe until its end; raise ValueError for one that is too long."""
    while head := stream.read(_HEAD):
        length = int.from_bytes(head, "little")
        if length > LONGEST_MESSAGE:
            raise ValueError(f"a message of {length} bytes; the maximum is {LONGEST_MESSAGE}")
        yield stream.read(length)


def link_address(folder: Path, name: str) -> str:
    """Return the address to bind: a Unix socket, or else a port of the loopback interface."""
    address = f"ipc://{folder}/{name}"
    if sys.platform == "win32" or len(address) > LONGEST_ADDRESS:
        return "tcp://127.0.0.1:*"
    return address


def bind_link(socket: zmq.Socket[bytes], address: str) -> tuple[str, dict[str, str]]:
    """Bind a socket and return its endpoint and the environment for the process that connects.

    Every account of the computer can reach a loopback port. There the link is encrypted (CurveZMQ)
    with a key that is only in this environment: without it no handshake succeeds. A command line
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
    """Connect the socket of a started process, with the key of its environment if it has one."""
    key = os.environ.pop(KEY, "")
    if key:
        socket.curve_publickey, socket.curve_secretkey = zmq.curve_keypair()
        socket.curve_serverkey = key.encode()
    socket.connect(endpoint)


def _new_socket(context: zmq.Context[zmq.Socket[bytes]]) -> zmq.Socket[bytes]:
    socket = context.socket(zmq.PAIR)
    socket.setsockopt(zmq.LINGER, 0)
    socket.setsockopt(zmq.SNDTIMEO, SEND_MS)
    socket.setsockopt(zmq.MAXMSGSIZE, LONGEST_MESSAGE)
    return socket
