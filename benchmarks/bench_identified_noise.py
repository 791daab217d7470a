"""Measure the identification on tests with disturbances that it does not assume.

Run with ``python benchmarks/bench_identified_noise.py [--tests 200] [--kinds white,step]``. The
tests are those of ``tests/model/identification/rig_noise.py``, whose disturbances of the probes the
estimator does not assume; sensitivity, zero and scatter are drawn as stated to it. A row for each
disturbance, of rigs that measure the temperature (T) and of others: how often 95 % limits of the
wear coefficient and of what remains hold the truth at 10, 30 and 60 % of life, the coefficient's
mean error and half width, how often limits of a pairing of eight specimens hold its median and each
specimen, how many tests of 21,377 revolutions raise a false alarm, and by how many scatters of a
reading the depth grows until a doubled coefficient is reported (median, and share never reported).
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from budgets import measured, size

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "model" / "identification"))
import rig_noise as rig

from rigapp_model.identification import (
    Bin,
    Bins,
    Consistency,
    DepthLife,
    Estimate,
    NotIdentifiable,
    Prior,
    ProbeErrors,
    depth_life,
    estimate_of,
    identify,
    pairing_of,
    remaining,
)

PARTS = (0.1, 0.3, 0.6)
GROUP = 8
"""Specimens of a pairing that are evaluated together."""
CHANNEL = " T"
"""Ending of a kind's name if the rig measures the temperature."""
KINDS = (*(kind + CHANNEL for kind in rig.KINDS), "white", "daily", "hourly")
ERRORS = ProbeErrors(0.01, 1e-6, 0.3e-6, 0.4e-6)
STATED = {"clearance": replace(ERRORS, geometry=0.04), "gain": replace(ERRORS, load=0.02)}
"""Stated errors of rows whose joint or load cell differs from the estimator's model."""
PRIOR = Prior(rig.COEFFICIENT)
COVERED = (0.93, 0.97)
MOST_FALSE = 0.01


@cache
def told_life() -> DepthLife:
    """Return the life given to the estimator: of the usual joint, with its stated uncertainties."""
    progress = np.concatenate([[0.0], np.geomspace(1.0, 12.0 * rig.LAST, 400)])
    depth = rig.worn(rig.USUAL, progress)
    stiff = rig.Joint(stiffness=rig.STIFFNESS * 1.02)
    moved = (rig.read_through(stiff, rig.USUAL, depth) - depth) / 0.02 * 0.2
    return depth_life(rig.COEFFICIENT, progress, depth, elastic=np.abs(moved))


def gathered(test: rig.Recorded, kind: str) -> list[list[Bin]]:
    """Return the bins that are closed at each part of a test, one reading a revolution."""
    bins, closed, room = Bins(), [], warmth(test, kind)
    for number, (read, warm) in enumerate(zip(test.read, room, strict=True), start=1):
        bins.add(float(number), float(number), float(read), float(warm))
        if number in (int(part * rig.LAST) for part in PARTS):
            closed.append(list(bins.closed))
    return closed


def stated(kind: str) -> ProbeErrors:
    """Return the errors that a rig's records state."""
    return STATED.get(kind.removesuffix(CHANNEL), ERRORS)


def warmth(test: rig.Recorded, kind: str) -> np.ndarray:
    """Return the room's temperature (n,), degC, NaN for a rig that does not measure it."""
    return 21.0 + test.room if kind.endswith(CHANNEL) else np.full(test.room.size, np.nan)


Row = tuple[float, float, float, float]


def covered(work: tuple[str, int]) -> tuple[list[Row], list[tuple[Estimate, float] | None]]:
    """Return of one test at each part: coefficient held, life held, error and half width of ln K.

    NaN where nothing is stated. Also each estimate for a pairing, with the true coefficient.
    """
    kind, seed = work
    test, life = recorded(kind, seed), told_life()
    rows: list[Row] = []
    estimates: list[tuple[Estimate, float] | None] = []
    end = float(test.clean[-1])
    reached = int(np.argmax(test.clean >= end)) + 1
    for bins in gathered(test, kind):
        try:
            known = identify(bins, life, stated(kind), PRIOR)
        except NotIdentifiable:
            rows.append((np.nan,) * 4)
            estimates.append(None)
            continue
        limits = known.coefficient
        truth = test.ratio * rig.COEFFICIENT
        left = remaining(known, life, end).revolutions
        rows.append(
            (
                float(limits.low <= truth <= limits.high),
                np.nan
                if left is None
                else float(left.low <= reached - known.revolution <= left.high),
                float(np.log(limits.median / truth)),
                0.5 * float(np.log(limits.high / limits.low)),
            )
        )
        try:
            estimates.append((estimate_of(known, f"{seed}"), truth))
        except NotIdentifiable:
            estimates.append(None)
    return rows, estimates


def pooled(tests: Sequence[Sequence[tuple[Estimate, float] | None]]) -> str:
    """Return of groups of specimens at each part how many medians and specimens are held, %."""
    shares = []
    for part in range(len(PARTS)):
        known = [estimates[part] for estimates in tests]
        some = [estimate for estimate in known if estimate is not None]
        medians, specimens = [], []
        for begin in range(0, len(some) - GROUP + 1, GROUP):
            group = some[begin : begin + GROUP]
            pairing = pairing_of([estimate for estimate, _ in group], "a group")
            medians.append(pairing.coefficient.low <= rig.COEFFICIENT <= pairing.coefficient.high)
            specimens += [
                limits.low <= truth <= limits.high
                for limits, (_, truth) in zip(pairing.each, group, strict=True)
            ]
        if medians:
            shares.append(f"{100.0 * np.mean(medians):.0f} {100.0 * np.mean(specimens):.0f}")
    return "/".join(shares)


def recorded(kind: str, seed: int, doubled_at: int | None = None) -> rig.Recorded:
    """Return a test; the same one for a rig with and without a temperature channel."""
    return rig.recorded(kind.removesuffix(CHANNEL), seed, doubled_at)


def watched(test: rig.Recorded, kind: str) -> Consistency:
    """Evaluate a test as the twin does, to its first departure."""
    life, consistency, bins = told_life(), Consistency(), Bins()
    rows = zip(test.read.tolist(), warmth(test, kind).tolist(), strict=True)
    for number, (depth, warm) in enumerate(rows, start=1):
        turn = float(number)
        if consistency.add(turn, turn, depth, life, warm) is not None:
            break
        if bins.add(turn, turn, depth, warm) is not None and len(bins.closed) > 4:
            try:
                consistency.renew(identify(bins, life, stated(kind), PRIOR))
            except NotIdentifiable:
                continue
    return consistency


def false_alarm(work: tuple[str, int]) -> float:
    """Return whether a constant joint raised an alarm."""
    return float(watched(recorded(*work), work[0]).departure is not None)


def growth(work: tuple[str, int]) -> float:
    """Return the growth of the depth in scatters until a doubled coefficient was reported."""
    half = rig.LAST // 2
    test = recorded(*work, doubled_at=half)
    departure = watched(test, work[0]).departure
    if departure is None or departure.revolution < half:
        return float("inf")
    return float((test.true[int(departure.revolution) - 1] - test.true[half - 1]) / rig.SCATTER)


def shown(values: np.ndarray, form: str) -> str:
    """Return a figure for each part of life."""
    return "/".join(format(float(value), form) for value in values)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tests", type=int, default=size(200, 2))
    parser.add_argument("--alarms", type=int, default=None, help="tests watched, half as many else")
    parser.add_argument("--kinds", default=",".join(size(KINDS, ("white T", "step T"))))
    parser.add_argument("--seed", type=int, default=0, help="of the first test")
    parser.add_argument("--processes", type=int, default=size(os.cpu_count() or 1, 1))
    given = parser.parse_args()
    watched_tests = max(given.tests // 2, 1) if given.alarms is None else given.alarms
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    missed = 0
    print(
        "kind         K held, %     error, %         half, %          life held, %  "
        "pooled, held, %       alarms  growth"
    )
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(given.processes, mp_context=spawn) as pool:
        for kind in given.kinds.split(","):
            start = time.perf_counter()
            work = [(kind, given.seed + number) for number in range(given.tests)]
            tests = list(pool.map(covered, work))
            rows = np.array([row for row, _ in tests])
            held = 100.0 * np.nanmean(rows, axis=0)
            stated = 1.0 - np.isnan(rows[..., 0]).mean()
            text = (
                f"{kind:<10}  {shown(held[:, 0], '3.0f'):<12}  {shown(held[:, 2], '+.1f'):<15}  "
                f"{shown(held[:, 3], '.1f'):<15}  {shown(held[:, 1], '3.0f'):<12}"
                f"  {pooled([estimates for _, estimates in tests]):<20}"
            )
            good = bool((held[:, 0] >= 100.0 * COVERED[0]).all())
            if watched_tests:
                alarms = np.array(list(pool.map(false_alarm, work[:watched_tests])))
                grown = np.array(list(pool.map(growth, work[: max(watched_tests // 2, 1)])))
                never = 100.0 * float(np.isinf(grown).mean())
                text += f"  {100 * alarms.mean():5.1f}%  {np.median(grown):.1f} ({never:.0f}% not)"
                good = good and bool(alarms.mean() < MOST_FALSE)
            missed += not good
            taken = time.perf_counter() - start
            print(
                f"{text}  stated {stated:.0%}  {'' if good else 'FAIL'}  {taken:.0f} s", flush=True
            )
    measured("identified-noise", missed)


if __name__ == "__main__":
    main()
