"""Calibration records named by a rig file: read, verified, and used in place of its own numbers."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from rigapp.calibrating.wiring import foreign
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, RigRecords, parse_rig, read_rig
from rigapp.config.reading import read_bytes
from rigapp.config.rig import ChannelSection, LoadCellSection, ProbesSection, RigFile
from rigapp.config.writing import whole_file
from rigapp.schema.wire import tree_of
from rigapp.texts import joined, say
from rigapp_calibration.load_cell.force_uncertainty import too_uncertain
from rigapp_calibration.records import (
    MALFORMED,
    Record,
    RecordError,
    check_shape,
    in_future,
    moment,
    unseal,
)

if TYPE_CHECKING:
    from rigapp.calibrating.verification import Verification

Rig = Document[RigFile]


@dataclass(frozen=True, slots=True)
class RecordPlace:
    """Where a rig file names records, and what they replace in it.

    section: its name, or that of a table and one of its entries (``channels.NAME``). kinds: of
    records that are allowed; a list of names allows the first only. use (rig, section,
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
        """Return whether one record of a kind is enough, without a list."""
        return len(self.kinds) == 1 or kind != self.kinds[0]


def with_records(rig: Rig, now: float | None = None) -> RigRecords:
    """Read the records that a rig file names (``places_of``).

    Paths are relative to the rig file. Each record is fitted again from its readings and compared.
    Raises UnusableInput for a record that is missing, changed since it was made, or of another
    kind.
    """
    texts: dict[str, str] = {}
    blocking: dict[str, str] = {}
    remarks: dict[str, str] = {}
    now = time.time() if now is None else now
    used, trusted = rig.record, _trusted_keys(rig)
    for place in places_of(used):
        section = place.of(used)
        names = getattr(section, place.key)
        if not names:
            continue
        single = isinstance(names, str)
        allowed = place.kinds if single else place.kinds[:1]
        key = f"{place.section}.{place.key}"
        texts_and_records = [
            _read(rig, key, name, allowed) for name in ((names,) if single else names)
        ]
        from rigapp.calibrating.verification import verified  # GTC and SciPy: only where needed

        try:
            with_numbers, labels = place.use(
                rig, section, [record for _, record in texts_and_records]
            )
            # A record must not contain values that the rig file itself could not.
            with_numbers = msgspec.convert(tree_of(with_numbers), type(section))
            each = []
            for text, record in texts_and_records:
                again = verified(text.encode())
                faults = [*_faults(rig, record, again, now), *_unsigned(record, trusted)]
                each.append((text, record, again, joined(say(" and "), faults)))
        except MALFORMED as error:
            named = joined(", ", (names,) if single else names)
            raise UnusableInput(
                "{}: {} = {}: a value of the record is missing or cannot be ‹{}›; export the"
                " record again from where it was made, or calibrate again.",
                rig.path,
                key,
                named,
                repr(error),
            ) from error
        used = place.put(used, with_numbers)
        override = getattr(section, f"{place.key}_override")
        # One record may hold both probes.
        for label, (text, record, again, against) in zip(labels, each * len(labels), strict=False):
            texts[label] = text
            if not against:
                due = say("record {}, due {}", record.number, str(record.content["due_at"])[:10])
                remarks[label] = joined(
                    ". ", (joined(", ", (due, *_signer(record, trusted))), *again.unverified)
                )
            elif override.strip():
                remarks[label] = say(
                    "record {} {}, used all the same: {}", record.number, against, override.strip()
                )
            else:
                blocking[label] = say(
                    "the calibration record {} of {} {}",
                    record.number,
                    label,
                    against,
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
        if record.kind in kinds:
            check_shape(record)
    except OSError as error:
        raise UnusableInput("{}: the record cannot be read ‹{}›.", where, error) from error
    except RecordError as error:
        raise UnusableInput("{}: {}.", where, error) from error
    if record.kind not in kinds:
        raise UnusableInput(
            "{}: this is the record of a {}, not of a {}.", where, record.kind, " or a ".join(kinds)
        )
    return data.decode(), record


def _trusted_keys(rig: Rig) -> dict[str, str]:
    """Return the names of the keys that a rig file trusts by the raw keys; raise UnusableInput."""
    stems: dict[str, str] = {}
    for name in rig.record.records.trusted_keys:
        from rigapp_calibration.signatures import UnusableKey, public_key_of  # only where needed

        path, where = rig.path.parent / name, f"{rig.path}: records.trusted_keys = {name!r}"
        try:
            stems[public_key_of(read_bytes(path))] = Path(name).stem
        except OSError as error:
            raise UnusableInput("{}: the key cannot be read ‹{}›.", where, error) from error
        except UnusableKey as error:
            raise UnusableInput("{}: {}.", where, error) from error
    return stems


def _unsigned(record: Record, trusted: Mapping[str, str]) -> Iterator[str]:
    """Yield why a record is not from a laboratory trusted by the rig file, if it names any.

    The signature itself is verified for every record.
    """
    if not trusted:
        return
    if record.signature is None:
        yield say("is not signed, and the rig file names the keys that it trusts")
    elif record.signature.public_key not in trusted:
        yield say("is signed by a key that the rig file does not trust ({})", _mark(record))


def _signer(record: Record, trusted: Mapping[str, str]) -> Iterator[str]:
    """Yield the signer of a record, if it is signed."""
    if record.signature is not None:
        name = trusted.get(record.signature.public_key, say("an unknown key"))
        yield say("signed by {} ({})", name, _mark(record))


def _mark(record: Record) -> str:
    from rigapp_calibration.signatures import fingerprint  # only where needed

    assert record.signature is not None
    return fingerprint(record.signature.public_key)


def _faults(rig: Rig, record: Record, again: Verification, now: float) -> list[str]:
    """Return the objections to the use of a record: untrue, expired, dated ahead, or foreign.

    Untrue: its readings give another result, are missing, or cannot be fitted by this version.
    Foreign: taken on another rig, on a simulated one for a real one or the reverse, of a load cell
    of another full scale or serial number, or by another line (``wiring``). Readings that came as a
    table do not state where they were taken.
    """
    content, own_rig = record.content, rig.record
    if again.compared:
        warnings: list[str] = [
            say("does not follow from its readings ({})", difference.rstrip("."))
            for difference in again.differences
        ]
    else:
        unknown = (*again.differences, *again.unverified)
        warnings = [
            say("cannot be verified ({})", difference.rstrip(".")) for difference in unknown
        ]
    ahead, due = in_future(record, now), str(content["due_at"])
    if ahead:
        warnings.append(ahead)
    if now > moment(due):
        warnings.append(say("expired on {}", due[:10]))
    taken = content.get("taken") or {}
    where = str(taken.get("rig") or "")
    if where and where != own_rig.name:
        warnings.append(say("was taken on the rig {}, this is {}", repr(where), repr(own_rig.name)))
    simulated = taken.get("simulated")
    if simulated is not None and bool(simulated) is not own_rig.simulated:
        kinds = (say("a real rig"), say("a simulated rig"))
        warnings.append(
            say("was taken on {}, this is {}", kinds[bool(simulated)], kinds[not simulated])
        )
    line = content["result"].get("uncertainty_line_N")
    full = content["settings"].get("cell", {}).get("full_scale_N")
    if line is not None and full is not None:
        warnings += filter(None, [too_uncertain(line["constant_N"] + line["per_N"] * full, full)])
    if full is not None and abs(full / own_rig.load_cell.full_scale_N - 1.0) > 1e-6:
        warnings.append(
            say(
                "is of a load cell of {:g} N, the rig file says {:g} N",
                full,
                own_rig.load_cell.full_scale_N,
            )
        )
    return [*warnings, *foreign(record.kind, content, own_rig)]


@dataclass(frozen=True, slots=True)
class ProbesStated:
    """The uncertainty of a depth by the records of the probes.

    sensitivity: relative standard uncertainty, the larger of both probes'; drift_um: standard
    drift of a depth in a decade of revolutions: the uncertainty of one position, since wear moves
    the pin through positions that each have this error. records: their names.
    """

    sensitivity: float
    drift_um: float
    records: str


def probes_stated(texts: Mapping[str, str]) -> ProbesStated | None:
    """Return the uncertainty by the probes' records among some texts, None where there are none.

    texts: as ``RigRecords`` has them. Raises RecordError for one that was changed.
    """
    records = [
        unseal(texts[label].encode())
        for label in ("probe_1", "probe_2", "probes")
        if label in texts
    ]
    results = [record.content["result"] for record in records]
    each = [part for result in results for part in result.get("probes", [result])]
    sensitivity = [result.get("sensitivity_relative_standard_uncertainty") for result in each]
    expanded = [result.get("expanded_uncertainty_um") for result in each]
    if not each or not all(isinstance(value, int | float) for value in (*sensitivity, *expanded)):
        return None
    position = max(r["expanded_uncertainty_um"] / r.get("coverage_factor", 2.0) for r in each)
    names = " + ".join(dict.fromkeys(str(record.number) for record in records))
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
            "{}: the record {} is in N per {}; the rig measures mV/V.",
            rig.path,
            record.number,
            unit,
        )
    line = result["uncertainty_line_N"]
    quadratic = result.get("quadratic_unit_per_N2")
    used = msgspec.structs.replace(
        section,
        matrix_N_per_mV_per_V=_pairs(result["matrix_N_per_unit"]),
        zero_mV_per_V=tuple(result["zero"]),
        quadratic_mV_per_V_per_N2=None if quadratic is None else _pairs(quadratic),
        uncertainty_N=(line["constant_N"], line["per_N"]),
        pin_weight_N=float(result.get("pin_weight_N") or 0.0),
    )
    return used, ("load_cell",)


def _probes(
    rig: Rig, section: ProbesSection, records: Sequence[Record]
) -> tuple[ProbesSection, Sequence[str]]:
    """One record of a pair, one of each probe, or one of both alike."""
    first, second = records[0], records[-1]
    pair = first.kind == "probe pair"
    results = [record.content["result"] for record in (first, second)]
    if pair:
        results = first.content["result"]["probes"]
    both = list(zip(results, (first, second), strict=True))
    stated = [result.get("expanded_uncertainty_um") for result in results]
    known = all(isinstance(value, int | float) for value in stated)
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

    The probes' own systematic part is in both, so that the sum is an upper estimate.
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
            "{}: channels.{}.unit = {}, and the record {} is in {}; write its unit, or"
            " name another record.",
            rig.path,
            name,
            repr(section.unit),
            record.number,
            result["unit"],
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
        raise UnusableInput("{}: the record {} has no {}.", rig.path, record.number, key)
    return float(value)


LOAD_CELL = RecordPlace("load_cell", "calibration", (say("load cell"),), _load_cell)
PROBES = RecordPlace("probes", "calibration", ("probe", say("probe pair")), _probes)
RUN_OUT = RecordPlace("probes", "run_out", (say("run-out map"),), _run_out)
PLACES = (LOAD_CELL, PROBES, RUN_OUT)
"""Where every rig file names records, in the order in which they are applied."""


def places_of(rig: RigFile) -> Iterator[RecordPlace]:
    """Yield where a rig file can name records: ``PLACES``, then each of its free channels."""
    yield from PLACES
    for name in rig.channels:
        yield RecordPlace(f"channels.{name}", "calibration", ("channel",), partial(_channel, name))


def former_record(path: Path | None, place: RecordPlace, which: int = 0) -> Record | None:
    """Return the record that a rig file names in a place, or one of two; None without one.

    An expired or foreign one too: it serves for comparison only.
    """
    if path is None:
        return None
    rig = read_rig(path)
    names = getattr(place.of(rig.record), place.key)
    listed = (names,) if isinstance(names, str) else names
    name = listed[min(which, len(listed) - 1)]
    try:
        return _read(rig, place.key, name, place.kinds)[1] if name else None
    except UnusableInput:
        return None


def only_records_differ(first: RigFile, second: RigFile) -> bool:
    """Return whether two rig files are the same but for the records that they name."""

    def bare(rig: RigFile) -> RigFile:
        for place in places_of(rig):
            names = {place.key: "", f"{place.key}_override": ""}
            rig = place.put(rig, msgspec.structs.replace(place.of(rig), **names))
        return rig

    return bare(first) == bare(second)


def name_record(rig: Path, record: Path, place: RecordPlace = LOAD_CELL) -> Path:
    """Enter a record in its place of a rig file; return the copy of the old file.

    The name is relative to the rig file. An override of the place is removed: its reason was the
    former record's. Everything else stays, comments included. Nothing is changed if the record
    would make the rig unusable. Raises UnusableInput.
    """
    import tomlkit

    before = read_rig(rig)
    document = tomlkit.parse(before.text)
    table = document[place.section]
    table[place.key] = os.path.relpath(record.resolve(), rig.resolve().parent)
    table.pop(f"{place.key}_override", None)
    text = tomlkit.dumps(document)
    with_records(Document(rig, text, parse_rig(text, str(rig))))
    copy = _copy(rig, before.text)
    with whole_file(rig) as part:
        part.write_text(text, encoding="utf-8", newline="")
    return copy


def _copy(rig: Path, text: str) -> Path:
    """Write the old text beside the rig file under a name that is free."""
    stamp = time.strftime("%Y%m%d-%H%M%S")
    for count in range(100):
        more = f"-{count}" if count else ""
        copy = rig.with_name(f"{rig.stem}.before-{stamp}{more}{rig.suffix}")
        try:
            with copy.open("x", encoding="utf-8", newline="") as stream:
                stream.write(text)
        except FileExistsError:
            continue
        except OSError as error:
            raise UnusableInput(
                "{}: the copy of the rig file cannot be written ‹{}›; the rig file is not changed.",
                copy,
                error,
            ) from error
        return copy
    raise UnusableInput("{}: there are too many copies beside it; remove some.", rig)
