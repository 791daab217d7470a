"""Calibrate the two-axis load cell from dead-weight readings: fit, checks, uncertainty, verdict."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibration.load_cell.budget import (
    Budget,
    budget,
    classification,
    expanded_line,
    matrix_covariance,
)
from calibration.load_cell.characteristics import Characteristics, characteristics, loads
from calibration.load_cell.checks import check_fit
from calibration.load_cell.evidence import examine
from calibration.load_cell.reading_checks import check_readings
from calibration.load_cell.readings import LoadCellReadings
from calibration.load_cell.settings import LoadCellSettings
from calibration.load_cell.two_axis import TwoAxisFit, choose_terms
from calibration.load_cell.weights import STANDARD_GRAVITY, pin_force, weight_force
from calibration.problems import Problem

Array = NDArray[np.float64]

STEADY_CODES = frozenset(
    {
        "not_a_number",
        "too_few_angles",
        "too_few_readings",
        "bridge_dead",
        "negative_mass",
        "mass_unit",
        "overload",
        "angle_unit",
        "signal_unit",
        "duplicated_rows",
        "copied_series",
    }
)
"""Problems without whose cure there is nothing to fit."""


@dataclass(frozen=True, slots=True)
class LoadCellCalibration:
    """The result. force on the pin = matrix (signal - zero), pin frame; SI, signal unit as read.

    matrix, zero and what follows are None when nothing could be fitted. covariance: of the matrix
    elements 11, 12, 21, 22. expanded_line: a (N), b of U(F) = a + b F at the coverage factor.
    """

    accepted: bool
    problems: tuple[Problem, ...]
    terms: str
    fit: TwoAxisFit | None
    covariance: Array | None
    traits: Characteristics | None
    budget: Budget | None
    expanded_line: tuple[float, float] | None
    classification: str
    applied: Array
    measured: Array | None


def calibrate_load_cell(
    readings: LoadCellReadings, settings: LoadCellSettings
) -> LoadCellCalibration:
    """Fit, check and judge; a calibration with a blocking problem is not accepted."""
    problems = list(check_readings(readings, settings))
    applied = _applied(readings, settings)
    if STEADY_CODES & {problem.code for problem in problems} or not _earthly(settings):
        return _refused(problems, settings, applied)
    try:
        evidence = examine(readings, settings)
    except np.linalg.LinAlgError:
        problems.append(
            Problem(
                "not_solvable",
                "The loads do not tell the two axes apart; take more pin angles and loads.",
            )
        )
        return _refused(problems, settings, applied)
    problems += check_fit(evidence)
    found, terms = choose_terms(applied, readings.signal)
    measured = found.force(readings.signal)
    traits = characteristics(
        loads(readings, applied, measured), settings.cell.full_scale, found.residual
    )
    full = settings.cell.full_scale
    budgets = tuple(budget(found, traits, settings, share * full) for share in (0.1, 0.4, 0.7, 1.0))
    return LoadCellCalibration(
        accepted=not any(problem.blocks for problem in problems),
        problems=tuple(problems),
        terms=terms,
        fit=found,
        covariance=matrix_covariance(found, traits, settings),
        traits=traits,
        budget=budgets[-1],
        expanded_line=expanded_line(budgets),
        classification=classification(settings, found.residual_std),
        applied=applied,
        measured=measured,
    )


def _earthly(settings: LoadCellSettings) -> bool:
    """Tell whether gravity is near enough to the truth for forces to be compared."""
    return abs(settings.place.gravity / STANDARD_GRAVITY - 1.0) < 0.02


def _applied(readings: LoadCellReadings, settings: LoadCellSettings) -> Array:
    weight = weight_force(readings.mass, settings.weights, settings.place)
    return pin_force(weight, readings.angle, settings.angle_offset)


def _refused(
    problems: list[Problem], settings: LoadCellSettings, applied: Array
) -> LoadCellCalibration:
    return LoadCellCalibration(
        accepted=False,
        problems=tuple(problems),
        terms="",
        fit=None,
        covariance=None,
        traits=None,
        budget=None,
        expanded_line=None,
        classification=classification(settings, 0.0),
        applied=applied,
        measured=None,
    )
