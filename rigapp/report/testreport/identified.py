"""Identified wear of recorded tests, individually and for specimens of one pairing.

The course has the twin's statements during the test, from the columns of the file. Posterior and
bands are recomputed from the twin's data in the file by the same functions of
``rigapp_model.identification``: the same bins give the same numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.schema.columns import identified_columns
from rigapp.schema.messages import last_set_speed
from rigapp.storage import (
    StoredColumns,
    TestReader,
    open_test,
    plausible_until,
    rows_up_to,
)
from rigapp.texts import as_written, say, sentence_of_error
from rigapp.twin.identifying import LEAST_REFERENCE
from rigapp.twin.kept import NO_BIN, kept_of, life_of
from rigapp_model.identification import (
    Band,
    Bin,
    Credible,
    DepthLife,
    Estimate,
    Identification,
    NotIdentifiable,
    Pairing,
    Remaining,
    estimate_of,
    identify,
    pairing_of,
    predictive_band,
    remaining,
)
from rigapp_model.identification.words import sentence

Array = NDArray[np.float64]

EARLY = 0.1
"""Share of the planned revolutions after which the early band is predicted, for comparison."""
BAND_POINTS = 60
"""Number of revolutions at which a band is computed, sufficient for a smooth curve."""
STATED = tuple(column.name for column in identified_columns())
"""Columns of the course."""


RECENT = 1 << 16
"""Number of last revolutions searched for one at the set speed; longer than any ramp."""


@dataclass(frozen=True, slots=True, eq=False)
class ForecastBand:
    """Band predicted after a revolution, up to the planned end."""

    after: int
    band: Band


@dataclass(frozen=True, slots=True, eq=False)
class IdentifiedTest:
    """Identified wear of one test.

    identifier: of the test; record: the probes' calibration; said: the statement as text, or the
    reason for its absence, and then refused; course: columns over the revolutions with a new
    statement of the twin; known: after the last bin; before: revolutions of the bushing before the
    test, included in those of readings and bands; left: None without a depth that ends the test.
    """

    path: Path
    title: str
    identifier: str
    specimen: str
    planned: int
    rpm: float
    said: str
    refused: bool = True
    record: str = ""
    course: Mapping[str, Array] = field(default_factory=dict)
    known: Identification | None = None
    left: Remaining | None = None
    bands: tuple[ForecastBand, ...] = ()
    before: int = 0

    @property
    def remaining_s(self) -> float:
        """Return the remaining time of the test at its last set speed, s; NaN if unknown."""
        if self.left is None or self.left.revolutions is None or not self.rpm:
            return float("nan")
        return 60.0 * self.left.revolutions.median / self.rpm


def identified_test(path: Path, after: int | None = None) -> IdentifiedTest:
    """Return the identified wear of a recorded test; raises UnusableInput for other files.

    The result has a reason for each unknown value. after: use only data up to a revolution.
    """
    with open_test(path) as reader:
        return identified(reader, path, after)


def identified(reader: TestReader, path: Path, after: int | None = None) -> IdentifiedTest:
    """Return the identified wear of an open test."""
    about = reader.metadata()
    end = reader.committed() if after is None else rows_up_to(reader, after)
    recent = max(0, end - RECENT)
    speed, quality = (reader.column(name, recent, end) for name in ("speed", "quality"))
    plain: dict[str, Any] = {
        "path": path,
        "title": str(about["title"]),
        "identifier": str(about["identifier"]),
        "specimen": str(about["specimen"]),
        "planned": int(about["planned_revolutions"]),
        "rpm": last_set_speed(speed, quality) if speed.size else 0.0,
    }
    record = ""
    until = plausible_until(reader)
    if until is not None:
        after = until if after is None else min(after, until)
    try:
        if until == 0:
            raise NotIdentifiable(say("its measured wear depth is not reliable; see the alarms"))
        kept, before = kept_of(reader)
        record = kept.sought.record
        moments = _moments(reader, kept.bins.closed, after, before)
        life = life_of(kept)

        def known_at(index: int) -> Identification:
            moment = moments[index]
            errors = kept.errors()
            if not before:  # else the zero of an earlier test is the best and is kept
                errors = replace(errors, reference=max(moment.reference, LEAST_REFERENCE))
            return identify(kept.bins.closed[: index + 1], life, errors, kept.prior())

        known = known_at(len(moments) - 1)
    except NotIdentifiable as error:
        reason = as_written(sentence_of_error(error)).rstrip(".")
        refusal = say("The wear coefficient cannot be determined, because {}.", reason)
        return IdentifiedTest(**plain, record=record, said=refusal)
    depth, departure = kept.sought.depth, kept.consistency.departure
    if departure is not None and after is not None and departure.revolution > after + before:
        departure = None
    planned = plain["planned"] + before
    early = [index for index, moment in enumerate(moments) if moment.closed <= EARLY * planned]
    bands = [_band(known, life, planned)]
    if early and early[-1] < len(moments) - 1:
        bands = [*_early(known_at, early[-1], life, planned), *bands]
    words = sentence(known, departure)
    if len(bands) > 1:
        words += beyond_band(bands[0], kept.bins.closed[: len(moments)], before)
    if until is not None:
        words += say(" After revolution {} the measured wear depth is not reliable.", until)
    if before:
        words += say(" Revolutions are counted from the new bushing, {} before this test.", before)
    return IdentifiedTest(
        **plain,
        record=record,
        said=words,
        before=before,
        refused=False,
        course=_course(reader, after),
        known=known,
        left=None if depth is None else _left(known, life, depth, _last(reader, after) + before),
        bands=tuple(bands),
    )


@dataclass(frozen=True, slots=True)
class _Moment:
    """Time when a bin was closed, and standard uncertainty of the depth's zero then, m."""

    closed: float
    reference: float


def _moments(
    reader: TestReader, bins: Sequence[Bin], after: int | None, before: int
) -> list[_Moment]:
    """Return the moments at which bins were closed: at the first reading after each bin.

    Raises NotIdentifiable without any.
    """
    table = StoredColumns(reader, "prediction")
    read = np.isfinite(table["measured_wear_depth"])
    revolutions = table["revolution"][read].astype(np.float64) + before
    uncertainty = np.minimum.accumulate(0.5e-3 * table["measured_wear_depth_uncertainty"][read])
    result = []
    for closed_bin in bins:
        index = int(np.searchsorted(revolutions, closed_bin.revolution, side="right"))
        if index < revolutions.size and (after is None or revolutions[index] <= after + before):
            result.append(_Moment(float(revolutions[index]), float(uncertainty[index])))
    if not result:
        raise NotIdentifiable(NO_BIN)
    return result


def _last(reader: TestReader, after: int | None) -> float:
    """Return the last revolution to evaluate."""
    rows = reader.committed("prediction")
    last = float(reader.column("revolution", rows - 1, rows, "prediction")[0])
    return last if after is None else min(last, float(after))


def _left(known: Identification, life: DepthLife, depth: float, last: float) -> Remaining:
    """Return the remaining life after the last revolution, which is later than the last bin."""
    result = remaining(known, life, depth)
    if result.revolutions is None:
        return result
    since = last - known.revolution
    left = result.revolutions
    counted = (max(count - since, 0.0) for count in (left.median, left.low, left.high))
    return replace(result, revolutions=Credible(*counted))


def _course(reader: TestReader, after: int | None) -> dict[str, Array]:
    """Return the columns of the rows with new statements."""
    table = StoredColumns(reader, "prediction")
    stated = np.isfinite(table["wear_coefficient"])
    if after is not None:
        stated &= table["revolution"] <= after
    columns = {name: np.asarray(table[name][stated], float) for name in ("revolution", *STATED)}
    rows = np.column_stack([columns[f"wear_coefficient{limit}"] for limit in ("", "_low", "_high")])
    new = np.ones(len(rows), dtype=bool)
    new[1:] = (np.diff(rows, axis=0) != 0.0).any(axis=1)
    return {name: values[new] for name, values in columns.items()}


def _early(
    known_at: Callable[[int], Identification], index: int, life: DepthLife, planned: int
) -> list[ForecastBand]:
    """Return the early band; empty where the wear was not identifiable then."""
    try:
        return [_band(known_at(index), life, planned)]
    except NotIdentifiable:
        return []


def _band(known: Identification, life: DepthLife, planned: int) -> ForecastBand:
    now = int(known.revolution)
    revolutions = np.unique(np.linspace(now, max(planned, now + 1), BAND_POINTS).astype(int))
    return ForecastBand(now, predictive_band(known, life, revolutions.astype(float)))


def beyond_band(early: ForecastBand, bins: Sequence[Bin], before: int = 0) -> str:
    """Return a sentence when the last measured depth is outside the early band, else empty.

    before: revolutions of the bushing before the test, included in those of bands and bins.
    """
    if len(bins) < 2 or bins[-1].revolution <= early.after:
        return ""
    last, start = bins[-1], bins[-2].revolution
    part = (last.progress - last.first) / max(last.last - last.first, 1e-300)
    middle = start + part * (last.revolution - start)
    band = early.band
    low, median, high = (
        1e6 * float(np.interp(middle, band.revolution, curve))
        for curve in (band.low, band.median, band.high)
    )
    depth = 1e6 * last.depth
    if not (depth < low or depth > high):
        return ""
    return say(
        " {:.1f} µm are measured at revolution {:.0f}; after revolution {} "
        "{:.1f} µm were predicted there, {:.1f} to {:.1f} µm with 95 %. The "
        "wear differs from the model and its first readings.",
        depth,
        middle - before,
        early.after - before,
        median,
        low,
        high,
    )


@dataclass(frozen=True, slots=True, eq=False)
class IdentifiedTests:
    """Parameters of several tests; pairing: of all together, or None with ``why_not``."""

    tests: tuple[IdentifiedTest, ...]
    pairing: Pairing | None = None
    counted: tuple[IdentifiedTest, ...] = ()
    why_not: str = ""


def identified_tests(
    paths: Sequence[Path],
    after: int | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> IdentifiedTests:
    """Return the identified wear of tests, and of their pairing from all with sufficient data.

    after: use only data up to a revolution. progress: called with the number of completed and of
    all files. Raises UnusableInput for files that are not tests, and for the same test twice.
    """
    tests: list[IdentifiedTest] = []
    for path in paths:
        tests.append(identified_test(path, after))
        same = next((test for test in tests[:-1] if test.identifier == tests[-1].identifier), None)
        if same is not None:
            raise UnusableInput("{}: that is the test of {} again; give it once.", path, same.path)
        if progress is not None:
            progress(float(len(tests)), float(len(paths)))
    counted: list[IdentifiedTest] = []
    estimates: list[Estimate] = []
    why_not = ""
    for test in tests:
        if test.known is None:
            continue
        later = next((two for two in tests if two.specimen == test.specimen and two.before), None)
        if later is not None and later.before > test.before:
            why_not = say("{}: its readings are among those of {}", test.path.name, later.path.name)
            continue
        try:
            estimates.append(estimate_of(test.known, test.record))
        except NotIdentifiable as error:
            why_not = f"{test.path.name}: {error}"
            continue
        counted.append(test)
    if not estimates:
        return IdentifiedTests(tuple(tests), why_not=why_not)
    names = ", ".join(test.path.name for test in counted)
    specimens = say("one specimen") if len(counted) == 1 else say("{} specimens", len(counted))
    pairing = pairing_of(estimates, f"{specimens}: {names}")
    return IdentifiedTests(tuple(tests), pairing, tuple(counted), why_not)
