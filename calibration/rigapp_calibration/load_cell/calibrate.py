"""Calibrate the two-axis load cell from dead-weight readings: fit, checks, uncertainty, verdict."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.budget import (
    BUDGET_AT,
    LoadUncertainty,
    classification,
    element_uncertainties,
    expanded_line,
    matrix_covariance,
    of_calibration,
    pin_weight,
    uncertainty_at,
    zero_uncertainty,
)
from rigapp_calibration.load_cell.characteristics import (
    Characteristics,
    Creep,
    Loads,
    angle_groups,
    applied_force,
    characteristics,
    check_creep,
    creep,
    examine,
    loads,
    run_numbers,
    unusable_creep,
    without_pin_weight,
    zeros_of,
)
from rigapp_calibration.load_cell.checks import check_fit
from rigapp_calibration.load_cell.reading_checks import check_readings
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.scatter import Scatter, scatter
from rigapp_calibration.load_cell.settings import LoadCellSettings, impossible
from rigapp_calibration.load_cell.two_axis import Terms, TwoAxisFit, choose_terms, fit
from rigapp_calibration.load_cell.weights import weight_force
from rigapp_calibration.problems import Problem, blocked, refusal
from rigapp_calibration.taking.uncertainty import Budget

STEADY_CODES = frozenset(
    {
        "not_a_number",
        "too_few_angles",
        "too_few_readings",
        "too_few_loads",
        "no_zero",
        "bridge_dead",
        "negative_mass",
        "mass_unit",
        "hanger_mass",
        "overload",
        "angle_unit",
        "signal_unit",
        "duplicated_rows",
        "copied_series",
    }
)
"""Problems that prevent any fit."""


@dataclass(frozen=True, slots=True)
class LoadCellCalibration:
    """The result. force on the pin = matrix (signal - zero), pin frame; SI, signal unit as read.

    matrix, zero and what follows are None when nothing could be fitted. covariance: of the matrix
    elements 11, 12, 21, 22, elements: their budgets. by_load: the uncertainty in use, from no load
    to full scale; at_calibration: of the calibration itself, to the largest load. zero: of the
    zeros of both axes, signal unit. expanded_line: a (N), b of U(F) = a + b F of one reading of a
    component. pin_weight: as it acts where the loads hang, N. residual (n, 2): N, of all readings.
    creep: None where it was not measured, and U has the stated one.
    """

    problems: tuple[Problem, ...]
    classification: str
    terms: str = ""
    fit: TwoAxisFit | None = None
    covariance: Array | None = None
    traits: Characteristics | None = None
    parts: Scatter | None = None
    by_load: tuple[LoadUncertainty, ...] = ()
    at_calibration: tuple[LoadUncertainty, ...] = ()
    elements: tuple[Budget, ...] = ()
    zero: tuple[Budget, Budget] | None = None
    pin_weight: Budget | None = None
    expanded_line: tuple[float, float] | None = None
    applied: Array | None = None
    residual: Array | None = None
    creep: Creep | None = None

    @property
    def budget(self) -> Budget | None:
        """Return the budget of one reading of a component at full scale."""
        return self.by_load[-1].component if self.by_load else None

    @property
    def accepted(self) -> bool:
        """Return whether there is a fit and nothing blocks it."""
        return self.fit is not None and not blocked(self.problems)


@dataclass(frozen=True, slots=True, eq=False)
class CellFit:
    """A fit of readings, without any check. applied, residual (n, 2): N, of all readings."""

    fit: TwoAxisFit
    terms: str
    parts: Scatter
    loads: Loads
    applied: Array
    residual: Array


def fit_readings(
    readings: LoadCellReadings, settings: LoadCellSettings, about: Array | None = None
) -> CellFit:
    """Fit the loaded readings less the zeros of their series, and analyse the residuals.

    about (2, 2): approximate sensitivity, None to find it from the readings. Raises
    numpy.linalg.LinAlgError when the loads do not span both axes.
    """
    applied = applied_force(readings, settings)
    loaded = np.hypot(*applied.T) > 0.0
    runs = run_numbers(readings.series, angle_groups(readings.angle))
    if about is None:
        about = fit(applied, readings.signal, Terms()).sensitivity
    zeros = zeros_of(readings, settings, about)
    found, terms = choose_terms(applied[loaded], (readings.signal - zeros.own)[loaded], zeros.rest)
    zeros = zeros_of(readings, settings, found.sensitivity)
    found = replace(found, rest=zeros.rest)
    # Relative to the common zero, so that drift and scatter of the zeros remain visible.
    about_rest = np.where(loaded[:, None], zeros.own - zeros.rest, zeros.circle)
    seen = loads(readings, applied, found.force(readings.signal - about_rest))
    residual = (readings.signal - zeros.own) @ found.matrix.T
    residual[loaded] = found.residual
    per_run = float(np.count_nonzero(~loaded)) / max(len(np.unique(runs[~loaded])), 1)
    parts = scatter(found, applied[loaded], seen.only(loaded), zeros, per_run)
    return CellFit(found, terms, parts, seen, applied, residual)


def calibrate_load_cell(
    readings: LoadCellReadings, settings: LoadCellSettings
) -> LoadCellCalibration:
    """Fit, check and evaluate; a calibration with a blocking problem is not accepted."""
    problems = list(check_readings(readings, settings))
    refused = LoadCellCalibration(tuple(problems), classification(settings, 0.0))
    if STEADY_CODES & {problem.code for problem in problems} or any(impossible(settings)):
        return refused
    try:
        evidence = without_pin_weight(examine(readings, settings))
        fitted = fit_readings(readings, settings, evidence.found.sensitivity)
    except np.linalg.LinAlgError:
        words = say("The loads do not separate the two axes; take more pin angles and loads.")
        return replace(refused, problems=(*problems, Problem("not_solvable", words)))
    problems += check_fit(evidence)
    full, found, parts = settings.cell.full_scale, fitted.fit, fitted.parts
    traits = characteristics(fitted.loads, full, fitted.residual)
    crept = _creep(readings, settings, found, parts)
    if crept is not None:
        problems += check_creep(crept)
        use = replace(settings.use, creep=crept.half_width, creep_measured=True)
        settings = replace(settings, use=use)
    elif readings.hung is not None:
        problems += unusable_creep(readings.hung)
    by_load = tuple(uncertainty_at(parts, settings, share * full) for share in BUDGET_AT)
    if not blocked(problems):
        problems += check_rated_output(found.sensitivity, settings, by_load[-1])
    return LoadCellCalibration(
        problems=tuple(problems),
        classification=classification(settings, found.residual_std),
        terms=fitted.terms,
        fit=found,
        covariance=matrix_covariance(parts, settings),
        elements=element_uncertainties(parts, settings),
        traits=traits,
        parts=parts,
        by_load=by_load,
        at_calibration=of_calibration(parts, settings),
        zero=zero_uncertainty(parts, settings),
        pin_weight=pin_weight(parts, settings),
        expanded_line=expanded_line([one.component for one in by_load]),
        applied=fitted.applied,
        residual=fitted.residual,
        creep=crept,
    )


def check_rated_output(
    sensitivity: Array, settings: LoadCellSettings, at_full_scale: LoadUncertainty
) -> Iterator[Problem]:
    """Yield a bridge whose output at full scale is not that of the data sheet.

    A wrong unit of mass, or a cable that always carries part of each load, leaves no residual:
    only previous knowledge reveals them.
    """
    cell = settings.cell
    if cell.rated_output is None:
        return
    outputs = np.diag(sensitivity) * cell.full_scale
    allowed = cell.rated_tolerance + at_full_scale.magnitude.expanded / cell.full_scale
    off = outputs / cell.rated_output - 1.0
    axis = int(np.abs(off).argmax())
    if abs(off[axis]) > allowed:
        yield refusal(
            "rated_output",
            "Bridge {} gives {:.4g} mV/V at full scale, {:+.1f} % from the rated {:.4g} mV/V;"
            " {:.1f} % are allowed. Check unit and mass of the weights, and whether something"
            " carries a part of the load.",
            axis + 1,
            float(outputs[axis]),
            100.0 * float(off[axis]),
            cell.rated_output,
            100.0 * allowed,
        )


def _creep(
    readings: LoadCellReadings, settings: LoadCellSettings, found: TwoAxisFit, parts: Scatter
) -> Creep | None:
    """Return the creep, None without usable readings."""
    hung = readings.hung
    if hung is None or any(unusable_creep(hung)):
        return None
    weight = weight_force(hung.mass, settings.weights, settings.place)
    return creep(hung, found, float(weight[0]), parts.repeatability)
