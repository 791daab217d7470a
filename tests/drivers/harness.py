"""A device on a pty: a thread carries bytes between a simulator and whoever opens the port.

Reached through the fixtures ``wire`` and ``wait_until`` of ``tests/drivers/conftest.py``::

    device = wire(simulator.receive)                      # answers only
    device = wire(simulator.receive, simulator.emit)      # sends by itself, too
    port = device.port                                    # path to open

``wire.source(simulator, signals)`` runs a simulated data source on the clock; ``rig_maker`` and
``Connections`` put a simulated drive with a motor, and drivers in front of it, on a wire.
"""

from __future__ import annotations

import contextlib
import os
import select
import socket
import threading
import time
import tty
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rigapp.process.processclock import ProcessClock
from rigapp_drivers.api import DriveRequest
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState

Respond = Callable[[bytes, float], bytes]
Produce = Callable[[float], bytes]

COUNTS = 3600
DUTY_COUNTS_PER_S = 40000.0
PERIOD_S = 0.002
LINK_BYTES = 1 << 16


class Wire:
    """One simulated device on one pty, or behind a TCP port as ``socket://``.

    The device lives on its own time: a computer that stands still lets no watchdog fire.
    """

    def __init__(
        self,
        respond: Respond,
        produce: Produce | None = None,
        overrun: Callable[[float], None] | None = None,
        *,
        tcp: bool = False,
    ) -> None:
        self.received = bytearray()
        self.failure: BaseException | None = None
        self._respond, self._produce, self._overrun = respond, produce, overrun
        self._waiting = bytearray()
        self._stopping = threading.Event()
        self._device, self._host = -1, -1
        self._server: socket.socket | None = None
        if tcp:
            self._server = socket.create_server(("127.0.0.1", 0))
            self.port = f"socket://127.0.0.1:{self._server.getsockname()[1]}"
        else:
            self._device, self._host = os.openpty()
            tty.setraw(self._device)
            tty.setraw(self._host)
            os.set_blocking(self._device, False)
            self.port = os.ttyname(self._host)
        self._thread = threading.Thread(target=self._run, name=f"wire {self.port}", daemon=True)
        self._thread.start()

    def unplug(self) -> None:
        """Take the device away: the host sees a broken connection."""
        self._stopping.set()
        self._thread.join(60.0)
        assert not self._thread.is_alive(), "the wire's thread did not end within 60 s"
        for descriptor in (self._device, self._host):
            with contextlib.suppress(OSError):
                os.close(descriptor)
        if self._server is not None:
            self._server.close()

    def close(self) -> None:
        """End the thread and say what went wrong in it."""
        self.unplug()
        if self.failure is not None:
            raise self.failure

    def send(self, data: bytes) -> None:
        """Put bytes on the wire, after what already waits."""
        self._waiting += data

    def _run(self) -> None:
        own = ProcessClock(time.monotonic(), time.thread_time())
        try:
            while self._server is not None and self._device < 0 and not self._stopping.is_set():
                self._accept(self._server)
            while not self._stopping.is_set():
                self._step(own.tick(time.monotonic(), time.thread_time(), PERIOD_S))
        except ConnectionError:
            return
        except BaseException as failure:
            self.failure = failure

    def _accept(self, server: socket.socket) -> None:
        if select.select([server], [], [], PERIOD_S)[0]:
            connection, _ = server.accept()
            connection.setblocking(False)
            self._device = connection.detach()

    def _step(self, now_s: float) -> None:
        writers = [self._device] if self._waiting else []
        ready, writable, _ = select.select([self._device], writers, [], PERIOD_S)
        if ready:
            data = os.read(self._device, 65536)
            if not data:
                raise ConnectionError("the host closed the connection")
            self.received += data
            self._waiting += self._respond(data, now_s)
        if self._produce is not None:
            self._waiting += self._produce(now_s)
        if len(self._waiting) > LINK_BYTES:
            assert self._overrun is not None, "the host does not read and nobody takes note"
            del self._waiting[: len(self._waiting) - LINK_BYTES]
            self._overrun(now_s)
        if writable or self._waiting:
            with contextlib.suppress(BlockingIOError):
                del self._waiting[: os.write(self._device, self._waiting[:16384])]


class Clock:
    """Feed a simulated data source with the samples that are due, speed times real time."""

    def __init__(self, simulator: Any, signals: Callable[[Any], Any], speed: float = 1.0) -> None:
        self._simulator, self._signals, self._speed = simulator, signals, speed
        self._last: float | None = None
        self._due = 1.0  # whoever asks finds a device that has converted a sample
        self.samples = 0

    def __call__(self, now_s: float) -> bytes:
        """Return the bytes of the samples that came due since the last call."""
        self._last = now_s if self._last is None else self._last
        self._due += (now_s - self._last) * self._speed * self._simulator.sample_rate_Hz
        self._last = now_s
        count = int(self._due)
        if count == 0:
            return b""
        self._due -= count
        index = np.arange(self.samples, self.samples + count)
        self.samples += count
        data: bytes = self._simulator.sample(self._signals(index), now_s)
        return data


class Wires:
    """Make wires and close them all at the end of a test."""

    def __init__(self) -> None:
        self._made: list[Wire] = []

    def __call__(
        self,
        respond: Respond,
        produce: Produce | None = None,
        overrun: Callable[[float], None] | None = None,
        *,
        tcp: bool = False,
    ) -> Wire:
        """Put a device on a new pty or TCP port."""
        wire = Wire(respond, produce, overrun, tcp=tcp)
        self._made.append(wire)
        return wire

    def source(
        self,
        simulator: Any,
        signals: Callable[[Any], Any],
        speed: float = 1.0,
        *,
        tcp: bool = False,
    ) -> tuple[Wire, Clock]:
        """Put a simulated data source on a new port; signals(sample indices) -> RigSignals."""
        clock = Clock(simulator, signals, speed)
        return self(simulator.receive, clock, simulator.overrun, tcp=tcp), clock

    def close(self) -> None:
        """Close all wires."""
        for wire in self._made:
            wire.close()


class Motor:
    """Turn as the drive wants, without inertia; duty 1 is 40000 counts/s."""

    def __init__(self, simulator: Any) -> None:
        self.simulator = simulator
        self.commands: list[DriveCommand] = [DriveCommand(DriveMode.OFF)]
        self.time_s = 0.0
        self._position = 0.0
        self._last: float | None = None

    def __call__(self, now_s: float) -> bytes:
        """Advance to now, and return what the drive sends."""
        elapsed = 0.0 if self._last is None else now_s - self._last
        self._last = now_s
        self.time_s += elapsed
        command = self.simulator.command(elapsed, now_s)
        self.commands.append(command)
        speed = command.speed_count_per_s + command.duty * DUTY_COUNTS_PER_S
        self._position += speed * elapsed
        self.simulator.observe(MotorState(int(self._position), speed, abs(speed) * 1e-4))
        data: bytes = self.simulator.emit(now_s)
        return data


@dataclass
class DriveRig:
    """A simulated drive whose motor follows it exactly, on a wire."""

    simulator: Any
    wire: Wire
    motor: Motor

    @property
    def port(self) -> str:
        """Return what a driver opens."""
        return self.wire.port

    @property
    def time_s(self) -> float:
        """Return the time that has passed for the drive."""
        return self.motor.time_s

    @property
    def commands(self) -> list[DriveCommand]:
        """Return what has driven the motor so far."""
        return self.motor.commands

    @property
    def last(self) -> DriveCommand:
        """Return what drives the motor now."""
        return self.commands[-1]

    @property
    def speed_rpm(self) -> float:
        """Return the set-point that drives the motor now."""
        return self.last.speed_count_per_s / COUNTS * 60.0


def rig_maker(wire: Wires, simulated: Callable[..., Any]) -> Callable[..., DriveRig]:
    """Return what makes a simulated drive on a pty from the options of its simulator."""

    def make(**options: Any) -> DriveRig:
        simulator = simulated(**options)
        motor = Motor(simulator)
        return DriveRig(simulator, wire(simulator.receive, motor), motor)

    return make


def drive_request(
    watchdog_s: float,
    direction: int = 1,
    counts: int = COUNTS,
    *,
    gear_ratio: float = 1.0,
) -> DriveRequest:
    """Return a request for at most 12 rev/s."""
    return DriveRequest(counts, direction, 12.0, watchdog_s, gear_ratio=gear_ratio)


class Connections:
    """Open and configure drivers: ``connect(rig, watchdog_s=1.0, SETTING=...)``; close them all.

    factory: makes a driver from name, port and settings. defaults: settings of every one.
    """

    def __init__(self, factory: Callable[..., Any], watchdog_s: float, **defaults: Any) -> None:
        self._factory = factory
        self._watchdog_s = watchdog_s
        self._defaults = defaults
        self._opened: list[Any] = []

    def __call__(
        self,
        rig: DriveRig,
        *,
        watchdog_s: float | None = None,
        **settings: Any,
    ) -> Any:
        """Return a driver that is open and configured."""
        driver = self._factory("drive", rig.port, {**self._defaults, **settings})
        self._opened.append(driver)
        driver.open()
        time_s = self._watchdog_s if watchdog_s is None else watchdog_s
        driver.configure(drive_request(time_s))
        return driver

    def close(self) -> None:
        """Close all drivers."""
        for driver in self._opened:
            driver.close()


def wait_until(condition: Callable[[], bool], what: str, timeout_s: float = 60.0) -> None:
    """Wait for a condition; fail the test with what was waited for."""
    deadline = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < deadline, f"waited {timeout_s:g} s in vain: {what}"
        time.sleep(0.002)
