"""Identified wear as CSV and JSON.

The keys are part of the public interface; docs/model-wear.md lists them.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from typing import Any

from rigapp.config.writing import harmless
from rigapp.report.testreport.identified import ForecastBand, IdentifiedTest, IdentifiedTests
from rigapp.schema.columns import identified_columns
from rigapp.schema.wire import parts_of_sentence
from rigapp.texts import as_written, say
from rigapp_model.identification import Credible, Disturbance, Identification, Pairing, Verdict
from rigapp_model.identification.words import revolution_of

UNIT = "mm^3/(N m)"
PER_UNIT = 1e9
"""mm^3/(N m) in 1 m^2/N."""
UM = 1e6
LEVEL = 0.95
"""Probability of the limits."""

COLUMNS = {
    "revolution": "revolution",
    **{
        column.name: f"{column.name}_mm3_per_N_m" if column.unit == UNIT else column.name
        for column in identified_columns()
    },
}
"""Column of the file -> column of the CSV, with a row for each revolution with a new statement."""


def as_csv(identified: IdentifiedTests) -> bytes:
    """Return the course of all tests as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("file", "specimen", *COLUMNS.values()))
    for test in identified.tests:
        columns = [test.course[name] for name in COLUMNS] if test.course else []
        for row in zip(*columns, strict=True):
            cells = [f"{number:.9g}" if math.isfinite(number) else "" for number in row]
            writer.writerow((harmless(test.path.name), harmless(test.specimen), *cells))
    return text.getvalue().encode()


def as_tree(identified: IdentifiedTests) -> dict[str, Any]:
    """Return all results as plain values, None if unknown."""
    tests = [tree_of_test(test) for test in identified.tests]
    return {
        "schema": 1,
        **promised_of_all(identified, tests),
        "tests": tests,
        "pairing": None
        if identified.pairing is None
        else _tree_of_pairing(identified.pairing, identified),
        "pairing_refused": identified.why_not,
    }


def tree_of_test(test: IdentifiedTest) -> dict[str, Any]:
    """Return the results of one test as plain values."""
    head: dict[str, Any] = {
        "file": str(test.path),
        "title": test.title,
        "specimen": test.specimen,
        "probe_record": test.record,
        "planned_revolutions": test.planned,
        "refused": test.refused,
        "sentence": test.said,
        "sentence_parts": parts_of_sentence(as_written(test.said)),
    }
    known = test.known
    if known is None:
        return head | promised(test)
    return head | {
        "revolution": int(known.revolution),
        "wear_coefficient": _credible(known.coefficient, PER_UNIT, UNIT),
        "statements": [_statement(known, verdict) for verdict in known.verdicts],
        "disturbances": [_disturbance(disturbance) for disturbance in known.disturbances],
        "budget": {
            "probe_sensitivity": known.sensitivity,
            "force": known.errors.load,
            "clearance_and_width": known.errors.geometry,
            "zero_um": UM * known.errors.reference,
        },
        **promised(test),
        "remaining_s": _finite(test.remaining_s),
        "prior": _prior(known.prior),
        "readings": {
            "revolution": _list(known.readings.revolution, 1.0),
            "depth_um": _list(known.readings.depth, UM),
            "noise_um": _list(known.readings.noise, UM),
        },
        "course": {name: _list(values, 1.0) for name, values in test.course.items()},
        "bands": [_band(band) for band in test.bands],
    }


def _statement(known: Identification, verdict: Verdict) -> dict[str, Any]:
    at = verdict.transition
    return {
        "name": verdict.name,
        "weight": verdict.weight,
        "wear_coefficient": _credible(verdict.coefficient, PER_UNIT, UNIT),
        "before": None if verdict.before is None else _credible(verdict.before, PER_UNIT, UNIT),
        "after": None if verdict.after is None else _credible(verdict.after, PER_UNIT, UNIT),
        "revolution": None if at is None else revolution_of(known, at.median),
    }


def _disturbance(disturbance: Disturbance) -> dict[str, Any]:
    return {
        "name": disturbance.name,
        "size_um": UM * disturbance.size,
        "standard_uncertainty_um": UM * disturbance.doubt,
        "revolutions": _finite(disturbance.revolutions),
        "probability": disturbance.probability,
    }


COEFFICIENT_KEY, REMAINING_KEY = "wear_coefficient_mm3_per_Nm", "remaining_revolutions"


def promised(test: IdentifiedTest) -> dict[str, Any]:
    """Return the keys in every JSON of a test: values with limits, or None and a reason.

    Each of the two quantities has its own ``..._reason``; ``reason`` holds those present.
    """
    known, left = test.known, test.left
    if known is None:
        return _promised(None, None, test.said, test.said)
    coefficient = _estimate(known.coefficient, PER_UNIT)
    rest: dict[str, Any] | None = None
    why = ""
    if left is None:
        why = say("The test has no stop.wear_depth_um, so its end is not known.")
    elif left.revolutions is None:
        why = left.reason
    else:
        rest = {
            "depth_um": UM * left.depth,
            "reason": left.reason,
            **_credible(left.revolutions, 1.0, "1"),
            **_estimate(left.revolutions, 1.0),
        }
    odds = known.best.weight / max(1.0 - known.best.weight, 1e-12)
    return _promised(coefficient, rest, "", why, known.best.name, odds)


def promised_of_all(
    identified: IdentifiedTests, tests: Sequence[Mapping[str, Any]]
) -> dict[str, Any]:
    """Return the same keys for a single test, or for the median specimen of several."""
    if len(tests) == 1:
        return {key: tests[0][key] for key in PROMISED}
    each = say("It belongs to one test: see the list of tests.")
    if identified.pairing is None:
        why = identified.why_not or say("No data for any of the tests.")
        return _promised(None, None, why, each)
    return _promised(_estimate(identified.pairing.coefficient, PER_UNIT), None, "", each)


def _promised(
    coefficient: Mapping[str, Any] | None,
    left: Mapping[str, Any] | None,
    why: str,
    why_left: str,
    model: str | None = None,
    odds: float | None = None,
) -> dict[str, Any]:
    return {
        COEFFICIENT_KEY: coefficient,
        f"{COEFFICIENT_KEY}_reason": why,
        REMAINING_KEY: left,
        f"{REMAINING_KEY}_reason": why_left,
        "reason": why or why_left,
        "wear_model": model,
        "odds": odds,
    }


PROMISED = tuple(_promised(None, None, "", ""))


def _estimate(quantity: Credible, factor: float) -> dict[str, Any]:
    """Return a quantity as estimate, limits and their level; unknown limits are None."""
    estimate, low, high = _list((quantity.median, quantity.low, quantity.high), factor)
    return {"estimate": estimate, "low": low, "high": high, "level": LEVEL}


def _band(forecast: ForecastBand) -> dict[str, Any]:
    band = forecast.band
    return {
        "after_revolution": forecast.after,
        "revolution": _list(band.revolution, 1.0),
        "median_um": _list(band.median, UM),
        "low_um": _list(band.low, UM),
        "high_um": _list(band.high, UM),
    }


def _tree_of_pairing(pairing: Pairing, identified: IdentifiedTests) -> dict[str, Any]:
    return {
        "files": [str(test.path) for test in identified.counted],
        "wear_coefficient": _credible(pairing.coefficient, PER_UNIT, UNIT),
        "next_specimen": _credible(pairing.next, PER_UNIT, UNIT),
        "scatter_factor": _credible(pairing.scatter, 1.0, "1"),
        "specimens": [_credible(error, PER_UNIT, UNIT) for error in pairing.each],
        "prior": _prior(pairing.prior),
    }


def _prior(prior: Any) -> Mapping[str, Any]:
    return {
        "wear_coefficient": PER_UNIT * prior.coefficient,
        "unit": UNIT,
        "spread_ln": prior.spread,
        "source": prior.source,
    }


def _credible(quantity: Credible, factor: float, unit: str) -> dict[str, Any]:
    median, low, high = _list((quantity.median, quantity.low, quantity.high), factor)
    return {"median": median, "low": low, "high": high, "unit": unit}


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _list(values: Any, factor: float) -> list[float | None]:
    return [_finite(factor * float(value)) for value in values]
