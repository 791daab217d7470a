"""Budgets of the benchmarks in one table, and the figures measured against them.

A benchmark calls ``measured`` for each budget that it covers. The line is printed, and
``python -m benchmarks`` collects all of them into its last table. ``size`` gives the small sizes
with which the test suite runs each benchmark once.
"""

from __future__ import annotations

import json
import os
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

COLLECTED = "RIGAPP_BENCH_FIGURES"
"""Environment variable: the file that collects the figures of a whole run, one JSON line each."""
SMALL = "RIGAPP_BENCH_SMALL"
"""Environment variable: set while the suite runs a benchmark only as a smoke test."""


@dataclass(frozen=True, slots=True)
class Budget:
    """A limit of one figure; at_least: the figure must not fall below it."""

    what: str
    unit: str
    limit: float
    at_least: bool = False

    def kept(self, value: float) -> bool:
        """Return whether a value is within the budget."""
        return value >= self.limit if self.at_least else value <= self.limit


BUDGETS = {
    "ingest": Budget("ingest + reduce + store, blocks of 360", "x GSV-8", 215.0, True),
    "ingest_72": Budget("ingest + reduce + store, blocks of 72", "revolutions/s", 3000.0, True),
    "reduce": Budget("reduction of a revolution", "reading passes", 8.0),
    "store": Budget("store a row and each tenth cycle", "revolutions/s", 80_000.0, True),
    "store_peer": Budget("the same, against the best h5py", "x", 8.0, True),
    "store_call": Budget("one store call at 1,000/s, p99.9 of processor time", "us", 150.0),
    "screen": Budget("end of revolution to screen, p99", "ms", 35.0),
    "window": Budget("start to visible window", "s", 1.2),
    "idle": Budget("idle window", "% of a core", 2.0),
    "stall": Budget("longest stall of the window in a test", "ms", 30.0),
    "frame": Budget("frame of 4 overlays + trend of 10^6 cycles", "ms", 12.0),
    "closed_form": Budget("closed-form cycle, 3600 angles", "ms", 0.25),
    "impacts_polymer": Budget("non-continuous contact, polymer with friction", "ms", 4.0),
    "impacts_steel": Budget("non-continuous contact, steel with friction", "ms", 8.0),
    "contact": Budget("contact solve, unworn", "ms", 0.05),
    "contact_worn": Budget("contact solve, worn, from the last cycle", "ms", 0.2),
    "contact_peer": Budget("contact solve against scikit-fem", "x", 10_000.0, True),
    "life_0.1": Budget("life of 23,000 cycles at 0.1 %", "ms", 80.0),
    "life_1": Budget("life of 23,000 cycles at 1 %", "ms", 20.0),
    "identification": Budget("update of the identification after 10^6 revolutions", "ms", 10.0),
    "trip": Budget("trip to drive-off command, over wire bytes, p99", "ms", 1.0),
    "snapshot": Budget("end of revolution to snapshot at the viewer, p99", "ms", 100.0),
    "trip_wire": Budget("overload at the cell to acknowledged drive-off", "ms", 100.0),
    "help": Budget("rigapp --help", "s", 0.1),
    "gsv8": Budget("parse GSV-8 float32 frames", "x its rate", 50.0, True),
    "dataq": Budget("parse DATAQ scans", "x its rate", 50.0, True),
    "lives": Budget("10,000 lives at 1 % on two workers", "min", 3.0),
    "workers": Budget("efficiency from one to two workers", "%", 90.0, True),
    "page_cpu": Budget("engine's processor time with 50 pages", "x alone", 1.15),
    "page_age": Budget("age of the data with 50 pages, p99", "x alone", 1.5),
    "plant": Budget("simulated plant at 960 Hz, chunks of 1/20 revolution", "x GSV-8", 20.0, True),
    "identified": Budget("goals of the identification that are missed", "of its table", 0.0),
    "identified-noise": Budget("kinds of disturbance that miss the goal", "of twelve", 0.0),
    "coverage": Budget("coverage of the load cell furthest from 95 %", "% away", 2.0),
    "independent_cell": Budget("truth held by U, cells in the time domain, worst", "%", 93.0, True),
    "independent_probe": Budget("the same of probes before a micrometer", "%", 93.0, True),
    "mistakes_named": Budget("mistakes of a calibration named rightly, worst", "%", 95.0, True),
    "length_resume": Budget("resume of 10^7 revolutions", "s", 5.0),
    "length_resume_memory": Budget("the same, peak memory", "MB", 300.0),
    "length_open": Budget("replay of 10^7 revolutions opened", "s", 3.0),
    "length_seek": Budget("the same, slowest of five seeks", "s", 0.2),
    "length_replay_memory": Budget("the same, peak memory", "MB", 300.0),
    "length_picture": Budget("picture of 10^7 revolutions", "s", 5.0),
    "length_picture_memory": Budget("the same, peak memory", "MB", 300.0),
    "length_report": Budget("report of 10^7 revolutions", "s", 60.0),
    "length_report_memory": Budget("the same, peak memory", "MB", 500.0),
    "mistakes_refused": Budget("good calibrations refused", "%", 0.5),
}


def measured(name: str, value: float, peer: str = "", ratio: float | None = None) -> bool:
    """Print a figure beside its budget, and collect it; return whether the budget is kept.

    peer, ratio: what was measured in the same run, and how many times slower that is.
    """
    budget = BUDGETS[name]
    kept = budget.kept(value)
    sign = ">=" if budget.at_least else "<="
    print(
        f"  {budget.what}: {value:.4g} {budget.unit} (budget {sign} {budget.limit:g}:"
        f" {'kept' if kept else 'MISSED'})",
        flush=True,
    )
    collect({"name": name, "value": value, "peer": peer, "ratio": ratio})
    return kept


def skipped(what: str, why: str) -> None:
    """Print what could not be measured, and collect it for the last table."""
    print(f"  SKIPPED {what}: {why}", flush=True)
    collect({"skipped": what, "why": why})


def collect(figure: dict[str, object]) -> None:
    """Append a figure to the file of the whole run, if there is one."""
    if path := os.environ.get(COLLECTED):
        with open(path, "a", encoding="utf-8") as file:
            file.write(json.dumps(figure) + "\n")


def median_s(work: Callable[[], object], rounds: int, repeat: int = 1) -> float:
    """Return the median time of a call, s, after an uncounted one; repeat: calls in each round."""
    work()
    times, repeat = [], size(repeat, 1)
    for _ in range(rounds):
        start = time.perf_counter()
        for _ in range(repeat):
            work()
        times.append((time.perf_counter() - start) / repeat)
    return statistics.median(times)


def size(whole: Any, small: Any) -> Any:
    """Return the size of a measurement: the small one while the suite runs a smoke test."""
    return small if os.environ.get(SMALL) else whole
