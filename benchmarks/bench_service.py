"""Measure the service: delay of a trip to the drive, and of a revolution to the viewer.

Run with ``python benchmarks/bench_service.py``.

Trip: from the Block with the first sample above the overload limit, as the driver hands it over, to
the drive-off command, as it enters the drive's driver. Devices in memory take no time; on the
simulated rig the command goes over real wire bytes.

Snapshot: from the end of a revolution (its host time in the file) to the viewer, through
wire bytes, assembler, file, ZeroMQ and MessagePack, with a viewer that polls every 5 ms on a rig in
real time at 120 rpm.
"""

from __future__ import annotations

import os
import statistics
import sys
import tempfile
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from budgets import measured, size

ROOT = Path(__file__).parents[1]
# The project itself is first: tests has folders named as its packages.
sys.path += [str(ROOT), str(ROOT / "tests"), str(ROOT / "tests" / "engine")]

from engine_doubles import MemoryRig, a_test, eventually  # noqa: E402

from rigapp.config.loading import Document, parse_test, read_rig  # noqa: E402
from rigapp.config.recipe import TestFile  # noqa: E402
from rigapp.engine.engine import Engine  # noqa: E402
from rigapp.schema.channels import BASE  # noqa: E402
from rigapp.schema.messages import RunState, as_array  # noqa: E402
from rigapp.schema.states import ENDED, Refused  # noqa: E402
from rigapp.service.client import Client  # noqa: E402
from rigapp.service.host import EngineHost  # noqa: E402
from rigapp.service.registry import running_engines  # noqa: E402

MEMORY_TRIPS = size(20, 1)
WIRE_TRIPS = size(5, 1)
SECONDS = size(30, 5)
RPM = 120.0
LONG = 100_000
OVERLOAD_MV_PER_V = 3.0
REST_N = 100.0
"""The pin at rest carries less: the block with the overload is no longer the newest one."""


def wire_test() -> Document[TestFile]:
    """Return a test at ``RPM`` without a twin."""
    text = (ROOT / "examples" / "quick.toml").read_text(encoding="utf-8")
    for old, new in (
        ("revolutions = 500", f"revolutions = {LONG}"),
        ("speed_rpm = 60.0", f"speed_rpm = {RPM}"),
        ("acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 120.0"),
        ("overspeed_rpm = 90.0", "overspeed_rpm = 180.0"),
        ("[prediction]", "[prediction]\nenabled = false"),
        ("every_revolutions = 10", "every_revolutions = 1000"),
    ):
        text = text.replace(old, new, 1)
    return Document(Path("bench.toml"), text, parse_test(text, "bench.toml"))


def trip_ms(engine: Engine, source: Any, spindle: Any) -> float:
    """Put an overload into the next Block; return the time from it to drive-off, ms."""
    handed_over: list[float] = []
    switched_off: list[float] = []
    selected = threading.Event()
    read, off = source.read, spindle.drive_off

    def timed_read(timeout_s: float) -> Any:
        after = selected.is_set()
        block = read(timeout_s)
        if not after or block is None:
            return block
        values = block.values.copy()
        values[0] = OVERLOAD_MV_PER_V
        block = replace(block, values=values)
        handed_over.append(time.perf_counter())
        return block

    def timed_off() -> None:
        switched_off.append(time.perf_counter())
        off()

    source.read, spindle.drive_off = timed_read, timed_off
    try:
        selected.set()
        engine.wait(ENDED, 60.0)
    finally:
        source.read, spindle.drive_off = read, off
    return 1000.0 * (switched_off[0] - handed_over[0])


def memory_trips() -> list[float]:
    """Return the trips of rigs in memory, ms."""
    times = []
    for _ in range(MEMORY_TRIPS):
        rig = MemoryRig()
        rig.engine.connect()
        rig.start(a_test(LONG))
        eventually(lambda rig=rig: len(rig.store.rows) >= 5)  # type: ignore[misc]
        times.append(trip_ms(rig.engine, rig.source, rig.spindle))
        rig.engine.shutdown()
    return times


def is_reset(engine: Engine) -> bool:
    """Try to resume after a trip; False while the overload is still detected."""
    connection = engine._connection
    if connection is None or connection.rig.processor.force_N > REST_N:
        return False
    try:
        engine.acknowledge()
        engine.reset()
    except Refused:
        return False
    return True


def start(host: EngineHost, out: Path) -> None:
    """Start the test and wait for its set speed."""
    host.start(wire_test(), out, "benchmark", resume=False)
    host.engine.wait((RunState.RUNNING, *ENDED), 60.0)


def snapshot_delays_ms() -> list[float]:
    """Follow a test as a viewer; return the age of each revolution on arrival, ms."""
    client = Client(running_engines()[-1], "benchmark")
    ages: list[float] = []
    deadline = time.monotonic() + SECONDS
    try:
        while time.monotonic() < deadline:
            snapshot = client.poll()
            now = time.time()
            if snapshot is not None and snapshot.rows:
                rows = as_array(snapshot.rows, "<f8").reshape(-1, len(BASE.names))
                ages.extend(1000.0 * (now - rows[:, BASE.place["host_time"]]))
            time.sleep(0.005)
    finally:
        client.close()
    return ages[2:]


def show(what: str, values: list[float]) -> float:
    """Print one line; return the 99th percentile."""
    p99 = float(np.percentile(values, 99))
    print(
        f"{what:44s} median {statistics.median(values):7.2f} ms   p99 {p99:7.2f} ms"
        f"   largest {max(values):7.2f} ms   n = {len(values)}"
    )
    return p99


def main() -> None:
    """Print the table."""
    trips = memory_trips()
    show("trip to drive-off, in memory", trips)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["RIGAPP_RUNTIME_DIR"] = f"{folder}/run"
        host = EngineHost(read_rig(ROOT / "examples" / "simulated.toml"), 1.0)
        try:
            wire: list[float] = []
            start(host, Path(folder) / "t.h5")
            ages = snapshot_delays_ms()
            for number in range(WIRE_TRIPS):
                if number:
                    eventually(lambda: is_reset(host.engine), 20.0)
                    start(host, Path(folder) / f"{number}.h5")
                connection = host.engine._connection
                assert connection is not None
                devices = connection.devices
                wire.append(trip_ms(host.engine, devices.source, devices.spindle))
        finally:
            host.close()
    measured("trip", show("trip to drive-off, over wire bytes", wire))
    measured("snapshot", show("end of revolution to snapshot at the viewer", ages))


if __name__ == "__main__":
    main()
