"""Golden frames, and a simulated CiA 402 drive with a motor on a pty."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from rigapp_drivers.cia402.driver import Cia402Drive
from rigapp_drivers.cia402.simulator import Cia402Simulator

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


@pytest.fixture
def drive_rig(wire: Any, harness: ModuleType) -> Callable[..., Any]:
    """Make a simulated drive on a pty: ``drive_rig(node_id=..., faults=[...])``."""
    make: Callable[..., Any] = harness.rig_maker(wire, Cia402Simulator)
    return make


@pytest.fixture
def connect(harness: ModuleType) -> Iterator[Callable[..., Cia402Drive]]:
    """Open and configure a driver on a rig: ``connect(rig, watchdog_s=1.0, SETTING=...)``."""
    connections = harness.Connections(Cia402Drive, 2.0, sleep_after_open_s=0.0)
    yield connections
    connections.close()


@pytest.fixture
def request_for(harness: ModuleType) -> Callable[..., Any]:
    """Return the function that makes a DriveRequest."""

    def make(watchdog_s: float = 2.0, **options: Any) -> Any:
        return harness.drive_request(watchdog_s, **options)

    return make
