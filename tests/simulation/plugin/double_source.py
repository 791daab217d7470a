"""A third-party data source for the process tests: streams on S, stops on P, float32 frames.

A frame is the shaft angle in revolutions, then the analog inputs in the order of their numbers.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rigapp_drivers.api import DriverInfo, DriverKind, SettingSpec
from rigapp_drivers.simulator_api import RigSignals


class DoubleSimulator:
    """Implements drivers.simulator_api.SimulatedDataSource."""

    def __init__(self, *, sample_rate_Hz: float = 10.0, counts_per_revolution: int = 0) -> None:
        if counts_per_revolution != 3600:
            raise ValueError("the rig file's encoder did not arrive")
        self.sample_rate_Hz = sample_rate_Hz
        self.streaming = False

    def receive(self, data: bytes, now_s: float) -> bytes:
        for byte in data:
            self.streaming = {ord("S"): True, ord("P"): False}.get(byte, self.streaming)
        return b""

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        if not self.streaming:
            return b""
        rows = [signals.shaft_revolutions, *(signals.analog[k] for k in sorted(signals.analog))]
        return np.column_stack(rows).astype("<f4").tobytes()

    def overrun(self, now_s: float) -> None:
        pass


def _no_driver(name: str, port: str, settings: Any) -> Any:
    raise NotImplementedError("only the simulator of this double is used")


DRIVER = DriverInfo(
    name="double",
    title="Double of a data source",
    kind=DriverKind.DATA_SOURCE,
    factory=_no_driver,
    settings={"sample_rate_Hz": SettingSpec(float, 10.0, "Samples per second.", 1.0, 48000.0)},
    simulator="double_source:DoubleSimulator",
)
