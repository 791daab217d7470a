"""Calibration records that a rig file names: read, judged, put in the place of its own numbers."""

from __future__ import annotations

import calendar
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec

from calibration.records import Record, RecordError, unseal
from rigapp.calibrating.probe_records_in_use import probe_records
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.reading import read_bytes
from rigapp.config.rig import RigFile


@dataclass(frozen=True, slots=True)
class RigRecords:
    """A rig with the numbers of its records. texts: section -> the record as stored, sealed.

    blocking: section -> why the record forbids a start (expired), empty when none does.
    """

    rig: Document[RigFile]
    texts: Mapping[str, str] = field(default_factory=dict)
    blocking: Mapping[str, str] = field(default_factory=dict)
    remarks: Mapping[str, str] = field(default_factory=dict)


def with_records(rig: Document[RigFile], now: float | None = None) -> RigRecords:
    """Read the records that ``load_cell.calibration`` and ``probes.calibration`` name.

    Paths are relative to the rig file. Raises UnusableInput for a record that is missing, changed
    after it was made, or of something else.
    """
    load_cell, probes = rig.record.load_cell, rig.record.probes
    texts: dict[str, str] = {}
    blocking: dict[str, str] = {}
    remarks: dict[str, str] = {}
    moment = time.time() if now is None else now
    if load_cell.calibration:
        text, record = _read(rig, "load_cell.calibration", load_cell.calibration, ("load cell",))
        texts["load_cell"] = text
        load_cell = _load_cell(rig, record)
        against = _faults(rig, record, moment)
        _judge("load_cell", record, load_cell.calibration_override, against, blocking, remarks)
    if probes.calibration or probes.run_out:
        found = probe_records(rig, lambda section, name, kinds: _read(rig, section, name, kinds))
        probes = found.probes
        for section, text, record, override in found.records:
            texts[section] = text
            against = _faults(rig, record, moment)
            _judge(section, record, override, against, blocking, remarks)
    record_file = msgspec.structs.replace(rig.record, load_cell=load_cell, probes=probes)
    return RigRecords(Document(rig.path, rig.text, record_file), texts, blocking, remarks)


def _read(
    rig: Document[RigFile], key: str, name: str, kinds: tuple[str, ...]
) -> tuple[str, Record]:
    path = Path(name)
    if not path.is_absolute():
        path = rig.path.parent / path
    where = f"{rig.path}: {key} = {name!r}"
    try:
        data = read_bytes(path)
        record = unseal(data)
    except OSError as error:
        raise UnusableInput(f"{where}: the record cannot be read ({error}).") from error
    except RecordError as error:
        raise UnusableInput(f"{where}: {error}.") from error
    if record.kind not in kinds:
        raise UnusableInput(
            f"{where}: this is the record of a {record.kind}, not of a {' or a '.join(kinds)}."
        )
    return data.decode(), record


def _load_cell(rig: Document[RigFile], record: Record) -> Any:
    result = record.content["result"]
    unit = record.content["settings"]["cell"]["signal_unit"]
    if unit != "mV/V":
        raise UnusableInput(
            f"{rig.path}: the record {record.number} is in N per {unit}; the rig measures mV/V."
        )
    line = result["uncertainty_line_N"]
    quadratic = result.get("quadratic_unit_per_N2")
    return msgspec.structs.replace(
        rig.record.load_cell,
        matrix_N_per_mV_per_V=tuple(tuple(row) for row in result["matrix_N_per_unit"]),
        zero_mV_per_V=tuple(result["zero"]),
        quadratic_mV_per_V_per_N2=None if quadratic is None else tuple(map(tuple, quadratic)),
        uncertainty_N=(line["constant_N"], line["per_N"]),
    )


def _faults(rig: Document[RigFile], record: Record, now: float) -> list[str]:
    """Return what stands against the use of a record: it has expired, or it is foreign.

    Foreign: taken on another rig, on a simulated one for a real one or the reverse, or of a load
    cell of another full scale. Readings that came as a table do not say where they were taken.
    """
    found = []
    content, here = record.content, rig.record
    due = str(content["due_at"])
    if now > calendar.timegm(time.strptime(due, "%Y-%m-%dT%H:%M:%SZ")):
        found.append(f"expired on {due[:10]}")
    taken = content.get("taken") or {}
    where = str(taken.get("rig") or "")
    if where and where != here.name:
        found.append(f"was taken on the rig {where!r}, this is {here.name!r}")
    simulated = taken.get("simulated")
    if simulated is not None and bool(simulated) is not (here.simulation is not None):
        kinds = ("a real rig", "a simulated rig")
        found.append(f"was taken on {kinds[bool(simulated)]}, this is {kinds[not simulated]}")
    if record.kind == "load cell":
        full = content["settings"]["cell"].get("full_scale_N")
        if full is not None and abs(full / here.load_cell.full_scale_N - 1.0) > 1e-6:
            found.append(
                f"is of a load cell of {full:g} N, the rig file says"
                f" {here.load_cell.full_scale_N:g} N"
            )
    return found


def _judge(
    section: str,
    record: Record,
    override: str,
    against: Sequence[str],
    blocking: dict[str, str],
    remarks: dict[str, str],
) -> None:
    """Block a start for what stands against a record, unless a reason overrides it."""
    words = " and ".join(against)
    if not against:
        remarks[section] = f"record {record.number}, due {str(record.content['due_at'])[:10]}"
    elif override.strip():
        remarks[section] = f"record {record.number} {words}, used all the same: {override.strip()}"
    else:
        blocking[section] = (
            f"the calibration record {record.number} of {section} {words};"
            f" calibrate again, or write calibration_override with the reason"
        )
