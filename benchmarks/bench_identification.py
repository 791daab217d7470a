"""Check the identification's figures with virtual tests, and time an update.

Run with ``python benchmarks/bench_identification.py [--tests 1000] [--processes N]``. Each virtual
test has a coefficient, a statement and errors of its own, drawn as stated by the certificate (see
``tests/model/identification/virtual_tests.py``); the bushing is the reference one, 60 um worn after
20,000 revolutions. Nothing is tuned to the drawn tests: missed figures are reported. A fifth as
many tests are drawn with running-in and with a change, half as many to be watched for false alarms,
a tenth with a coefficient that doubles at half time.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import statistics
import sys
import time
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path

import numpy as np
from budgets import measured, size

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "model" / "identification"))
import virtual_tests as virtual

from rigapp.twin.identifying import LifeAhead
from rigapp_model.identification import (
    Bins,
    Consistency,
    DepthLife,
    depth_life,
    identify,
    remaining,
)
from rigapp_model.identification.consistency import FINE
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters
from rigapp_model.wear.loads import constant_load

LAST = 21377
PARTS = (0.1, 0.3, 0.6)
COVERED = (0.93, 0.97)
ODDS = 20.0
TOLD = 0.99
"""Share of tests in which an effect on the depth of more than 5 sigma must be reported."""
MOST_FALSE = 0.01
GROWTH = 5.0
LONG = 1_000_000
FORCE_N, COEFFICIENT = 110.0, 5.05e-13
WORN, AFTER = 60e-6, 20_000.0


@cache
def a_life() -> DepthLife:
    """Return the life of the reference bushing as the twin makes it, which wears WORN in AFTER."""
    parameters = Parameters(
        Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871),
        Joint(0.0095, 0.010, 0.020, 0.0131),
        Bushing(Material(500e6, 0.38), 2200.0, COEFFICIENT),
        Material(206e9, 0.29),
    )
    ahead = LifeAhead(parameters, constant_load(FORCE_N, 0.0095))
    while ahead.depth[-1] < 6.0 * WORN:
        ahead.step()
    life = ahead.life()
    assert life is not None
    scale = AFTER / float(np.interp(WORN, ahead.depth, ahead.progress))
    return depth_life(
        virtual.NOMINAL,
        scale * np.array(ahead.progress),
        ahead.depth,
        life.relative_error,
        life.elastic,
    )


def covered(seed: int) -> list[tuple[bool, bool, float, bool]]:
    """Return the coverage of a test with a constant coefficient at each part of its life.

    Whether coefficient and remaining revolutions are within their limits, the half width of the
    former, and whether another statement was made.
    """
    life = a_life()
    drawn = virtual.drawn(np.random.default_rng([1, seed]), life, LAST)
    end = float(drawn.clean[-1])
    reached = int(np.argmax(drawn.clean >= end)) + 1
    outcomes = []
    for part in PARTS:
        now = int(part * LAST)
        bins = virtual.gathered_at_once(drawn.depth[:now])
        known = identify(bins, life, virtual.ERRORS, virtual.PRIOR)
        within = known.coefficient
        left = remaining(known, life, end).revolutions
        weights = {each.name: each.weight for each in known.verdicts}
        outcomes.append(
            (
                within.low <= drawn.coefficient <= within.high,
                left is not None and left.low <= reached - now <= left.high,
                0.5 * (within.high - within.low) / within.median,
                max(weights.values()) > ODDS * weights["constant"],
            )
        )
    return outcomes


def statements_told(seed: int) -> list[tuple[bool, bool]]:
    """Return whether running-in and a change were reported, in tests where they exceed 5 sigma."""
    life, outcomes = a_life(), []
    for part in PARTS:
        each = []
        for kind in ("running-in", "change"):
            random = np.random.default_rng([2, seed, int(100 * part), len(kind)])
            drawn = virtual.drawn(random, life, int(part * LAST), kind)
            while virtual.moved(life, drawn.scaled) <= GROWTH:
                drawn = virtual.drawn(random, life, int(part * LAST), kind)
            bins = virtual.gathered_at_once(drawn.depth)
            known = identify(bins, life, virtual.ERRORS, virtual.PRIOR)
            weights = {verdict.name: verdict.weight for verdict in known.verdicts}
            each.append(weights[kind] > ODDS * weights["constant"])
        outcomes.append((each[0], each[1]))
    return outcomes


def watched(drawn: virtual.Drawn) -> Consistency:
    """Evaluate a test as the twin does, until a departure is reported or it ends."""
    life, consistency = a_life(), Consistency()
    coarse = virtual.gathered_at_once(drawn.depth)
    done = 0
    for fine in virtual.gathered_at_once(drawn.depth, FINE):
        now = done
        while now < len(coarse) and coarse[now].revolution < fine.first:
            now += 1
        if now > max(done, 5):
            consistency.renew(identify(coarse[:now], life, virtual.ERRORS, virtual.PRIOR))
        done = now
        if consistency.judge(fine, life) is not None:
            break
    return consistency


def false_alarm(seed: int) -> bool:
    """Return whether a departure was reported in a test without one."""
    drawn = virtual.drawn(np.random.default_rng([3, seed]), a_life(), LAST)
    return watched(drawn).departure is not None


def doubled(seed: int) -> float:
    """Return the growth of the depth (m) until a doubled coefficient was reported."""
    life, random = a_life(), np.random.default_rng([4, seed])
    number, half = np.arange(1.0, LAST + 1.0), LAST // 2
    ratio = float(np.exp(random.normal(0.0, 0.3)))
    scaled = ratio * (np.minimum(number, half) + 2.0 * np.maximum(number - half, 0.0))
    depth = life.course.at(scaled)[0]
    clean, read = virtual.measured(random, depth, life)
    departure = watched(virtual.Drawn(ratio * virtual.NOMINAL, scaled, clean, read)).departure
    if departure is None or departure.revolution < half:
        return float("inf")
    return float(depth[int(departure.revolution) - 1] - depth[half - 1])


def update_ms(rounds: int) -> tuple[float, float]:
    """Return the time of an update after LONG revolutions, and of processing one reading, ms."""
    life = a_life()
    edges = np.unique(np.geomspace(1, LONG, 4000).astype(np.int64)).astype(float)
    random = np.random.default_rng(5)
    # Slow progress, so that the life reaches LONG revolutions; bins as the stream closes them.
    slow = life.course.progress[-1] / (2.0 * LONG)
    bins = Bins()
    for number in edges:
        depth = float(life.course.at(np.array([slow * number]))[0][0])
        bins.add(number, slow * number, depth + random.normal(0.0, virtual.ERRORS.scatter))
    times, reading = [], []
    for _ in range(rounds):
        start = time.process_time()
        known = identify(bins, life, virtual.ERRORS, virtual.PRIOR)
        remaining(known, life, 1.2 * bins.closed[-1].depth)
        times.append(1e3 * (time.process_time() - start))
        start = time.perf_counter()
        for number in range(1000):
            bins.add(LONG + number, slow * (LONG + number), 1e-4)
        reading.append(time.perf_counter() - start)
    return statistics.median(times), statistics.median(reading)


def line(name: str, value: str, goal: str, met: bool) -> bool:
    """Print one figure with its goal; return whether it is met."""
    print(f"  {'pass' if met else 'FAIL'}  {name:<58}{value:>18}   {goal}", flush=True)
    return met


def shares(values: Iterable[Iterable[bool]]) -> list[float]:
    """Return the mean of each column."""
    return [float(mean) for mean in np.mean([list(row) for row in values], axis=0)]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tests", type=int, default=size(1000, 2))
    parser.add_argument("--processes", type=int, default=size(os.cpu_count() or 1, 1))
    given = parser.parse_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # for the workers: their matrices are small
    met = []
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(given.processes, mp_context=spawn) as pool:
        print(f"{given.tests} virtual tests of {LAST} revolutions at a constant coefficient")
        rows = list(pool.map(covered, range(given.tests)))
        within = f"{COVERED[0]:.0%} to {COVERED[1]:.0%}"
        for index, name in enumerate(("coefficient", "remaining life")):
            for part, share in zip(PARTS, shares([o[index] for o in r] for r in rows), strict=True):
                good = COVERED[0] <= share <= COVERED[1]
                title = f"{name} within its 95 % limits, at {part:.0%} of life"
                met.append(line(title, f"{share:.1%}", within, good))
        widths = shares([part[2] for part in row] for row in rows)
        print("        half width of the limits: " + ", ".join(f"{width:.1%}" for width in widths))
        wrong = shares([part[3] for part in row] for row in rows)
        for part, share in zip(PARTS, wrong, strict=True):
            title = f"another statement told where there is none, at {part:.0%}"
            met.append(line(title, f"{share:.1%}", f"< {MOST_FALSE:.0%}", share < MOST_FALSE))
        for index, kind in enumerate(("running-in", "change")):
            if index == 0:
                rows_told = list(pool.map(statements_told, range(max(given.tests // 5, 1))))
            columns = shares([part[index] for part in row] for row in rows_told)
            for part, share in zip(PARTS, columns, strict=True):
                title = f"{kind} over 5 sigma told at odds > 20, at {part:.0%} of life"
                met.append(line(title, f"{share:.1%}", f">= {TOLD:.0%}", share >= TOLD))
        alarms = list(pool.map(false_alarm, range(max(given.tests // 2, 1))))
        title = "tests with a false alarm"
        share = float(np.mean(alarms))
        met.append(line(title, f"{share:.2%}", f"< {MOST_FALSE:.0%}", share < MOST_FALSE))
        grown = (
            np.array(list(pool.map(doubled, range(max(given.tests // 10, 1)))))
            / virtual.ERRORS.scatter
        )
        title = "growth until a doubled K is told, worst, in scatters of a reading"
        goal = f"< {GROWTH:g}; median {np.median(grown):.1f}"
        met.append(line(title, f"{grown.max():.1f}", goal, bool(grown.max() < GROWTH)))
        spent, reading = pool.submit(update_ms, 15).result()
    title = f"update with what remains, after {LONG} revolutions"
    print(f"  {title}")
    measured("identification", spent)
    print(f"        gathering one reading: {1e3 * reading:.1f} us")
    measured("identified", met.count(False))


if __name__ == "__main__":
    main()
