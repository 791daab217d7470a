"""Put a cycle on a uniform grid of crank angles, so that cycles can be compared point by point.

The samples in the file stay unchanged; this makes a copy. Angles are those of the file, already
corrected for each channel's latency.

linear: between the two neighbouring samples. It neither overshoots nor adds a peak, and needs no
assumption; with fewer points than samples it is subject to aliasing. band-limited: harmonics of the
revolution up to half the points and no others, by linear interpolation to a grid of four times as
many points as samples or more, and a Fourier transform. It removes what the grid cannot resolve,
and suits spectra and differences; at a step it rings.

A cycle is treated as periodic: the last sample's neighbour is the first. Samples at the same angle
(standstill, reversal) are averaged. Gaps are not interpolated: their points are NaN (linear), or
the cycle is refused (band-limited).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.schema.channels import LOAD_CELL, ChannelTable
from rigapp.texts import say

Array = NDArray[np.float64]
Method = Literal["linear", "band-limited"]

SMALLEST_GAP_DEG = 3.0
"""Minimum distance of two samples with a gap between them ..."""

GAP_SPACINGS = 10.0
"""... and as a multiple of their usual distance."""

OVERSAMPLED = 4  # aliases of the kinks between samples become 16 times weaker


def grid_deg(points: int) -> Array:
    """Return the crank angles of a grid in [0, 360); raises ValueError for fewer than 2 points."""
    if points < 2:
        raise ValueError(say("a grid needs 2 points at least, not {}", points))
    return np.asarray(np.arange(points) * (360.0 / points), np.float64)


def on_grid(
    angle_deg: ArrayLike, values: ArrayLike, points: int, method: Method = "linear"
) -> Array:
    """Return values (..., points) at the crank angles of ``grid_deg``, of one periodic revolution.

    angle_deg: (samples,) any order, any turn. values: (..., samples). Raises ValueError for too few
    samples, an unknown method, or a gap that a band-limited curve cannot have.
    """
    grid = grid_deg(points)
    angle, rows = _in_order(angle_deg, values)
    if method == "linear":
        out = _linear(angle, rows, grid)
    elif method == "band-limited":
        out = _band_limited(angle, rows, points)
    else:
        raise ValueError(say("method {} is not linear or band-limited", repr(method)))
    return out.reshape((*np.shape(values)[:-1], points))


def resample_channels(
    columns: Mapping[str, ArrayLike], table: ChannelTable, points: int, method: Method
) -> dict[str, Array]:
    """Return the angle and the channels of a cycle on a grid; ``force`` is computed anew."""
    names = [channel.name for channel in table.sampled]
    rows = on_grid(columns["angle"], np.array([columns[name] for name in names]), points, method)
    result = dict(zip(names, rows, strict=True))
    result["force"] = np.hypot(*(result[name] for name in table.names_of(LOAD_CELL)))
    return {"angle": grid_deg(points), **{curve.name: result[curve.name] for curve in table.curves}}


def _in_order(angle_deg: ArrayLike, values: ArrayLike) -> tuple[Array, Array]:
    """Return the sorted unique angles in [0, 360), and the mean values (rows, angles)."""
    turned = np.mod(np.asarray(angle_deg, np.float64), 360.0)
    rows = np.asarray(values, np.float64).reshape(-1, turned.size)
    angle, group, number = np.unique(turned, return_inverse=True, return_counts=True)
    if angle.size < 2:
        raise ValueError(say("a cycle needs samples at two angles at least"))
    if angle.size == turned.size:
        return angle, rows[:, np.argsort(turned)]
    sums = np.array([np.bincount(group, weights=row, minlength=angle.size) for row in rows])
    return angle, sums / number


def _gaps(angle: Array) -> tuple[Array, Array]:
    """Return the start and the length of each gap without samples."""
    spacing = np.diff(angle, append=angle[0] + 360.0)
    wide = spacing > max(SMALLEST_GAP_DEG, GAP_SPACINGS * float(np.median(spacing)))
    return angle[wide], spacing[wide]


def _linear(angle: Array, rows: Array, grid: Array) -> Array:
    around = np.concatenate(([angle[-1] - 360.0], angle, [angle[0] + 360.0]))
    out = np.empty((len(rows), grid.size))
    for i, row in enumerate(rows):
        out[i] = np.interp(grid, around, np.concatenate((row[-1:], row, row[:1])))
    for begin, length in zip(*_gaps(angle), strict=True):
        into = np.mod(grid - begin, 360.0)
        out[:, (into > 0) & (into < length)] = np.nan
    return out


def _band_limited(angle: Array, rows: Array, points: int) -> Array:
    begins, lengths = _gaps(angle)
    if begins.size:
        raise ValueError(
            say(
                "no samples for {:.1f} deg from {:.1f} deg on; a band-limited curve cannot"
                " be made of it",
                lengths[0],
                begins[0],
            )
        )
    fine = points * math.ceil(OVERSAMPLED * max(1.0, angle.size / points))
    spectrum = np.fft.rfft(_linear(angle, rows, grid_deg(fine)), axis=1)
    kept = np.zeros((len(rows), points // 2 + 1), np.complex128)
    most = (points - 1) // 2 + 1
    kept[:, :most] = spectrum[:, :most]
    return np.asarray(np.fft.irfft(kept, points, axis=1) * (points / fine), np.float64)
