"""Run the real command line in the background and look at what it leaves."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from patience import PATIENCE_S

from rigapp.schema.messages import Event
from rigapp.service.client import Client
from rigapp.service.launch import find_engine
from rigapp.storage import open_test

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated.toml"
COMMAND = [sys.executable, "-m", "rigapp"]


def recipe(folder: Path, revolutions: int, *, twin: bool, every: int = 10) -> Path:
    """Write a test that starts quickly."""
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    for old, new in (
        ("revolutions = 500", f"revolutions = {revolutions}"),
        ("acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 240.0"),
        ("every_revolutions = 10", f"every_revolutions = {every}"),
        ("[prediction]", f"[prediction]\nenabled = {str(twin).lower()}"),
    ):
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path = folder / "test.toml"
    path.write_text(text, encoding="utf-8")
    return path


NEVER_OVER = 5000
"""More revolutions than a simulated rig makes while a test waits for something."""


def until(condition: Callable[[], Any], what: str, seconds: float = PATIENCE_S) -> None:
    """Wait for a condition with a deadline."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"not within {seconds:g} s: {what}"
        time.sleep(0.02)


def end_soon(rig: Path) -> int:
    """Let the test of a rig, which must be running, end soon; return its last revolution."""
    entry = find_engine(rig)
    assert entry is not None
    client = Client(entry, "Ada", look=False)
    planned = 0

    def shortened() -> bool:
        nonlocal planned
        planned = client.request("status", timeout_s=30.0).result["revolution"] + 40
        return client.request("extend", {"revolutions": planned}, timeout_s=30.0).ok

    try:
        until(shortened, "the test is told to end soon")
    finally:
        client.close()
    return planned


def with_ports(folder: Path, rig: Path, urls: Mapping[str, str]) -> Path:
    """Write a rig file whose devices are behind these ports."""
    text = rig.read_text(encoding="utf-8")
    for name, url in urls.items():
        head, tail = text.split(f"[devices.{name}]", 1)
        text = f"{head}[devices.{name}]" + tail.replace('"simulated"', f'"{url}"', 1)
    path = folder / "rig.toml"
    path.write_text(real(text), encoding="utf-8")
    return path


def real(text: str) -> str:
    """Return the text of a rig file without [simulation], which a real rig may not have."""
    return re.sub(r"(?m)^\[simulation\]\n(?:(?!\[).*\n)*", "", text)


class Running:
    """A test in progress; its milestones are collected by a thread of their own."""

    def __init__(self, *arguments: str | Path) -> None:
        self.process = subprocess.Popen(
            [*COMMAND, *map(str, arguments), "--progress", "json"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.events: list[dict[str, Any]] = []
        self.committed = 0
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            if not line.endswith("\n"):
                break
            event = json.loads(line)
            self.events.append(event)
            if event["event"] == "committed":
                self.committed = event["revolutions"]

    def states(self) -> list[str]:
        """Return the states so far."""
        return [event["state"] for event in list(self.events) if event["event"] == "state"]

    def wait_for(
        self, condition: Callable[[], Any], what: str, seconds: float = PATIENCE_S
    ) -> None:
        """Wait for a condition while the test lives."""

        def come() -> bool:
            done = bool(condition())
            assert done or self.process.poll() is None, f"it ended before: {what}; {self.events}"
            return done

        until(come, what, seconds)

    def end(self, seconds: float = PATIENCE_S) -> dict[str, Any]:
        """Wait for the end and return the last milestone of the test."""
        self.process.wait(seconds)
        self._reader.join(10.0)
        ends = [event for event in self.events if event["event"] == "finished"]
        assert ends, self.complaint()
        return ends[-1]

    def complaint(self) -> str:
        """Return what was said on standard error."""
        assert self.process.stderr is not None
        return self.process.stderr.read()

    def kill(self) -> None:
        """Kill at once; milestones that were sent are read."""
        self.process.kill()
        self.process.wait(10.0)
        self._reader.join(10.0)

    def close(self) -> None:
        """Leave nothing behind."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait(10.0)
        self._reader.join(10.0)
        for stream in (self.process.stdout, self.process.stderr):
            if stream is not None:
                stream.close()


def children(pid: int, word: str) -> list[int]:
    """Return the children of a process whose command line contains a word."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in task.read_text().split():
            try:
                line = Path(f"/proc/{child}/cmdline").read_bytes().decode(errors="replace")
            except OSError:
                continue
            if word in line:
                found.append(int(child))
    return found


def numbers(path: Path) -> NDArray[np.int64]:
    """Return the revolution numbers of a file."""
    with open_test(path) as reader:
        return np.asarray(reader.column("revolution")).astype(np.int64)


def log(path: Path) -> list[Event]:
    """Return the events of a file."""
    with open_test(path) as reader:
        assert reader.first_altered_event() is None
        return list(reader.events())


def summary(path: Path) -> dict[str, Any]:
    """Return the summary of a file."""
    with open_test(path) as reader:
        return dict(reader.summary())
