"""Strangers who connect and say nothing: the page goes on for everybody else."""

from __future__ import annotations

import json
import os
import resource
import socket
import ssl
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from http.client import HTTPConnection, HTTPSConnection
from pathlib import Path
from typing import Any

import psutil
import pytest
from page.doubles import OpenPage, ServedEngine, eventually
from patience import PATIENCE_S

Show = Callable[..., OpenPage]
STRANGERS = 300
LOW = 96
"""Open files of a page whose system is strict; with them and without strangers it works."""


def silent(stack: ExitStack, port: int, number: int) -> None:
    """Connect so often and say nothing."""
    for _ in range(number):
        with suppress(ConnectionError):
            line = socket.create_connection(("127.0.0.1", port), PATIENCE_S)
            stack.enter_context(line)


def test_who_says_nothing_before_tls_begins_makes_room(
    rig: Path, show: Show, token: Path, pair: tuple[Path, Path]
) -> None:
    page = show([rig], "127.0.0.1:0", token, *pair)
    bearer = {"Authorization": f"Bearer {token.read_text().strip()}"}
    with ExitStack() as stack:
        silent(stack, page.port, STRANGERS)
        assert page.get("/healthz", **bearer)[0] == 200
        process = psutil.Process()
        eventually(
            lambda: len([one for one in process.net_connections("tcp") if of(page, one)]) < 80,
            "the oldest silent connections end",
        )
        assert page.get("/healthz", **bearer)[0] == 200


def of(page: OpenPage, line: Any) -> bool:
    """Tell whether a connection is one that the page has accepted and not let go."""
    return bool(
        line.laddr and line.laddr.port == page.port and line.status == psutil.CONN_ESTABLISHED
    )


@contextmanager
def page_of_its_own(rig: Path, *options: object, files: int | None = None) -> Iterator[Any]:
    """Run a page as a process; yield it with its port. files: how many it may open."""

    def limit() -> None:
        if files is not None:
            resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))

    words = ["--rig", rig, "--bind", "127.0.0.1:0", *options]
    with subprocess.Popen(
        [sys.executable, "-m", "rigapp", "page", *map(str, words)],
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=limit,
    ) as page:
        assert page.stdout is not None
        yield page, int(page.stdout.readline().rstrip().rstrip("/").rpartition(":")[2])
        assert page.poll() is None
        page.terminate()


def test_a_page_without_descriptors_goes_on(rig: Path, serve: Callable[..., ServedEngine]) -> None:
    serve(rig)
    with page_of_its_own(rig, files=LOW) as (_, port):
        eventually(lambda: attached(port), "the engine is seen")
        with ExitStack() as stack:
            silent(stack, port, STRANGERS)
            assert attached(port)
        eventually(lambda: attached(port), "the page goes on")


def memory_that_strangers_take(
    rig: Path, token: Path, pair: tuple[Path, Path] | None, number: int, at_once: int
) -> int:
    """Let so many say nothing, some at once; return by how many bytes the page grew."""
    options: list[object] = ["--token", token]
    if pair is not None:
        options += ["--certificate", pair[0], "--key", pair[1]]
    with page_of_its_own(rig, *options) as (page, port):
        healthy(port, token, pair)
        process = psutil.Process(page.pid)
        before = process.memory_info().rss
        for _ in range(number // at_once):
            with ExitStack() as stack:
                silent(stack, port, at_once)
                healthy(port, token, pair)
        return int(process.memory_info().rss - before)


def healthy(port: int, token: Path, pair: tuple[Path, Path] | None) -> None:
    """Assert that the page answers."""
    line: HTTPConnection = HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    if pair is not None:
        context = ssl.create_default_context(cafile=str(pair[0]))
        line = HTTPSConnection("127.0.0.1", port, timeout=PATIENCE_S, context=context)
    line.request(
        "GET", "/healthz", headers={"Authorization": f"Bearer {token.read_text().strip()}"}
    )
    assert line.getresponse().status == 200
    line.close()


@pytest.mark.sampled
@pytest.mark.parametrize("tls", [True, False], ids=["TLS", "plain"])
def test_strangers_leave_no_memory_behind(
    rig: Path, token: Path, pair: tuple[Path, Path], tls: bool
) -> None:
    taken = memory_that_strangers_take(rig, token, pair if tls else None, STRANGERS, STRANGERS)
    assert taken < 50e6, "256 kB each would be 77 MB"


@pytest.mark.soak
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("tls", [True, False], ids=["TLS", "plain"])
def test_a_hundred_thousand_strangers_leave_no_memory_behind(
    rig: Path, token: Path, pair: tuple[Path, Path], tls: bool
) -> None:
    number = int(os.environ.get("RIGAPP_SOAK_STRANGERS", "100000"))
    at_once, most = min(number, 10_000), resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(at_once + 500, most), most))
    assert memory_that_strangers_take(rig, token, pair if tls else None, number, at_once) < 50e6


def attached(port: int) -> bool:
    """Tell whether the page answers, and has an engine."""
    line = HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
    try:
        line.request("GET", "/api/status")
        answer = json.loads(line.getresponse().read())
        return all(one["line"] == "attached" for one in answer["rigs"]) and bool(answer["rigs"])
    except ConnectionError:
        time.sleep(0.1)
        return False
    finally:
        line.close()
