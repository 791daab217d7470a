"""Calibrate a capacitance probe from micrometer steps: V = V0 + S d, with its uncertainty."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import GTC
import numpy as np
from numpy.typing import ArrayLike

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.probes.checks import checks, falling, robust_line, unusable
from rigapp_calibration.probes.readings import ProbeReadings, ProbeSettings
from rigapp_calibration.problems import Problem, blocked, refusal
from rigapp_calibration.taking.uncertainty import (
    Budget,
    Contribution,
    at_most,
    combine,
    straight_line,
)

FEWEST_FREE = 4
"""Degrees of freedom of repeated positions: fewer give the noise worse than a curve does."""
KNOTS = 16
"""Points of the range at which its nonlinearity is stated; it is smooth in between."""


@dataclass(frozen=True, slots=True)
class ProbeCalibration:
    """The result: position = sensitivity (voltage - offset), m/V and V; None when refused early.

    linearity: largest residual over the range, best-fit line, per cent. residual_std in m.
    hysteresis: mean difference between falling and rising steps, m. gain: cylinder correction
    included in the sensitivity (1 without). budget: of one position, m.
    """

    accepted: bool
    problems: tuple[Problem, ...]
    sensitivity: float | None = None
    offset: float | None = None
    sensitivity_uncertainty: float | None = None
    linearity: float | None = None
    residual_std: float | None = None
    hysteresis: float | None = None
    gain: float = 1.0
    residual: Array | None = None
    budget: Budget | None = None

    @property
    def expanded(self) -> float | None:
        """Return the expanded uncertainty of one position, m."""
        return None if self.budget is None else self.budget.expanded

    @property
    def expanded_of_mean(self) -> float | None:
        """Return the expanded uncertainty of a mean of many readings of one position, m."""
        return None if self.budget is None else self.budget.of_mean(math.inf).expanded

    @property
    def coverage_factor(self) -> float | None:
        """Return the coverage factor."""
        return None if self.budget is None else self.budget.coverage_factor


def calibrate_probe(readings: ProbeReadings, settings: ProbeSettings) -> ProbeCalibration:
    """Fit, check and evaluate; a calibration with a blocking problem is not accepted."""
    problems = list(unusable(readings, settings))
    if blocked(problems):
        return ProbeCalibration(False, tuple(problems))
    line = robust_line(readings.position, readings.signal)
    if line.slope == 0.0:
        flat = refusal("probe_dead", "The voltage does not change with the position.")
        return ProbeCalibration(False, (flat,))
    return _result(readings, settings, [*problems, *checks(readings, settings, line)])


def _hysteresis(readings: ProbeReadings, residual: Array) -> float | None:
    """Return the mean of falling less rising at common positions, m."""
    rising: dict[float, list[float]] = {}
    falling: dict[float, list[float]] = {}
    last: dict[str, float] = {}
    direction: dict[str, float] = {}
    for name, position, value in zip(readings.series, readings.position, residual, strict=True):
        if name in last and position != last[name]:
            direction[name] = position - last[name]
        last[name] = float(position)
        side = rising if direction.get(name, 1.0) > 0.0 else falling
        side.setdefault(round(float(position), 9), []).append(float(value))
    common = [p for p in set(rising) & set(falling) if p < max(rising)]
    if not common:
        return None
    return float(np.mean([np.mean(falling[p]) - np.mean(rising[p]) for p in common]))


@dataclass(frozen=True, slots=True)
class _Scatter:
    """Components of the residuals of a line, separated so that nothing counts twice; m.

    noise: standard deviation of one reading, with its degrees of freedom. between: of positions,
    beyond their noise and the nonlinearity. nonlinear: deviation from the line by terms of second
    and third degree, at even points of the range. drift: from the first to the last reading. The
    contribution of noise to them is subtracted.
    """

    noise: float
    degrees: float
    between: float
    nonlinear: tuple[float, ...]
    drift: float


def _scatter(readings: ProbeReadings, residual: Array) -> _Scatter:
    """Split residuals (n,) of the straight line into components."""
    count, down = len(residual), falling(readings).astype(np.float64)
    others = np.column_stack((np.linspace(-0.5, 0.5, count), down - down.mean()))
    others = others[:, : 1 if down.min() == down.max() else 2]
    middle = 0.5 * float(readings.position.min() + readings.position.max())
    w = 2.0 * (readings.position - middle) / float(np.ptp(readings.position))
    curve = np.column_stack((np.vander(w, 4, increasing=True), others))
    solution, left, free = _solved(curve, residual)
    variance, between = left / free, 0.0
    steps, position = np.unique(np.round(readings.position, 9), return_inverse=True)
    if count - len(steps) - others.shape[1] >= FEWEST_FREE and len(steps) > 4:
        # Repeated positions separate noise from errors of the positions.
        own = np.column_stack((np.eye(len(steps))[position], others))
        _, inside, inside_free = _solved(own, residual)
        variance = inside / inside_free
        more = (left - inside) / (free - inside_free) - variance
        between, free = max(0.0, more) * len(steps) / count, inside_free
    # Only the part of noise that a straight line leaves can look nonlinear.
    line = np.linalg.qr(curve[:, :2])[0]
    shapes = np.vander(np.linspace(-1.0, 1.0, KNOTS), 4, increasing=True)
    gains = shapes @ np.linalg.pinv(curve)[:4]
    gains = gains - (gains @ line) @ line.T
    curved = shapes @ solution[:4]
    seen = float(curved @ curved)
    by_noise = (variance + between * count / len(steps)) * float(np.sum(gains**2))
    kept = math.sqrt(max(0.0, 1.0 - by_noise / seen)) if seen > 0.0 else 0.0
    return _Scatter(
        math.sqrt(variance), float(free), math.sqrt(between), tuple((kept * curved).tolist()),
        float(solution[4]),
    )  # fmt: skip


def _solved(rows: Array, values: Array) -> tuple[Array, float, int]:
    """Return the least squares solution, its sum of squared residuals, degrees of freedom."""
    solution = np.asarray(np.linalg.lstsq(rows, values, rcond=None)[0], np.float64)
    rest = values - rows @ solution
    return solution, float(rest @ rest), max(1, len(values) - int(rows.shape[1]))


def _result(
    readings: ProbeReadings, settings: ProbeSettings, problems: list[Problem]
) -> ProbeCalibration:
    count = len(readings.position)
    line = straight_line(readings.position, readings.signal)
    intercept, slope = (float(GTC.value(one)) for one in line)
    residual = readings.signal / slope - intercept / slope - readings.position
    std = math.sqrt(float(np.sum(residual**2)) / (count - 2))
    span = float(np.ptp(readings.position))
    gain, curvature = _cylinder(readings, settings)
    relative = abs(float(GTC.uncertainty(line[1]) / slope))
    away = np.array([readings.position.min(), readings.position.max()])
    at_ends = [float(GTC.uncertainty(line[0] + line[1] * end)) for end in away]
    hysteresis = _hysteresis(readings, residual)
    parts, screw = _scatter(readings, residual), settings.micrometer_uncertainty
    lines = (
        Contribution("repeatability", parts.noise, parts.degrees, "A", averages=True),
        Contribution(
            say("line, at the end of its range"),
            max(at_ends) / abs(slope),
            float(count - 2),
            "A",
        ),
        Contribution(
            say("bend of the line, second and third degree"),
            math.sqrt(float(np.mean(np.square(parts.nonlinear)))),
            evaluation="A",
            distribution="two-point",
            points=parts.nonlinear,
        ),
        Contribution("micrometer", screw),
        # The micrometer's own errors make positions differ as well.
        Contribution(
            say("differences between positions beyond those of the micrometer"),
            math.sqrt(max(0.0, parts.between**2 - screw**2)),
            parts.degrees,
            "A",
        ),
        at_most(say("drift during the calibration"), 0.5 * abs(parts.drift), "A"),
        at_most("resolution", 0.5 * settings.resolution_volts / abs(slope)),
        Contribution("backlash", abs(hysteresis or 0.0) / 2.0, math.inf, "A", "two-point"),
        at_most(say("cylindrical target, change of sensitivity"), curvature),
        at_most(say("motion across the axis"), _off_axis(settings)),
        at_most(say("direction of the probe"), settings.direction * settings.off_axis),
    )
    return ProbeCalibration(
        accepted=not blocked(problems),
        problems=tuple(problems),
        sensitivity=float(1.0 / (slope * gain)),
        offset=float(intercept),
        sensitivity_uncertainty=relative,
        linearity=float(100.0 * np.max(np.abs(residual)) / span),
        residual_std=std,
        hysteresis=hysteresis,
        gain=gain,
        residual=residual,
        budget=combine(0.0, lines),
    )


def _cylinder(readings: ProbeReadings, settings: ProbeSettings) -> tuple[float, float]:
    """Return the gain at the middle of the range and the effect of its change over the range, m."""
    if not (settings.target_radius and settings.sensor_radius and settings.gap_at_zero):
        return 1.0, 0.0
    sensor, target = settings.sensor_radius, settings.target_radius
    gap = settings.gap_at_zero + np.unique(readings.position)
    middle = settings.gap_at_zero + float(np.mean(readings.position))
    gain = float(sensitivity_gain(middle, sensor, target))
    straight = apparent_gap(middle, sensor, target) + gain * (gap - middle)
    curvature = np.abs(apparent_gap(gap, sensor, target) - straight).max() / gain
    return gain, float(curvature)


def _off_axis(settings: ProbeSettings) -> float:
    """Return the reading by motion across a cylindrical pin's axis, y^2 / (2 R), m."""
    if not settings.target_radius:
        return 0.0
    return settings.off_axis**2 / (2.0 * settings.target_radius)


def apparent_gap(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return the gap that a flat-target calibration reads when the target is a cylinder, m."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(0.5 * d * (1.0 + np.sqrt(1.0 + q)), dtype=np.float64)


def sensitivity_gain(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return d(apparent gap)/d(gap): the factor of the sensitivity by a cylindrical target."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(0.5 * (1.0 + (1.0 + 0.5 * q) / np.sqrt(1.0 + q)), dtype=np.float64)


LARGEST_ANGLE = math.radians(15.0)
"""A probe mounted by eye is within five degrees; three times that is a mistake."""


@dataclass(frozen=True, slots=True, eq=False)
class Alignment:
    """Orientation of the probes, rad; each with its standard uncertainty.

    angle (2,): of probe 1 against e2 and of probe 2 against n2, positive from e2 towards n2.
    orthogonality: angle between the probes less 90 degrees. matrix (2, 2): position of the pin in
    (e2, n2) from the two calibrated probes; matrix_uncertainty (2, 2).
    """

    angle: Array
    angle_uncertainty: Array
    orthogonality: float
    orthogonality_uncertainty: float
    matrix: Array
    matrix_uncertainty: Array


@dataclass(frozen=True, slots=True, eq=False)
class PairCalibration:
    """Both probes and their alignment; alignment is None while a probe is refused."""

    probes: tuple[ProbeCalibration, ProbeCalibration]
    alignment: Alignment | None
    problems: tuple[Problem, ...]

    @property
    def accepted(self) -> bool:
        """Return whether nothing blocks the pair."""
        return self.alignment is not None and not blocked(self.problems)


def calibrate_pair(
    readings: tuple[ProbeReadings, ProbeReadings], settings: tuple[ProbeSettings, ProbeSettings]
) -> PairCalibration:
    """Calibrate both probes and find their alignment; the problems name the probe."""
    one, two = (
        calibrate_probe(taken, given) for taken, given in zip(readings, settings, strict=True)
    )
    problems = [
        Problem(problem.code, say("Probe {}: {}", number, problem.sentence), problem.blocks)
        for number, found in enumerate((one, two), 1)
        for problem in found.problems
    ]
    if not (one.accepted and two.accepted):
        return PairCalibration((one, two), None, tuple(problems))
    if readings[0].other is None or readings[1].other is None:
        problems.append(
            refusal("no_other", "The other probe was not read; the alignment is unknown.")
        )
        return PairCalibration((one, two), None, tuple(problems))
    alignment = align(readings, (settings[0].direction, settings[1].direction))
    if np.abs(alignment.angle).max() > LARGEST_ANGLE:
        worst = math.degrees(float(np.abs(alignment.angle).max()))
        problems.append(
            refusal("crooked", "A probe is {:.1f} degrees off its axis; mount it again.", worst)
        )
    return PairCalibration((one, two), alignment, tuple(problems))


def align(
    readings: tuple[ProbeReadings, ProbeReadings], direction: tuple[float, float]
) -> Alignment:
    """Return the alignment of the probes, from readings along e2 and along n2.

    direction: standard uncertainty (rad) of the two motions' directions against the follower; no
    reading shows its error, which only adds to the uncertainty.
    """
    along, across = readings
    assert along.other is not None
    assert across.other is not None
    own = [straight_line(one.position, one.signal)[1] for one in readings]
    other = [
        straight_line(across.position, across.other)[1],
        straight_line(along.position, along.other)[1],
    ]
    # The directions of motion are known only as stated: their errors rotate the result.
    one, two = (
        sign * seen / felt + GTC.ureal(0.0, doubt)
        for sign, seen, felt, doubt in zip((1.0, -1.0), other, own, direction, strict=True)
    )
    angles = [GTC.atan(tangent) for tangent in (one, two)]
    apart = angles[1] - angles[0]
    # Inverse of ((1, one), (-two, 1)), which maps the pin's position to the probes.
    area = 1.0 + one * two
    matrix = [[1.0 / area, -one / area], [two / area, 1.0 / area]]
    return Alignment(
        angle=np.array([GTC.value(angle) for angle in angles]),
        angle_uncertainty=np.array([GTC.uncertainty(angle) for angle in angles]),
        orthogonality=float(GTC.value(apart)),
        orthogonality_uncertainty=float(GTC.uncertainty(apart)),
        matrix=np.array([[GTC.value(value) for value in row] for row in matrix]),
        matrix_uncertainty=np.array([[GTC.uncertainty(value) for value in row] for row in matrix]),
    )


def split_pair(readings: ProbeReadings) -> tuple[ProbeReadings, ProbeReadings]:
    """Return the readings of both probes from one table: the series are 1.x and 2.x."""
    series = np.array(readings.series)
    one, two = (
        replace(
            readings,
            series=tuple(series[rows].tolist()),
            step=readings.step[rows],
            position=readings.position[rows],
            signal=readings.signal[rows],
            other=None if readings.other is None else readings.other[rows],
        )
        for rows in (np.char.startswith(series, "1."), np.char.startswith(series, "2."))
    )
    return one, two
