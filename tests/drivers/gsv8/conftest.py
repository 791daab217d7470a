"""Fixtures for the GSV-8: a driver in front of a simulator on a pty."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from rigapp_drivers.api import Block, DataRequest
from rigapp_drivers.gsv8.driver import Gsv8
from rigapp_drivers.gsv8.simulator import Gsv8Simulator
from rigapp_drivers.simulator_api import RigSignals

BRIDGE_1, BRIDGE_2, VOLT_3, VOLT_4 = 0.5, -0.25, 2.5, -2.5
REVOLUTIONS_PER_SAMPLE = 1.0 / 480.0


def rig_signals(index: Any) -> RigSignals:
    """Return steady signals and a shaft that turns by 1/480 of a revolution a sample."""
    ones = np.ones(len(index))
    analog = {1: BRIDGE_1 * ones, 2: BRIDGE_2 * ones, 3: VOLT_3 * ones, 4: VOLT_4 * ones}
    return RigSignals(analog, np.asarray(index) * REVOLUTIONS_PER_SAMPLE)


def rig_request(rate: float = 960.0, **settings: Any) -> DataRequest:
    """Ask for the inputs of the rig: two bridges, two probes, the encoder."""
    inputs = {
        "analog_1": ("bridge", 3.5),
        "analog_2": ("bridge", 3.5),
        "analog_3": ("voltage", 10.0),
        "analog_4": ("voltage", 10.0),
        "counter_1": ("counter", 3600.0),
    }
    return DataRequest(rate, inputs, settings)


@dataclass
class Bench:
    """A simulator, its wire and clock, and the driver in front of it."""

    simulator: Gsv8Simulator
    wire: Any
    clock: Any
    driver: Gsv8

    def stream(self, rate: float = 960.0, **settings: Any) -> Any:
        """Open, configure for the rig and start; return the set-up."""
        self.driver.open()
        setup = self.driver.configure(rig_request(rate, **settings))
        self.driver.start()
        return setup

    def blocks(self, samples: int) -> list[Block]:
        """Read blocks until so many samples came."""
        blocks: list[Block] = []
        for _ in range(10_000):
            if sum(block.values.shape[1] for block in blocks) >= samples:
                return blocks
            block = self.driver.read(60.0)
            assert block is not None, "no block within 60 s"
            blocks.append(block)
        raise AssertionError("too many small blocks")


MakeBench = Callable[..., Bench]


@pytest.fixture
def bench(wire: Any) -> Iterator[MakeBench]:
    """Make benches: ``bench(speed=..., settings={...}, **simulator options)``."""
    drivers = []

    def make(
        speed: float = 1.0,
        settings: dict[str, Any] | None = None,
        tcp: bool = False,
        **options: Any,
    ) -> Bench:
        simulator = Gsv8Simulator(**options)
        line, clock = wire.source(simulator, rig_signals, speed, tcp=tcp)
        driver = Gsv8("daq", line.port, {"reply_timeout_s": 2.0, **(settings or {})})
        drivers.append(driver)
        return Bench(simulator, line, clock, driver)

    yield make
    for driver in drivers:
        driver.close()
