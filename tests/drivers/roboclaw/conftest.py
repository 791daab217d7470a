"""Golden packets, and a simulated RoboClaw with a motor on a pty."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from rigapp_drivers.roboclaw.driver import RoboClaw
from rigapp_drivers.roboclaw.simulator import RoboClawSimulator

GOLDEN = Path(__file__).parents[2] / "data" / "roboclaw_golden.toml"


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give a test one row of a golden table by the name of its argument."""
    tables = tomllib.loads(GOLDEN.read_text())
    for argument, table in (("golden_write", "writes"), ("golden_read", "reads")):
        if argument in metafunc.fixturenames:
            rows = tables[table]
            names = [f"{row['command']}-{row.get('values', 'text')}" for row in rows]
            metafunc.parametrize(argument, rows, ids=names)


@pytest.fixture
def drive_rig(wire: Any, harness: ModuleType) -> Callable[..., Any]:
    """Make a simulated drive on a pty: ``drive_rig(firmware=..., faults=[...])``."""
    make: Callable[..., Any] = harness.rig_maker(wire, RoboClawSimulator)
    return make


@pytest.fixture
def connect(harness: ModuleType) -> Iterator[Callable[..., RoboClaw]]:
    """Open and configure a driver on a rig: ``connect(rig, watchdog_s=1.0, SETTING=...)``."""
    connections = harness.Connections(RoboClaw, 0.5)
    yield connections
    connections.close()


@pytest.fixture
def request_for(harness: ModuleType) -> Callable[..., Any]:
    """Return the function that makes a DriveRequest."""

    def make(watchdog_s: float = 0.5, **options: Any) -> Any:
        return harness.drive_request(watchdog_s, **options)

    return make
