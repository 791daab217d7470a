"""The result of a load-cell calibration: for ``--json`` and the record, and in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rigapp.calibrating.records import budget_result, finite, problems_of
from rigapp.calibrating.session import NumberTable, Outcome
from rigapp.config.calibration_settings import LoadCellFile, load_cell_meaning
from rigapp.texts import joined, say
from rigapp_calibration.coverage import by_uncertainty
from rigapp_calibration.load_cell.budget import LoadUncertainty, expanded_line, plain
from rigapp_calibration.load_cell.calibrate import LoadCellCalibration, calibrate_load_cell
from rigapp_calibration.load_cell.characteristics import Creep, applied_force, creep_words
from rigapp_calibration.load_cell.force_uncertainty import too_uncertain
from rigapp_calibration.load_cell.readings import load_cell_table
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.two_axis import common_zero_fit
from rigapp_calibration.problems import Problem, blocked, refusal
from rigapp_calibration.taking.readings import Rows

OF_A_FIT = (
    "matrix_N_per_unit", "zero", "residual_std_N", "expanded_uncertainty_N", "coverage_factor",
)  # fmt: skip
"""Keys of a result without a fit, too."""
Result = dict[str, Any]


def load_cell_result(calibration: LoadCellCalibration, settings: LoadCellSettings) -> Result:
    """Return the result for ``--json`` and the record, units in the keys."""
    fit, traits = calibration.fit, calibration.traits
    budget, zero = calibration.budget, calibration.zero
    problems = (*calibration.problems, *_too_uncertain(calibration, settings))
    result: dict[str, Any] = {
        "accepted": calibration.accepted and not blocked(problems),
        "problems": problems_of(problems),
        "classification": calibration.classification,
        "full_scale_N": settings.cell.full_scale,
    }
    if fit is None or traits is None or budget is None or zero is None:
        return {**result, **dict.fromkeys(OF_A_FIT)}
    applied, residual = calibration.applied, calibration.residual
    covariance, elements = calibration.covariance, calibration.elements
    assert applied is not None
    assert residual is not None
    assert covariance is not None
    zero_N = float(np.hypot(*(fit.matrix * [z.expanded for z in zero]).T).max())
    return {
        **result,
        "terms": calibration.terms,
        "matrix_N_per_unit": fit.matrix.tolist(),
        "matrix_covariance": covariance.tolist(),
        "matrix_standard_uncertainty_N_per_unit": _square(np.sqrt(np.diag(covariance)).tolist()),
        "matrix_expanded_uncertainty_N_per_unit": _square([e.expanded for e in elements]),
        "matrix_effective_degrees_of_freedom": _square([finite(e.degrees) for e in elements]),
        "zero": fit.zero.tolist(),
        **_pin_weight(calibration),
        "sensitivity_unit_per_N": fit.sensitivity.tolist(),
        "quadratic_unit_per_N2": None if fit.quadratic is None else fit.quadratic.tolist(),
        "residual_std_N": fit.residual_std,
        "uncertainty_line_N": _line(calibration.expanded_line or (budget.expanded, 0.0)),
        "uncertainty_lines_of_mean_N": {
            name: _line(
                expanded_line([getattr(at, name).of_mean(math.inf) for at in calibration.by_load])
            )
            for name in ("component", "magnitude")
        },
        **budget_result(budget, "N"),
        "magnitude": budget_result(calibration.by_load[-1].magnitude, "N"),
        "uncertainty_by_load": [_at_load(load) for load in calibration.by_load],
        "of_calibration": _of_calibration(calibration.at_calibration),
        "zero_expanded_uncertainty": [z.expanded for z in zero],
        "zero_standard_uncertainty": [z.combined for z in zero],
        "zero_effective_degrees_of_freedom": [finite(z.degrees) for z in zero],
        "zero_expanded_uncertainty_N": zero_N,
        "characteristics_percent": {
            "reproducibility_b": traits.reproducibility,
            "repeatability_b_prime": traits.repeatability,
            "interpolation_fc": traits.interpolation,
            "zero_return_f0": traits.zero_return,
            "reversibility_v": traits.reversibility,
            "creep_c": None if calibration.creep is None else calibration.creep.percent,
        },
        "creep": _creep(calibration.creep),
        "zero_drift_N": traits.drift,
        "applied_N": applied.tolist(),
        "residual_N": residual.tolist(),
    }


def _of_calibration(by_load: Sequence[LoadUncertainty]) -> dict[str, Any]:
    """Return U of the calibration itself: the other keys are for use."""
    last = by_load[-1]
    return {
        "load_N": last.load,
        **budget_result(last.component, "N"),
        "magnitude": budget_result(last.magnitude, "N"),
        "uncertainty_line_N": _line(expanded_line([load.component for load in by_load])),
        "uncertainty_by_load": [_at_load(load) for load in by_load],
    }


def _pin_weight(calibration: LoadCellCalibration) -> dict[str, Any]:
    """Return the weight of the turning parts, as it acts where the loads hang."""
    weight = calibration.pin_weight
    assert weight is not None
    return {"pin_weight_N": weight.value, "pin_weight_expanded_uncertainty_N": weight.expanded}


def _creep(creep: Creep | None) -> dict[str, Any] | None:
    if creep is None:
        return None
    return {
        "load_N": creep.load,
        "hung_s": list(creep.times),
        "change_N": creep.change,
        "half_width_percent": 100.0 * creep.half_width,
    }


def _at_load(uncertainty: LoadUncertainty) -> dict[str, Any]:
    """Return the uncertainty at a load."""
    result: dict[str, Any] = {"load_N": uncertainty.load}
    for name in ("component", "magnitude", "across"):
        for words, readings in (("one_reading", 1.0), ("mean_of_many", math.inf)):
            result[f"{name}_{words}_N"] = getattr(uncertainty, name).of_mean(readings).expanded
    return {
        **result,
        "coverage_factor": uncertainty.component.coverage_factor,
        "effective_degrees_of_freedom": finite(uncertainty.component.degrees),
    }


def _too_uncertain(
    calibration: LoadCellCalibration, settings: LoadCellSettings
) -> Iterator[Problem]:
    """Check U if there is no other problem: a known mistake makes it large by itself."""
    if calibration.budget is not None and calibration.accepted:
        against = too_uncertain(calibration.budget.expanded, settings.cell.full_scale)
        if against:
            largest = max(
                calibration.budget.contributions, key=lambda contribution: contribution.uncertainty
            )
            yield refusal(
                "too_uncertain",
                "The result {}. The largest part is {} (u = {:.3g} N): correct its"
                " setting, or measure it better.",
                against,
                largest.name,
                largest.uncertainty,
            )


def _square(values: list[Any]) -> list[list[Any]]:
    """Return four values of the elements 11, 12, 21, 22 as rows."""
    return [values[:2], values[2:]]


def _line(line: tuple[float, float]) -> dict[str, float]:
    return {"constant_N": line[0], "per_N": line[1]}


def _weight_words(calibration: LoadCellCalibration) -> Iterator[str]:
    weight = calibration.pin_weight
    if weight is not None:
        rounded = (
            by_uncertainty(value, weight.expanded) for value in (weight.value, weight.expanded)
        )
        yield say("Weight that turns with the pin: {} N, U = {} N.", *rounded)


def applied_by_former(rows: Rows, file: LoadCellFile, drift: bool | None) -> dict[str, Any]:
    """Return the numbers applied to samples by evaluations 1 and 2: one zero for all series.

    drift: whether that of the zero was fitted, None to let the readings decide.
    """
    readings = load_cell_table(rows)
    settings = load_cell_meaning(file, say("the record's settings"))
    fit = common_zero_fit(applied_force(readings, settings), readings.signal, drift)
    return {
        "matrix_N_per_unit": fit.matrix.tolist(),
        "zero": fit.zero.tolist(),
        "quadratic_unit_per_N2": None if fit.quadratic is None else fit.quadratic.tolist(),
    }


def fit_load_cell(rows: Rows, file: LoadCellFile, where: str) -> Outcome:
    """Fit a table of readings by settings from ``where``: for display, printing and storage.

    Raises ReadingsError and UnusableInput.
    """
    settings = load_cell_meaning(file, where)
    calibration = calibrate_load_cell(load_cell_table(rows), settings)
    result = load_cell_result(calibration, settings)
    if calibration.fit is None or calibration.budget is None or calibration.expanded_line is None:
        return Outcome(say("load cell"), result, (calibration.classification,))
    unit = settings.cell.signal_unit
    matrix = calibration.fit.matrix.tolist()
    zero = joined(", ", (f"{value:.6f}" for value in calibration.fit.zero))
    constant, slope = calibration.expanded_line
    lines = (
        say("Force on the pin = matrix (signal - zero), pin frame; matrix in N per {}:", unit),
        *("    " + "  ".join(f"{value:12.5f}" for value in row) for row in matrix),
        say("Zero: {} {}.  Model: {}.", zero, unit, calibration.terms),
        *_weight_words(calibration),
        say("Residual standard deviation: {} N.", plain(calibration.fit.residual_std, 2)),
        say(
            "Expanded uncertainty of the calibration at {} N: {} N (k = {:.2f}).",
            plain(calibration.at_calibration[-1].load),
            plain(calibration.at_calibration[-1].component.expanded, 2),
            calibration.at_calibration[-1].component.coverage_factor,
        ),
        say(
            "Expanded uncertainty in use at {} N: {} N (k = {:.2f}); U(F) = {} N + {} F.",
            plain(calibration.budget.value),
            plain(calibration.budget.expanded, 2),
            calibration.budget.coverage_factor,
            plain(constant, 2),
            plain(slope, 2),
        ),
        creep_words(calibration.creep, settings.use.creep),
        calibration.classification,
    )
    header = (
        "",
        say("Signal 1 (N per {})", unit),
        say("Signal 2 (N per {})", unit),
        say("Zero ({})", unit),
    )
    axes = zip((say("Axis 1"), say("Axis 2")), matrix, calibration.fit.zero.tolist(), strict=True)
    shown = ((name, *(f"{value:.4f}" for value in row), f"{rest:.6f}") for name, row, rest in axes)
    return Outcome(say("load cell"), result, lines, NumberTable(header, tuple(shown), in_lines=4))
