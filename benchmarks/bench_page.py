"""Compare an engine with 50 open pages, ten of which never read, with the same one alone.

Run with ``python benchmarks/bench_page.py``. A simulated test at x20 runs in a process of its own;
alternately without readers, and with 50 readers of a page in another process. Printed: the engine's
processor time and age of its data in both, and their ratios.
"""

from __future__ import annotations

import math
import os
import re
import selectors
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import psutil
from budgets import measured, size

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from rigapp.schema.messages import RunState  # noqa: E402
from rigapp.service.client import Client, EngineUnreachable  # noqa: E402
from rigapp.service.launch import find_engine  # noqa: E402
from rigapp.service.registry import EngineEntry  # noqa: E402

RIG = ROOT / "examples" / "simulated.toml"
PAGES, DEAF = 50, 10
TURNS = size(4, 1)
TURN_S = size(15, 2)
SETTLE_S = 3.0
ASK_EVERY_S = 0.1
START_S = 180.0


@contextmanager
def running(*arguments: str, output: int = subprocess.DEVNULL) -> Iterator[subprocess.Popen[str]]:
    """Run rigapp for the duration."""
    command = [sys.executable, "-P", "-m", "rigapp", *arguments]
    process = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL, text=True)
    try:
        yield process
    finally:
        process.terminate()
        process.wait()


def entry_of(rig: Path) -> EngineEntry:
    """Wait for the engine's entry."""
    deadline = time.monotonic() + START_S
    while (entry := find_engine(rig)) is None:
        if time.monotonic() > deadline:
            raise TimeoutError(f"no engine within {START_S:g} s")
        time.sleep(0.2)
    return entry


def at_speed(client: Client) -> None:
    """Wait until the test runs and has data."""
    deadline = time.monotonic() + START_S
    while time.monotonic() < deadline:
        with suppress(EngineUnreachable):
            status = client.request("status").result
            if status["state"] == RunState.RUNNING and math.isfinite(status["data_age_s"]):
                return
        time.sleep(ASK_EVERY_S)
    raise TimeoutError(f"the test does not run after {START_S:g} s")


def turn(client: Client, pid: int) -> tuple[float, list[float]]:
    """Return the engine's processor time per second, and ages of its data (s), in one period."""
    process = psutil.Process(pid)
    time.sleep(SETTLE_S)
    ages: list[float] = []
    began, before = time.monotonic(), sum(process.cpu_times()[:2])
    while (passed := time.monotonic() - began) < TURN_S:
        ages.append(client.request("status").result["data_age_s"])
        time.sleep(ASK_EVERY_S)
    return (sum(process.cpu_times()[:2]) - before) / passed, ages


@contextmanager
def looked_at() -> Iterator[None]:
    """Open the page and its readers for the duration; some never read."""
    with ExitStack() as stack:
        page = stack.enter_context(
            running("page", "--rig", str(RIG), "--bind", "127.0.0.1:0", output=subprocess.PIPE)
        )
        assert page.stdout is not None
        address = re.search(r":(\d+)/", page.stdout.readline())
        assert address is not None, "the page did not start"
        reader = stack.enter_context(reading(int(address[1])))
        yield
        assert reader.poll() is None, "the readers ended early"


@contextmanager
def reading(port: int) -> Iterator[subprocess.Popen[bytes]]:
    """Run the readers in a process of their own for the duration."""
    process = subprocess.Popen([sys.executable, __file__, "--read", str(port)])
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def read(port: int) -> None:
    """Open all readers and read from all but those that never read, until the process is ended."""
    selector, kept = selectors.DefaultSelector(), []
    for number in range(PAGES):
        line = socket.create_connection(("127.0.0.1", port))
        line.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        kept.append(line)
        if number >= DEAF:
            selector.register(line, selectors.EVENT_READ)
    while selector.get_map():
        for key, _ in selector.select():
            assert isinstance(key.fileobj, socket.socket)
            if not key.fileobj.recv(1 << 16):
                selector.unregister(key.fileobj)


def main() -> None:
    """Print the table."""
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        os.environ["RIGAPP_RUNTIME_DIR"] = f"{folder}/run"
        stack.enter_context(
            running(
                "run", str(ROOT / "examples" / "paper.toml"), "--rig", str(RIG),
                "--out", f"{folder}/t.h5", "--speed", "20",
            )
        )  # fmt: skip
        entry = entry_of(RIG)
        client = Client(entry, look=False)
        at_speed(client)
        alone, watched = [], []
        for _ in range(TURNS):
            alone.append(turn(client, entry.pid))
            with looked_at():
                watched.append(turn(client, entry.pid))
        client.close()
    judge(alone, watched)


def judge(alone: list[tuple[float, list[float]]], watched: list[tuple[float, list[float]]]) -> None:
    """Print the result."""
    cpu = [statistics.median(load for load, _ in turns) for turns in (alone, watched)]
    ages = [sorted(age for _, sampled in turns for age in sampled) for turns in (alone, watched)]
    p99 = [ordered[int(0.99 * len(ordered))] for ordered in ages]
    ratios = (cpu[1] / cpu[0], p99[1] / p99[0])
    print(f"{'':32s} {'alone':>10s} {f'{PAGES} pages':>10s} {'ratio':>8s}")
    for what, scale, (without, watched), ratio in (
        ("engine, processor (% of a core)", 100.0, cpu, ratios[0]),
        ("age of the data, p99 (ms)", 1e3, p99, ratios[1]),
    ):
        print(f"{what:32s} {scale * without:10.1f} {scale * watched:10.1f} {ratio:8.2f}")
    measured("page_cpu", ratios[0])
    measured("page_age", ratios[1])


if __name__ == "__main__":
    if sys.argv[1:2] == ["--read"]:
        read(int(sys.argv[2]))
    else:
        main()
