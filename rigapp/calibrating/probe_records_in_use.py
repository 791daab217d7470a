"""Records of the probes in the place of the rig file's numbers: line, alignment, run-out map."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec

from calibration.records import Record
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.rig import ProbesSection, RigFile

Read = Callable[[str, str, tuple[str, ...]], tuple[str, Record]]
"""Read a record: key, name, kinds that are allowed -> text and record."""


@dataclass(frozen=True, slots=True)
class ProbeRecords:
    """The probes with the numbers of their records.

    records: section, text, record, and why it is used though expired.
    """

    probes: ProbesSection
    records: tuple[tuple[str, str, Record, str], ...]


def probe_records(rig: Document[RigFile], read: Read) -> ProbeRecords:
    """Read what ``probes.calibration`` and ``probes.run_out`` name; raise UnusableInput."""
    probes = rig.record.probes
    records: list[tuple[str, str, Record, str]] = []
    if probes.calibration:
        probes, found = _calibrated(rig, read)
        records += [
            (section, text, one, probes.calibration_override) for section, text, one in found
        ]
    if probes.run_out:
        text, record = read("probes.run_out", probes.run_out, ("run-out map",))
        records.append(("run_out", text, record, probes.run_out_override))
        probes = _mapped(rig, probes, record)
    return ProbeRecords(probes, tuple(records))


def _calibrated(
    rig: Document[RigFile], read: Read
) -> tuple[ProbesSection, list[tuple[str, str, Record]]]:
    probes = rig.record.probes
    names = probes.calibration
    key = "probes.calibration"
    if isinstance(names, str):
        text, record = read(key, names, ("probe", "probe pair"))
        if record.kind == "probe pair":
            return _pair(rig, probes, record), [("probes", text, record)]
        found = [(text, record)] * 2
    else:
        found = [read(key, name, ("probe",)) for name in names]
    results = [record.content["result"] for _, record in found]
    with_numbers = _with_numbers(rig, probes, results, [record for _, record in found])
    sections = [(f"probe_{i}", text, record) for i, (text, record) in enumerate(found, 1)]
    return with_numbers, sections


def _pair(rig: Document[RigFile], probes: ProbesSection, record: Record) -> ProbesSection:
    result = record.content["result"]
    probes = _with_numbers(rig, probes, result["probes"], [record, record])
    matrix = result["alignment"]["matrix"]
    return msgspec.structs.replace(probes, alignment=tuple(tuple(row) for row in matrix))


def _with_numbers(
    rig: Document[RigFile],
    probes: ProbesSection,
    results: Sequence[Mapping[str, Any]],
    records: Sequence[Record],
) -> ProbesSection:
    both = list(zip(results, records, strict=True))
    stated = [result.get("expanded_uncertainty_um") for result in results]
    uncertainty = probes.uncertainty_um
    if all(isinstance(one, int | float) for one in stated):
        uncertainty = (float(stated[0]), float(stated[1]))  # type: ignore[arg-type]
    return msgspec.structs.replace(
        probes,
        sensitivity_um_per_V=tuple(_number(rig, r, n, "sensitivity_um_per_V") for r, n in both),
        offset_V=tuple(_number(rig, r, n, "offset_V") for r, n in both),
        uncertainty_um=uncertainty,
    )


def _mapped(rig: Document[RigFile], probes: ProbesSection, record: Record) -> ProbesSection:
    """Return the probes with the map; its uncertainty and the probes' add as squares.

    The probes' own systematic part is in both, so that the sum is rather too large than too small.
    """
    result = record.content["result"]
    map_U = result["expanded_uncertainties_um"]
    stated = probes.uncertainty_um
    return msgspec.structs.replace(
        probes,
        run_out_cos_um=tuple(tuple(row) for row in result["cos_um"]),
        run_out_sin_um=tuple(tuple(row) for row in result["sin_um"]),
        uncertainty_um=None
        if stated is None
        else (math.hypot(stated[0], map_U[0]), math.hypot(stated[1], map_U[1])),
    )


def _number(rig: Document[RigFile], result: Mapping[str, Any], record: Record, key: str) -> float:
    value = result.get(key)
    if not isinstance(value, int | float):
        raise UnusableInput(f"{rig.path}: the record {record.number} has no {key}.")
    return float(value)
