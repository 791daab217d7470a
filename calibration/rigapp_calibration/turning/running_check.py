"""The running check: the pin's own inertia in the cell, without the follower, at several speeds.

The mass m outboard of the gauges, its centre at the distance r from the crank's axis, presses the
cell outward with m r w^2. Force on the follower by the pin has the opposite sign, so

    force_1 = - m r w^2,    force_2 = 0,

constant in the crank frame. The slowest speed is the zero; the difference of the faster ones must
equal the known term within the uncertainty. It is the only check with a turning spindle.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.problems import Problem, blocked, note, refusal

COVERAGE = 2.0
"""About 95 % (GUM 6.3.3)."""
LEAST_REVOLUTIONS = 5
"""Revolutions whose spread is a standard uncertainty."""


@dataclass(frozen=True, slots=True)
class Known:
    """Known values.

    m r (kg m) and its relative standard uncertainty; of the cell the resolution (N) and the
    relative standard uncertainty of a force.
    """

    moment: float
    moment_uncertainty: float
    resolution: float
    relative: float


@dataclass(frozen=True, slots=True)
class SpeedRun:
    """Revolutions at one speed: speeds (n,) rad/s, mean forces (n, 2) N, spread within one, N."""

    speed: Array
    force: Array
    spread: float


@dataclass(frozen=True, slots=True)
class Comparison:
    """One speed against the slowest: known and measured change (2,) N, expanded uncertainty, N."""

    speed: float
    known: tuple[float, float]
    measured: tuple[float, float]
    expanded: float

    @property
    def agrees(self) -> bool:
        """Return whether both components agree within the expanded uncertainty."""
        return max(abs(m - k) for m, k in zip(self.measured, self.known, strict=True)) <= (
            self.expanded
        )


@dataclass(frozen=True, slots=True)
class RunningCheck:
    """The result. moment: m r (kg m) by the cell, with its expanded uncertainty."""

    accepted: bool
    problems: tuple[Problem, ...]
    comparisons: tuple[Comparison, ...]
    moment: float | None
    moment_expanded: float | None
    sentence: str


def running_check(runs: Sequence[SpeedRun], known: Known) -> RunningCheck:
    """Compare the change over the speeds with the known term; raise ValueError below two speeds."""
    order = sorted(runs, key=lambda run: float(run.speed.mean()) if len(run.speed) else 0.0)
    if len(order) < 2:
        raise ValueError(say("two speeds are the least: the slowest is the zero"))
    short = tuple(_short(run) for run in order if len(run.speed) < LEAST_REVOLUTIONS)
    if short:
        return RunningCheck(False, short, (), None, None, short[0].sentence)
    zero, faster = order[0], order[1:]
    found = tuple(_compare(run, zero, known) for run in faster)
    moment, expanded = _moment(found, zero)
    faults = tuple(_problem(one, moment) for one in found if not one.agrees)
    fast = max(found, key=lambda one: one.speed)
    if known.moment > 0.0 and abs(fast.known[0]) < fast.expanded:
        faults += (
            note(
                "too_slow",
                (
                    "At the fastest speed the known term is {:.2f} N, less than the uncertainty"
                    " of {:.2f} N: this proves little; use a higher speed."
                ),
                abs(fast.known[0]),
                fast.expanded,
            ),
        )
    accepted = not blocked(faults)
    return RunningCheck(
        accepted, faults, found, moment, expanded, _sentence(accepted, fast, moment, expanded)
    )


def dither_error(spread: float, resolution: float) -> float:
    """Return the standard uncertainty (N) that steps of ``resolution`` leave in a long mean.

    A spread within the readings smooths the steps: the error's amplitude is resolution / pi
    exp(-2 pi^2 s^2 / resolution^2) (the first harmonic of the staircase; Widrow's quantisation
    theory). Spread: standard deviation as read, the steps' own part included.
    """
    if resolution <= 0.0:
        return 0.0
    own = max(spread**2 - resolution**2 / 12.0, 0.0)
    amplitude = resolution / math.pi * math.exp(-2.0 * math.pi**2 * own / resolution**2)
    return amplitude / math.sqrt(2.0)


def _short(run: SpeedRun) -> Problem:
    return refusal(
        "too_few_revolutions",
        "Only {} revolutions at a steady speed; take at least {}.",
        len(run.speed),
        LEAST_REVOLUTIONS,
    )


def _compare(run: SpeedRun, zero: SpeedRun, known: Known) -> Comparison:
    squares = float(np.mean(run.speed**2) - np.mean(zero.speed**2))
    term = -known.moment * squares
    change = run.force.mean(axis=0) - zero.force.mean(axis=0)
    parts = [known.moment_uncertainty * term, known.relative * float(np.hypot(*change))]
    for one in (run, zero):
        parts.append(float(one.force.std(axis=0, ddof=1).max()) / math.sqrt(len(one.force)))
        parts.append(dither_error(one.spread, known.resolution))
    expanded = COVERAGE * math.sqrt(sum(part**2 for part in parts))
    speed = float(run.speed.mean())
    return Comparison(speed, (term, 0.0), (float(change[0]), float(change[1])), expanded)


def _moment(found: Sequence[Comparison], zero: SpeedRun) -> tuple[float, float]:
    """Return m r and its expanded uncertainty from all speeds, weighted least squares."""
    slow = float(np.mean(zero.speed**2))
    squares = np.array([one.speed**2 - slow for one in found])
    weights = np.array([1.0 / max(one.expanded, 1e-9) ** 2 for one in found])
    power = float(np.sum(weights * squares**2))
    change = np.array([one.measured[0] for one in found])
    return -float(np.sum(weights * squares * change)) / power, 1.0 / math.sqrt(power)


def _problem(one: Comparison, moment: float) -> Problem:
    rpm = one.speed * 30.0 / math.pi
    along, across = (m - k for m, k in zip(one.measured, one.known, strict=True))
    if abs(across) > one.expanded:
        return refusal(
            "across",
            "At {:.0f} rpm the force across the crank changes by {:+.2f} N, which"
            " inertia cannot do (uncertainty {:.2f} N): are the axes and the angle"
            " reference right, and is the follower off?",
            rpm,
            across,
            one.expanded,
        )
    return refusal(
        "inertia_differs",
        "At {:.0f} rpm force_1 changes by {:+.2f} N instead of {:+.2f} N, {:+.2f} N off"
        " (uncertainty {:.2f} N), as if mass times radius were {:.3f} kg mm: check that"
        " mass, the sign of force_1, and that the follower is off.",
        rpm,
        one.measured[0],
        one.known[0],
        along,
        one.expanded,
        1000.0 * moment,
    )


def _sentence(accepted: bool, fast: Comparison, moment: float, expanded: float) -> str:
    rpm = fast.speed * 30.0 / math.pi
    if not accepted:
        return say("The running check failed: the turning cell does not show the known inertia.")
    return say(
        (
            "The running check is passed: at {:.0f} rpm force_1 changes by {:+.2f} N, {:+.2f} N"
            " are known, the uncertainty is {:.2f} N. The cell gives mass times radius as {:.3f}"
            " kg mm, +- {:.3f}."
        ),
        rpm,
        fast.measured[0],
        fast.known[0],
        fast.expanded,
        1000.0 * moment,
        1000.0 * expanded,
    )
