"""Map of the pin's run-out from a slow roll, while the pin rests in its seat.

Whole slow revolutions are developed in Fourier orders 1 ... N of the crank angle, each probe
separately, revolution by revolution. The mean over the revolutions is the map, their spread its
uncertainty. The mean value of a probe over the turn is the seat of the pin, indistinguishable from
run-out, so the map has none.

Indistinguishable from run-out in one roll: every motion of the pin in the follower that repeats
each turn. Inertia moves it with the square of the speed; rolls at two speeds or more are
extrapolated to speed 0, map = roll - c speed^2. Elasticity moves it into the bushing with the
force: where known, that is subtracted from a turn, so that the map holds at any load. A
changing direction of the load moves it too: rolls under different loads show it, and what differs
between them is part of the uncertainty.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from GTC import reporting

from rigapp.texts import SentenceError, say
from rigapp_calibration.arrays import Array
from rigapp_calibration.problems import Problem, blocked, note, refusal

FEWEST_REVOLUTIONS = 5
GOOD_REVOLUTIONS = 10
"""Revolutions whose spread is a standard uncertainty: known within 35 % of five, 24 % of ten."""
FASTEST = 2.0 * math.pi * 15.0 / 60.0
"""Crank speed (rad/s) above which inertia moves the pin too much for a slow roll."""
OVER = 1.02
"""Factor of that: a drive set to this speed may turn so much faster on average."""
MOST_ORDERS = 32
"""Finer structures are smaller than the probes' sensing area on the pin."""
SAMPLES_PER_ORDER = 16
"""Eight samples per half wave: higher frequencies do not alias into the orders."""
GRID = 360
LARGE = 100e-6
"""Ten times the usual run-out of a pin ground between centres, m."""
UNSTEADY = 0.2
BETWEEN = 0.25
"""Parts of the map by which a roll may change, and rolls may differ, before it is reported: the map
still removes three quarters of the run-out."""
DISTINCT = 1.3
"""Ratio of the fastest to the slowest roll from which the effect of speed is separable."""
MODEL = 0.3
"""Relative standard uncertainty of that effect: growth with the square is a model."""


class RunOutError(SentenceError, ValueError):
    """No map can be made; the text gives the reason."""


@dataclass(frozen=True, slots=True, eq=False)
class SlowRevolution:
    """One whole slow revolution. angle (n,) crank angle, rad; probes (2, n), m; saturated.

    elastic (2, n): elastic motion of the pin under the force, at the probes, m; or None.
    """

    number: int
    angle: Array
    probes: Array
    saturated: bool = False
    elastic: Array | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Roll:
    """Slow revolutions of one speed and load. speed: of the crank, rad/s."""

    label: str
    speed: float
    turns: tuple[SlowRevolution, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Harmonics:
    """Orders of one revolution: coefficients (2, 2 N) as cos 1, sin 1, cos 2 ...; rest (2,), m.

    elastic (2, 2 N): subtracted elastic motion. rest: standard deviation not explained by the
    orders.
    """

    roll: int
    number: int
    coefficients: Array
    elastic: Array
    rest: Array


@dataclass(frozen=True, slots=True, eq=False)
class RunOutMap:
    """The result. coefficients (2, 2 N), m, and their covariance (2, 2 N, 2 N).

    combined, expanded (2,): uncertainty of the map where it is largest, m. inertia (2,): largest
    motion with the speed that was taken off the slowest roll, m, None for rolls of one speed.
    elastic (2,): largest elastic motion that was taken off, m, None where the turns tell none.
    between (2,): largest deviation of a roll from the map, m, None where nothing is left to show
    it. drift (2,): largest change from the first to the last half, m. peak (2,): largest less
    smallest value of the map, m. rest (2,): what the orders leave of a revolution, m.
    """

    accepted: bool
    problems: tuple[Problem, ...]
    harmonics: tuple[Harmonics, ...] = ()
    coefficients: Array | None = None
    covariance: Array | None = None
    combined: Array | None = None
    expanded: Array | None = None
    coverage_factor: float | None = None
    peak: Array | None = None
    inertia: Array | None = None
    elastic: Array | None = None
    between: Array | None = None
    drift: Array | None = None
    rest: Array | None = None


def evaluate(coefficients: Array, angle: Array) -> Array:
    """Return a map (2, n) at crank angles (n,), rad; coefficients (2, 2 N)."""
    return np.asarray(coefficients @ _basis(angle, coefficients.shape[1] // 2).T, np.float64)


def spread_at(covariance: Array, angle: Array) -> Array:
    """Return the standard uncertainty (2, n) of a map at crank angles (n,)."""
    basis = _basis(angle, covariance.shape[1] // 2)
    variance = np.einsum("ni,pij,nj->pn", basis, covariance, basis)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)), np.float64)


def make_map(rolls: Sequence[Roll], orders: int, elastic_doubts: Sequence[Array] = ()) -> RunOutMap:
    """Develop slow revolutions into a map of ``orders`` orders and check it.

    elastic_doubts: a matrix (2, 2) for each independent error of the elastic motion; times the
    motion it is one standard uncertainty. Raises RunOutError without usable revolutions.
    """
    if not 1 <= orders <= MOST_ORDERS:
        raise RunOutError("orders: choose 1 to {}", MOST_ORDERS)
    problems = list(_unusable(rolls, orders))
    if blocked(problems):
        return RunOutMap(False, tuple(problems))
    harmonics = tuple(
        _develop(index, turn, orders) for index, roll in enumerate(rolls) for turn in roll.turns
    )
    return map_of_harmonics(harmonics, [roll.speed for roll in rolls], elastic_doubts, problems)


def map_of_harmonics(
    harmonics: tuple[Harmonics, ...],
    speeds: Sequence[float],
    elastic_doubts: Sequence[Array] = (),
    problems: Sequence[Problem] = (),
) -> RunOutMap:
    """Make the map of developed revolutions; speeds: of the rolls, rad/s.

    problems: of the samples. The rest is as for ``make_map``.
    """
    part = _combine(harmonics, speeds, elastic_doubts)
    grid = np.linspace(0.0, 2.0 * math.pi, GRID, endpoint=False)
    curve = evaluate(part.coefficients, grid)
    combined = spread_at(part.covariance, grid).max(axis=1)
    within = spread_at(part.within, grid).max(axis=1)
    inertia = _largest([part.inertia], grid) if part.inertia is not None else None
    elastic = _largest([part.elastic], grid) if part.elastic.any() else None
    between = _largest(part.away, grid) if part.away else None
    drift = _drift(harmonics, grid)
    rest = np.asarray(np.mean([h.rest for h in harmonics], axis=0), np.float64)
    peak = np.asarray(np.ptp(curve, axis=1), np.float64)
    problems = (*problems, *_judge(curve, combined, within, between, drift))
    factor = float(reporting.k_factor(max(2.0, float(len(harmonics) - 1))))
    return RunOutMap(
        accepted=not blocked(problems),
        problems=problems,
        harmonics=harmonics,
        coefficients=part.coefficients,
        covariance=part.covariance,
        combined=combined,
        expanded=factor * combined,
        coverage_factor=factor,
        peak=peak,
        inertia=inertia,
        elastic=elastic,
        between=between,
        drift=drift,
        rest=rest,
    )


def _basis(angle: Array, orders: int) -> Array:
    """Return cos 1, sin 1, cos 2, sin 2 ... (n, 2 N)."""
    multiples = np.outer(angle, np.arange(1, orders + 1))
    basis = np.empty((len(angle), 2 * orders))
    basis[:, 0::2] = np.cos(multiples)
    basis[:, 1::2] = np.sin(multiples)
    return basis


def _develop(roll: int, turn: SlowRevolution, orders: int) -> Harmonics:
    """Return the orders of one revolution by least squares, its mean and its drift left out.

    The angles need not be evenly spaced; a straight drift over the turn (temperature) is fitted as
    well, since it would appear in all sine orders.
    """
    turned = (turn.angle - turn.angle.mean()) / (2.0 * math.pi)
    design = np.column_stack((_basis(turn.angle, orders), np.ones_like(turned), turned))
    moved = np.zeros_like(turn.probes) if turn.elastic is None else turn.elastic
    shown = np.concatenate((turn.probes - moved, moved)).T
    solution = np.linalg.lstsq(design, shown, rcond=None)[0]
    rest = (shown - design @ solution)[:, :2].std(axis=0, ddof=design.shape[1])
    orders_of = np.asarray(solution[: 2 * orders].T, np.float64)
    return Harmonics(roll, turn.number, orders_of[:2], orders_of[2:], rest)


@dataclass(frozen=True, slots=True, eq=False)
class _Combined:
    """The map with its covariance, the part of it within the rolls, and the subtracted motion."""

    coefficients: Array
    covariance: Array
    within: Array
    inertia: Array | None
    elastic: Array
    away: tuple[Array, ...]


def _combine(
    harmonics: Sequence[Harmonics], speeds: Sequence[float], elastic_doubts: Sequence[Array]
) -> _Combined:
    """Extrapolate to speed 0 where the speeds differ, else take the mean of the rolls."""
    count = len(speeds)
    groups = [np.array([h.coefficients for h in harmonics if h.roll == i]) for i in range(count)]
    means = np.array([group.mean(axis=0) for group in groups])
    squares = np.square(speeds)
    distinct = math.sqrt(squares.max() / squares.min()) >= DISTINCT
    design = np.column_stack((np.ones(count), squares)) if distinct else np.ones((count, 1))
    weights = np.linalg.pinv(design)
    parts = np.tensordot(weights, means, axes=1)
    away = means - np.tensordot(design, parts, axes=1)
    size = means.shape[2]
    within = np.zeros((2, size, size))
    for weight, group in zip(weights[0], groups, strict=True):
        for probe in range(2):
            within[probe] += weight**2 * np.cov(group[:, probe].T) / len(group)
    moved = [np.mean([h.elastic for h in harmonics if h.roll == i], axis=0) for i in range(count)]
    elastic = np.tensordot(weights[0], np.array(moved), axes=1)
    total, free = within.copy(), count - design.shape[1]
    inertia = parts[1] * squares.min() if distinct else None
    for probe in range(2):
        if free > 0:
            scatter = away[:, probe].T @ away[:, probe] / free
            total[probe] += scatter * float(weights[0] @ weights[0])
        if inertia is not None:
            total[probe] += MODEL**2 * np.outer(inertia[probe], inertia[probe])
        for doubt in elastic_doubts:
            error = doubt[probe] @ elastic
            total[probe] += np.outer(error, error)
    shown = tuple(away) if free > 0 else ()
    return _Combined(parts[0], total, within, inertia, elastic, shown)


def _largest(parts: Sequence[Array], grid: Array) -> Array:
    """Return the largest value (2,) of any of some maps."""
    values = [np.abs(evaluate(part, grid)).max(axis=1) for part in parts]
    return np.asarray(np.max(values, axis=0), np.float64)


def _drift(harmonics: Sequence[Harmonics], grid: Array) -> Array:
    """Return the largest change of the map from the first to the last half of a roll, m."""
    worst = np.zeros(2)
    for index in sorted({one.roll for one in harmonics}):
        group = [h.coefficients for h in harmonics if h.roll == index]
        half = len(group) // 2
        change = np.mean(group[-half:], axis=0) - np.mean(group[:half], axis=0)
        worst = np.maximum(worst, np.abs(evaluate(change, grid)).max(axis=1))
    return worst


def _unusable(rolls: Sequence[Roll], orders: int) -> Iterator[Problem]:
    if not rolls:
        raise RunOutError("there is no roll")
    for roll in rolls:
        count = len(roll.turns)
        if count < FEWEST_REVOLUTIONS:
            yield refusal(
                "too_few_revolutions",
                "{}: only {} complete, undisturbed revolutions; take at least {}, better {}.",
                roll.label,
                count,
                FEWEST_REVOLUTIONS,
                GOOD_REVOLUTIONS,
            )
            continue
        if count < GOOD_REVOLUTIONS:
            yield note(
                "few_revolutions",
                "{}: {} revolutions; with {} the spread is known better.",
                roll.label,
                count,
                GOOD_REVOLUTIONS,
            )
        if not 0.0 < abs(roll.speed) <= OVER * FASTEST:
            yield refusal(
                "too_fast",
                "{}: {:.1f} rpm is no slow roll: inertia moves the pin. Turn at {:.0f}"
                " rpm or less.",
                roll.label,
                60.0 * abs(roll.speed) / (2.0 * math.pi),
                60.0 * FASTEST / (2.0 * math.pi),
            )
        yield from _unusable_turns(roll, orders)


def _unusable_turns(roll: Roll, orders: int) -> Iterator[Problem]:
    for turn in roll.turns:
        where = say("{}, revolution {}", roll.label, turn.number)
        if not (np.isfinite(turn.probes).all() and np.isfinite(turn.angle).all()):
            yield refusal("not_a_number", "{}: a value is not a number; roll again.", where)
            return
        if len(turn.angle) < SAMPLES_PER_ORDER * orders:
            yield refusal(
                "too_few_samples",
                "{}: {} samples are too few for {} orders; sample faster, or ask for fewer orders.",
                where,
                len(turn.angle),
                orders,
            )
            return
        if turn.saturated:
            yield refusal("saturated", "{}: a probe is at the end of its range; move it.", where)
            return
    for probe in range(2):
        if all(np.ptp(turn.probes[probe]) == 0.0 for turn in roll.turns):
            yield refusal(
                "probe_dead",
                "{}: probe {} never changes; is it connected?",
                roll.label,
                probe + 1,
            )


def _judge(
    curve: Array, combined: Array, within: Array, between: Array | None, drift: Array
) -> Iterator[Problem]:
    um = 1e6
    for probe in range(2):
        name, size = say("Probe {}", probe + 1), float(np.abs(curve[probe]).max())
        if size > LARGE:
            yield refusal(
                "too_large",
                "{}: a run-out of {:.0f} um is no run-out of a ground pin: the pin is"
                " loose, bent, or turns about another axis.",
                name,
                um * size,
            )
        if drift[probe] > max(UNSTEADY * size, 6.0 * within[probe]):
            yield refusal(
                "unsteady",
                "{}: from the first to the last half the map changes by {:.2f} um: let"
                " the rig warm up and run in, and roll again.",
                name,
                um * drift[probe],
            )
        if between is not None and between[probe] > max(BETWEEN * size, 4.0 * within[probe]):
            yield note(
                "not_run_out",
                "{}: the rolls differ by {:.2f} um from the map: the pin moves in the"
                " follower with the load. That part is no run-out; it is counted as"
                " uncertainty.",
                name,
                um * between[probe],
            )
        if size < 2.0 * combined[probe]:
            yield note(
                "below_uncertainty",
                (
                    "{}: the run-out is not larger than its uncertainty ({:.2f} um, u = {:.2f}"
                    " um); there is no gain in applying the map."
                ),
                name,
                um * size,
                um * combined[probe],
            )
