"""The result of a probe calibration: for ``--json`` and the record, and in words."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rigapp.calibrating.records import budget_result, problems_of
from rigapp.calibrating.session import Outcome
from rigapp.texts import say
from rigapp_calibration.probes.calibrate import (
    Alignment,
    PairCalibration,
    ProbeCalibration,
    calibrate_pair,
    calibrate_probe,
    split_pair,
)
from rigapp_calibration.probes.readings import ProbeSettings, probe_table
from rigapp_calibration.taking.readings import Rows

UM = 1e6


def probe_result(calibration: ProbeCalibration) -> dict[str, Any]:
    """Return the result for ``--json`` and the record, units in the keys."""
    return {
        "accepted": calibration.accepted,
        "problems": problems_of(calibration.problems),
        "sensitivity_um_per_V": _times(calibration.sensitivity),
        "sensitivity_relative_standard_uncertainty": calibration.sensitivity_uncertainty,
        "offset_V": calibration.offset,
        "linearity_percent": calibration.linearity,
        "residual_std_um": _times(calibration.residual_std),
        "hysteresis_um": _times(calibration.hysteresis),
        "cylinder_gain": calibration.gain,
        **budget_result(calibration.budget, "um", UM),
        "expanded_uncertainty_of_mean_um": _times(calibration.expanded_of_mean),
        "residual_um": None
        if calibration.residual is None
        else (UM * calibration.residual).tolist(),
    }


def pair_result(pair: PairCalibration) -> dict[str, Any]:
    """Return the result of both probes with their alignment, units in the keys."""
    stated = [calibration for calibration in pair.probes if calibration.expanded is not None]
    worst = max(stated, key=lambda calibration: calibration.expanded or 0.0, default=None)
    return {
        "accepted": pair.accepted,
        "problems": problems_of(pair.problems),
        "probes": [probe_result(calibration) for calibration in pair.probes],
        "alignment": None if pair.alignment is None else _alignment(pair.alignment),
        "expanded_uncertainty_um": None if worst is None else _times(worst.expanded),
        "coverage_factor": None if worst is None else worst.coverage_factor,
    }


def _alignment(alignment: Alignment) -> dict[str, Any]:
    return {
        "angle_deg": np.degrees(alignment.angle).tolist(),
        "angle_standard_uncertainty_deg": np.degrees(alignment.angle_uncertainty).tolist(),
        "orthogonality_deg": math.degrees(alignment.orthogonality),
        "orthogonality_standard_uncertainty_deg": math.degrees(alignment.orthogonality_uncertainty),
        "matrix": alignment.matrix.tolist(),
        "matrix_standard_uncertainty": alignment.matrix_uncertainty.tolist(),
    }


def _times(value: float | None) -> float | None:
    return None if value is None else UM * value


def probe_lines(calibration: ProbeCalibration) -> list[str]:
    """Return the result in words and numbers, a line each."""
    if calibration.sensitivity is None or calibration.offset is None:
        return []
    assert calibration.expanded is not None
    assert calibration.expanded_of_mean is not None
    backlash = calibration.hysteresis
    return [
        say(
            "Position = {:.4f} um/V (voltage {:+.5f} V).",
            UM * calibration.sensitivity,
            -calibration.offset,
        ),
        say(
            "Linearity {:.3f} % of the range; expanded uncertainty {:.2f} um (k = {:.2f}), of a"
            " mean of many readings {:.2f} um.",
            calibration.linearity,
            UM * calibration.expanded,
            calibration.coverage_factor,
            UM * calibration.expanded_of_mean,
        ),
        say("Backlash is not known.")
        if backlash is None
        else say("Going back reads {:+.3f} um against going out.", UM * backlash),
    ]


def pair_lines(pair: PairCalibration) -> list[str]:
    """Return the result of both probes in words and numbers, a line each."""
    lines: list[str] = [
        say("Probe {}: {}", number, line)
        for number, calibration in enumerate(pair.probes, 1)
        for line in probe_lines(calibration)
    ]
    alignment = pair.alignment
    if alignment is None:
        return lines
    angles, spread = np.degrees(alignment.angle), np.degrees(alignment.angle_uncertainty)
    return [
        *lines,
        say(
            (
                "Probe 1 is {:+.2f} degrees off the follower's axis, probe 2 {:+.2f} degrees off"
                " the direction across it (u = {:.2f} and {:.2f} degrees)."
            ),
            angles[0],
            angles[1],
            spread[0],
            spread[1],
        ),
        say(
            "The angle between them is {:.2f} degrees (u = {:.2f}).",
            90.0 + math.degrees(alignment.orthogonality),
            math.degrees(alignment.orthogonality_uncertainty),
        ),
    ]


def fit_probes(rows: Rows, settings: Sequence[ProbeSettings]) -> Outcome:
    """Fit a table of readings of one probe, or of both where two are set (series 1.x and 2.x).

    Returns it for display, printing and storage; raises ReadingsError.
    """
    readings = probe_table(rows)
    if len(settings) == 1:
        calibration = calibrate_probe(readings, settings[0])
        return Outcome("probe", probe_result(calibration), tuple(probe_lines(calibration)))
    both = calibrate_pair(split_pair(readings), (settings[0], settings[1]))
    return Outcome(say("probe pair"), pair_result(both), tuple(pair_lines(both)))
