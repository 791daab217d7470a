"""The largest force of a test and the revolution in which it tripped.

A trip ends a test within a revolution, which has no row of statistics: its samples are among the
unfinished revolutions, and the log has the force that caused the trip.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.alarms import UNBELIEVED, kind_of
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.loglines import alarm_change, severity_of
from rigapp.schema.messages import Event, FinishReason, Flag, Severity
from rigapp.storage.reading.blocks import blocks, rows_up_to
from rigapp.storage.reading.reader import StoredCycle, TestReader
from rigapp.storage.structure.events import logged_sentence

OVERLOAD, BEYOND_RANGE, NO_FORCE = "overload", "overload:beyond_range", "saturated"
RESUMED, STOOD = "resumed", "stopped"
DEPTH = "measured_wear_depth"
SPEED_OVER_DEG = 5.0
"""Crank angle over which the speed is averaged, 50 counts of the encoder."""
TRIGGER_N = 0.2
"""Tolerance of the trigger: forces are stored rounded to the amplifier's steps of about 0.1 N."""
REVERSAL_DEG = 1.0
"""Reversal of the crank that counts as a swing; a dithering encoder edge causes less."""


@dataclass(frozen=True, slots=True)
class LargestForce:
    """The largest |F| of a test, N.

    angle_deg: crank angle, NaN where unknown. lower_bound: the force exceeded the measuring range.
    complete: its revolution has a row of statistics.
    """

    value_N: float
    revolution: int
    angle_deg: float = math.nan
    lower_bound: bool = False
    complete: bool = True

    @property
    def sign(self) -> str:
        """Return the sign before the value."""
        return "≥ " if self.lower_bound else ""


@dataclass(frozen=True, slots=True, eq=False)
class Trip:
    """The revolution in which a test tripped.

    cycle: its samples in the file, until the crank swung back. before: the last whole cycle saved
    before it, of the revolution just before in nearly every file. peak: its largest force. None
    where the file has none. after: the revolutions up to the crank's standstill.
    trigger_N: the force that exceeded its limit, NaN for another cause.
    """

    revolution: int
    cycle: StoredCycle | None
    before: StoredCycle | None
    peak: LargestForce | None
    after: tuple[StoredCycle, ...] = ()
    trigger_N: float = math.nan


def largest_force(test: TestReader) -> LargestForce | None:
    """Return the largest force of a test, None when none was measured.

    A saturated input counts only as the lower bound of an overload.
    """
    # Of equal values the last one: it has the flag of a lower bound.
    return max(reversed(_peaks(test)), key=_value, default=None)


def _value(force: LargestForce) -> float:
    return force.value_N


def _peaks(test: TestReader) -> list[LargestForce]:
    """Return the largest forces of whole revolutions, of each part of one and of each overload."""
    log = _ForceLog(test.events())
    parts = [_of_part(cycle) for cycle in test.unfinished() if log.knows_force(cycle)]
    result = [*parts, *_of_rows(test, log)]
    for number, (value, beyond) in log.overloads.items():
        # The part first: a resumed test makes a whole revolution of the same number.
        known = next((peak for peak in result if peak.revolution == number), None)
        angle, complete = (known.angle_deg, known.complete) if known else (math.nan, False)
        most = max(value, known.value_N if known is not None else value)
        if most > 0.0:
            result.append(LargestForce(most, number, angle, beyond, complete))
    return result


def trip_of(test: TestReader) -> Trip | None:
    """Return the revolution in which a test tripped; None when an operator ended it."""
    summary, code = test.summary(), test.metadata()["reason_code"]
    ends = (FinishReason.OPERATOR, FinishReason.COMPLETE)
    if summary["status"] != "stopped" or not code or code in ends:
        return None
    first_out = _first_out(test.events())
    number, trigger = (summary["last_revolution"] or 0) + 1, math.nan
    if first_out is not None:
        change = alarm_change(first_out)
        if first_out.key.partition(":")[0] == OVERLOAD and change is not None:
            trigger = change.value or math.nan
        kind = kind_of(first_out.key)
        judged_whole = kind is None or kind.whole_revolution
        number = first_out.revolution + (not judged_whole)
    saved = test.cycle_revolutions()
    parts = [cycle for cycle in test.unfinished() if cycle.revolution == number]
    places = np.flatnonzero(saved == number)
    before = np.flatnonzero(saved < number)
    cycle = test.cycle(int(places[-1])) if places.size else parts[-1] if parts else None
    after = [test.cycle(int(index)) for index in np.flatnonzero(saved > number)]
    after += [cycle for cycle in test.unfinished() if cycle.revolution > number]
    peaks = (peak for peak in reversed(_peaks(test)) if peak.revolution == number)
    return Trip(
        number,
        _forwards(cycle) if cycle is not None else None,
        test.cycle(int(before[-1])) if before.size else None,
        max(peaks, key=_value, default=None),
        tuple(later for later in map(_forwards, after) if later is not None),
        trigger,
    )


def _forwards(cycle: StoredCycle) -> StoredCycle | None:
    """Return a revolution up to the first reversal of the crank; None without a force."""
    angle = cycle.columns["angle"]
    reversals = np.flatnonzero(np.maximum.accumulate(angle) - angle > REVERSAL_DEG)
    stop = int(reversals[0]) if reversals.size else len(angle)
    columns = {name: values[:stop] for name, values in cycle.columns.items()}
    return replace(cycle, columns=columns) if np.isfinite(columns["force"]).any() else None


def _first_out(events: list[Event]) -> Event | None:
    """Return the event of the first critical alarm since the test was last started or resumed."""
    result: Event | None = None
    for event in events:
        change = alarm_change(event)
        if event.kind == RESUMED:
            result = None
        elif change is not None and change.first_out and severity_of(event) is Severity.CRITICAL:
            result = event
    return result


@dataclass(frozen=True, slots=True, eq=False)
class TripPiece:
    """A sequence of samples around a trip, (n,) each; before: of the revolution before it.

    time_s: from the trip. values: by channel, with ``speed`` in rpm.
    """

    time_s: NDArray[np.float64]
    values: dict[str, NDArray[np.float64]]
    before: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class TripCapture:
    """The time around a trip: samples, the cause, and the time until the crank was stationary.

    pieces: in order of time. currents: time from the trip (n,) and A, by slow channel, one value a
    revolution. sentence: why the test ended. happened: host time of the alarm's line in the log,
    written after the drive was commanded; stood_s: from there to the line of the spindle's
    standstill; turned_s: from the trip to the last movement, by the device's clock; NaN: unknown.
    """

    trip: Trip
    pieces: tuple[TripPiece, ...]
    currents: dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]
    sentence: str
    happened: float = math.nan
    stood_s: float = math.nan
    turned_s: float = math.nan
    table: ChannelTable = BASE

    def series(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return those of the named channels that every piece has."""
        return tuple(name for name in names if all(name in piece.values for piece in self.pieces))


def trip_capture(test: TestReader) -> TripCapture | None:
    """Return the seconds around the trip of a test; None without one, or without its samples."""
    result = trip_of(test)
    if result is None or result.cycle is None:
        return None
    cycle, before = result.cycle, [result.before] if result.before is not None else []
    zero, events = _tripped_at(result, cycle), test.events()
    pieces = tuple(
        TripPiece(part.columns["time"] - zero, _values(part), part is result.before)
        for part in (*before, cycle, *result.after)
    )
    first_out = _first_out(events)
    happened = first_out.time if first_out is not None else math.nan
    reached_standstill = [
        event.time for event in events if event.kind == STOOD and event.time >= happened
    ]
    return TripCapture(
        result,
        pieces,
        _currents(test, cycle.table, zero, pieces[0].time_s[0]),
        logged_sentence(str(test.summary()["reason"]), events),
        happened,
        reached_standstill[0] - happened if reached_standstill else math.nan,
        _turned_s(result, cycle, zero),
        cycle.table,
    )


def _values(cycle: StoredCycle) -> dict[str, NDArray[np.float64]]:
    names = [curve.name for curve in cycle.table.curves if curve.name in cycle.columns]
    return {**{name: cycle.columns[name] for name in names}, "speed": _speed_rpm(cycle)}


def _currents(
    test: TestReader, table: ChannelTable, zero: float, since: float
) -> dict[str, tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Return the values of slow channels in A, of revolutions that ended from ``since`` on."""
    slow = [channel.name for channel in table.slow if channel.unit == "A"]
    if not slow or not test.committed():
        return {}
    time = test.column("time") - zero
    kept = time >= since
    return {name: (time[kept], test.column(name)[kept]) for name in slow}


def _tripped_at(trip: Trip, cycle: StoredCycle) -> float:
    """Return the device's time of the trip, s: that of the force which exceeded its limit."""
    force, time = cycle.columns["force"], cycle.columns["time"]
    # A force beyond the measuring range is stored as the end of the range.
    trigger = min(trip.trigger_N, float(np.nanmax(force)))
    with np.errstate(invalid="ignore"):
        over = np.flatnonzero(force >= trigger - TRIGGER_N)
    return float(time[over[0] if over.size else -1])


def _speed_rpm(cycle: StoredCycle) -> NDArray[np.float64]:
    """Return the speed of the crank (n,), averaged over ``SPEED_OVER_DEG``."""
    angle, time = cycle.columns["angle"].astype(np.float64), cycle.columns["time"]
    indices = np.searchsorted(np.maximum.accumulate(angle), angle - SPEED_OVER_DEG)
    duration = time - time[indices]
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(duration > 0.0, (angle - angle[indices]) / duration / 6.0, np.nan)


def _turned_s(trip: Trip, cycle: StoredCycle, zero: float) -> float:
    """Return the time from a trip to the last recorded movement of the crank, s."""
    last = (trip.after or (cycle,))[-1]
    moved = np.flatnonzero(np.diff(last.columns["angle"]) != 0.0)
    end = last.columns["time"][int(moved[-1]) + 1 if moved.size else 0]
    return max(0.0, float(end) - zero)


class _ForceLog:
    """Forces in the log: overloads, and the revolutions without a known force.

    overloads: revolution -> force, and whether it is a lower bound.
    """

    def __init__(self, events: list[Event]) -> None:
        self.overloads: dict[int, tuple[float, bool]] = {}
        changes: list[tuple[int, bool]] = []
        for event in events:
            change, (kind, _, what) = alarm_change(event), event.key.partition(":")
            raised = change is not None and change.what == "raised"
            if event.kind == RESUMED:
                changes.append((event.revolution, True))
            elif raised and kind == NO_FORCE and what:
                changes.append((event.revolution, False))
            elif raised and change is not None and kind == OVERLOAD:
                # Older files have the value only in the text; it then comes from the samples.
                self.overloads[event.revolution + 1] = (
                    change.value or 0.0,
                    event.key == BEYOND_RANGE,
                )
        self._since = np.array([number for number, _ in changes], np.int64)
        self._known = np.array([True, *(known for _, known in changes)])

    def known(self, number: NDArray[np.int64], quality: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return whether the forces of revolutions are known, from their quality flags."""
        state = self._known[np.searchsorted(self._since, number, side="left")]
        return np.asarray(state | ((quality & Flag.SATURATED) == 0))

    def knows_force(self, part: StoredCycle) -> bool:
        """Return whether the force of a revolution is known, and has samples."""
        number, quality = (np.array([value], np.int64) for value in (part.revolution, part.quality))
        force = part.columns["force"]
        return bool(self.known(number, quality)[0] and np.isfinite(force).any())


def _of_rows(test: TestReader, log: _ForceLog) -> Iterator[LargestForce]:
    names = ("revolution", "quality", "force_max", "force_angle_of_max")
    forces: list[LargestForce] = []
    most: LargestForce | None = None
    overloads = np.array(list(log.overloads), np.int64)
    for _, block in blocks(test, names):
        number = block["revolution"].astype(np.int64)
        known = log.known(number, block["quality"].astype(np.int64))
        force = np.where(known, block["force_max"], np.nan)

        def at(row: int, force: Any = force, block: Any = block) -> LargestForce:
            angle = float(block["force_angle_of_max"][row])
            return LargestForce(float(force[row]), int(block["revolution"][row]), angle)

        forces += map(at, np.flatnonzero(np.isin(number, overloads)).tolist())
        if np.isfinite(force).any():
            largest = at(int(np.nanargmax(force)))
            most = largest if most is None or largest.value_N > most.value_N else most
    if most is not None and most.revolution not in {largest.revolution for largest in forces}:
        forces.append(most)
    yield from sorted(forces, key=lambda largest: largest.revolution)


def _of_part(part: StoredCycle) -> LargestForce:
    force = part.columns["force"]
    index = int(np.nanargmax(force))
    angle = float(part.columns["angle"][index])
    return LargestForce(float(force[index]), part.revolution, angle, complete=False)


def plausible_until(reader: TestReader) -> int | None:
    """Return the last revolution whose measured wear depth is plausible, None where all are.

    The alarm comes some revolutions late, since the twin lags: depths nearer to that of the alarm
    than to the last plausible one are not plausible.
    """
    for event in reader.events():
        change = alarm_change(event)
        if change is None or change.what != "raised" or event.key not in UNBELIEVED:
            continue
        return _last_plausible(reader, event.revolution, change.value)
    return None


def _last_plausible(reader: TestReader, revolution: int, value_um: float | None) -> int:
    """Return the last revolution whose depth is nearer to the newest one than to ``value_um``."""
    if value_um is None:
        return 0
    last: float | None = None
    rows, names = rows_up_to(reader, revolution, "prediction"), ("revolution", DEPTH)
    for _, block in blocks(reader, names, "prediction", stop=rows, backwards=True):
        depth = 1e3 * block[DEPTH]
        known = np.flatnonzero(np.isfinite(depth))
        if not known.size:
            continue
        last = float(depth[known[-1]]) if last is None else last
        near = np.abs(depth[known] - value_um) <= np.abs(depth[known] - last)
        if near.any():
            return int(block["revolution"][known[near][-1]])
    return 0
