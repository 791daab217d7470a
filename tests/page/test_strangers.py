"""Strangers who connect and say nothing: the page goes on for everybody else."""

from __future__ import annotations

import json
import resource
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import ExitStack, suppress
from http.client import HTTPConnection
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


def test_a_page_without_descriptors_goes_on(rig: Path, serve: Callable[..., ServedEngine]) -> None:
    serve(rig)
    with subprocess.Popen(
        [sys.executable, "-m", "rigapp", "page", "--rig", str(rig), "--bind", "127.0.0.1:0"],
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (LOW, LOW)),
    ) as page:
        assert page.stdout is not None
        port = int(page.stdout.readline().rstrip().rstrip("/").rpartition(":")[2])
        eventually(lambda: attached(port), "the engine is seen")
        with ExitStack() as stack:
            silent(stack, port, STRANGERS)
            assert attached(port)
        eventually(lambda: attached(port), "the page goes on")
        assert page.poll() is None
        page.terminate()


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


@pytest.mark.soak
def test_a_hundred_thousand_strangers(rig: Path, show: Show) -> None:
    page = show([rig])
    before = psutil.Process().memory_info().rss
    for _ in range(1000):
        with ExitStack() as stack:
            silent(stack, page.port, 100)
    assert page.get("/healthz")[0] == 200
    assert psutil.Process().memory_info().rss - before < 50e6
