"""A simulated instrument on a pty, whose first input tells the true shaft angle in volts."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from rigapp_drivers.api import Block, DataRequest, Quality
from rigapp_drivers.dataq.driver import Dataq
from rigapp_drivers.dataq.simulator import DataqSimulator
from rigapp_drivers.simulator_api import RigSignals

LINES = 900
VOLTS_PER_REVOLUTION = 0.25
SPEED = 3.0
PATIENT = {"silence_s": 60.0, "idle_check_s": 60.0}
"""While the shaft turns, silence is a busy computer's: a device that is asked whether it lives does
not scan meanwhile. Tests of silence set their own."""


class Shaft:
    """Turn at a speed that a test may change; analog 1 is proportional to the angle."""

    def __init__(self, simulator: DataqSimulator, rev_per_s: float) -> None:
        self.rev_per_s = rev_per_s
        self.revolutions = -36.0001  # -9 V; +9 V is 8 s away
        self._simulator = simulator

    def __call__(self, index: np.ndarray) -> RigSignals:
        step = self.rev_per_s / self._simulator.sample_rate_Hz
        shaft = self.revolutions + step * np.arange(1, index.size + 1)
        self.revolutions = float(shaft[-1])
        return RigSignals({1: VOLTS_PER_REVOLUTION * shaft, 2: np.cos(50.0 * shaft)}, shaft)


@dataclass
class Bench:
    """A driver on a simulated instrument; ``blocks`` keeps what was read."""

    simulator: DataqSimulator
    driver: Dataq
    wire: Any
    shaft: Shaft
    clock: str
    blocks: list[Block] = field(default_factory=list)

    def configure(self, rate_Hz: float = 960.0, **settings: Any) -> Any:
        inputs = {
            "analog_1": ("voltage", 10.0),
            "analog_2": ("voltage", 10.0),
            "counter_1": ("counter", float(LINES)),
        }
        return self.driver.configure(DataRequest(rate_Hz, inputs, settings))

    def read(self, timeout_s: float = 1.0) -> Block | None:
        block = self.driver.read(timeout_s)
        if block is not None:
            self.blocks.append(block)
        return block

    def read_until(self, condition: Callable[[], bool], what: str) -> None:
        for _ in range(600):
            if condition():
                return
            self.read(0.05)
        raise AssertionError(f"waited in vain: {what}; {self.driver.tally}")

    @property
    def samples(self) -> int:
        return sum(block.quality.size for block in self.blocks)

    @property
    def gaps(self) -> list[Block]:
        return [block for block in self.blocks if block.lost_before]

    def rest(self) -> None:
        """Stop, and read what came before."""
        self.driver.stop()
        while self.read(0.0) is not None:
            pass

    def check(self, *, slipped: bool = False) -> None:
        """Require that no sample is wrong: volts and count tell the same angle all along."""
        volts_per_line = VOLTS_PER_REVOLUTION / LINES
        origin = None
        expected = 0
        for sequence, block in enumerate(self.blocks):
            assert block.sequence == sequence
            assert block.first_sample == expected + block.lost_before
            expected = block.first_sample + block.quality.size
            if block.quality.size == 0:
                continue  # a sign of life
            if block.lost_before:
                assert block.quality[0] & Quality.LOST_BEFORE
                origin = None if slipped else origin
            volts = block.values[0] * 10.0 / 32768.0
            apart = volts - block.values[2] * volts_per_line
            origin = apart[0] if origin is None else origin
            assert np.abs(apart - origin).max() < 2.5e-3
            assert np.abs(block.values[1]).max() <= 3280


@pytest.fixture(params=["internal", "encoder"])
def clock(request: pytest.FixtureRequest) -> str:
    """Run a test with both clocks."""
    return str(request.param)


@pytest.fixture
def bench(wire: Any, clock: str) -> Iterator[Callable[..., Bench]]:
    """Make a bench: ``bench(model=4108, rev_per_s=3.0, faults=[...])``; driver opened."""
    opened: list[Dataq] = []

    def make(model: int = 2108, rev_per_s: float = 3.0, **options: Any) -> Bench:
        settings = {
            "model": model,
            "clock": clock,
            "command_pause_s": 0.0,
            "reply_timeout_s": 1.0,
            **PATIENT,
            **options.pop("settings", {}),
        }
        simulator = DataqSimulator(model, counts_per_revolution=LINES, **options)
        shaft = Shaft(simulator, rev_per_s)
        line, _ = wire.source(simulator, shaft, SPEED)
        driver = Dataq("daq", line.port, settings)
        opened.append(driver)
        driver.open()
        return Bench(simulator, driver, line, shaft, clock)

    yield make
    for driver in opened:
        driver.close()
