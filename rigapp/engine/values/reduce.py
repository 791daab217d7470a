"""Reduce a revolution to its statistics: one compiled pass from raw samples to the stored row.

Latency shift, calibration, |F|, extremes, moments and speed are fused, so that the samples are read
from memory once. Sums run in ``LANES`` independent lanes, which lets the compiler use vector
instructions without being allowed to reorder floating-point arithmetic (fastmath stays off).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from model.compiled import njit
from rigapp.engine.samples.assembler import STANDSTILL_S, Revolution
from rigapp.engine.values.bend import straighten
from rigapp.engine.values.calibrate import Calibration, shifted, with_margins
from rigapp.engine.values.probes import ProbeCorrection
from rigapp.schema.columns import CHANNELS, STATISTICS, revolution_columns

Array = NDArray[np.float64]

HEAD = len(revolution_columns()) - len(CHANNELS) * len(STATISTICS)
"""Columns of a row before the first statistic of a channel."""

NAMES = tuple(column.name for column in revolution_columns())
PLACE = {name: place for place, name in enumerate(NAMES)}
"""Column name -> place in a row."""

PROBE_STATISTICS = CHANNELS.index("probe_1") * len(STATISTICS)
"""Place of the first probe's statistics among all."""

SPEED_WINDOWS = 36
"""Local speed is the slope of a straight line fitted to this part of a revolution."""

_SIGNATURE = (
    "void({0}[::1], {0}[::1], {0}[::1], {0}[::1], int64[::1], float64[::1], float64[:, ::1],"
    " float64[::1], float64[:, ::1], int64[::1], int64[:, ::1], float64[:, ::1], float64[::1],"
    " float64[::1])"
)


@njit("void(float64[::1], int64, int64[::1], float64[::1])", cache=True, nogil=True, inline="never")
def _extremes_and_moments(x: Array, n: int, counts: NDArray[np.int64], out: Array) -> None:
    """Write max, min, RMS, mean and the count at the first maximum of x[:n] to out[:5]."""
    s0 = s1 = s2 = s3 = 0.0
    q0 = q1 = q2 = q3 = 0.0
    a0 = a1 = a2 = a3 = x[0]
    b0 = b1 = b2 = b3 = x[0]
    whole = n - n % 4
    for i in range(0, whole, 4):
        v0, v1, v2, v3 = x[i], x[i + 1], x[i + 2], x[i + 3]
        s0 += v0
        s1 += v1
        s2 += v2
        s3 += v3
        q0 += v0 * v0
        q1 += v1 * v1
        q2 += v2 * v2
        q3 += v3 * v3
        a0 = v0 if v0 > a0 else a0
        a1 = v1 if v1 > a1 else a1
        a2 = v2 if v2 > a2 else a2
        a3 = v3 if v3 > a3 else a3
        b0 = v0 if v0 < b0 else b0
        b1 = v1 if v1 < b1 else b1
        b2 = v2 if v2 < b2 else b2
        b3 = v3 if v3 < b3 else b3
    for i in range(whole, n):
        v0 = x[i]
        s0 += v0
        q0 += v0 * v0
        a0 = v0 if v0 > a0 else a0
        b0 = v0 if v0 < b0 else b0
    largest = max(max(a0, a1), max(a2, a3))
    place = 0
    for i in range(n):
        if x[i] == largest:
            place = i
            break
    out[0] = largest
    out[1] = min(min(b0, b1), min(b2, b3))
    out[2] = math.sqrt(((q0 + q1) + (q2 + q3)) / n)
    out[3] = ((s0 + s1) + (s2 + s3)) / n
    out[4] = counts[place]


def _reduce(
    raw_1: Array,
    raw_2: Array,
    raw_3: Array,
    raw_4: Array,
    start: NDArray[np.int64],
    part: Array,
    gain: Array,
    bias: Array,
    bend: Array,
    counts: NDArray[np.int64],
    segments: NDArray[np.int64],
    scratch: Array,
    speed: Array,
    out: Array,
) -> None:
    n = counts.shape[0]
    g11, g12, g21, g22 = gain[0, 0], gain[0, 1], gain[1, 0], gain[1, 1]
    c1, c2 = bias[0], bias[1]
    first, second, total = scratch[0], scratch[1], scratch[2]
    p1, p2 = part[0], part[1]
    a, b = raw_1[start[0] :], raw_2[start[1] :]
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
        a_next, b_next = raw_1[start[0] + e1 :], raw_2[start[1] + e2 :]
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
        curved = curved or bend[0, j] != 0.0 or bend[1, j] != 0.0
    if curved:
        straighten(first, second, total, n, bend)
    _extremes_and_moments(first, n, counts, out[0:5])
    _extremes_and_moments(second, n, counts, out[5:10])
    _extremes_and_moments(total, n, counts, out[10:15])
    for k in range(2):
        raw = raw_3 if k == 0 else raw_4
        g, c, p = gain[2 + k, 2 + k], bias[2 + k], part[2 + k]
        a = raw[start[2 + k] :]
        if p == 0.0:
            for i in range(n):
                first[i] = g * a[i] + c
        else:
            w = 1.0 - p
            a_next = raw[start[2 + k] + 1 :]
            for i in range(n):
                first[i] = g * (w * a[i] + p * a_next[i]) + c
        _extremes_and_moments(first, n, counts, out[15 + 5 * k : 20 + 5 * k])
    _local_speed(counts, segments, speed)


@njit("void(int64[::1], int64[:, ::1], float64[::1])", cache=True, nogil=True)
def _local_speed(counts: NDArray[np.int64], segments: NDArray[np.int64], out: Array) -> None:
    """Write max, min and RMS of the local slope in counts per sample to out[:3].

    The slope is fitted by least squares over 1/SPEED_WINDOWS of a revolution, 8 samples at least,
    never across a break: single quantised counts do not show in it.
    """
    n = counts.shape[0]
    window = max(8, n // 36)
    highest, lowest, squares, weight = -np.inf, np.inf, 0.0, 0
    for k in range(segments.shape[0]):
        begin = segments[k, 0]
        end = segments[k + 1, 0] if k + 1 < segments.shape[0] else n
        while end - begin >= 2:
            size = end - begin if end - begin < 2 * window else window
            middle = 0.5 * (size - 1)
            origin = counts[begin]
            total, moment = 0, 0  # whole numbers, so that the sums are exact in any order
            for i in range(size):
                height = counts[begin + i] - origin
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


_reduce_kernel = njit(
    [_SIGNATURE.format("float32"), _SIGNATURE.format("int32")], cache=True, nogil=True
)(_reduce)


class Reducer:
    """Turn revolutions into rows in the order of ``revolution_columns()``; one thread calls it."""

    def __init__(self, calibration: Calibration) -> None:
        self.calibration = calibration
        self._gain, self._bias = calibration.gains()
        self._whole, self._part = calibration.shift
        self._margins = calibration.margins
        self._scratch = np.empty((3, 8192))
        self._statistics = np.empty(len(CHANNELS) * len(STATISTICS))
        self._speed = np.empty(3)
        self._turn = calibration.encoder.counts_per_revolution
        self._deg_per_count = 360.0 / calibration.encoder.counts_per_revolution
        self._rpm_per_slope = (
            60.0 * calibration.sample_rate_Hz / calibration.encoder.counts_per_revolution
        )

    def reduce(self, revolution: Revolution) -> Array:
        """Return the row of a revolution: statistics filled in, the head but for the speed not.

        The caller writes revolution, time and host_time.
        """
        n = revolution.samples
        row = np.full(len(NAMES), np.nan)
        row[PLACE["samples"]] = n
        row[PLACE["lost_samples"]] = revolution.lost_samples
        row[PLACE["quality"]] = int(revolution.flags)
        if n == 0:
            return row
        if n > self._scratch.shape[1]:
            self._scratch = np.empty((3, 2 * n))
        rows, part = self.calibration.rows, self._part
        if revolution.ticks is None:
            values, before = with_margins(revolution, self._margins)
            start = self._whole + before
        else:
            # Shifted by time already; 16 bits and 24 bits are exact in a float32.
            values = shifted(revolution, self.calibration).astype(np.float32)
            rows, start, part = (0, 1, 2, 3), np.zeros(4, np.int64), np.zeros(4)
        _reduce_kernel(
            values[rows[0]],
            values[rows[1]],
            values[rows[2]],
            values[rows[3]],
            start,
            part,
            self._gain,
            self._bias,
            self.calibration.bend,
            revolution.counts,
            revolution.segments,
            self._scratch,
            self._speed,
            self._statistics,
        )
        if self.calibration.correction is not None:
            self._correct_probes(revolution, self.calibration.correction)
        statistics = self._statistics
        index_deg = math.degrees(self.calibration.index_angle_rad)
        statistics[4::5] = (statistics[4::5] * self._deg_per_count + index_deg) % 360.0
        row[HEAD:] = statistics
        turned = revolution.end_count - int(revolution.counts[0])
        elapsed = revolution.end_sample - revolution.first_sample - revolution.idle_samples
        rpm_per_slope = self._rpm_per_slope
        if revolution.ticks is not None:
            self._speed[:] = _speed_by_time(revolution)
            rpm_per_slope = 60.0 * revolution.sample_rate_Hz / self._turn
        row[PLACE["speed"]] = turned / max(elapsed, 1) * rpm_per_slope
        row[PLACE["speed_max"]] = self._speed[0] * rpm_per_slope
        row[PLACE["speed_min"]] = self._speed[1] * rpm_per_slope
        row[PLACE["speed_rms"]] = self._speed[2] * rpm_per_slope
        return row

    def _correct_probes(self, revolution: Revolution, correction: ProbeCorrection) -> None:
        """Replace the probes' statistics by those of the corrected pair."""
        raw = shifted(revolution, self.calibration)[2:]
        gain = np.diag(self._gain)[2:, None]
        pair = correction.apply(revolution.counts, gain * raw + self._bias[2:, None])
        first = PROBE_STATISTICS
        for place, values in zip((first, first + len(STATISTICS)), pair, strict=True):
            out = self._statistics[place : place + len(STATISTICS)]
            row = np.ascontiguousarray(values)
            _extremes_and_moments(row, revolution.samples, revolution.counts, out)


def _speed_by_time(revolution: Revolution) -> tuple[float, float, float]:
    """Return max, min and RMS over time of the speed in counts per tick, of samples at pulses.

    The speed is that over 1/SPEED_WINDOWS of a revolution, 8 pulses at least; a stand within one
    counts as idle, not as slowness.
    """
    ticks = np.append(revolution.sample_indices(), revolution.end_sample)
    counts = np.append(revolution.counts, revolution.end_count)
    window = max(8, revolution.samples // SPEED_WINDOWS)
    places = np.unique(np.append(np.arange(0, revolution.samples, window), revolution.samples))
    longest = round(STANDSTILL_S * revolution.sample_rate_Hz)
    idle = np.append(0, np.cumsum(np.maximum(np.diff(ticks) - longest, 0)))
    elapsed = np.maximum(np.diff((ticks - idle)[places]), 1)
    speed = np.diff(counts[places]) / elapsed
    squares = float((speed**2 * elapsed).sum() / elapsed.sum())
    return float(speed.max()), float(speed.min()), math.sqrt(squares)
