"""What is known of the wear of tests as columns (CSV) and as one tree of plain values (JSON).

The keys of both are a promise to users: docs/model-wear.md lists them.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping
from typing import Any

from rigapp.report.testreport.identified import ForecastBand, IdentifiedTest, IdentifiedTests
from rigapp.schema.columns import identified_columns
from rigapp_model.identification import Credible, Identification, Pairing, Remaining, Verdict
from rigapp_model.identification.words import revolution_of

UNIT = "mm^3/(N m)"
PER_UNIT = 1e9
"""mm^3/(N m) in 1 m^2/N."""
UM = 1e6

COLUMNS = {
    "revolution": "revolution",
    **{
        one.name: f"{one.name}_mm3_per_N_m" if one.unit == UNIT else one.name
        for one in identified_columns()
    },
}
"""Column of the file -> of the CSV: a row for each revolution at which something new was stated."""


def as_csv(found: IdentifiedTests) -> bytes:
    """Return the course of all tests as CSV."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("file", "specimen", *COLUMNS.values()))
    for test in found.tests:
        columns = [test.course[name] for name in COLUMNS] if test.course else []
        for row in zip(*columns, strict=True):
            cells = [f"{one:.9g}" if math.isfinite(one) else "" for one in row]
            writer.writerow((test.path.name, test.specimen, *cells))
    return text.getvalue().encode()


def _three(one: Credible) -> tuple[float, float, float]:
    return one.median, one.low, one.high


def as_tree(found: IdentifiedTests) -> dict[str, Any]:
    """Return all that is known as plain values: what is not known is None."""
    return {
        "schema": 1,
        "tests": [tree_of_test(one) for one in found.tests],
        "pairing": None if found.pairing is None else _tree_of_pairing(found.pairing, found),
        "pairing_refused": found.why_not,
    }


def tree_of_test(test: IdentifiedTest) -> dict[str, Any]:
    """Return what is known of one test as plain values."""
    head: dict[str, Any] = {
        "file": str(test.path),
        "title": test.title,
        "specimen": test.specimen,
        "probe_record": test.record,
        "planned_revolutions": test.planned,
        "refused": test.refused,
        "sentence": test.said,
    }
    known = test.known
    if known is None:
        return head
    return head | {
        "revolution": int(known.revolution),
        "wear_coefficient": _credible(known.coefficient, PER_UNIT, UNIT),
        "statements": [_statement(known, one) for one in known.verdicts],
        "remaining_revolutions": _left(test.left),
        "remaining_s": _finite(test.remaining_s),
        "prior": _prior(known.prior),
        "readings": {
            "revolution": _list(known.readings.revolution, 1.0),
            "depth_um": _list(known.readings.depth, UM),
            "noise_um": _list(known.readings.noise, UM),
        },
        "course": {name: _list(values, 1.0) for name, values in test.course.items()},
        "bands": [_band(one) for one in test.bands],
    }


def _statement(known: Identification, one: Verdict) -> dict[str, Any]:
    return {
        "name": one.name,
        "weight": one.weight,
        "wear_coefficient": _credible(one.coefficient, PER_UNIT, UNIT),
        "before": None if one.before is None else _credible(one.before, PER_UNIT, UNIT),
        "revolution": None if one.place is None else revolution_of(known, one.place.median),
    }


def _left(left: Remaining | None) -> dict[str, Any] | None:
    if left is None:
        return None
    known = left.revolutions
    values = _credible(known, 1.0, "1") if known is not None else {}
    return {"depth_um": UM * left.depth, "reason": left.reason, **values}


def _band(one: ForecastBand) -> dict[str, Any]:
    band = one.band
    return {
        "after_revolution": one.after,
        "revolution": _list(band.revolution, 1.0),
        "median_um": _list(band.median, UM),
        "low_um": _list(band.low, UM),
        "high_um": _list(band.high, UM),
    }


def _tree_of_pairing(pairing: Pairing, found: IdentifiedTests) -> dict[str, Any]:
    return {
        "files": [str(one.path) for one in found.counted],
        "wear_coefficient": _credible(pairing.coefficient, PER_UNIT, UNIT),
        "next_specimen": _credible(pairing.next, PER_UNIT, UNIT),
        "scatter_factor": _credible(pairing.scatter, 1.0, "1"),
        "specimens": [_credible(one, PER_UNIT, UNIT) for one in pairing.each],
        "prior": _prior(pairing.prior),
    }


def _prior(prior: Any) -> Mapping[str, Any]:
    return {
        "wear_coefficient": PER_UNIT * prior.coefficient,
        "unit": UNIT,
        "spread_ln": prior.spread,
        "source": prior.source,
    }


def _credible(one: Credible, factor: float, unit: str) -> dict[str, Any]:
    median, low, high = (_finite(factor * value) for value in _three(one))
    return {"median": median, "low": low, "high": high, "unit": unit}


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _list(values: Any, factor: float) -> list[float | None]:
    return [_finite(factor * float(one)) for one in values]
