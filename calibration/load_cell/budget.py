"""The uncertainty of a calibrated force: a budget by GTC, and what class it would allow."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from calibration.arrays import Array
from calibration.load_cell.characteristics import Characteristics
from calibration.load_cell.settings import LoadCellSettings
from calibration.load_cell.two_axis import TwoAxisFit
from calibration.load_cell.weights import relative_force_uncertainty
from calibration.taking.uncertainty import Budget, Contribution, combine


def turn_derivative(sensitivity: Array) -> Array:
    """Return how the fitted A (2, 2) changes with a common angle offset, per radian.

    A pin that stands at a larger angle than believed turns every force; the fit turns A with it and
    leaves no residual, so only the angle reference step bounds this error.
    """
    return np.asarray(sensitivity @ np.array([[0.0, 1.0], [-1.0, 0.0]]), dtype=np.float64)


def sensitivity_covariance(
    found: TwoAxisFit, traits: Characteristics, settings: LoadCellSettings
) -> Array:
    """Return the covariance (4, 4) of A11, A12, A21, A22 with what no residual shows.

    That is the scale (applied force), half the hysteresis loop (the fit lies between rising and
    falling readings) and the turn (angle reference).
    """
    scale = found.sensitivity.ravel()
    turn = turn_derivative(found.sensitivity).ravel()
    relative = relative_force_uncertainty(settings.weights, settings.place)
    between = abs(traits.loop or 0.0) / 100.0 / 2.0 / math.sqrt(3.0)
    return np.asarray(
        found.sensitivity_covariance()
        + (relative**2 + between**2) * np.outer(scale, scale)
        + settings.angle_uncertainty**2 * np.outer(turn, turn),
        dtype=np.float64,
    )


def matrix_covariance(
    found: TwoAxisFit, traits: Characteristics, settings: LoadCellSettings
) -> Array:
    """Return the covariance (4, 4) of the matrix elements 11, 12, 21, 22 (first order)."""
    return _through_inverse(found.matrix, sensitivity_covariance(found, traits, settings))


@dataclass(frozen=True, slots=True)
class LoadUncertainty:
    """The uncertainty of one reading at a load (N): of a component (worst direction), of |F|.

    ``Budget.of_mean`` tells that of a mean of readings.
    """

    load: float
    component: Budget
    magnitude: Budget


def uncertainty_at(
    found: TwoAxisFit, traits: Characteristics, settings: LoadCellSettings, load: float
) -> LoadUncertainty:
    """Return the budgets of one reading at a load (N): the worst direction of the load is taken.

    An error of the angle turns the force: it is in the components, |F| stays.
    """
    relative = relative_force_uncertainty(settings.weights, settings.place)
    directions = np.linspace(0.0, 2.0 * np.pi, 73)
    force = load * np.stack((np.cos(directions), np.sin(directions)), axis=-1)
    variance = float(np.linalg.eigvalsh(found.force_covariance(force)).max())
    free = 2.0 * found.degrees
    common = [
        Contribution("applied force (mass, gravity, buoyancy)", relative * load),
        Contribution("fit", math.sqrt(variance), free, "A"),
        Contribution("repeatability", found.residual_std, free, "A", averages=True),
    ]
    if traits.loop is not None:
        half = abs(traits.loop) / 200.0 * load
        common.append(Contribution("reversibility", half, math.inf, "A", "two-point"))
    if traits.zero_return is not None:
        zero = traits.zero_return / 100.0 * settings.cell.full_scale / math.sqrt(3.0)
        common.append(Contribution("zero return", zero, math.inf, "A", "rectangular"))
    turned = Contribution("angle reference", settings.angle_uncertainty * load)
    return LoadUncertainty(load, combine(load, (turned, *common)), combine(load, tuple(common)))


def zero_uncertainty(found: TwoAxisFit) -> Budget:
    """Return the budget of the zero, N, of the axis where it is larger."""
    place = [2, found.terms.count + 2]
    covariance = found.covariance[np.ix_(place, place)]
    spread = float(np.sqrt(np.linalg.eigvalsh(found.matrix @ covariance @ found.matrix.T).max()))
    return combine(0.0, (Contribution("fit", spread, 2.0 * found.degrees, "A"),))


def expanded_line(budgets: tuple[Budget, ...]) -> tuple[float, float]:
    """Return a (N) and b of U(F) = a + b F that bounds the expanded uncertainties from above."""
    force = np.array([one.value for one in budgets])
    expanded = np.array([one.expanded for one in budgets])
    slope, intercept = np.polyfit(force, expanded, 1)
    lift = float(np.max(expanded - intercept - slope * force))
    return float(intercept) + lift, float(slope)


def classification(settings: LoadCellSettings, single: float) -> str:
    """Say in words what the force standards allow, and what averaging would have to reach.

    single: standard deviation of one reading, N.
    """
    full, step = settings.cell.full_scale, settings.cell.resolution
    e74, iso = 400.0 * step, 500.0 * step
    if e74 <= full and iso <= full:
        return (
            f"With a resolution of {step:g} N the smallest force for ASTM E74 class A is {e74:g} N"
            f" and for ISO 376 class 2 {iso:g} N; whether a class is reached is for a calibration"
            " of one axis under these standards to show. This procedure follows them, it does not"
            " comply."
        )
    smallest = 80.0
    class_2, class_1 = smallest / 500.0, smallest / 1000.0
    return (
        f"Not classifiable: with a resolution of {step:g} N, ASTM E74 class A needs forces of at"
        f" least {e74:g} N and ISO 376 class 2 of at least {iso:g} N, above the full scale of"
        f" {full:g} N. The expanded uncertainty is stated instead of a class. For forces from"
        f" {smallest:g} N upward, class 2 would need a resolution of {class_2:.2f} N and class 1 of"
        f" {class_1:.2f} N.{_averaging(single, class_2)}"
    )


def _averaging(single: float, wanted: float) -> str:
    """Say how many readings a mean needs until it is known as well as a resolution ``wanted``."""
    if not single > 0.0:
        return ""
    count = math.ceil((single / (wanted / math.sqrt(12.0))) ** 2)
    if count < 2:
        return (
            f" The readings of this calibration scatter by {single:.3f} N: if they are means of"
            " many, such means would reach class 2; a single reading does not."
        )
    return (
        f" A reading scatters by {single:.2f} N: the mean of about {count} readings at each load"
        " would reach class 2."
    )


def _through_inverse(matrix: Array, covariance: Array) -> Array:
    """Carry a covariance of A to one of its inverse."""
    jacobian = -np.einsum("ia,bj->ijab", matrix, matrix).reshape(4, 4)
    return np.asarray(jacobian @ covariance @ jacobian.T, dtype=np.float64)
