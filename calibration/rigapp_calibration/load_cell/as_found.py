"""As found against as left: the deviation of the previous record, found by a new calibration.

The former record is applied to the signals that the new one gives for known forces (or positions).
Its deviation is compared with U of the difference of both: the root of the sum of the squares of
their own. Records of one item, oldest first, are its trend.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from rigapp.texts import joined, say
from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.daily import ZERO_SHARE
from rigapp_calibration.load_cell.two_axis import forces
from rigapp_calibration.records import MALFORMED, Record, RecordError

DIRECTIONS = 16
Result = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Change:
    """Deviation of a former record in one quantity, and the allowed one: U, or a limit."""

    what: str
    unit: str
    value: float
    allowed: float

    @property
    def beyond(self) -> bool:
        """Return whether it exceeds the allowed deviation."""
        return abs(self.value) > self.allowed

    @property
    def words(self) -> str:
        """Return it in words."""
        more = say(", MORE than allowed") if self.beyond else ""
        return say(
            "{} {:+.2g} {} ({:.2g} {} allowed{})",
            self.what,
            self.value,
            self.unit,
            self.allowed,
            self.unit,
            more,
        )

    @property
    def tree(self) -> dict[str, Any]:
        """Return it as plain values."""
        return {
            "what": self.what,
            "unit": self.unit,
            "value": self.value,
            "allowed": self.allowed,
            "beyond": self.beyond,
        }


@dataclass(frozen=True, slots=True)
class Output:
    """A sensitivity that a record states, with its expanded uncertainty, in its unit."""

    what: str
    unit: str
    value: float
    expanded: float


def outputs(kind: str, result: Result) -> tuple[Output, ...]:
    """Return the sensitivities of a result for a trend; () if it states none."""
    if kind == "load cell" and result.get("sensitivity_unit_per_N"):
        full = float(result["full_scale_N"])
        share = _own_expanded(result) / full
        return tuple(
            Output(
                say("output of bridge {} at full scale", axis + 1),
                "mV/V",
                abs(float(result["sensitivity_unit_per_N"][axis][axis])) * full,
                abs(float(result["sensitivity_unit_per_N"][axis][axis])) * full * share,
            )
            for axis in range(2)
        )
    each = result.get("probes", [result])
    key = "sensitivity_relative_standard_uncertainty"
    return tuple(
        Output(
            say("sensitivity of probe {}", number) if len(each) > 1 else say("sensitivity"),
            "um/V",
            float(one["sensitivity_um_per_V"]),
            2.0 * float(one[key]) * abs(float(one["sensitivity_um_per_V"])),
        )
        for number, one in enumerate(each, 1)
        if one.get("sensitivity_um_per_V") is not None and one.get(key) is not None
    )


def _own_expanded(result: Result) -> float:
    """Return U of the calibration itself along a force at full scale, N, of a mean of many."""
    own = result.get("of_calibration")
    if own is None:
        return _expanded(result, "magnitude")
    last = own["uncertainty_by_load"][-1]
    return float(last["magnitude_mean_of_many_N"] / last["load_N"] * result["full_scale_N"])


def changes(kind: str, former: Result, new: Result) -> tuple[Change, ...]:
    """Return the deviations of the former of two results of a kind; () for kinds without a rule."""
    if kind == "load cell":
        return tuple(_of_cell(former, new))
    if kind not in ("probe", "probe pair"):
        return ()
    probes = (former.get("probes", [former]), new.get("probes", [new]))
    return tuple(
        one
        for number, (before, now) in enumerate(zip(*probes, strict=False), 1)
        for one in _of_probe(before, now, number if len(probes[1]) > 1 else 0)
    )


def as_found(kind: str, former: Record, new: Result) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Return the as-found result for the new record, and as sentences; empty if there is none.

    Raises KeyError, TypeError or ValueError for a former record that lacks numbers.

    """
    found = changes(kind, former.content["result"], new)
    if not found:
        return {}, ()
    tree = {
        "record": former.number,
        "calibrated_at": former.content["calibrated_at"],
        "changes": [one.tree for one in found],
    }
    listed = joined("; ", (one.words for one in found))
    day = str(former.content["calibrated_at"])[:10]
    lines: list[str] = [
        say("As found, the record {} of {} was too optimistic: {}.", former.number, day, listed)
    ]
    if any(one.beyond for one in found):
        lines.append(
            say(
                (
                    "That is more than both records allow: find out what changed since {} before"
                    " the new record is used. Results measured since then may be wrong by as"
                    " much."
                ),
                day,
            )
        )
    return tree, tuple(lines)


def _of_cell(former: Result, new: Result) -> Iterator[Change]:
    full = float(new["full_scale_N"])
    if abs(float(former["full_scale_N"]) / full - 1.0) > 1e-6:
        return
    one, other = (np.array(result["matrix_N_per_unit"], np.float64) for result in (former, new))
    ways = np.arange(DIRECTIONS) * (2.0 * math.pi / DIRECTIONS)
    unit = np.column_stack((np.cos(ways), np.sin(ways)))
    force = full * unit
    signal = force @ np.linalg.inv(other).T + _bent(new, force)
    off = forces(signal, one, np.zeros(2), _quadratic(former)) - force
    along = np.sum(off * unit, axis=1)
    across = off[:, 1] * unit[:, 0] - off[:, 0] * unit[:, 1]
    for name, values, keys in (
        (say("force at full scale"), along, "magnitude"),
        (say("force across it"), across, "across"),
    ):
        allowed = math.hypot(*(_expanded(result, keys) for result in (former, new)))
        yield Change(name, "N", float(values[np.abs(values).argmax()]), allowed)
    shift = other @ (np.array(new["zero"]) - np.array(former["zero"]))
    yield Change(say("zero"), "N", float(shift[np.abs(shift).argmax()]), ZERO_SHARE * full)


def _quadratic(result: Result) -> Array | None:
    terms = result.get("quadratic_unit_per_N2")
    return None if terms is None else np.array(terms, np.float64)


def _bent(result: Result, force: Array) -> Array:
    terms = _quadratic(result)
    if terms is None:
        return np.zeros_like(force)
    x, y = force.T
    return np.asarray(np.column_stack((x * x, x * y, y * y)) @ terms.T, np.float64)


def _expanded(result: Result, part: str) -> float:
    """Return U at full scale along or across the force; of older records that of a reading."""
    by_load: Sequence[Result] = result.get("uncertainty_by_load") or ()
    stated = by_load[-1].get(f"{part}_mean_of_many_N") if by_load else None
    return float(result["expanded_uncertainty_N"] if stated is None else stated)


def _of_probe(former: Result, new: Result, number: int) -> Iterator[Change]:
    before, now = (float(one["sensitivity_um_per_V"]) for one in (former, new))
    key = "sensitivity_relative_standard_uncertainty"
    if former.get(key) is None or new.get(key) is None:
        return
    doubt = math.hypot(float(former[key]), float(new[key]))
    name = say("sensitivity of probe {}", number) if number else say("sensitivity")
    yield Change(name, "%", 100.0 * (before / now - 1.0), 200.0 * doubt)


def trend(records: Sequence[Record]) -> list[tuple[Record, tuple[Change, ...]]]:
    """Return records of one kind by date, each with the deviations of the one before.

    Raises RecordError for two that cannot be compared.
    """
    ordered = sorted(records, key=lambda one: str(one.content["calibrated_at"]))
    found: list[tuple[Record, tuple[Change, ...]]] = [(one, ()) for one in ordered[:1]]
    for before, one in pairwise(ordered):
        try:
            told = changes(one.kind, before.content["result"], one.content["result"])
        except MALFORMED as error:
            raise RecordError(
                "the records {} and {} cannot be compared, a number is missing or wrong in one"
                " ‹{}›; rigapp calibrate verify names it",
                before.number,
                one.number,
                repr(error),
            ) from error
        found.append((one, told))
    return found
