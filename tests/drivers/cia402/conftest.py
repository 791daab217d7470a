"""Golden frames, and a simulated CiA 402 drive with a motor on a pty."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from drivers.api import DriveCommand, DriveMode, DriveRequest, MotorState
from drivers.cia402.driver import Cia402Drive
from drivers.cia402.simulator import Cia402Simulator

COUNTS = 3600
GOLDEN = Path(__file__).parents[2] / "data" / "cia402_golden.toml"


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give a test one golden transfer by the name of its argument."""
    for argument, by_client in (("golden_transfer", False), ("client_transfer", True)):
        if argument in metafunc.fixturenames:
            rows = tomllib.loads(GOLDEN.read_text())["transfers"]
            rows = [row for row in rows if not by_client or row.get("client", True)]
            metafunc.parametrize(argument, rows, ids=[row["meaning"] for row in rows])


@pytest.fixture
def golden_states() -> list[dict[str, str]]:
    """Return the golden walk through the state machine."""
    rows: list[dict[str, str]] = tomllib.loads(GOLDEN.read_text())["states"]
    return rows


@dataclass
class Rig:
    """A simulated drive whose motor follows it exactly, on a wire."""

    simulator: Cia402Simulator
    wire: Any
    port: str
    commands: list[DriveCommand] = field(default_factory=list)

    @property
    def last(self) -> DriveCommand:
        """Return what drives the motor now."""
        return self.commands[-1]

    @property
    def speed_rpm(self) -> float:
        """Return the set-point that drives the motor now."""
        return self.last.speed_count_per_s / COUNTS * 60.0


class Motor:
    """Turn as the drive wants, without inertia."""

    def __init__(self, simulator: Cia402Simulator) -> None:
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
        self._position += command.speed_count_per_s * elapsed
        speed = command.speed_count_per_s
        self.simulator.observe(MotorState(int(self._position), speed, abs(speed) * 1e-4))
        return self.simulator.emit(now_s)


@pytest.fixture
def drive_rig(wire: Any) -> Callable[..., Rig]:
    """Make a simulated drive on a pty: ``drive_rig(node_id=..., faults=[...])``."""

    def make(**options: Any) -> Rig:
        simulator = Cia402Simulator(**options)
        motor = Motor(simulator)
        made = wire(simulator.receive, motor)
        return Rig(simulator, made, made.port, motor.commands)

    return make


@pytest.fixture
def connect() -> Iterator[Callable[..., Cia402Drive]]:
    """Open and configure a driver on a rig: ``connect(rig, watchdog_s=1.0, node_id=1)``."""
    opened: list[Cia402Drive] = []

    def make(
        rig: Rig, *, watchdog_s: float = 2.0, simulated: bool = True, **settings: Any
    ) -> Cia402Drive:
        driver = Cia402Drive("drive", rig.port, {"sleep_after_open_s": 0.0, **settings})
        opened.append(driver)
        driver.open()
        driver.configure(drive_request(watchdog_s, simulated=simulated))
        return driver

    yield make
    for driver in opened:
        driver.close()


def drive_request(
    watchdog_s: float = 2.0, direction: int = 1, counts: int = COUNTS, *, simulated: bool = True
) -> DriveRequest:
    """Return a request for at most 12 rev/s."""
    return DriveRequest(counts, direction, 12.0, watchdog_s, simulated=simulated)


@pytest.fixture
def request_for() -> Callable[..., DriveRequest]:
    """Return the function that makes a DriveRequest."""
    return drive_request
