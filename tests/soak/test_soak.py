"""Long tests and their short forms: nothing grows, nothing leaks, the count is exact.

RIGAPP_SOAK_REVOLUTIONS (1,000,000) and RIGAPP_SOAK_SECONDS (3,600) set the long forms,
which run with ``-m soak`` (``make soak``).
"""

from __future__ import annotations

import collections
import gc
import itertools
import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from footprint import MEGABYTE, Footprint, footprint
from numpy.typing import NDArray
from patience import PATIENCE_S
from stories import RIG, Running, numbers, recipe, summary, until

from rigapp.config.loading import Document, parse_test
from rigapp.config.recipe import TestFile
from rigapp.engine.drive.timing import Timing
from rigapp.engine.recording.store import open_file
from rigapp.schema.channels import BASE
from rigapp.schema.messages import FinishReason, as_array
from rigapp.schema.states import ACTIVE, ENDED
from rigapp.service.client import Client
from rigapp.service.registry import running_engines
from rigapp.storage import open_test
from tests.engine import engine_doubles
from tests.engine.engine_doubles import Crank, MemoryRig

pytestmark = pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="needs Linux's /proc")

GROWTH = 5 * MEGABYTE
LONG_REVOLUTIONS = int(os.environ.get("RIGAPP_SOAK_REVOLUTIONS", "1000000"))
LONG_SECONDS = float(os.environ.get("RIGAPP_SOAK_SECONDS", "3600"))
EXAMPLES = Path(__file__).parents[2] / "examples"
MOST_REVOLUTIONS_PER_S = 400
WARM_REVOLUTIONS = 250
"""So many after the start every part has worked and its buffers are as large as they get."""
BATCHES = 3
WALKS = 25
"""From a start through a fault to a reconnection; the first third and the last end alike."""
LEAST_REVOLUTIONS = 60
"""Of a batch, however slow the computer is."""


class QuickCrank(Crank):
    """The crank of the doubles, a whole block at a time."""

    def turn(self, samples: int) -> NDArray[np.float64]:
        """Advance and return the position at each sample, in revolutions."""
        step = 1.0 / engine_doubles.RATE
        self.turned_at = time.monotonic()
        with self.lock:
            lack = (self.target if self.powered else 0.0) - self.speed
            ramp = self.acceleration * step * np.arange(1, samples + 1)
            speed = self.speed + np.sign(lack) * np.minimum(abs(lack), ramp)
            turns = self.position_rev + np.cumsum(speed) * step
            self.speed, self.position_rev = float(speed[-1]), float(turns[-1])
        return turns


def long_test(revolutions: int) -> Document[TestFile]:
    """Return a test at 360 rpm, of 80 samples a revolution."""
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    for old, new in (
        ("revolutions = 500", f"revolutions = {revolutions}"),
        ("speed_rpm = 60.0", "speed_rpm = 360.0"),
        ("acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 600.0"),
        ("overspeed_rpm = 90.0", "overspeed_rpm = 399.0"),
        ("every_revolutions = 10", "every_revolutions = 1000"),
    ):
        assert old in text, old
        text = text.replace(old, new, 1)
    return Document(Path("long.toml"), text, parse_test(text, "long.toml"))


def feed(path: Path, revolutions: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Feed Blocks of so many revolutions to an engine with a viewer and a real file; check all."""
    monkeypatch.setattr(engine_doubles, "BLOCK", 480)
    gc.collect()
    threads, before = set(threading.enumerate()), footprint(os.getpid())
    rig = MemoryRig(crank=QuickCrank(), open_store=open_file)
    rig.measured = []
    rig.engine._core._on_measured = collections.deque(maxlen=4).append
    rig.engine.connect()
    viewer = rig.engine.subscribe()
    rig.engine.start(long_test(revolutions), path, operator="Ada")
    warm: Footprint | None = None
    shown, seen_at = 0, time.monotonic()
    while rig.engine.state in ACTIVE:
        taken = rig.engine.snapshot(viewer)
        rows = np.frombuffer(taken.rows).reshape(-1, len(taken.columns))
        if len(rows):
            seen_at = time.monotonic()
            assert rows[0, 0] == shown + 1
            shown = int(rows[-1, 0])
        assert time.monotonic() - seen_at < 30.0, f"nothing came after revolution {shown}"
        if warm is None and shown >= revolutions // 4:
            warm = footprint(os.getpid())
        time.sleep(0.02)
    hot = footprint(os.getpid())
    outcome = rig.engine.outcome
    assert outcome is not None
    assert (outcome.reason, outcome.revolutions) == (FinishReason.COMPLETE, revolutions)
    rig.engine.shutdown()
    assert warm is not None
    assert hot.memory - warm.memory < GROWTH
    assert hot.threads <= warm.threads
    assert hot.handles <= warm.handles
    until(lambda: set(threading.enumerate()) <= threads, "the engine's threads have ended")
    assert footprint(os.getpid()).handles <= before.handles
    with open_test(path) as reader:
        found = reader.summary()
        assert (found["status"], found["revolutions"]) == ("complete", revolutions)
        assert found["gaps"] == 0
        np.testing.assert_array_equal(reader.column("revolution"), np.arange(1, revolutions + 1))
        assert reader.column("force_max").max() < 51.0


@pytest.mark.long
def test_fed_revolutions_leave_nothing_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    feed(tmp_path / "fed.h5", 5000, monkeypatch)


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_a_million_fed_revolutions_leave_nothing_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The number is set by RIGAPP_SOAK_REVOLUTIONS (1,000,000)."""
    feed(tmp_path / "fed.h5", LONG_REVOLUTIONS, monkeypatch)


def objects() -> int:
    """Return how many objects the garbage collector knows after it has collected."""
    gc.collect()
    return len(gc.get_objects())


@pytest.mark.long
def test_faults_and_reconnections_leave_nothing_behind() -> None:
    rig = MemoryRig()
    found: list[tuple[Footprint, int]] = []
    try:
        for walk in range(WALKS):
            rig.engine.connect()
            engine_doubles.eventually(
                lambda: not any(one.active for one in rig.engine.status().alarms)
            )
            if rig.engine.status().alarms:
                rig.engine.acknowledge(operator="Ada")
                rig.engine.reset("Ada")
            rig.start(engine_doubles.a_test(1_000_000))
            engine_doubles.eventually(lambda: len(rig.store.rows) >= 5)
            rig.source.lost, rig.source.silent = walk % 2 == 0, walk % 2 == 1
            rig.engine.wait(ENDED, 60.0)
            rig.source.lost = rig.source.silent = False
            rig.stores.clear()
            rig.requests.clear()
            rig.measured.clear()
            rig.spindle.commands.clear()
            if walk in (WALKS // 3, WALKS - 1):
                found.append((footprint(os.getpid()), objects()))
    finally:
        rig.engine.shutdown(20.0)
    (warm, before), (hot, after) = found
    assert after - before < 10 * WALKS, "a walk leaves its notices in the log"
    assert hot.memory - warm.memory < GROWTH
    assert hot.threads <= warm.threads
    assert hot.handles <= warm.handles


@pytest.mark.long
def test_slow_disk_costs_no_revolution(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every sync takes 2 s; the revolutions go on meanwhile."""
    delays: list[float] = []
    real = os.fdatasync

    def slow(handle: int) -> None:
        delays.append(2.0)
        time.sleep(2.0)
        real(handle)

    rig = MemoryRig(crank=QuickCrank(), open_store=open_file, timing=Timing())
    path = tmp_path / "slow.h5"
    rig.engine.connect()
    viewer = rig.engine.subscribe()
    rig.engine.start(long_test(3000), path, operator="Ada")
    monkeypatch.setattr(os, "fdatasync", slow)
    shown = most = 0
    while rig.engine.state in ACTIVE:
        syncs, taken = len(delays), rig.engine.snapshot(viewer)
        rows = np.frombuffer(taken.rows).reshape(-1, len(taken.columns))
        if len(rows):
            shown = int(rows[-1, 0])
        if syncs == 1:
            most = max(most, shown)
        time.sleep(0.01)
    rig.engine.shutdown()
    assert delays
    assert most > 20, "revolutions were recorded and shown during the first slow sync"
    with open_test(path) as reader:
        assert reader.summary()["status"] == "complete", reader.summary()
        np.testing.assert_array_equal(reader.column("revolution"), np.arange(1, 3001))


def watched(test: Running, client: Client, batch_s: float) -> tuple[int, list[Footprint]]:
    """Look on for ``BATCHES`` once the test is warm; return the last revolution that was shown.

    Also the footprints before the first and after each batch, which lasts at least batch_s.
    """
    footprints: list[Footprint] = []
    shown, next_row = 0, -1
    revolutions, due_s = WARM_REVOLUTIONS, time.monotonic()
    deadline = due_s + BATCHES * batch_s + PATIENCE_S
    while len(footprints) <= BATCHES:
        assert test.process.poll() is None, test.complaint()
        assert time.monotonic() < deadline, f"{test.committed} of {revolutions} revolutions"
        snapshot = client.poll()
        if snapshot is not None and snapshot.rows:
            rows = as_array(snapshot.rows, "<f8").reshape(-1, len(BASE.names))
            assert snapshot.first_row >= next_row
            next_row = snapshot.first_row + len(rows)
            shown = int(rows[-1, 0])
        if test.committed >= revolutions and time.monotonic() >= due_s:
            footprints.append(footprint(test.process.pid))
            revolutions, due_s = test.committed + LEAST_REVOLUTIONS, time.monotonic() + batch_s
        time.sleep(0.03)
    return shown, footprints


def over_the_wire(folder: Path, seconds: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run a test as fast as it goes with twin and viewer for so long, then stop it; check all.

    What leaks grows in every batch; what a busy computer delays grows in one.
    """
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(folder / "run"))
    planned = round((seconds + PATIENCE_S) * MOST_REVOLUTIONS_PER_S)
    plan = recipe(folder, planned, twin=True, every=100)
    out = folder / "wire.h5"
    test = Running("run", plan, "--rig", RIG, "--out", out, "--speed", "max")
    client: Client | None = None
    try:
        test.wait_for(lambda: test.committed > 0, "the test runs")
        client = Client(running_engines()[-1], "Ada")
        shown, footprints = watched(test, client, seconds / BATCHES)
        test.process.send_signal(signal.SIGINT)
        end = test.end()
    finally:
        if client is not None:
            client.close()
        test.close()
    assert end["reason"] == "operator", end
    pairs = list(itertools.pairwise(footprints))
    assert min(hot.memory - warm.memory for warm, hot in pairs) < GROWTH / BATCHES, footprints
    assert min(hot.threads - warm.threads for warm, hot in pairs) <= 0, footprints
    assert min(hot.handles - warm.handles for warm, hot in pairs) <= 0, footprints
    found = numbers(out)
    assert len(found) >= shown > 0
    assert np.array_equal(found, np.arange(1, len(found) + 1))
    assert summary(out)["gaps"] == 0


@pytest.mark.long
def test_a_test_over_wire_bytes_grows_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    over_the_wire(tmp_path, 9.0, monkeypatch)


@pytest.mark.soak
@pytest.mark.timeout(0)
def test_an_hour_over_wire_bytes_grows_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The duration is set by RIGAPP_SOAK_SECONDS (3,600)."""
    over_the_wire(tmp_path, LONG_SECONDS, monkeypatch)
