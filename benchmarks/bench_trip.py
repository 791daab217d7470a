"""Measure the time from an overload at the load cell to the drive's acknowledged off command.

Run with ``python benchmarks/bench_trip.py``. The simulated rig runs in real time in a process of
its own, at 60 rpm; the devices speak their bytes over ptys. The clock starts before the fault is
requested: the figure includes the simulation's own step, the wire, the driver, the engine and
the drive's reply.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path

from budgets import measured, size

from rigapp.config.loading import read_rig, read_test
from rigapp.engine.engine import Engine
from rigapp.schema.messages import RunState
from rigapp.service.simulated import SimulatedDevices

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
TRIPS = size(7, 1)


def trip(engine: Engine, devices: SimulatedDevices, path: Path) -> float:
    """Run until the set speed is reached, overload the cell, return the seconds to drive-off."""
    connection = engine._connection
    assert connection is not None
    spindle = connection.devices.spindle
    off = spindle.drive_off
    done: list[float] = []

    def timed() -> None:
        off()
        done.append(time.monotonic())

    spindle.drive_off = timed  # type: ignore[method-assign]
    try:
        engine.start(read_test(EXAMPLES / "quick.toml"), path, operator="benchmark")
        engine.wait((RunState.RUNNING,), 30.0)
        time.sleep(1.3)
        start = time.monotonic()
        devices.process.inject({"kind": "saturated_input", "device": "daq"})
        engine.wait((RunState.STOPPED, RunState.FAULT), 60.0)
    finally:
        spindle.drive_off = off  # type: ignore[method-assign]
    devices.process.clear("saturated_input")
    deadline = time.monotonic() + 10.0
    while any(alarm.active for alarm in engine.status().alarms):
        if time.monotonic() > deadline:
            raise SystemExit("the overload does not go away")
        time.sleep(0.05)
    engine.acknowledge(operator="benchmark")
    engine.reset("benchmark")
    return done[0] - start


def main() -> None:
    """Print the median and the longest of some trips, and the ratio to the budget."""
    rig = read_rig(EXAMPLES / "simulated.toml")
    devices = SimulatedDevices(rig, 1.0)
    engine = Engine(rig, ports=devices.ports(read_test(EXAMPLES / "quick.toml").record.model))
    try:
        engine.connect()
        with tempfile.TemporaryDirectory() as folder:
            times = [trip(engine, devices, Path(folder) / f"{i}.h5") for i in range(TRIPS)]
    finally:
        engine.shutdown()
        devices.close()
    median, longest = statistics.median(times), max(times)
    print(f"overload to drive-off, {TRIPS} trips: median {median * 1e3:.0f} ms", end="")
    print(f", longest {longest * 1e3:.0f} ms")
    measured("trip_wire", 1e3 * longest)


if __name__ == "__main__":
    main()
