"""Calibration records that a rig file names: read, judged, put in the place of its own numbers."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.reading import read_bytes
from rigapp.config.rig import ChannelSection, LoadCellSection, ProbesSection, RigFile
from rigapp_calibration.load_cell.force_uncertainty import too_uncertain
from rigapp_calibration.records import Record, RecordError, in_future, moment, unseal

if TYPE_CHECKING:
    from rigapp.calibrating.verification import Verification

Rig = Document[RigFile]


@dataclass(frozen=True, slots=True)
class RigRecords:
    """A rig with the numbers of its records. texts: label -> the record as stored, sealed.

    blocking: label -> why the record forbids a start (expired), empty when none does. remarks:
    label -> the record's number and date, and what of it cannot be verified.
    """

    rig: Rig
    texts: Mapping[str, str] = field(default_factory=dict)
    blocking: Mapping[str, str] = field(default_factory=dict)
    remarks: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RecordPlace:
    """Where a rig file names records, and what they replace in it.

    section: its name, or that of a table and one of its entries (``channels.NAME``). kinds: of
    records that may stand there; a list of names allows the first only. use (rig, section,
    records): the section with the records' numbers, and a label of each record.
    """

    section: str
    key: str
    kinds: tuple[str, ...]
    use: Callable[[Rig, Any, Sequence[Record]], tuple[Any, Sequence[str]]]

    def of(self, rig: RigFile) -> Any:
        """Return the section of a rig file."""
        table, _, name = self.section.partition(".")
        return getattr(rig, table)[name] if name else getattr(rig, table)

    def put(self, rig: RigFile, section: Any) -> RigFile:
        """Return a rig file with another section in this place."""
        table, _, name = self.section.partition(".")
        new = {**getattr(rig, table), name: section} if name else section
        return msgspec.structs.replace(rig, **{table: new})

    def alone(self, kind: str) -> bool:
        """Tell whether one record of a kind says all, and not one of a list."""
        return len(self.kinds) == 1 or kind != self.kinds[0]


def with_records(rig: Rig, now: float | None = None) -> RigRecords:
    """Read the records that a rig file names (``places_of``).

    Paths are relative to the rig file. Each record is fitted again from its readings and compared.
    Raises UnusableInput for a record that is missing, changed after it was made, or of something
    else.
    """
    texts: dict[str, str] = {}
    blocking: dict[str, str] = {}
    remarks: dict[str, str] = {}
    now = time.time() if now is None else now
    used = rig.record
    for place in places_of(used):
        section = place.of(used)
        names = getattr(section, place.key)
        if not names:
            continue
        one = isinstance(names, str)
        allowed = place.kinds if one else place.kinds[:1]
        key = f"{place.section}.{place.key}"
        found = [_read(rig, key, name, allowed) for name in ((names,) if one else names)]
        from rigapp.calibrating.verification import verified  # GTC and SciPy: only where needed

        with_numbers, labels = place.use(rig, section, [record for _, record in found])
        used = place.put(used, with_numbers)
        override = getattr(section, f"{place.key}_override")
        for label, (text, record) in zip(labels, found * len(labels), strict=False):
            texts[label] = text
            found_again = verified(text.encode())
            against = " and ".join(_faults(rig, record, found_again, now))
            if not against:
                due = f"record {record.number}, due {str(record.content['due_at'])[:10]}"
                remarks[label] = ". ".join((due, *found_again.unverified))
            elif override.strip():
                remarks[label] = (
                    f"record {record.number} {against}, used all the same: {override.strip()}"
                )
            else:
                blocking[label] = (
                    f"the calibration record {record.number} of {label} {against};"
                    f" calibrate again, or write calibration_override with the reason"
                )
    return RigRecords(Document(rig.path, rig.text, used), texts, blocking, remarks)


def _read(rig: Rig, key: str, name: str, kinds: tuple[str, ...]) -> tuple[str, Record]:
    path = Path(name)
    if not path.is_absolute():
        path = rig.path.parent / path
    where = f"{rig.path}: {key} = {name!r}"
    try:
        data = read_bytes(path)
        record = unseal(data)
    except OSError as error:
        raise UnusableInput(f"{where}: the record cannot be read ‹{error}›.") from error
    except RecordError as error:
        raise UnusableInput(f"{where}: {error}.") from error
    if record.kind not in kinds:
        raise UnusableInput(
            f"{where}: this is the record of a {record.kind}, not of a {' or a '.join(kinds)}."
        )
    return data.decode(), record


def _faults(rig: Rig, record: Record, again: Verification, now: float) -> list[str]:
    """Return what stands against the use of a record: untrue, expired, dated ahead, or foreign.

    Untrue: its readings give something else. Foreign: taken on another rig, on a simulated one for
    a real one or the reverse, or of a load cell of another full scale. Readings that came as a
    table do not say where they were taken.
    """
    content, here = record.content, rig.record
    found = [f"does not follow from its readings ({one.rstrip('.')})" for one in again.differences]
    ahead, due = in_future(record, now), str(content["due_at"])
    if ahead:
        found.append(ahead)
    if now > moment(due):
        found.append(f"expired on {due[:10]}")
    taken = content.get("taken") or {}
    where = str(taken.get("rig") or "")
    if where and where != here.name:
        found.append(f"was taken on the rig {where!r}, this is {here.name!r}")
    simulated = taken.get("simulated")
    if simulated is not None and bool(simulated) is not here.simulated:
        kinds = ("a real rig", "a simulated rig")
        found.append(f"was taken on {kinds[bool(simulated)]}, this is {kinds[not simulated]}")
    line = content["result"].get("uncertainty_line_N")
    full = content["settings"].get("cell", {}).get("full_scale_N")
    if line is not None and full is not None:
        found += filter(None, [too_uncertain(line["constant_N"] + line["per_N"] * full, full)])
    if full is not None and abs(full / here.load_cell.full_scale_N - 1.0) > 1e-6:
        found.append(
            f"is of a load cell of {full:g} N, the rig file says {here.load_cell.full_scale_N:g} N"
        )
    return found


@dataclass(frozen=True, slots=True)
class ProbesStated:
    """What the records of the probes state of a depth.

    sensitivity: relative standard uncertainty, the larger of both probes'; drift_um: standard, what
    a depth may wander by in a decade of revolutions: the uncertainty of one position, since wear
    moves the pin through positions that are each wrong by so much. records: which ones.
    """

    sensitivity: float
    drift_um: float
    records: str


def probes_stated(texts: Mapping[str, str]) -> ProbesStated | None:
    """Return what the probes' records among some texts state, None where there are none.

    texts: as ``RigRecords`` has them. Raises RecordError for one that was changed.
    """
    records = [
        unseal(texts[label].encode())
        for label in ("probe_1", "probe_2", "probes")
        if label in texts
    ]
    results = [one.content["result"] for one in records]
    each = [part for result in results for part in result.get("probes", [result])]
    sensitivity = [one.get("sensitivity_relative_standard_uncertainty") for one in each]
    expanded = [one.get("expanded_uncertainty_um") for one in each]
    if not each or not all(isinstance(one, int | float) for one in (*sensitivity, *expanded)):
        return None
    position = max(one["expanded_uncertainty_um"] / one.get("coverage_factor", 2.0) for one in each)
    names = " + ".join(dict.fromkeys(str(one.number) for one in records))
    return ProbesStated(float(max(sensitivity)), float(position), names)


# --- what the records of a place replace ----------------------------------------------------------


def _load_cell(
    rig: Rig, section: LoadCellSection, records: Sequence[Record]
) -> tuple[LoadCellSection, Sequence[str]]:
    (record,) = records
    result = record.content["result"]
    unit = record.content["settings"]["cell"]["signal_unit"]
    if unit != "mV/V":
        raise UnusableInput(
            f"{rig.path}: the record {record.number} is in N per {unit}; the rig measures mV/V."
        )
    line = result["uncertainty_line_N"]
    quadratic = result.get("quadratic_unit_per_N2")
    used = msgspec.structs.replace(
        section,
        matrix_N_per_mV_per_V=_pairs(result["matrix_N_per_unit"]),
        zero_mV_per_V=tuple(result["zero"]),
        quadratic_mV_per_V_per_N2=None if quadratic is None else _pairs(quadratic),
        uncertainty_N=(line["constant_N"], line["per_N"]),
    )
    return used, ("load_cell",)


def _probes(
    rig: Rig, section: ProbesSection, records: Sequence[Record]
) -> tuple[ProbesSection, Sequence[str]]:
    """One record of a pair, one of each probe, or one of both alike."""
    first, second = records[0], records[-1]
    pair = first.kind == "probe pair"
    results = [one.content["result"] for one in (first, second)]
    if pair:
        results = first.content["result"]["probes"]
    both = list(zip(results, (first, second), strict=True))
    stated = [result.get("expanded_uncertainty_um") for result in results]
    known = all(isinstance(one, int | float) for one in stated)
    used = msgspec.structs.replace(
        section,
        sensitivity_um_per_V=tuple(_number(rig, r, n, "sensitivity_um_per_V") for r, n in both),
        offset_V=tuple(_number(rig, r, n, "offset_V") for r, n in both),
        uncertainty_um=tuple(map(float, stated)) if known else section.uncertainty_um,
    )
    if not pair:
        return used, ("probe_1", "probe_2")
    matrix = _pairs(first.content["result"]["alignment"]["matrix"])
    return msgspec.structs.replace(used, alignment=matrix), ("probes",)


def _run_out(
    rig: Rig, section: ProbesSection, records: Sequence[Record]
) -> tuple[ProbesSection, Sequence[str]]:
    """Take the map; its uncertainty and the probes' add as squares.

    The probes' own systematic part is in both, so that the sum is rather too large than too small.
    """
    result = records[0].content["result"]
    stated, of_map = section.uncertainty_um, result["expanded_uncertainties_um"]
    used = msgspec.structs.replace(
        section,
        run_out_cos_um=_pairs(result["cos_um"]),
        run_out_sin_um=_pairs(result["sin_um"]),
        uncertainty_um=None if stated is None else tuple(map(math.hypot, stated, of_map)),
    )
    return used, ("run_out",)


def _channel(
    name: str, rig: Rig, section: ChannelSection, records: Sequence[Record]
) -> tuple[ChannelSection, Sequence[str]]:
    (record,) = records
    result = record.content["result"]
    if result["unit"] != section.unit:
        raise UnusableInput(
            f"{rig.path}: channels.{name}.unit = {section.unit!r}, and the record {record.number}"
            f" is in {result['unit']}; write its unit, or name another record."
        )
    used = msgspec.structs.replace(
        section,
        scale=1.0 if result["scale_per_V"] is None else result["scale_per_V"],
        offset_V=result["offset_V"] or 0.0,
        table=_pairs(result["table"] or ()),
        uncertainty=result["expanded_uncertainty_value"],
    )
    return used, (f"channel_{name}",)


def _pairs(rows: Sequence[Sequence[float]]) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in rows)


def _number(rig: Rig, result: Mapping[str, Any], record: Record, key: str) -> float:
    value = result.get(key)
    if not isinstance(value, int | float):
        raise UnusableInput(f"{rig.path}: the record {record.number} has no {key}.")
    return float(value)


LOAD_CELL = RecordPlace("load_cell", "calibration", ("load cell",), _load_cell)
PROBES = RecordPlace("probes", "calibration", ("probe", "probe pair"), _probes)
RUN_OUT = RecordPlace("probes", "run_out", ("run-out map",), _run_out)
PLACES = (LOAD_CELL, PROBES, RUN_OUT)
"""Where every rig file names records, in the order in which they are put to use."""


def places_of(rig: RigFile) -> Iterator[RecordPlace]:
    """Yield where a rig file can name records: ``PLACES``, then each of its free channels."""
    yield from PLACES
    for name in rig.channels:
        yield RecordPlace(f"channels.{name}", "calibration", ("channel",), partial(_channel, name))
