"""Verify that a record follows from its own readings: fit them again and compare the results.

A digest shows that a record is unchanged since it was sealed, not that it is true: whoever can
write a record can seal one. The numbers applied to every sample must therefore follow from the
readings beside them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import msgspec

from rigapp.calibrating.channel import fit_channel
from rigapp.calibrating.load_cell_result import applied_by_former, fit_load_cell
from rigapp.calibrating.probe_result import fit_probes
from rigapp.calibrating.run_out import map_again
from rigapp.calibrating.running_check import check_again
from rigapp.config.calibration_settings import (
    ChannelFile,
    LoadCellFile,
    ProbeFile,
    probe_meaning,
)
from rigapp.config.errors import UnusableInput
from rigapp.texts import say
from rigapp_calibration.load_cell.readings import LOAD_CELL_COLUMNS
from rigapp_calibration.probes.readings import PROBE_COLUMNS
from rigapp_calibration.records import EVALUATION, MALFORMED, Record, unseal
from rigapp_calibration.taking.readings import read_table

SAME = 1e-6
"""Relative: a fit repeats to rounding, some 1e-12 on any computer; a certificate prints 1e-5."""
NOTHING = 1e-12
"""Smaller values in their unit are rounding: relevant quadratic terms are above 1e-8."""
ZEROS_BY_SERIES = 3
"""The evaluation from which on each series of the load cell has its own zero."""
ALIKE = 1e-3
"""Relative, between evaluations: a tenth of the limit of the best attainable class (1) of ISO
376."""

Content = Mapping[str, Any]
Result = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Verification:
    """The result of fitting the stored readings again.

    compared: how many numbers. differences: sentences, none when all agree. unverified: sentences
    on what could not be compared.
    """

    compared: int
    differences: tuple[str, ...] = ()
    unverified: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Kind:
    """The repeated fit of records of a kind.

    applied: keys of the result that samples get. of_samples: keys that follow from samples only,
    which are not in a record.
    """

    fit: Callable[[Content], Result]
    applied: tuple[str, ...]
    of_samples: tuple[str, ...] = ()


def _load_cell(content: Content) -> Result:
    settings = msgspec.convert(content["settings"], LoadCellFile)
    rows = read_table(content["readings_csv"], LOAD_CELL_COLUMNS)
    again = fit_load_cell(rows, settings, say("the record's settings")).result
    if content.get("evaluation", 1) >= ZEROS_BY_SERIES:
        return again
    # In the first evaluation only the words show whether the drift was fitted.
    drift = "drift" in content["result"].get("terms", "") if "evaluation" not in content else None
    return {**again, **applied_by_former(rows, settings, drift)}


def _probes(content: Content) -> Result:
    settings = probe_meaning(msgspec.convert(content["settings"], ProbeFile))
    count = 2 if content["kind"] == "probe pair" else 1
    rows = read_table(content["readings_csv"], PROBE_COLUMNS)
    return fit_probes(rows, [settings] * count).result


def _channel(content: Content) -> Result:
    settings = msgspec.convert(content["settings"], ChannelFile)
    return fit_channel(content["readings_csv"], settings, "", "").result


KINDS: Mapping[str, _Kind] = {
    "load cell": _Kind(
        _load_cell, ("matrix_N_per_unit", "zero", "quadratic_unit_per_N2", "pin_weight_N")
    ),
    "probe": _Kind(_probes, ("sensitivity_um_per_V", "offset_V")),
    "probe pair": _Kind(_probes, ("sensitivity_um_per_V", "offset_V", "matrix")),
    "run-out map": _Kind(map_again, ("cos_um", "sin_um"), ("rest_um",)),
    "channel": _Kind(_channel, ("scale_per_V", "offset_V", "table")),
    "running check": _Kind(check_again, ("measured_mass_times_radius_kg_m",)),
}


@lru_cache(maxsize=32)
def verified(data: bytes) -> Verification:
    """Return the verification of a sealed record; raise RecordError.

    An invalid signature is a difference.
    """
    record = unseal(data)
    verification = verify(record)
    if record.signature is None:
        return verification
    from rigapp_calibration.signatures import signature_fault

    fault = signature_fault(record)
    return (
        replace(verification, differences=(fault, *verification.differences))
        if fault
        else verification
    )


def verify(record: Record) -> Verification:
    """Fit the readings of a record again and compare the result.

    The numbers of an unknown evaluation cannot be checked: that is a difference.
    """
    content, kind = record.content, KINDS.get(record.kind)
    if kind is None or not content.get("readings_csv"):
        missing = say("holds no readings") if kind else say("is of a {}", record.kind)
        return Verification(0, (), (say("The record {}: its result cannot be verified.", missing),))
    if not 1 <= record.evaluation <= EVALUATION:
        words = say(
            "It was made by evaluation {}, this program supports up to {}; update rigapp.",
            repr(content["evaluation"]),
            EVALUATION,
        )
        return Verification(0, (words,))
    try:
        return _compare(record, kind, kind.fit(content))
    except (UnusableInput, *MALFORMED) as error:
        words = say("This version cannot fit its readings ‹{}›.", repr(error))
        return Verification(0, (words,))


def _compare(record: Record, kind: _Kind, again: Result) -> Verification:
    """Compare the result of a record with the repeated one."""
    content = record.content
    same = record.evaluation == EVALUATION
    stated, computed = dict(numbers(content["result"])), dict(numbers(again))
    keys = [
        key for key in (stated | computed if same else stated) if same or _name(key) in kind.applied
    ]
    keys = [key for key in keys if _name(key) not in kind.of_samples]
    within = SAME if same else ALIKE
    differences = tuple(_differences(keys, stated, computed, within))
    refused = tuple(problem["sentence"] for problem in again["problems"] if problem["blocks"])
    if same:
        differences += tuple(say("Its readings are refused: {}", sentence) for sentence in refused)
        return Verification(len(keys), differences)
    return Verification(len(keys), differences, tuple(_of_another(record, again, refused)))


def numbers(value: Any, name: str = "") -> Iterator[tuple[str, tuple[float, ...]]]:
    """Yield every key of a result whose value is numbers, flat, with its full name.

    Numbers that are missing (None) are an empty tuple.
    """
    if isinstance(value, Mapping):
        for key, item in value.items():
            if key not in ("accepted", "problems"):
                yield from numbers(item, f"{name}.{key}" if name else str(key))
    elif isinstance(value, list) and any(isinstance(item, Mapping) for item in value):
        for number, item in enumerate(value, 1):
            yield from numbers(item, f"{name}.{number}")
    elif not isinstance(value, str):
        yield name, tuple(_flat(value))


def _flat(value: Any) -> Iterator[float]:
    if isinstance(value, Sequence) and not isinstance(value, str):
        for item in value:
            yield from _flat(item)
    elif value is not None:
        yield float(value)


def _name(key: str) -> str:
    return key.rpartition(".")[2]


def _differences(
    keys: Sequence[str],
    stated: Mapping[str, tuple[float, ...]],
    computed: Mapping[str, tuple[float, ...]],
    within: float,
) -> Iterator[str]:
    for key in keys:
        if key not in stated:
            yield say("{}: the record does not state this number of its readings.", key)
            continue
        if key not in computed:
            yield say("{}: its readings do not give this number.", key)
            continue
        old, new = stated[key], computed[key]
        if len(old) != len(new):
            yield say(
                "{}: the record states {} numbers, its readings give {}.", key, len(old), len(new)
            )
            continue
        size = max(map(abs, (*old, *new)), default=0.0)
        off = [abs(a - b) for a, b in zip(old, new, strict=True)]
        if off and max(off) > within * size + NOTHING:
            at = off.index(max(off))
            yield say(
                "{}: the record states {:.9g}, its readings give {:.9g}.", key, old[at], new[at]
            )


def _of_another(record: Record, again: Result, refused: Sequence[str]) -> Iterator[str]:
    result = record.content["result"]
    words = say("; what is applied to the samples was compared, the uncertainty cannot be verified")
    for key, unit in (("expanded_uncertainty_N", "N"), ("expanded_uncertainty_um", "um")):
        before, now = result.get(key), again.get(key)
        if before is not None and now is not None:
            words = say(
                "; what is applied to the samples was compared, the uncertainty cannot"
                " be verified: it states U = {:.3g} {}, this evaluation gives {:.3g} {}",
                before,
                unit,
                now,
                unit,
            )
    yield say(
        "It was made by evaluation {}, this program has {}{}.", record.evaluation, EVALUATION, words
    )
    for sentence in refused:
        yield say("Today's checks would refuse its readings: {}", sentence)
