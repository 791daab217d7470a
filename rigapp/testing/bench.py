"""Test bench: a driver connected to its simulator by a wire with faults, and the true values."""

from __future__ import annotations

import contextlib
import select
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.process.processclock import DEVICE_SHARE, ProcessClock
from rigapp.simulation.wire.link import SimulatedWire, WireFault
from rigapp.simulation.wire.ports import port_at
from rigapp.testing.contracts import Contract, ExpectedFault
from rigapp_drivers.api import (
    Block,
    DataRequest,
    DataSource,
    DeviceError,
    DriveRequest,
    Quality,
    SlowRequest,
    SlowSource,
    Spindle,
    StreamSetup,
)
from rigapp_drivers.registry import check_settings, load_simulator
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState, RigSignals

PATIENCE = 3.0
"""Factor on the contract's times, for a busy computer."""
PERIOD = 480
"""Samples per revolution; the first analog input encodes the index of a sample."""
COUNTS = 3600
SPAN = 0.9
TOLERANCE = 2e-3
WATCHDOG_S = 0.5
STEP_S = 0.001
Produce = Callable[[float], bytes]


def wait_until(condition: Callable[[], bool], what: str, timeout_s: float = 60.0) -> None:
    """Wait for a condition; fail with its description."""
    deadline = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < deadline, f"waited {timeout_s:g} s in vain: {what}"
        time.sleep(0.002)


class Port:
    """One simulated device on a port whose name persists when the cable is pulled.

    time_s: the device's time, which advances only while this process runs.
    """

    def __init__(self, simulator: Any, link: Path, produce: Produce, *, streams: bool) -> None:
        self.wire = SimulatedWire(port_at(link))
        self.url = self.wire.endpoint.url
        self.failure: BaseException | None = None
        self.received = bytearray()
        self.time_s = 0.0
        self._simulator, self._produce, self._streams = simulator, produce, streams
        self._stopping = threading.Event()
        self._lock = threading.Lock()
        self._thread = threading.Thread(target=self._run, name=f"port {link.name}", daemon=True)
        self._thread.start()

    def start_fault(self, fault: ExpectedFault) -> None:
        """Begin a fault of the wire or of the device."""
        with self._lock:
            if fault.layer == "wire":
                self.wire.start_fault(WireFault(fault.kind), fault.value or 0.0)
                return
            data = {"value": fault.value, "count": fault.count}
            self._simulator.inject(fault.kind, **{k: v for k, v in data.items() if v is not None})

    def stop_fault(self, fault: ExpectedFault) -> None:
        """End a fault."""
        with self._lock:
            if fault.layer == "wire":
                self.wire.stop_fault(WireFault(fault.kind))
            else:
                self._simulator.clear(fault.kind)

    def close(self) -> None:
        """Stop the device and raise its error, if any."""
        self._stopping.set()
        self._thread.join(60.0)
        self.wire.close()
        if self.failure is not None:
            raise self.failure

    def _run(self) -> None:
        own = ProcessClock(time.monotonic(), time.thread_time(), DEVICE_SHARE)
        try:
            while not self._stopping.is_set():
                with self._lock:
                    self.time_s = own.tick(time.monotonic(), time.thread_time(), STEP_S)
                    self._step(self.time_s)
                    waitable = self.wire.endpoint.waitable()
                with contextlib.suppress(OSError):  # a fault has closed it in the meantime
                    select.select(waitable, [], [], STEP_S)
        except BaseException as failure:
            self.failure = failure

    def _step(self, now_s: float) -> None:
        self.wire.connected()
        data = self.wire.receive()
        self.received += data
        if data:
            self.wire.send(self._simulator.receive(data, now_s), now_s, droppable=False)
        made = self._produce(now_s)
        if not self.wire.send(made, now_s, droppable=self._streams):
            self._simulator.overrun(now_s)
        self.wire.flush(now_s)


# --- slow sources -------------------------------------------------------------------------------


class SlowBench:
    """A slow source, its simulator, and a distinct value of each quantity."""

    def __init__(self, contract: Contract, link: Path, settings: dict[str, Any]) -> None:
        self.contract = contract
        self.simulator = make_simulator(contract, contract.simulator)
        self.truth = {
            name: 20.0 + 7.0 * index for index, name in enumerate(contract.info.quantities)
        }
        self.simulator.observe(self.truth)
        later = partial(self.simulator.receive, b"")
        self.port = Port(self.simulator, link, later, streams=False)
        self.settings = check_settings(contract.info, contract.settings | settings, "contract")
        self.driver = self.make()

    def make(self) -> SlowSource:
        """Return a new driver on the port."""
        driver = self.contract.info.factory("climate", self.port.url, self.settings)
        assert isinstance(driver, SlowSource)
        return driver

    def connect(self) -> None:
        """Open and configure."""
        identity = self.driver.open()
        assert identity.model
        assert identity.port == self.port.url
        request = SlowRequest(tuple(self.truth), settings=self.settings)
        assert set(self.truth) <= set(self.driver.configure(request))

    def close(self) -> None:
        """Close driver and device."""
        self.driver.close()
        self.port.close()


# --- data sources -------------------------------------------------------------------------------


class Feed:
    """Feed a simulated data source in real time; each sample of a turn has distinct values."""

    def __init__(self, simulator: Any, inputs: dict[str, tuple[str, float]]) -> None:
        self._simulator = simulator
        self._ranges = {
            int(name.removeprefix("analog_")): span
            for name, (kind, span) in inputs.items()
            if kind != "counter"
        }
        self._last: float | None = None
        self._due = 0.0
        self.samples = 0

    def __call__(self, now_s: float) -> bytes:
        """Return the bytes of the samples that are due."""
        self._last = now_s if self._last is None else self._last
        self._due += (now_s - self._last) * self._simulator.sample_rate_Hz
        self._last = now_s
        count = int(self._due)
        self._due -= count
        index = np.arange(self.samples, self.samples + count)
        self.samples += count
        analog = {
            number: span * truth(row, index)
            for row, (number, span) in enumerate(self._ranges.items())
        }
        data: bytes = self._simulator.sample(RigSignals(analog, index / PERIOD), now_s)
        return data


def truth(row: int, index: NDArray[Any]) -> NDArray[np.float64]:
    """Return the true signal of the analog input with index ``row``, as a fraction of its range."""
    turn = (np.asarray(index) % PERIOD) / PERIOD
    if row == 0:
        return np.asarray(SPAN * (2.0 * turn - 1.0))
    return np.asarray(SPAN * np.cos(2.0 * np.pi * turn + row))


class SourceBench:
    """A data source, its simulator, and the check of its samples."""

    def __init__(self, contract: Contract, link: Path, settings: dict[str, Any]) -> None:
        self.contract = contract
        facts = {"counts_per_revolution": COUNTS} | contract.simulator
        self.simulator = make_simulator(contract, facts)
        self.feed = Feed(self.simulator, contract.inputs)
        self.port = Port(self.simulator, link, self.feed, streams=True)
        self.settings = check_settings(contract.info, contract.settings | settings, "contract")
        self.driver = self.make()
        self.setup: StreamSetup | None = None

    def make(self) -> DataSource:
        """Return a new driver on the port."""
        driver = self.contract.info.factory("daq", self.port.url, self.settings)
        assert isinstance(driver, DataSource)
        return driver

    def connect(self) -> None:
        """Open, configure and start."""
        identity = self.driver.open()
        assert identity.model
        assert identity.port == self.port.url
        request = DataRequest(self.contract.sample_rate_Hz, self.contract.inputs, self.settings)
        self.setup = self.driver.configure(request)
        assert {spec.name for spec in self.setup.channels} >= set(self.contract.inputs)
        assert self.setup.sample_rate_Hz == self.contract.sample_rate_Hz
        self.driver.start()

    def blocks(self, samples: int, timeout_s: float = 60.0) -> list[Block]:
        """Read until ``samples`` samples were received."""
        blocks: list[Block] = []
        deadline = time.monotonic() + timeout_s
        while sum(block.values.shape[1] for block in blocks) < samples:
            assert time.monotonic() < deadline, f"no {samples} samples in {timeout_s:g} s"
            block = self.driver.read(0.1)
            if block is not None:
                blocks.append(block)
        return blocks

    def judge(self, blocks: list[Block], *, gaps: bool = False) -> None:
        """Compare every sample without a flag with the simulator's input.

        gaps: samples may be missing without a report if the encoder's count shows it.
        """
        assert self.setup is not None
        rows = [spec.name for spec in self.setup.channels]
        for block in blocks:
            assert block.values.shape == (len(rows), len(block.quality))
            sound = (block.quality & ~np.uint8(Quality.LOST_BEFORE)) == 0
            index = self._index(block, rows)
            for row, name in enumerate(n for n in self.contract.inputs if "analog" in n):
                signal = self._electrical(block, rows.index(name)) / self.contract.inputs[name][1]
                wrong = sound & (np.abs(signal - truth(row, index)) > TOLERANCE)
                assert not wrong.any(), f"{name}: wrong samples accepted as good: {signal[wrong]}"
            steps = np.diff(index) % PERIOD
            unflagged = (block.quality == 0)[1:] & sound[:-1]
            in_order = steps == 1
            assert gaps or in_order[unflagged].all(), f"samples are missing without a flag: {steps}"
            within_turn = unflagged & (index[1:] != 0) & in_order
            for name in (n for n in self.contract.inputs if "counter" in n):
                counts = np.diff(self._electrical(block, rows.index(name)))[within_turn]
                assert (np.abs(counts - COUNTS / PERIOD) <= 1.0).all(), f"{name} steps by {counts}"

    def _electrical(self, block: Block, row: int) -> NDArray[np.float64]:
        assert self.setup is not None
        spec = self.setup.channels[row]
        return np.asarray(block.values[row].astype(np.float64) * spec.scale + spec.offset)

    def _index(self, block: Block, rows: list[str]) -> NDArray[np.int64]:
        name = next(name for name in self.contract.inputs if "analog" in name)
        part = self._electrical(block, rows.index(name)) / self.contract.inputs[name][1]
        return np.rint((part / SPAN + 1.0) / 2.0 * PERIOD).astype(np.int64) % PERIOD

    def close(self) -> None:
        """Close driver and device."""
        self.driver.close()
        self.port.close()


# --- spindles -----------------------------------------------------------------------------------


class Motor:
    """A motor without inertia that follows the drive's command."""

    def __init__(self, simulator: Any) -> None:
        self._simulator = simulator
        self.command = DriveCommand(DriveMode.OFF)
        self.speed_count_per_s = 0.0
        self.standstill_s = 0.0
        self._position = 0.0
        self._last: float | None = None

    def __call__(self, now_s: float) -> bytes:
        """Advance to now and return the bytes sent by the drive."""
        if self.speed_count_per_s:
            self.standstill_s = now_s
        elapsed = 0.0 if self._last is None else now_s - self._last
        self._last = now_s
        self.command = command = self._simulator.command(elapsed, now_s)
        self.speed_count_per_s = command.speed_count_per_s + command.duty * 40000.0
        self._position += self.speed_count_per_s * elapsed
        current = abs(self.speed_count_per_s) * 1e-4
        self._simulator.observe(MotorState(int(self._position), self.speed_count_per_s, current))
        data: bytes = self._simulator.emit(now_s)
        return data


class SpindleBench:
    """A spindle driver, its simulator, and a motor that follows it."""

    def __init__(self, contract: Contract, link: Path, settings: dict[str, Any]) -> None:
        self.contract = contract
        facts = {"counts_per_revolution": COUNTS} | contract.simulator
        self.simulator = make_simulator(contract, facts)
        self.motor = Motor(self.simulator)
        self.port = Port(self.simulator, link, self.motor, streams=False)
        self.settings = check_settings(contract.info, contract.settings | settings, "contract")
        self.driver = self.make()
        self.counts_per_crank_revolution = float(COUNTS)

    def make(self) -> Spindle:
        """Return a new driver on the port."""
        driver = self.contract.info.factory("drive", self.port.url, self.settings)
        assert isinstance(driver, Spindle)
        return driver

    def connect(self, watchdog_s: float = WATCHDOG_S, gear_ratio: float = 1.0) -> None:
        """Open and configure."""
        identity = self.driver.open()
        assert identity.maker
        assert identity.port == self.port.url
        self.counts_per_crank_revolution = COUNTS * gear_ratio
        request = DriveRequest(COUNTS, 1, 12.0, watchdog_s, self.settings, gear_ratio=gear_ratio)
        readback = self.driver.configure(request)
        assert 0.0 < float(readback["watchdog_timeout_s"]) <= watchdog_s

    def turn(self, speed: float = 2.0) -> None:
        """Command a speed in rev/s and check that the motor reaches it."""
        self.driver.set_speed(speed, 1000.0)

        def turns() -> bool:
            self.driver.status()  # feeds the watchdog
            target = speed * self.counts_per_crank_revolution
            return abs(self.motor.speed_count_per_s - target) < 1.0

        wait_until(turns, f"the motor to turn at {speed} rev/s")

    def in_background(self, call: Callable[[], None]) -> threading.Thread:
        """Start a slow call in a thread; its errors are ignored."""

        def run() -> None:
            with contextlib.suppress(DeviceError):
                call()

        thread = threading.Thread(target=run, name="call", daemon=True)
        thread.start()
        return thread

    def is_safe(self) -> bool:
        """Return whether the motor is stationary and not driven."""
        return self.motor.speed_count_per_s == 0.0 and self.motor.command.duty == 0.0

    def stops_within(self, seconds: float, since_s: float, what: str) -> None:
        """Wait until the spindle is safe; fail if it takes longer, by the drive's clock."""
        wait_until(self.is_safe, what)
        took_s = self.motor.standstill_s - since_s
        assert took_s <= seconds, f"{what}: {took_s:.2f} s instead of {seconds:g} s"

    def close(self) -> None:
        """Close driver and device."""
        with contextlib.suppress(Exception):
            self.driver.drive_off()
        self.driver.close()
        self.port.close()


def make_simulator(contract: Contract, facts: dict[str, Any]) -> Any:
    """Return the driver's simulator with those facts for which it has parameters."""
    import inspect

    simulator = load_simulator(contract.info)
    known = inspect.signature(simulator).parameters
    return simulator(**{key: value for key, value in facts.items() if key in known})
