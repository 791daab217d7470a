"""Measure the DATAQ driver, bytes to Blocks, as a multiple of the device's own maximum rate.

Run with ``python benchmarks/bench_dataq.py``. One core; the driver's own stream reads a port in
memory that gives pieces of 4095 bytes (the kernel's buffer) or of 64 KiB, and returns Blocks of
20 ms at the device's maximum, 60 MHz / 375 = 160000 scans/s. A scan is four analog words and the
counter. The last line is the ratio of the budget.
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from budgets import measured, size

from rigapp_drivers.api import DataRequest, filled
from rigapp_drivers.dataq.link import Link
from rigapp_drivers.dataq.plan import Plan, make_plan
from rigapp_drivers.dataq.settings import SETTINGS
from rigapp_drivers.dataq.stream import Pace, Stream

SCANS = size(1_000_000, 20_000)
REPEATS = size(3, 1)
DEVICE_RATE = 160_000
CASES = {
    "DI-2108, internal clock": ({"model": 2108, "clock": "internal"}, 0),
    "DI-4108, encoder clock": ({"model": 4108, "clock": "encoder"}, 1),
}


class MemoryPort:
    """Port that returns prepared bytes in pieces, and the echo of every command."""

    device = "daq"
    port = "memory"
    is_open = True

    def __init__(self, stream: bytes, piece: int) -> None:
        self._stream, self._piece, self._place = stream, piece, -1
        self._echo = b""

    def open(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""

    def drain(self) -> bytes:
        """Return nothing: no bytes are pending."""
        return b""

    def write(self, data: bytes) -> None:
        """Start the stream, or echo."""
        if data.startswith(b"start"):
            self._place = 0
        else:
            self._echo = data

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return the next piece."""
        if self._echo:
            echo, self._echo = self._echo, b""
            return echo
        data = self._stream[self._place : self._place + self._piece]
        self._place += len(data)
        return data


def plan_of(settings: dict[str, object]) -> Plan:
    """Return the plan of four inputs and the counter, at the device's maximum rate."""
    inputs = {f"analog_{n}": ("voltage", 10.0) for n in (1, 2, 3, 4)}
    request = DataRequest(10_000.0, inputs | {"counter_1": ("counter", 900.0)})
    return replace(make_plan(request, filled(SETTINGS, settings)), sample_rate_Hz=DEVICE_RATE)


def stream_of(entries: int, step: int) -> bytes:
    """Return the bytes of the scans."""
    words = np.random.default_rng(1).integers(0, 65536, (SCANS, entries)).astype("<u2")
    words[:, -1] = (np.arange(SCANS) * step % 65536) ^ 0x8000
    return words.tobytes()


def best_rate(plan: Plan, data: bytes, piece: int) -> float:
    """Return the scans per second of the best of three runs over the stream."""
    best = 0.0
    for _ in range(REPEATS):
        port = MemoryPort(data, piece)
        stream = Stream(Link(port, 1.0, 0.0), plan, Pace(0.02, 60.0, 60.0))
        stream.start()
        count = 0
        begin = time.perf_counter()
        while block := stream.read(0.05):
            count += block.quality.size
            end = time.perf_counter()
        best = max(best, count / (end - begin))
        if stream.tally.gaps or count < SCANS - 10:
            raise SystemExit(f"only {count} of {SCANS} scans came back ({stream.tally})")
    return best


def main() -> None:
    """Print a line for each case and piece size, then the ratio of the budget."""
    slowest = float("inf")
    for title, (settings, step) in CASES.items():
        plan = plan_of(settings)
        data = stream_of(plan.layout.words, step)
        for piece in (4095, 65536):
            rate = best_rate(plan, data, piece)
            ratio = rate / DEVICE_RATE
            slowest = min(slowest, ratio)
            print(
                f"{title:24} pieces of {piece:5} bytes: {rate / 1e6:5.2f} M scans/s, "
                f"{ratio:5.0f} x the device's {DEVICE_RATE} /s"
            )
    measured("dataq", slowest)


if __name__ == "__main__":
    main()
