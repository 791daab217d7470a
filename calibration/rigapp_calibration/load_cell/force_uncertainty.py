"""Expanded uncertainty of a measured force: of a sample, a mean, a component, of |F|.

The calibration states U(F) = constant + relative |F| for all parts that do not average out: scale,
angle reference, fit, hysteresis, zero, and what changes in use. It is that of one component in its
worst direction; that of |F|, whose error is the component along F, has its own two numbers where
the calibration states them (an error of the angle turns F and leaves |F|). |F| is the magnitude of
the whole force also for a component. A single sample has its noise in addition:

    U = sqrt((constant + relative |F|)^2 + (coverage factor noise)^2 / n)

of a mean of n samples, n = 1 of one. The straight line bounds U from above; where the calibration
states U at each load, along the force and across it, that is taken between the loads, and holds the
truth in 95 of 100. Older records state U of a reading, its scatter included.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.coverage import COVERAGE, NORMAL_FACTOR
from rigapp_calibration.records import RecordError, unseal

RIG_FILE_FACTOR = 2.0
"""Coverage factor of ``load_cell.uncertainty_N`` of a rig file."""

LARGEST_SHARE = 0.05
"""Part of full scale. An uncalibrated cell, read by the sensitivity of its data sheet, is wrong by
its cross-talk, up to 5 %; a calibration that states more is worse than none."""

BY_LOAD = ("by_load_N", "by_load_along_N", "by_load_across_N")
SHARES_OF_FULL_SCALE = (0.0, 0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True, slots=True)
class ForceUncertainty:
    """The expanded uncertainty of one force.

    noise_N: standard deviation of one sample of one component, 0 where it is not known; ``source``
    says who states the rest. magnitude: constant (N) and relative part of |F|, None where they are
    not stated: those of a component hold. by_load: loads (N) from 0 up, and U at each of them along
    the force (that of |F|) and across it; empty where it is not stated.
    """

    constant_N: float
    relative: float
    coverage_factor: float
    source: str
    noise_N: float = 0.0
    magnitude: tuple[float, float] | None = None
    by_load: tuple[tuple[float, ...], ...] = ()

    def at(
        self,
        force: ArrayLike,
        samples: ArrayLike = 1,
        *,
        of_magnitude: bool = False,
        component: ArrayLike | None = None,
    ) -> Array:
        """Return the expanded uncertainty of components, N, each a mean of several samples.

        force: magnitudes of the whole force. of_magnitude: of |F| instead. component: of components
        of this size, N; else of one in its worst direction.
        """
        size = np.abs(np.asarray(force, dtype=np.float64))
        stated = self._stated(size, of_magnitude=of_magnitude, component=component)
        random = (
            self.coverage_factor * self.noise_N / np.sqrt(np.asarray(samples, dtype=np.float64))
        )
        return np.asarray(np.hypot(stated, random), np.float64)

    def _stated(self, size: Array, *, of_magnitude: bool, component: ArrayLike | None) -> Array:
        """Return the part that does not average out."""
        own = self.magnitude if of_magnitude else None
        constant, relative = own or (self.constant_N, self.relative)
        line = constant + relative * size
        if not self.by_load:
            return line
        loads, *both = map(np.asarray, self.by_load)
        along, across = (np.interp(size, loads, one) for one in both)
        if of_magnitude:
            combined = along
        elif component is None:
            combined = np.maximum(along, across)
        else:
            cosine = np.clip(np.abs(component) / np.maximum(size, 1e-300), 0.0, 1.0)
            combined = np.hypot(along * cosine, across * np.sqrt(1.0 - cosine**2))
        return np.asarray(np.where(size <= loads[-1], combined, line), np.float64)

    @property
    def words(self) -> str:
        """Return the line as printed."""
        line = f"{self.constant_N:.2f} N + {self.relative:.5f} |F|"
        noise = (
            say(", one sample besides ± {:.2f} N", self.coverage_factor * self.noise_N)
            if self.noise_N
            else ""
        )
        return f"U(F) = {line}, k = {self.coverage_factor:.2f} ({self.source}){noise}"


def force_uncertainty(
    calibration: Mapping[str, Any], configuration: Mapping[str, Any]
) -> ForceUncertainty | None:
    """Return the uncertainty that a file states, or None.

    By its numbers; in older files by the calibration record of the load cell, else by
    ``uncertainty_N`` of the rig file.
    """
    stored = calibration.get("force_uncertainty")
    if isinstance(stored, Mapping):
        return _of_numbers(stored)
    kept = calibration.get("record_load_cell")
    text = kept.get("record", "") if isinstance(kept, Mapping) else ""
    return stated_uncertainty(str(text), _line_of_rig(str(configuration.get("rig", ""))))


def stated_uncertainty(record: str, line: tuple[float, float] | None) -> ForceUncertainty | None:
    """Return the uncertainty of a sealed record, else the line of the rig file, else None."""
    candidate = _of_record(record)
    if candidate is None and line is not None:
        candidate = ForceUncertainty(line[0], line[1], RIG_FILE_FACTOR, say("rig file"))
    return _known(candidate)


def too_uncertain(expanded_N: float, full_scale_N: float) -> str:
    """Return why an expanded uncertainty at full scale is unacceptable, empty if acceptable."""
    if expanded_N <= LARGEST_SHARE * full_scale_N:
        return ""
    return say(
        "states an uncertainty of {:.3g} N at {:g} N, more than the {:.0f} % by which a"
        " cell without calibration may be wrong",
        expanded_N,
        full_scale_N,
        100.0 * LARGEST_SHARE,
    )


def noise_of_sample(
    matrix: Array, noise: tuple[float, float] | None, resolution_N: float
) -> tuple[float, str]:
    """Return the standard deviation (N) of one sample of a component, and its source.

    matrix: (2, 2) N per signal unit. noise: standard deviations of the signals at rest, None when
    they are not known. Steps not dithered by noise are invisible at rest: they count as resolution.
    """
    steps = resolution_N / math.sqrt(12.0)
    if noise is not None and all(map(math.isfinite, noise)):
        seen = float(np.sqrt((matrix**2 @ np.square(noise)).max()))
        if seen > steps:
            return seen, say("signals at rest before the start")
    return steps, say("resolution of the load cell")


def uncertainty_record(
    stated: ForceUncertainty | None, noise_N: float, noise_from: str, full_scale_N: float
) -> dict[str, Any]:
    """Return the group of the file, units in the keys; NaN where nothing is stated."""
    nothing = ForceUncertainty(
        math.nan, math.nan, RIG_FILE_FACTOR, say("not stated: calibrate the load cell")
    )
    known = replace(stated or nothing, noise_N=noise_N)
    of_magnitude = known.magnitude or (known.constant_N, known.relative)
    forces = full_scale_N * np.array(SHARES_OF_FULL_SCALE)
    return {
        "description": say(
            "expanded uncertainty U of a measured force, of one component as of |F|, that"
            " is a mean of n samples (n = 1: one sample): U = sqrt((constant_N + relative"
            " |F|)^2 + (coverage_factor noise_N)^2 / n); of |F| with magnitude_constant_N"
            " and magnitude_relative it is as small as a line may state it. These lines"
            " bound U; by_load_along_N (that of |F|) and by_load_across_N are U of a mean"
            " of many at the loads by_load_N, linear between them, where the calibration"
            " states it. |F|: magnitude of the whole force, also for a component; for the"
            " largest of a revolution force_max, for a mean or RMS force_rms"
        ),
        "source": known.source,
        "coverage_factor": known.coverage_factor,
        "coverage_probability": COVERAGE,
        "constant_N": known.constant_N,
        "relative": known.relative,
        "magnitude_constant_N": of_magnitude[0],
        "magnitude_relative": of_magnitude[1],
        **dict(zip(BY_LOAD, map(list, known.by_load), strict=False)),
        "noise_N": noise_N,
        "noise_from": noise_from,
        "force_N": forces.tolist(),
        "one_sample_N": known.at(forces).tolist(),
        "mean_of_many_N": known.at(forces, math.inf).tolist(),
        "not_included": say(
            "drift of the zero during the test and temperature beyond what the calibration"
            " states, response of filter and cell to fast changes; the largest of n samples"
            " reads high by their noise, about noise_N sqrt(2 ln n), and so does |F| where"
            " it is not larger than its uncertainty; the samples of a mean count as"
            " independent"
        ),
    }


def _of_numbers(stored: Mapping[str, Any]) -> ForceUncertainty | None:
    try:
        return _known(
            ForceUncertainty(
                float(stored["constant_N"]),
                float(stored["relative"]),
                float(stored["coverage_factor"]),
                str(stored["source"]),
                float(stored["noise_N"]),
                _magnitude(stored),
                _by_load([stored[name] for name in BY_LOAD if name in stored]),
            )
        )
    except (KeyError, TypeError, ValueError):
        return None


def _line_of_rig(text: str) -> tuple[float, float] | None:
    try:
        constant, share = tomllib.loads(text)["load_cell"]["uncertainty_N"]
        return float(constant), float(share)
    except (tomllib.TOMLDecodeError, KeyError, TypeError, ValueError):
        return None


def _of_record(text: str) -> ForceUncertainty | None:
    try:
        record = unseal(text.encode())
        result = record.content["result"]
        source = say("record {}", record.number)
        lines = result.get("uncertainty_lines_of_mean_N")
        if lines is None:
            line, factor = result["uncertainty_line_N"], float(result["coverage_factor"])
            return ForceUncertainty(*_line(line), factor, source)
        return ForceUncertainty(
            *_line(lines["component"]),
            NORMAL_FACTOR,
            source,
            magnitude=_line(lines["magnitude"]),
            by_load=_by_load(
                [
                    [one[key] for one in result.get("uncertainty_by_load", ())]
                    for key in ("load_N", "magnitude_mean_of_many_N", "across_mean_of_many_N")
                ]
            ),
        )
    except (RecordError, KeyError, TypeError, ValueError):
        return None


def _line(line: Mapping[str, Any]) -> tuple[float, float]:
    return float(line["constant_N"]), float(line["per_N"])


def _by_load(columns: Sequence[Sequence[float]]) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(map(float, one)) for one in columns if len(one))


def _magnitude(stored: Mapping[str, Any]) -> tuple[float, float] | None:
    if "magnitude_constant_N" not in stored:
        return None
    magnitude = float(stored["magnitude_constant_N"]), float(stored["magnitude_relative"])
    component = float(stored["constant_N"]), float(stored["relative"])
    return None if magnitude == component else magnitude


def _known(candidate: ForceUncertainty | None) -> ForceUncertainty | None:
    """Return an uncertainty with finite numbers, else None."""
    if candidate is None:
        return None
    stated = (candidate.constant_N, candidate.relative, candidate.coverage_factor)
    return candidate if np.isfinite(stated).all() else None
