"""Calibrate the two-axis load cell from dead-weight readings: fit, checks, uncertainty, verdict."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.budget import (
    LoadUncertainty,
    classification,
    element_uncertainties,
    expanded_line,
    matrix_covariance,
    uncertainty_at,
    zero_uncertainty,
)
from rigapp_calibration.load_cell.characteristics import (
    Characteristics,
    Creep,
    characteristics,
    check_creep,
    creep,
    loads,
    unusable_creep,
)
from rigapp_calibration.load_cell.checks import check_fit
from rigapp_calibration.load_cell.evidence import examine
from rigapp_calibration.load_cell.plausible import impossible
from rigapp_calibration.load_cell.reading_checks import check_readings
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.scatter import Scatter, scatter
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.two_axis import TwoAxisFit, choose_terms
from rigapp_calibration.load_cell.weights import weight_force
from rigapp_calibration.problems import Problem, blocked
from rigapp_calibration.taking.uncertainty import Budget

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
BUDGET_AT = (0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0)
"""Shares of full scale at which the uncertainty is told; U = a + b F bounds it between them."""


@dataclass(frozen=True, slots=True)
class LoadCellCalibration:
    """The result. force on the pin = matrix (signal - zero), pin frame; SI, signal unit as read.

    matrix, zero and what follows are None when nothing could be fitted. covariance: of the matrix
    elements 11, 12, 21, 22, elements: their budgets. by_load: the uncertainty from no load to full
    scale. zero: of the zeros of both axes, signal unit. expanded_line: a (N), b of U(F) = a + b F
    of one reading of a component. creep: None where it was not measured, and U has the stated one.
    """

    problems: tuple[Problem, ...]
    classification: str
    terms: str = ""
    fit: TwoAxisFit | None = None
    covariance: Array | None = None
    traits: Characteristics | None = None
    parts: Scatter | None = None
    by_load: tuple[LoadUncertainty, ...] = ()
    elements: tuple[Budget, ...] = ()
    zero: tuple[Budget, Budget] | None = None
    expanded_line: tuple[float, float] | None = None
    applied: Array | None = None
    creep: Creep | None = None

    @property
    def budget(self) -> Budget | None:
        """Return the budget of one reading of a component at full scale."""
        return self.by_load[-1].component if self.by_load else None

    @property
    def accepted(self) -> bool:
        """Tell whether there is a fit and nothing blocks it."""
        return self.fit is not None and not blocked(self.problems)


def calibrate_load_cell(
    readings: LoadCellReadings, settings: LoadCellSettings, drift: bool | None = None
) -> LoadCellCalibration:
    """Fit, check and judge; a calibration with a blocking problem is not accepted.

    drift: whether the zero's drift is fitted, where it is not for the readings to say.
    """
    problems = list(check_readings(readings, settings))
    refused = LoadCellCalibration(tuple(problems), classification(settings, 0.0))
    if STEADY_CODES & {problem.code for problem in problems} or any(impossible(settings)):
        return refused
    try:
        evidence = examine(readings, settings)
    except np.linalg.LinAlgError:
        words = "The loads do not tell the two axes apart; take more pin angles and loads."
        return replace(refused, problems=(*problems, Problem("not_solvable", words)))
    problems += check_fit(evidence)
    applied = evidence.force
    found, terms = choose_terms(applied, readings.signal, drift)
    measured = found.force(readings.signal)
    full = settings.cell.full_scale
    seen = loads(readings, applied, measured)
    traits = characteristics(seen, full, found.residual)
    parts = scatter(found, applied, seen)
    crept = _creep(readings, settings, found, parts)
    if crept is not None:
        problems += check_creep(crept)
        use = replace(settings.use, creep=crept.half_width, creep_measured=True)
        settings = replace(settings, use=use)
    elif readings.hung is not None:
        problems += unusable_creep(readings.hung)
    by_load = tuple(uncertainty_at(parts, settings, share * full) for share in BUDGET_AT)
    return LoadCellCalibration(
        problems=tuple(problems),
        classification=classification(settings, found.residual_std),
        terms=terms,
        fit=found,
        covariance=matrix_covariance(parts, settings),
        elements=element_uncertainties(parts, settings),
        traits=traits,
        parts=parts,
        by_load=by_load,
        zero=zero_uncertainty(parts, settings),
        expanded_line=expanded_line([one.component for one in by_load]),
        applied=applied,
        creep=crept,
    )


def _creep(
    readings: LoadCellReadings, settings: LoadCellSettings, found: TwoAxisFit, parts: Scatter
) -> Creep | None:
    """Return the creep, None where no usable readings tell it."""
    hung = readings.hung
    if hung is None or any(unusable_creep(hung)):
        return None
    weight = weight_force(hung.mass, settings.weights, settings.place)
    return creep(hung, found, float(weight[0]), parts.repeatability)
