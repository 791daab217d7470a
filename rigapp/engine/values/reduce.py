"""Reduction of a revolution to its statistics: one compiled pass from raw samples to the row.

One kernel for the load cell, whose forces follow from two inputs, and one for the other inputs:
latency shift, calibration, |F|, extremes and moments are fused, so that the samples are read from
memory once. Sums are in independent lanes, so that the compiler can use vector instructions without
reordering floating-point arithmetic (no fastmath).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.assembler import STANDSTILL_S, Revolution
from rigapp.engine.values.calibrate import Calibration, Measured, with_margins
from rigapp.engine.values.corrections import follow, linearise_rows
from rigapp.schema.channels import LOAD_CELL, STATISTICS
from rigapp_model.compiled import njit

Array = NDArray[np.float64]

SPEED_WINDOWS = 36
"""Windows per revolution; local speed is the slope of a straight line fitted to each."""

LEAST_SAMPLES = 8
"""Fewest samples of a window; with fewer the quantisation of the counts affects the slope."""

LANES = 64
"""Independent sums of a curve, a power of two, for vector code: twice as fast as four sums. Fixed,
so that a row has the same bits on all computers."""

_FORCES = (
    "void({0}[::1], {0}[::1], int64, int64[::1], float64[::1], float64[:, ::1], float64[::1],"
    " float64[:, ::1], float64[:, ::1], int64[::1], int64[:, ::1], float64, float64,"
    " float64[:, ::1], float64[:, ::1], int64, float64[::1], float64[::1])"
)
_SINGLE = (
    "void({0}[::1], int64, float64, float64, float64, float64[:, ::1], int64[::1], float64,"
    " float64, float64[::1], float64[:, ::1], int64, float64[::1])"
)


@njit("int64(float64[::1], int64, float64)", cache=True, nogil=True, inline="never")
def _first(x: Array, n: int, value: float) -> int:
    """Return the first index of a value in x[:n], 0 without one."""
    for i in range(0, n, LANES):
        part = x[i : min(i + LANES, n)]
        hits = 0
        for j in range(part.shape[0]):  # without break, which would prevent vector code
            hits += part[j] == value
        if hits > 0:
            for j in range(part.shape[0]):
                if part[j] == value:
                    return i + j
    return 0


@njit(
    "void(float64[::1], int64, int64[::1], float64, float64, float64[:, ::1], float64[::1])",
    cache=True,
    nogil=True,
    inline="never",
    error_model="numpy",
)
def _extremes_and_moments(
    x: Array,
    n: int,
    counts: NDArray[np.int64],
    pitch_deg: float,
    index_deg: float,
    lanes: Array,
    out: Array,
) -> None:
    """Write max, min, RMS, mean and the crank angle of the first maximum of x[:n] to out[:5].

    pitch_deg: of one count; index_deg: angle at count 0. lanes: (4, LANES), overwritten.
    """
    sums, squares, highest, lowest = lanes[0], lanes[1], lanes[2], lanes[3]
    for j in range(LANES):
        sums[j] = squares[j] = 0.0
        highest[j], lowest[j] = -np.inf, np.inf
    for i in range(0, n, LANES):
        # Slices and counted loops from 0 are vectorised.
        part = x[i : min(i + LANES, n)]
        for j in range(part.shape[0]):
            v = part[j]
            sums[j] += v
            squares[j] += v * v
            # NaN fails both comparisons.
            highest[j] = v if v > highest[j] else highest[j]
            lowest[j] = v if v < lowest[j] else lowest[j]
    half = LANES // 2
    while half > 0:
        for j in range(half):
            sums[j] += sums[j + half]
            squares[j] += squares[j + half]
            highest[j] = max(highest[j], highest[j + half])
            lowest[j] = min(lowest[j], lowest[j + half])
        half //= 2
    total, square, largest, smallest = sums[0], squares[0], highest[0], lowest[0]
    if largest < smallest:  # all samples are NaN
        largest = smallest = np.nan
    out[0] = largest
    out[1] = smallest
    out[2] = math.sqrt(square / n)
    out[3] = total / n
    out[4] = (counts[_first(x, n, largest)] * pitch_deg + index_deg) % 360.0


@njit("void(int64[::1], int64[:, ::1], float64[::1])", cache=True, nogil=True)
def _local_speed(counts: NDArray[np.int64], segments: NDArray[np.int64], out: Array) -> None:
    """Write max, min and RMS of the local slope in counts per sample to out[:3].

    The slope is fitted by least squares over 1/SPEED_WINDOWS of a revolution, at least
    LEAST_SAMPLES, not across a break, so that the quantisation of the counts has no effect.
    """
    n = counts.shape[0]
    window = max(LEAST_SAMPLES, n // SPEED_WINDOWS)
    highest, lowest, squares, weight = -np.inf, np.inf, 0.0, 0
    for k in range(segments.shape[0]):
        begin = segments[k, 0]
        end = segments[k + 1, 0] if k + 1 < segments.shape[0] else n
        while end - begin >= 2:
            size = end - begin if end - begin < 2 * window else window
            middle = 0.5 * (size - 1)
            part = counts[begin : begin + size]  # from 0, so that the loop is vectorised
            total, moment = 0, 0  # integers, so that the sums are exact in any order
            for i in range(size):
                height = part[i] - part[0]
                total += height
                moment += i * height
            slope = (moment - middle * total) / (size * (size * size - 1.0) / 12.0)
            highest = max(highest, slope)
            lowest = min(lowest, slope)
            squares += slope * slope * size
            weight += size
            begin += size
    if weight == 0:
        highest = lowest = squares = np.nan
        weight = 1
    out[0] = highest
    out[1] = lowest
    out[2] = math.sqrt(squares / weight)


def _forces(
    raw_1: Array,
    raw_2: Array,
    before: int,
    start: NDArray[np.int64],
    part: Array,
    gain: Array,
    bias: Array,
    quadratic_terms: Array,
    own: Array,
    counts: NDArray[np.int64],
    segments: NDArray[np.int64],
    pitch_deg: float,
    index_deg: float,
    scratch: Array,
    lanes: Array,
    column: int,
    row: Array,
    speed: Array,
) -> None:
    """Write the statistics of both forces and of |F| from row[column] on, and the speed."""
    n = counts.shape[0]
    g11, g12, g21, g22 = gain[0, 0], gain[0, 1], gain[1, 0], gain[1, 1]
    c1, c2 = bias[0], bias[1]
    first, second, total = scratch[0], scratch[1], scratch[2]
    p1, p2 = part[0], part[1]
    s1, s2 = start[0] + before, start[1] + before
    a, b = raw_1[s1:], raw_2[s2:]
    if p1 == 0.0 and p2 == 0.0:
        for i in range(n):
            u, v = float(a[i]), float(b[i])
            x = g11 * u + g12 * v + c1
            y = g21 * u + g22 * v + c2
            first[i] = x
            second[i] = y
            total[i] = math.sqrt(x * x + y * y)
    else:
        w1, w2 = 1.0 - p1, 1.0 - p2
        e1, e2 = 1 if p1 > 0 else 0, 1 if p2 > 0 else 0
        a_next, b_next = raw_1[s1 + e1 :], raw_2[s2 + e2 :]
        for i in range(n):
            u = w1 * a[i] + p1 * a_next[i]
            v = w2 * b[i] + p2 * b_next[i]
            x = g11 * u + g12 * v + c1
            y = g21 * u + g22 * v + c2
            first[i] = x
            second[i] = y
            total[i] = math.sqrt(x * x + y * y)
    curved = False
    for j in range(3):
        curved = curved or quadratic_terms[0, j] != 0.0 or quadratic_terms[1, j] != 0.0
    if curved:
        linearise_rows(first, second, total, n, quadratic_terms)
    turn = own.shape[1]
    if turn > 0:
        for i in range(n):
            k = counts[i] % turn
            x = first[i] + own[0, k]
            y = second[i] + own[1, k]
            first[i] = x
            second[i] = y
            total[i] = math.sqrt(x * x + y * y)
    for values in (first, second, total):
        _extremes_and_moments(
            values, n, counts, pitch_deg, index_deg, lanes, row[column : column + 5]
        )
        column += 5
    _local_speed(counts, segments, speed)


def _single(
    raw: Array,
    start: int,
    part: float,
    gain: float,
    bias: float,
    table: Array,
    counts: NDArray[np.int64],
    pitch_deg: float,
    index_deg: float,
    scratch: Array,
    lanes: Array,
    column: int,
    row: Array,
) -> None:
    """Write the statistics of a channel of one input from row[column] on."""
    n = counts.shape[0]
    a = raw[start:]
    if part == 0.0:
        for i in range(n):
            scratch[i] = gain * a[i] + bias
    else:
        weight = 1.0 - part
        following = raw[start + 1 :]
        for i in range(n):
            scratch[i] = gain * (weight * a[i] + part * following[i]) + bias
    follow(scratch, n, table)
    _extremes_and_moments(scratch, n, counts, pitch_deg, index_deg, lanes, row[column : column + 5])


_forces_kernel = njit(
    [_FORCES.format(kind) for kind in ("float32", "int32")], cache=True, nogil=True
)(_forces)
_single_kernel = njit(
    [_SINGLE.format(kind) for kind in ("float32", "int32")], cache=True, nogil=True
)(_single)


@dataclass(frozen=True, slots=True, eq=False)
class _Single:
    """Parameters of a channel of one input; column: of its first statistic in a row."""

    row: int
    delay: int
    part: float
    gain: float
    bias: float
    table: Array
    column: int


class Reducer:
    """Reducer of revolutions to rows in the order of the calibration's table; for one thread."""

    def __init__(self, calibration: Calibration) -> None:
        table = calibration.table
        self.calibration = calibration
        self.table = table
        self._delay, self._part = calibration.shift
        self._margins = calibration.margins
        self._scratch = np.empty((3, 8192))
        self._lanes = np.empty((4, LANES))
        self._speed = np.empty(3)
        self._turn = calibration.encoder.counts_per_revolution
        self._pitch_deg = 360.0 / self._turn
        self._index_deg = math.degrees(calibration.index_angle_rad)
        self._rpm_per_slope = 60.0 * calibration.sample_rate_Hz / self._turn
        pair = calibration.inputs_of(LOAD_CELL)
        self._pair = [calibration.rows[i] for i in pair]
        self._pair_delay, self._pair_part = self._delay[pair], self._part[pair]
        self._gain, self._bias = calibration.force_gain()
        self._first = table.place[f"{table.curves[0].name}_max"]
        self._singles = [
            _Single(
                wire.row,
                int(self._delay[i]),
                float(self._part[i]),
                *line.linear(wire),
                line.table,
                table.place[f"{wire.channel.name}_max"],
            )
            for i, wire in enumerate(calibration.wires)
            if (line := calibration.lines.get(wire.channel.name)) is not None
        ]
        index = table.place
        self._samples, self._lost, self._quality = (
            index[name] for name in ("samples", "lost_samples", "quality")
        )
        self._mean_speed = index["speed"]
        self._speeds = slice(index["speed_max"], index["speed_rms"] + 1)
        self._unknown = np.full(len(table.names), np.nan)

    def reduce(self, measured: Measured) -> Array:
        """Return the row of a revolution: statistics, speed, samples, lost samples and flags.

        The caller adds revolution, time, host_time and slow channels.
        """
        revolution = measured.revolution
        n = revolution.samples
        row = self._unknown.copy()
        row[self._samples] = n
        row[self._lost] = revolution.lost_samples
        row[self._quality] = int(revolution.flags)
        if n == 0:
            return row
        if revolution.ticks is None and self.calibration.probes.correction is None:
            self._from_raw(revolution, row)
        else:
            self._from_calibrated(measured, row)
        turned = revolution.end_count - int(revolution.counts[0])
        elapsed = revolution.end_sample - revolution.first_sample - revolution.idle_samples
        rpm_per_slope = self._rpm_per_slope
        if revolution.ticks is not None:
            self._speed[:] = _speed_by_time(revolution)
            rpm_per_slope = 60.0 * revolution.sample_rate_Hz / self._turn
        row[self._mean_speed] = turned / max(elapsed, 1) * rpm_per_slope
        row[self._speeds] = self._speed * rpm_per_slope
        return row

    def _from_raw(self, revolution: Revolution, row: Array) -> None:
        """Compute the statistics in one pass from the raw samples, including latency."""
        n = revolution.samples
        if n > self._scratch.shape[1]:
            self._scratch = np.empty((3, 2 * n))
        values, before = with_margins(revolution, self._margins)
        counts, scratch, first = revolution.counts, self._scratch, self._scratch[0]
        _forces_kernel(
            values[self._pair[0]],
            values[self._pair[1]],
            before,
            self._pair_delay,
            self._pair_part,
            self._gain,
            self._bias,
            self.calibration.load_cell.quadratic_terms,
            self.calibration.own_weight,
            counts,
            revolution.segments,
            self._pitch_deg,
            self._index_deg,
            scratch,
            self._lanes,
            self._first,
            row,
            self._speed,
        )
        for single in self._singles:
            _single_kernel(
                values[single.row],
                before + single.delay,
                single.part,
                single.gain,
                single.bias,
                single.table,
                counts,
                self._pitch_deg,
                self._index_deg,
                first,
                self._lanes,
                single.column,
                row,
            )

    def _from_calibrated(self, measured: Measured, row: Array) -> None:
        """Compute the statistics for samples at irregular times, or with corrected probes."""
        revolution, values = measured.revolution, measured.calibrated
        _local_speed(revolution.counts, revolution.segments, self._speed)
        for channel in self.table.curves:
            first = self.table.place[f"{channel.name}_max"]
            curve = np.ascontiguousarray(values[channel.name])
            out = row[first : first + len(STATISTICS)]
            _extremes_and_moments(
                curve,
                revolution.samples,
                revolution.counts,
                self._pitch_deg,
                self._index_deg,
                self._lanes,
                out,
            )


def _speed_by_time(revolution: Revolution) -> tuple[float, float, float]:
    """Return max, min and RMS over time of the speed in counts per tick, for samples at pulses.

    Over windows of 1/SPEED_WINDOWS of a revolution, at least LEAST_SAMPLES pulses; a standstill
    within one is idle time, and not included in the speed.
    """
    ticks = np.append(revolution.sample_indices(), revolution.end_sample)
    counts = np.append(revolution.counts, revolution.end_count)
    window = max(LEAST_SAMPLES, revolution.samples // SPEED_WINDOWS)
    bounds = np.unique(np.append(np.arange(0, revolution.samples, window), revolution.samples))
    longest = round(STANDSTILL_S * revolution.sample_rate_Hz)
    idle = np.append(0, np.cumsum(np.maximum(np.diff(ticks) - longest, 0)))
    elapsed = np.maximum(np.diff((ticks - idle)[bounds]), 1)
    speed = np.diff(counts[bounds]) / elapsed
    squares = float((speed**2 * elapsed).sum() / elapsed.sum())
    return float(speed.max()), float(speed.min()), math.sqrt(squares)
