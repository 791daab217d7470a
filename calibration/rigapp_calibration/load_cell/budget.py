"""Uncertainty of a calibrated force: a budget by GTC, and the class that it would allow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal

import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import ACROSS, Array
from rigapp_calibration.load_cell.scatter import Scatter
from rigapp_calibration.load_cell.settings import LoadCellSettings, Use
from rigapp_calibration.load_cell.two_axis import design
from rigapp_calibration.load_cell.weights import relative_force_uncertainty
from rigapp_calibration.taking.uncertainty import Budget, Contribution, at_most, combine

NEAR = 1.06
"""Factor of the largest load up to which forces count as calibrated: pieces rarely sum to full
scale."""
IN_A_ZERO = 1.15
"""Factor of the half width of a zero's shift: a metal with hysteresis always shifts by about two
thirds of the loop, whose root mean square is that of a rectangle so much wider. A zero in use that
is taken at another angle has all of it."""
LEAN_OF_A_PART = 2.0
"""The same for a cell loaded to part of its scale: loops grow with the square of the load
(Rayleigh); a previous load in the other direction makes one twice as long, half of it the shift."""
SMALLEST_SHARE = 0.2
"""Part of full scale: smallest force for which the needs of a class are stated, as a fifth of
it."""
BUDGET_AT = (0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
"""Shares of full scale at which the uncertainty is stated; U = a + b F bounds it between them."""
DIRECTIONS = 16
"""Directions of the load, of which the worst is stated; from eight angles on all are alike."""


@dataclass(frozen=True, slots=True)
class LoadUncertainty:
    """The uncertainty of one reading at a load (N): across the force, and along it, that of |F|.

    ``Budget.of_mean`` gives that of a mean of readings.
    """

    load: float
    magnitude: Budget
    across: Budget

    @property
    def component(self) -> Budget:
        """Return the budget of a component in its worst direction."""
        return max(self.magnitude, self.across, key=lambda one: one.expanded)


def uncertainty_at(parts: Scatter, settings: LoadCellSettings, load: float) -> LoadUncertainty:
    """Return the budgets of one reading at a load (N); the worst direction of the load is taken.

    Along the force are scale, reproducibility, creep, and what changes the gain; across it is the
    angle reference. Zero, reversibility, fit and repeatability are in both.
    """
    steps, scatters = _steps(parts, settings)
    use, full = settings.use, settings.cell.full_scale
    relative = relative_force_uncertainty(settings.weights, settings.place)
    points = parts.branches.points(load)
    free = float(parts.series - 1)
    along = (
        Contribution(say("applied force (mass, gravity, buoyancy)"), relative * load),
        Contribution(say("reproducibility between series"), parts.gain_between * load, free, "A"),
        at_most(say("creep, measured"), use.creep * load, "A")
        if use.creep_measured
        else at_most("creep", use.creep * load),
        at_most(say("temperature, gain"), use.gain_per_kelvin * use.temperature * load),
        at_most(say("change until the next calibration"), use.change * load),
        at_most(say("hysteresis that was not read"), _loop(parts, settings, load)),
        at_most(say("dead zone"), min(use.dead_zone * full, load)),
    )
    both = (
        *_zeros(parts, settings),
        # Hysteresis of each bridge depends on its own load, whatever the direction of the force.
        Contribution(
            say("reversibility and interpolation"),
            math.sqrt(float(np.mean(np.square(points)))) if points else 0.0,
            evaluation="A",
            distribution="two-point",
            points=points,
        ),
        *_introduction(use, load),
        at_most(
            say("terms that the pin angles do not show"),
            _undetermined_cross_terms(parts, settings, load),
        ),
        at_most(say("loads beyond the largest"), _beyond_largest(parts, settings, load)),
        at_most(say("temperature, zero"), use.zero_per_kelvin * use.temperature * full),
        _display(parts, steps),
        Contribution("repeatability", scatters, parts.degrees, "A", averages=True),
    )
    turned = (
        Contribution(say("angle reference"), settings.angle_uncertainty * load),
        at_most(say("angle in use"), use.angle * load),
    )
    return LoadUncertainty(
        load,
        combine(load, (*along, _fit(parts, load, across=False), *both)),
        combine(load, (*turned, _fit(parts, load, across=True), *both)),
    )


def of_calibration(parts: Scatter, settings: LoadCellSettings) -> tuple[LoadUncertainty, ...]:
    """Return the uncertainties of the calibration itself, from no load to the largest one.

    As a laboratory states them (ILAC-P14): without contributions from later use or transport.
    """
    largest = parts.branches.largest
    use = replace(
        settings.use, temperature=0.0, creep=0.0, change=0.0, angle=0.0, largest=largest,
        other_adapter=False,
    )  # fmt: skip
    loads = [share * settings.cell.full_scale for share in BUDGET_AT]
    loads = [*(load for load in loads if load * NEAR < largest), largest]
    return tuple(uncertainty_at(parts, replace(settings, use=use), load) for load in loads)


def _zeros(parts: Scatter, settings: LoadCellSettings) -> tuple[Contribution, ...]:
    """Return the contributions of the zero, and of the subtracted pin weight, to a component."""
    zeros = parts.zeros
    more = 1.0
    if settings.use.zeroed:
        part = settings.cell.full_scale > NEAR * parts.branches.largest
        more = LEAN_OF_A_PART if part else IN_A_ZERO
    weight = (
        Contribution(say("own weight of the pin"), zeros.weight_uncertainty, zeros.degrees, "A"),
        # A zero shifts towards the previous load; so does the weight of a pin.
        at_most(say("zero shift after a load"), more * _zero_shift(parts, settings), "A"),
    )
    if settings.use.zeroed:
        return weight
    rest = float(zeros.rest_uncertainty.max())
    return (
        *weight,
        Contribution(say("zero of the calibration"), rest, zeros.degrees, "A"),
        Contribution(say("zero between series"), parts.zero_between, zeros.degrees, "A"),
        at_most(say("zero drift during the calibration"), parts.drift, "A"),
    )


def _zero_shift(parts: Scatter, settings: LoadCellSettings) -> float:
    """Return the possible shift (N) of a zero to the previous load: loop, and half the creep.

    The hysteresis at no load depends on previous loads, between 0 and the widest loop; half of
    the creep has recovered before a zero is read.
    """
    use, full = settings.use, settings.cell.full_scale
    loop = parts.branches.widest() if _loops_read(parts, settings) else use.loop * full
    return loop + 0.5 * use.creep * full


def _introduction(use: Use, load: float) -> tuple[Contribution, ...]:
    """Return the contributions of the load introduction: each adapter has its own."""
    if not use.introduction:
        return ()
    size = use.introduction * load
    here = at_most(say("load introduction, in the calibration"), size)
    return (here, at_most(say("load introduction, in use"), size)) if use.other_adapter else (here,)


def _undetermined_cross_terms(parts: Scatter, settings: LoadCellSettings, load: float) -> float:
    """Return the half width (N) of cross terms that the pin angles of the plan do not determine."""
    if parts.shown:
        return 0.0
    return settings.use.cross_terms * load**2 / settings.cell.full_scale


def _beyond_largest(parts: Scatter, settings: LoadCellSettings, load: float) -> float:
    """Return the half width (N) of a nonlinearity of third degree beyond the largest load."""
    largest, full = parts.branches.largest, settings.cell.full_scale
    # Loads just short of full scale are due to the pieces, not extrapolation.
    if load <= NEAR * largest:
        return 0.0
    return settings.use.nonlinearity * load * (load**2 - largest**2) / full**2


def _reach(settings: LoadCellSettings) -> float:
    """Return the largest force in use, N."""
    full, stated = settings.cell.full_scale, settings.use.largest
    return full if stated is None else min(stated, full)


def _loops_read(parts: Scatter, settings: LoadCellSettings) -> bool:
    """Return whether falling loads were read, in cycles as long as those in use."""
    return parts.falling and _reach(settings) <= NEAR * parts.branches.largest


def _loop(parts: Scatter, settings: LoadCellSettings, load: float) -> float:
    """Return the half width (N) of the hysteresis that is stated where it was not measured."""
    if _loops_read(parts, settings):
        return 0.0
    share = min(load / _reach(settings), 1.0)
    return settings.use.loop * settings.cell.full_scale * math.sin(math.pi * share)


def zero_uncertainty(parts: Scatter, settings: LoadCellSettings) -> tuple[Budget, Budget]:
    """Return the budgets of both zeros, signal unit, at the middle of the calibration."""
    zeros = parts.zeros
    one, two = (
        (
            Contribution(
                "fit", float(np.hypot(*(row * zeros.rest_uncertainty))), zeros.degrees, "A"
            ),
            # All zeros are read with the same resolution step of the display.
            _display(parts, _steps(parts, settings)[0] * float(np.hypot(*row))),
        )
        for row in parts.found.sensitivity
    )
    return combine(0.0, one), combine(0.0, two)


def pin_weight(parts: Scatter, settings: LoadCellSettings) -> Budget:
    """Return the weight of the turning parts, N, as it acts where the loads hang."""
    zeros = parts.zeros
    lines = (
        Contribution(say("zeros over the pin angle"), zeros.weight_uncertainty, zeros.degrees, "A"),
        at_most(say("zero shift after a load"), _zero_shift(parts, settings), "A"),
    )
    return combine(zeros.weight, lines)


def element_uncertainties(parts: Scatter, settings: LoadCellSettings) -> tuple[Budget, ...]:
    """Return the budgets of the matrix elements 11, 12, 21, 22, N per signal unit.

    Each includes what no residual shows: the scale (applied force), the turn (angle
    reference), and half the difference of the gains of the rising and the falling branch.
    """
    matrix = parts.found.matrix
    turned = ACROSS @ matrix
    relative = relative_force_uncertainty(settings.weights, settings.place)
    gain = _gain_of_rising(parts, settings)
    budgets = []
    for row, column in np.ndindex(2, 2):
        size = abs(float(matrix[row, column]))
        # d matrix = - (d force per force) matrix
        force = np.zeros((2, parts.found.terms.count))
        force[row, :2] = matrix[:, column]
        budgets.append(
            combine(
                float(matrix[row, column]),
                (
                    Contribution(say("applied force (mass, gravity, buoyancy)"), relative * size),
                    Contribution(
                        say("angle reference"),
                        settings.angle_uncertainty * abs(float(turned[row, column])),
                    ),
                    Contribution(
                        "reversibility", gain * size, evaluation="A", distribution="two-point"
                    ),
                    _fit_contribution(parts, force),
                ),
            )
        )
    return tuple(budgets)


def matrix_covariance(parts: Scatter, settings: LoadCellSettings) -> Array:
    """Return the covariance (4, 4) of the matrix elements 11, 12, 21, 22 (first order)."""
    matrix = parts.found.matrix
    p = parts.found.terms.count
    place = [0, 1, p, p + 1]
    relative = relative_force_uncertainty(settings.weights, settings.place)
    scale, turn = matrix.ravel(), (ACROSS @ matrix).ravel()
    through = np.kron(np.eye(2), matrix.T)
    return np.asarray(
        through @ parts.scores.coefficients()[np.ix_(place, place)] @ through.T
        + (relative**2 + _gain_of_rising(parts, settings) ** 2) * np.outer(scale, scale)
        + settings.angle_uncertainty**2 * np.outer(turn, turn),
        dtype=np.float64,
    )


def _gain_of_rising(parts: Scatter, settings: LoadCellSettings) -> float:
    """Return the relative difference of the gain of rising loads from the fit's.

    Too few loads show no branches: then it is half of the loop that the settings state.
    """
    known = len(parts.branches.coefficients) > 0
    return parts.branches.gain() if known else 0.5 * settings.use.loop


def _steps(parts: Scatter, settings: LoadCellSettings) -> tuple[float, float]:
    """Return the display's resolution error left in a mean, and the remaining repeatability, N.

    Readings that scatter less than the steps do are means over blurred steps. Of single readings
    the steps scatter like noise.
    """
    if parts.repeatability >= settings.cell.resolution / math.sqrt(12.0):
        return 0.0, parts.repeatability
    steps = min(parts.steps, parts.repeatability)
    return steps, math.sqrt(parts.repeatability**2 - steps**2)


def _display(parts: Scatter, steps: float) -> Contribution:
    return Contribution(say("steps of the display in a mean"), steps, parts.degrees, "A")


def _fit(parts: Scatter, load: float, *, across: bool) -> Contribution:
    """Return the fit's contribution to a force along it or across it, in the worst direction."""
    turns = 2.0 * np.pi / DIRECTIONS * np.arange(DIRECTIONS)
    units = np.stack((np.cos(turns), np.sin(turns)), axis=-1)
    combinations = np.einsum(
        "da,dp->dap", units @ ACROSS if across else units, _terms(parts, load * units)
    ).reshape(DIRECTIONS, -1)
    covariance = parts.scores.coefficients()
    worst = np.einsum("du,uv,dv->d", combinations, covariance, combinations).argmax()
    return _fit_contribution(parts, combinations[worst])


def _fit_contribution(parts: Scatter, combination: Array) -> Contribution:
    """Return the fit's contribution to a combination (2 p,) of coefficients in N, axis-major."""
    variance, degrees = parts.scores.variance(combination.ravel())
    return Contribution("fit", math.sqrt(variance), degrees, "A")


def _terms(parts: Scatter, force: Array) -> Array:
    """Return the terms (n, p) of the fit at forces (n, 2), N, in the middle of the calibration."""
    rows = design(force, parts.found.terms)
    if parts.found.terms.drift:
        rows[:, -1] = 0.0
    return rows


def expanded_line(budgets: Sequence[Budget]) -> tuple[float, float]:
    """Return a (N) and b of U(F) = a + b F that bounds the expanded uncertainties from above.

    b is not below 0: a rig file states an uncertainty that does not fall with the force.
    """
    force = np.array([one.value for one in budgets])
    expanded = np.array([one.expanded for one in budgets])
    slope = max(float(np.polyfit(force, expanded, 1)[0]), 0.0)
    return float(np.max(expanded - slope * force)), slope


def plain(value: float, digits: int = 4) -> str:
    """Return a number of some significant digits without an exponent: 0.00005, 20000."""
    return f"{Decimal(f'{value:.{digits}g}'):f}"


def classification(settings: LoadCellSettings, single: float) -> str:
    """Return in words the class that the force standards allow, and the averaging it would need.

    single: standard deviation of one reading, N.
    """
    full, step = settings.cell.full_scale, settings.cell.resolution
    e74, iso = 400.0 * step, 500.0 * step
    if e74 <= full and iso <= full:
        return say(
            "With a resolution of {} N the smallest force for ASTM E74 class A is"
            " {} N and for ISO 376 class 2 {} N; whether a class is reached is for"
            " a calibration of one axis under these standards to show. This procedure"
            " follows them, it does not comply.",
            *map(plain, (step, e74, iso)),
        )
    smallest = SMALLEST_SHARE * full
    class_2, class_1 = smallest / 500.0, smallest / 1000.0
    return say(
        "Not classifiable: with a resolution of {} N, ASTM E74 class A needs forces"
        " of at least {} N and ISO 376 class 2 of at least {} N, above the full"
        " scale of {} N. The expanded uncertainty is stated instead of a class. For"
        " forces from {} N upward, class 2 would need a resolution of {} N and"
        " class 1 of {} N{}.",
        *map(plain, (step, e74, iso, full, smallest, class_2, class_1)),
        _averaging(single, class_2),
    )


def _averaging(single: float, wanted: float) -> str:
    """Return how many readings a mean needs to be known as well as a resolution ``wanted``."""
    if not single > 0.0:
        return ""
    count = math.ceil((single / (wanted / math.sqrt(12.0))) ** 2)
    if count < 2:
        return say(
            ". The readings of this calibration scatter by {} N: if they are means"
            " of many, such means would reach class 2; a single reading does not",
            plain(single, 2),
        )
    return say(
        ". A reading scatters by {} N: the mean of about {} readings at each load"
        " would reach class 2",
        plain(single, 2),
        count,
    )
