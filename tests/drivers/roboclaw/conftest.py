"""Golden packets, and a simulated RoboClaw with a motor on a pty."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from drivers.api import DriveCommand, DriveMode, DriveRequest, MotorState
from drivers.roboclaw.driver import RoboClaw
from drivers.roboclaw.simulator import RoboClawSimulator

COUNTS = 3600
GOLDEN = Path(__file__).parents[2] / "data" / "roboclaw_golden.toml"


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give a test one row of a golden table by the name of its argument."""
    tables = tomllib.loads(GOLDEN.read_text())
    for argument, table in (("golden_write", "writes"), ("golden_read", "reads")):
        if argument in metafunc.fixturenames:
            rows = tables[table]
            names = [f"{row['command']}-{row.get('values', 'text')}" for row in rows]
            metafunc.parametrize(argument, rows, ids=names)


@dataclass
class Rig:
    """A simulated drive whose motor follows it exactly, on a wire."""

    simulator: RoboClawSimulator
    wire: Any
    port: str
    commands: list[DriveCommand] = field(default_factory=list)

    @property
    def last(self) -> DriveCommand:
        """Return what drives the motor now."""
        return self.commands[-1]


class Motor:
    """Turn as the drive wants, without inertia: duty 1 is 40000 counts/s."""

    def __init__(self, simulator: RoboClawSimulator) -> None:
        self.simulator = simulator
        self.commands: list[DriveCommand] = [DriveCommand(DriveMode.OFF)]
        self._position = 0.0
        self._last: float | None = None

    def __call__(self, now_s: float) -> bytes:
        """Advance to now, and return what the drive sends."""
        elapsed = 0.0 if self._last is None else now_s - self._last
        self._last = now_s
        command = self.simulator.command(elapsed, now_s)
        self.commands.append(command)
        speed = command.speed_count_per_s + command.duty * 40000.0
        self._position += speed * elapsed
        self.simulator.observe(MotorState(int(self._position), speed, abs(speed) * 1e-4))
        return self.simulator.emit(now_s)


@pytest.fixture
def drive_rig(wire: Any) -> Callable[..., Rig]:
    """Make a simulated drive on a pty: ``drive_rig(firmware=..., faults=[...])``."""

    def make(**options: Any) -> Rig:
        simulator = RoboClawSimulator(**options)
        motor = Motor(simulator)
        made = wire(simulator.receive, motor)
        return Rig(simulator, made, made.port, motor.commands)

    return make


@pytest.fixture
def connect() -> Iterator[Callable[..., RoboClaw]]:
    """Open and configure a driver on a rig: ``connect(rig, watchdog_s=0.5, motor=1)``."""
    opened: list[RoboClaw] = []

    def make(
        rig: Rig, *, watchdog_s: float = 0.5, simulated: bool = True, **settings: Any
    ) -> RoboClaw:
        driver = RoboClaw("drive", rig.port, settings)
        opened.append(driver)
        driver.open()
        driver.configure(drive_request(watchdog_s, simulated=simulated))
        return driver

    yield make
    for driver in opened:
        driver.close()


def drive_request(
    watchdog_s: float = 0.5, direction: int = 1, *, simulated: bool = True
) -> DriveRequest:
    """Return a request for 3600 counts a revolution and at most 12 rev/s."""
    return DriveRequest(COUNTS, direction, 12.0, watchdog_s, simulated=simulated)


@pytest.fixture
def request_for() -> Callable[..., DriveRequest]:
    """Return the function that makes a DriveRequest."""
    return drive_request
