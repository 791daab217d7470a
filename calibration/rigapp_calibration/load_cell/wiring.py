"""Wiring: plugs exchanged or turned, bridges dead; of all readings, or of some series.

Also the pin angles of two series interchanged, which looks similar.

A run (a series at one pin angle) has one slope: the change of both signals per newton. Wiring
changes slopes by half and more, so that a tenth distinguishes it from all else.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from rigapp.texts import joined, say
from rigapp_calibration.arrays import Array, Marks, Whole
from rigapp_calibration.load_cell.characteristics import Evidence
from rigapp_calibration.problems import Problem, refusal

FITS = 0.1
"""Relative to the cell's sensitivity: a slope fits within a turn of six degrees and a gain of ten
per cent; a plug exchanged at 30 degrees from equal load on both bridges changes it five times as
much. """
DEAD = 0.05
"""Relative to the other bridge's largest slope: below cross-talk, which a dead bridge lacks too."""
APART = 0.5
"""Sine between two directions of load that determine the sensitivity: 30 degrees, noise doubled."""
ROUND = 0.3
"""Smallest over largest singular value of a sensitivity: the bridges of a cell are alike."""
FEWEST_RUNS = 4
"""Two runs determine the sensitivity, and as many contradict them."""
STRAY_RUNS = 5
"""One run in this many may have another fault as well."""
DIRECTION_FITS = 0.95
DIRECTION_WRONG = 0.7
"""Cosines: within 18 degrees a signal fits a wiring, from 45 degrees it fits another."""


@dataclass(frozen=True, slots=True)
class Wiring:
    """A wiring mistake: signals = change (correct signals)."""

    code: str
    change: tuple[tuple[float, float], tuple[float, float]]
    words: str


def _wirings() -> Iterator[Wiring]:
    swapped = say("the two signals are swapped: exchange the two bridges' plugs")
    yield Wiring("axes_swapped", ((0.0, 1.0), (1.0, 0.0)), swapped)
    turned = say("has the wrong sign: turn its plug, or exchange its two signal wires")
    yield Wiring("axis_reversed", ((-1.0, 0.0), (0.0, 1.0)), say("signal_1 {}", turned))
    yield Wiring("axis_reversed", ((1.0, 0.0), (0.0, -1.0)), say("signal_2 {}", turned))
    dead = say("does not follow the load: is its bridge connected and switched on?")
    yield Wiring("bridge_dead", ((0.0, 0.0), (0.0, 1.0)), say("signal_1 {}", dead))
    yield Wiring("bridge_dead", ((1.0, 0.0), (0.0, 0.0)), say("signal_2 {}", dead))


WIRINGS = tuple(_wirings())


def check_plugs(change: Array, direction: Array) -> Problem | None:
    """Check plugs by one load: change of the signals (2,), direction of the force (2,).

    Bridges are alike, so that signals point as the force does. None without a mistake, or if the
    direction is ambiguous (equal load on both bridges, or none on one).
    """
    size = float(np.hypot(*change) * np.hypot(*direction))
    if not size > 0.0 or float(change @ direction) / size > DIRECTION_WRONG:
        return None
    for wiring in WIRINGS:
        if wiring.code != "bridge_dead":
            expected = np.array(wiring.change) @ direction
            if float(change @ expected) / size > DIRECTION_FITS:
                return refusal(wiring.code, "As the load shows, {}", _sentence(wiring.words))
    return None


def check_wiring(evidence: Evidence) -> Iterator[Problem]:
    """Yield wiring mistakes of some series, and a bridge that is dead in all of them."""
    run = evidence.loads.runs()
    force, signal = evidence.force, evidence.readings.signal
    slopes, directions, used = [], [], []
    for number in range(int(run.max()) + 1):
        members = run == number
        loads = evidence.loads.applied[members]
        if np.count_nonzero(loads > 0.0) >= 2 and np.ptp(loads) > 0.0:
            slopes.append(_slope(loads, signal[members]))
            heaviest = force[members][np.argmax(loads)]
            directions.append(heaviest / np.hypot(*heaviest))
            used.append(number)
    seen, towards = np.array(slopes), np.array(directions)
    if len(used) < FEWEST_RUNS:
        return
    largest = np.abs(seen).max(axis=0)
    weak = int(np.argmin(largest))
    if largest[weak] < DEAD * largest[1 - weak]:
        yield refusal(
            "bridge_dead",
            "signal_{} hardly follows the load ({:.1f} % of the other signal): is the"
            " bridge connected and switched on?",
            weak + 1,
            100.0 * largest[weak] / largest.max(),
        )
        return
    sensitivity, fitting = _best(seen, towards)
    as_is = fitting[0]
    pair = np.flatnonzero(~as_is)
    if len(pair) == 2 and _exchanged(sensitivity, seen, towards, pair):
        # Moved plugs stay so to the end, or were wrong from the start.
        to_the_end = fitting[1:, pair[0] :].all(axis=1)
        from_the_start = fitting[1:, : pair[1] + 1].all(axis=1)
        if not (to_the_end | from_the_start).any():
            yield _exchange(evidence, [used[number] for number in pair], run)
            return
    if np.count_nonzero(~fitting.any(axis=0)) > len(used) // STRAY_RUNS or as_is.all():
        return
    names = [evidence.readings.series[int(np.flatnonzero(run == number)[0])] for number in used]
    left = ~as_is
    for wiring, fits in zip(WIRINGS, fitting[1:], strict=True):
        wrong = left & fits
        if wrong.any():
            left &= ~wrong
            where = _where(names, wrong, ~as_is | fits)
            yield refusal(
                wiring.code, "{}: {} Then take them again.", where, _sentence(wiring.words)
            )


def _exchanged(sensitivity: Array, seen: Array, towards: Array, pair: Whole) -> bool:
    """Return whether two runs fit with interchanged load directions."""
    expected = towards[pair[::-1]] @ sensitivity.T
    return bool(np.all(np.hypot(*(expected - seen[pair]).T) < FITS * _size(sensitivity)))


def _exchange(evidence: Evidence, numbers: Sequence[int], run: Whole) -> Problem:
    angles = [float(evidence.readings.angle[run == number][0]) for number in numbers]
    one, other = (evidence.readings.series[np.flatnonzero(run == n)[0]] for n in numbers)
    return refusal(
        "angles_exchanged",
        "The pin angles of series {} ({:.1f} degrees) and {} ({:.1f} degrees) are written for"
        " each other: exchange them.",
        one,
        np.degrees(angles[0]),
        other,
        np.degrees(angles[1]),
    )


def _size(sensitivity: Array) -> float:
    """Return the mean size of a sensitivity: the root of the product of its singular values."""
    return float(np.sqrt(abs(np.linalg.det(sensitivity))))


def _sentence(words: str) -> str:
    return words if words.endswith("?") else say("{}.", words)


def _slope(loads: Array, signal: Array) -> Array:
    """Return the change of both signals per newton: the median over all pairs (Theil and Sen)."""
    first, second = np.triu_indices(len(loads), 1)
    apart = loads[second] - loads[first]
    told = np.abs(apart) > 0.1 * np.ptp(loads)
    steps = signal[second[told]] - signal[first[told]]
    return np.asarray(np.median(steps / apart[told, None], axis=0))


def _best(seen: Array, towards: Array) -> tuple[Array, Marks]:
    """Return the best sensitivity, and which runs fit it as they are (row 0) and with each wiring.

    Every two runs propose one. Criteria in this order: no run unexplained, a correctly wired
    cell, most runs that fit as they are.
    """
    changes = np.array([np.eye(2), *(one.change for one in WIRINGS)])
    best: tuple[tuple[int, bool, int], Array, Marks] | None = None
    for pair in combinations(range(len(seen)), 2):
        span = towards[list(pair)].T
        if abs(np.linalg.det(span)) < APART:
            continue
        sensitivity = seen[list(pair)].T @ np.linalg.inv(span)
        small, large = sorted(np.linalg.svd(sensitivity, compute_uv=False))
        if small < ROUND * large:
            continue
        expected = np.einsum("wij,jk,rk->wri", changes, sensitivity, towards)
        fits = np.hypot(*np.moveaxis(expected - seen, -1, 0)) < FITS * _size(sensitivity)
        straight = bool(np.all(np.diag(sensitivity) > 0.5 * large))
        rank = (int(fits.any(axis=0).sum()), straight, int(fits[0].sum()))
        if best is None or rank > best[0]:
            best = rank, sensitivity, fits
    if best is None:
        return np.eye(2), np.ones((len(changes), len(seen)), dtype=np.bool_)
    return best[1:]


def _where(names: Sequence[str], wrong: Marks, may_be: Marks) -> str:
    """Return the series concerned, in words; may_be: runs equal under both wirings count too."""
    first, last = (int(one) for one in np.flatnonzero(wrong)[[0, -1]])
    if first and may_be[first:].all():
        return say("From series {} on", names[first])
    if last > first and may_be[first : last + 1].all():
        return say("In series {} to {}", names[first], names[last])
    found = dict.fromkeys(name for name, one in zip(names, wrong, strict=True) if one)
    return say("In series {}", joined(", ", found))
