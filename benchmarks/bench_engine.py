"""Measure the engine's path of a sample: ingest, reduce, evaluate and store, on one core.

Run with ``python benchmarks/bench_engine.py``. Revolutions of 3600 samples x 5 channels come in
Blocks of 20 ms as a driver hands them over, and go through the same objects as in a test: overload
check, assembler, latency correction, calibration, statistics, rules, real HDF5 file with a commit a
second, every tenth whole cycle kept. Nothing is written to the screen and no twin runs.

The budget is a multiple of the fastest data acquisition. The GSV-8 sends at most 12,000 (float32)
or 16,000 (integer) frames a second with a counter, 48,000 without.
"""

from __future__ import annotations

import os
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from budgets import measured, median_s, size

from rigapp.config.recipe import CyclesSection, LimitRule
from rigapp.engine.judging.limits import RuleMonitor
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.processing import Processor
from rigapp.engine.recording.history import History
from rigapp.engine.recording.recorder import Recorder
from rigapp.engine.samples.assembler import Assembler, EncoderSetup, Revolution
from rigapp.engine.values.calibrate import Calibration, Measured
from rigapp.engine.values.instruments import Counter, LoadCell, ProbePair, Wire
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.storage import FilePlan, TestMetadata, create_test
from rigapp_drivers.api import Block

SAMPLES = 3600
RATE = 3600.0
REVOLUTIONS = size(2000, 20)
REPEATS = size(3, 1)
DEVICES = {"GSV-8 with counter, float32": 12_000, "GSV-8 without counter, int16": 48_000}
KEEP = 10


def calibration() -> Calibration:
    """Return a full calibration with a latency that is not a whole number of samples."""
    latency_s = 1.1e-3
    table = ChannelTable(tuple(replace(channel, latency_s=latency_s) for channel in BASE.channels))
    wires = tuple(Wire(c, row, c.signal_unit) for row, c in enumerate(table.sampled))
    return Calibration(
        table=table,
        wires=wires,
        counter=Counter(len(wires)),
        encoder=EncoderSetup(3600),
        index_angle_rad=0.0,
        sample_rate_Hz=RATE,
        load_cell=LoadCell(np.array([[200.0, 3.0], [-2.0, 195.0]]), np.array([0.01, 0.02])),
        probes=ProbePair(np.array([100.0, 100.0])),
        scalars={},
    )


def stream(samples: int) -> list[Block]:
    """Return the Blocks of ``samples`` of one revolution, to be sent repeatedly."""
    rng = np.random.default_rng(1)
    angle = 2 * np.pi * np.arange(SAMPLES) / SAMPLES
    values = np.empty((5, SAMPLES), np.float32)
    values[0], values[1] = 0.4 * np.cos(angle), 0.4 * np.sin(angle)
    values[2], values[3] = 0.1 * np.cos(angle), 0.1 * np.sin(angle)
    values[:4] += rng.normal(0.0, 0.003, (4, SAMPLES)).astype(np.float32)
    values[4] = np.arange(SAMPLES)
    quality = np.zeros(samples, np.uint8)
    return [
        Block("daq", 0, 0, RATE, 0, values[:, at : at + samples].copy(), quality)
        for at in range(0, SAMPLES, samples)
    ]


class Path5:
    """The engine's evaluation without threads: numbers, stores, and commits once a second."""

    def __init__(self, run: TestRun, recorder: Recorder) -> None:
        self.run, self.recorder = run, recorder

    def begun(self, sample: int) -> None:
        """Start the test's time."""
        self.run.begin(sample)
        self.recorder.begin(sample)

    def revolution(self, revolution: Revolution) -> None:
        """Number, reduce, evaluate and store."""
        row = self.run.take(revolution, True)
        if row is not None:
            self.recorder.row(row.number, row.values, row.measured)

    def overload(self, force_N: float, beyond_range: bool) -> None:
        """No sample of the benchmark is above the limit."""
        raise SystemExit(f"overload of {force_N} N in the benchmark")

    def cut_off(self, inputs: frozenset[str], force_N: float, slowed: bool) -> bool:
        """No input of the benchmark is saturated."""
        raise SystemExit(f"{inputs} cut off in the benchmark")

    def saturated(self, inputs: frozenset[str]) -> None:
        """Likewise."""
        raise SystemExit(f"{inputs} saturated in the benchmark")

    def calm(self) -> None:
        """Nothing to do."""

    def motion(self, speed_rpm: float) -> None:
        """Nothing to do."""

    def lost(self, samples: int) -> None:
        """No sample of the benchmark may be lost."""
        raise SystemExit(f"{samples} samples lost in the benchmark")

    def missing(self, seconds: float) -> None:
        """No time of the benchmark may be without samples."""
        raise SystemExit(f"{seconds} s without samples in the benchmark")


def whole_path(folder: Path, samples: int) -> float:
    """Return revolutions per second of one core through the whole path."""
    kind = calibration()
    plan = FilePlan(REVOLUTIONS, REVOLUTIONS // KEEP, SAMPLES)
    path = folder / f"bench-{samples}-{time.monotonic_ns()}.h5"
    store = create_test(path, plan, TestMetadata("benchmark", "", ""))
    rule = LimitRule("force_max", warning_above=300.0, critical_above=350.0)
    run = TestRun(
        kind, RuleMonitor((rule,)), 1, REVOLUTIONS, 0.0, lambda ns, later: ns * 1e-9, False
    )
    section = CyclesSection("every", every_revolutions=KEEP)
    recorder = Recorder(store, History(section, REVOLUTIONS), kind, 0.0)
    processor = Processor(kind, lambda: 380.0, real_time=False)
    processor.monitor = Path5(run, recorder)
    processor.begin_test()
    templates = stream(samples)
    first = sequence = 0
    committed = start = time.process_time()
    while not run.complete:
        for made in templates:
            block = Block("daq", sequence, first, RATE, first * 1000, made.values, made.quality)
            processor.handle(block)
            first += samples
            sequence += 1
        if time.process_time() - committed > 1.0:
            committed = time.process_time()
            recorder.commit()
    recorder.finish("complete", "complete", "the benchmark is over")
    elapsed = time.process_time() - start
    if store.revolutions != REVOLUTIONS:
        raise SystemExit(f"{store.revolutions} of {REVOLUTIONS} revolutions are in the file")
    path.unlink()
    return REVOLUTIONS / elapsed


def parts() -> None:
    """Print the cost of each step of one revolution, against one reading pass of its block."""
    kind = calibration()
    assembler = Assembler(kind.encoder, 4, RATE, kind.margins)
    values = np.concatenate([b.values for b in stream(SAMPLES)] * 4, axis=1)
    quality = np.zeros(values.shape[1], np.uint8)
    revolution = assembler.push(Block("daq", 0, 0, RATE, 0, values, quality))[1]
    reducer = Reducer(kind)
    inside = np.ascontiguousarray(revolution.values)
    flat = inside.ravel()
    reading = 1e6 * median_s(lambda: flat.max(), 7, 285)
    reduce = 1e6 * median_s(lambda: reducer.reduce(Measured(revolution, kind)), 7, 285)
    print(f"one reading pass of the block (max of {flat.size} float32): {reading:6.1f} us")
    print(f"latency, calibration, statistics, speed:            {reduce:6.1f} us")
    measured("reduce", reduce / reading, "reading pass", reduce / reading)


def main() -> None:
    """Print the rates, then the ratios of the budget."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    parts()
    with tempfile.TemporaryDirectory() as name:
        for frames in (72, 360, 3600):
            rate = max(whole_path(Path(name), frames) for _ in range(REPEATS))
            print(f"whole path, blocks of {frames:4} samples: {rate:7.0f} rev/s of {SAMPLES} x 5")
            if frames == 360:
                quoted = rate
            elif frames == 72:
                measured("ingest_72", rate)
    slowest = float("inf")
    for title, fastest in DEVICES.items():
        ratio = quoted * SAMPLES / fastest
        slowest = min(slowest, ratio)
        print(f"{title} ({fastest} frames/s): {ratio:.0f} times its rate")
    measured("ingest", slowest)


if __name__ == "__main__":
    main()
