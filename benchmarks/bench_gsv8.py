"""Measure GSV-8 parsing as a multiple of the device's own maximum rate.

Run with ``python benchmarks/bench_gsv8.py``. One core; bytes as they come from a port (pieces of
4095 bytes, the kernel's buffer, and of 64 KiB) to (channels, samples) arrays with quality flags.
The budget is of float32 frames of four analog inputs and the
counter, against 12000 frames a second.
"""

from __future__ import annotations

import time

import numpy as np
from budgets import measured, size

from rigapp_drivers.gsv8.frames import FrameLayout, StreamParser, encode_frames
from rigapp_drivers.gsv8.numbers import DataType

SAMPLES = size(600_000, 6_000)
REPEATS = size(3, 1)
CASES = {
    "float32, 5 objects": (FrameLayout(5), 12_000),
    "float32, 5 objects, CRC-16": (FrameLayout(5, checksum=True), 12_000),
    "int24, 5 objects": (FrameLayout(5, DataType.INT24), 16_000),
    "int16, 4 objects": (FrameLayout(4, DataType.INT16), 48_000),
}


def best_rate(layout: FrameLayout, stream: bytes, piece: int) -> float:
    """Return the samples per second of the best of three runs over the stream."""
    best = 0.0
    for _ in range(REPEATS):
        parser = StreamParser(layout)
        count = 0
        start = time.perf_counter()
        for position in range(0, len(stream), piece):
            parsed = parser.feed(stream[position : position + piece])
            count += sum(run.values.shape[1] for run in parsed.runs)
        best = max(best, count / (time.perf_counter() - start))
        if count != SAMPLES:
            raise SystemExit(f"only {count} of {SAMPLES} samples came back")
    return best


def main() -> None:
    """Print a line for each format and piece size, then the ratio of the budget."""
    rng = np.random.default_rng(1)
    slowest = float("inf")
    for title, (layout, device_rate) in CASES.items():
        values = rng.uniform(-3.0, 3.0, (layout.objects, SAMPLES))
        if layout.data_type is not DataType.FLOAT32:
            values = np.round(values * 1000)
        start = time.perf_counter()
        stream = encode_frames(values, layout).tobytes()
        encoded = SAMPLES / (time.perf_counter() - start)
        for piece in (4095, 65536):
            rate = best_rate(layout, stream, piece)
            ratio = rate / device_rate
            print(
                f"{title:28} pieces of {piece:5} bytes: {rate / 1e6:5.2f} M samples/s, "
                f"{ratio:5.0f} x the device's {device_rate} /s (encoding {encoded / 1e6:.2f} M/s)"
            )
            if layout == FrameLayout(5):
                slowest = min(slowest, ratio)
    measured("gsv8", slowest)


if __name__ == "__main__":
    main()
