"""Predict one measured revolution, and compare the measurement with it. Pure functions."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import (
    AGREEMENT,
    PREDICTION_POINTS,
    identified_columns,
    in_order,
    prediction_columns,
)
from rigapp.schema.deviations import deviation_columns
from rigapp.schema.messages import Prediction, RevolutionMeasured, as_array
from rigapp.texts import say
from rigapp.twin.ahead import bushing_ahead
from rigapp.twin.approach import RIGID
from rigapp.twin.jointload import UNKNOWN, JointLoad
from rigapp.twin.measureddepth import ELASTIC_DOUBT
from rigapp.twin.pinpath import FRICTION_DOUBT, rotated
from rigapp_model.dynamics import MechanismMotion
from rigapp_model.frames import into_frame
from rigapp_model.history import FEWEST_SAMPLES, smooth_history
from rigapp_model.history_uncertainty import NOTHING_YET, MotionUncertainty, motion_uncertainty
from rigapp_model.joints import perfect_joint
from rigapp_model.parameters import Parameters
from rigapp_model.recurrent_motion import RecurrentMotion
from rigapp_model.wear.techniques import solve_of

Array = NDArray[np.float64]
Compute = Callable[[Array, Array], MechanismMotion]

COVERAGE_FACTOR = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class PredictionUncertainty:
    """The expanded uncertainty (k = 2, N) of the predicted force at crank angles.

    unfollowed: the largest angular acceleration (rad/s^2) that the angle shows and the prediction
    does not follow; 0 when none exceeds the noise of the angle. lasting: part of the curve that is
    the same in each revolution, and does not average out. recurrent: motion of each revolution,
    this one included.
    """

    curve: Array
    lasting: float
    unfollowed: float
    recurrent: RecurrentMotion

    @property
    def largest(self) -> float:
        """Return the largest of the revolution, N."""
        return float(self.curve.max())


def prediction_uncertainty(
    doubt: MotionUncertainty,
    on_grid: Callable[[Array], Array],
    motion: MechanismMotion,
    compute: Compute,
) -> PredictionUncertainty:
    """Return the uncertainty of the force of a motion that ``compute`` gave.

    doubt: of the angles as they were measured; on_grid: from there to the angles of the motion (one
    revolution evenly), at which ``compute`` takes speed and acceleration.
    """
    speed, acceleration, force = motion.speed, motion.acceleration, motion.force_crank
    faster = compute(speed + on_grid(doubt.speed), acceleration).force_crank - force
    pushed = compute(speed, acceleration + on_grid(doubt.acceleration)).force_crank - force
    step = motion.angle[1] - motion.angle[0]
    angle = on_grid(doubt.angle)
    turned = angle * (np.roll(force, -1, axis=-1) - np.roll(force, 1, axis=-1)) / (2.0 * step)
    parts = np.concatenate([np.asarray(part) for part in (faster, pushed, turned)])
    return PredictionUncertainty(
        COVERAGE_FACTOR * np.sqrt(np.sum(parts**2, axis=0)),
        doubt.lasting,
        doubt.unfollowed,
        doubt.recurrent,
    )


GRID: Array = np.arange(PREDICTION_POINTS, dtype=np.float64) * (2.0 * np.pi / PREDICTION_POINTS)


NOTHING: Mapping[str, float] = dict.fromkeys(
    (column.name for column in (*deviation_columns(), *identified_columns())), math.nan
)
"""Columns identified from many revolutions while unknown."""


NO_BAND: Array = np.full(1, np.nan)
"""The band of a prediction without one."""


class PredictionError(ValueError):
    """A revolution cannot be predicted; the text gives the reason, without a full stop."""


@dataclass(frozen=True, slots=True)
class MeasuredRevolution:
    """One measured revolution in SI: time (s), crank angle (rad), forces (N), probes (m).

    temperature: of the room, degC, NaN where it is not known.
    """

    revolution: int
    time: Array
    angle: Array
    force_1: Array
    force_2: Array
    probe_1: Array
    probe_2: Array
    temperature: float = math.nan
    on_grid: Callable[[Array], Array] = field(init=False, repr=False)
    """Interpolates values (n,) at its angles linearly to ``GRID``."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "on_grid", _onto_grid(self.angle))


def _onto_grid(angle: Array) -> Callable[[Array], Array]:
    """Return the interpolation of periodic values (n,) at some angles, rad, to ``GRID``."""
    turn = 2.0 * np.pi
    inside = np.mod(angle, turn)
    order = np.argsort(inside)
    inside = inside[order]
    around = np.concatenate([inside[-1:] - turn, inside, inside[:1] + turn])
    order = np.concatenate([order[-1:], order, order[:1]])
    after = np.searchsorted(around, GRID, side="right")
    share = (GRID - around[after - 1]) / (around[after] - around[after - 1])
    low, up = order[after - 1], order[after]

    def on_grid(values: Array) -> Array:
        begin = values[low]
        return np.asarray(begin + share * (values[up] - begin), dtype=np.float64)

    return on_grid


@dataclass(frozen=True, slots=True)
class Wear:
    """The wear at a revolution, m at the contact point; NaN when unknown.

    predicted: by the model alone. driven: by the model from the measured forces. measured: by the
    probes, with its expanded uncertainty (k = 2).
    """

    predicted_depth: float = 0.0
    driven_depth: float = float("nan")
    measured_depth: float = float("nan")
    measured_uncertainty: float = float("nan")


def unpack(message: RevolutionMeasured) -> MeasuredRevolution:
    """Turn a message into arrays in SI; samples that do not advance the crank are left out.

    Raises PredictionError for a stationary or reversed crank, and for values that are no numbers.
    """
    time, angle = as_array(message.time_s, "<f8"), as_array(message.angle_rad, "<f8")
    force_1, force_2 = as_array(message.force_1, "<f8"), as_array(message.force_2, "<f8")
    if not all(np.isfinite(values).all() for values in (time, angle, force_1, force_2)):
        raise PredictionError(say("its angles, times or forces are not all numbers"))
    forward = np.diff(np.maximum.accumulate(angle), prepend=-np.inf) > 0.0
    if np.count_nonzero(forward) < FEWEST_SAMPLES:
        raise PredictionError(say("the crank did not turn forward"))
    um = 1e-6
    return MeasuredRevolution(
        revolution=message.revolution,
        time=time[forward],
        angle=angle[forward],
        force_1=force_1[forward],
        force_2=force_2[forward],
        probe_1=um * as_array(message.probe_1, "<f8")[forward],
        probe_2=um * as_array(message.probe_2, "<f8")[forward],
        temperature=message.temperature_C,
    )


def predict_force(
    parameters: Parameters,
    joint: str,
    measured: MeasuredRevolution,
    depth: float,
    before: RecurrentMotion = NOTHING_YET,
) -> tuple[MechanismMotion, PredictionUncertainty]:
    """Compute motion and forces at ``GRID`` from the history of the crank's angle alone.

    joint: one of ``SOLVABLE``, of a bushing worn by depth (m) at the contact point. Returns also
    the uncertainty of the force by the angle, with the recurrent motion of earlier revolutions.
    """
    fitted = smooth_history(measured.time, measured.angle)
    doubt = motion_uncertainty(measured.time, measured.angle, fitted, before)
    on_grid, history = measured.on_grid, doubt.history
    compute = functools.partial(_motion, parameters, joint, depth)
    motion = compute(on_grid(history.speed), on_grid(history.acceleration))
    return motion, prediction_uncertainty(doubt, on_grid, motion, compute)


def _motion(
    parameters: Parameters, joint: str, depth: float, speed: Array, acceleration: Array
) -> MechanismMotion:
    return solve_of(joint)(parameters, GRID, speed, acceleration, depth)[0]


def measured_force(measured: MeasuredRevolution) -> Array:
    """Return the measured joint force (2, points) at ``GRID``, crank frame, N."""
    return np.stack([measured.on_grid(measured.force_1), measured.on_grid(measured.force_2)])


def compare(
    measured: MeasuredRevolution,
    motion: MechanismMotion,
    wear: Wear,
    doubt: PredictionUncertainty | None = None,
    load: JointLoad = UNKNOWN,
    band: Array = NO_BAND,
    identified: Mapping[str, float] = NOTHING,
) -> Prediction:
    """Return the prediction of a revolution, its uncertainty, and the deviation of the measurement.

    band: within which a healthy rig agrees, N. identified: columns told from many revolutions,
    NaN where unknown.
    """
    force_1, force_2 = motion.force_crank
    force = motion.force_magnitude
    curves = {"force_1": force_1, "force_2": force_2, "force": force}
    others = load.curves | {AGREEMENT.name: band}
    size = np.hypot(measured.force_1, measured.force_2)
    values = {
        "revolution": measured.revolution,
        "residual_rms": _rms(size - _at(measured.angle, force)),
        "residual_1_rms": _rms(measured.force_1 - _at(measured.angle, force_1)),
        "residual_2_rms": _rms(measured.force_2 - _at(measured.angle, force_2)),
        "phase_shift": np.degrees(phase_shift(measured.on_grid(size), force)),
        "wear_depth": 1e3 * wear.predicted_depth,
        "measured_wear_depth": 1e3 * wear.measured_depth,
        "measured_wear_depth_uncertainty": 1e3 * wear.measured_uncertainty,
        "driven_wear_depth": 1e3 * wear.driven_depth,
        "force_uncertainty": math.nan if doubt is None else doubt.largest,
        "unfollowed_acceleration": math.nan if doubt is None else doubt.unfollowed,
        f"{AGREEMENT.name}_max": float(np.max(band)),
    }
    values |= {**load.values, **NOTHING, **identified}
    for name, curve in curves.items():
        statistics = {"max": np.max(curve), "min": np.min(curve), "rms": _rms(curve)}
        values |= {f"{name}_{statistic}": value for statistic, value in statistics.items()}
    return Prediction(
        revolution=measured.revolution,
        values=in_order(prediction_columns(), values).tobytes(),
        **{name: samples.astype("<f4").tobytes() for name, samples in (curves | others).items()},
    )


def phase_shift(measured: Array, predicted: Array) -> float:
    """Return the lag (rad) of the measured curve behind the predicted one, both on ``GRID``.

    The maximum of the circular cross-correlation, refined by a parabola through its neighbours.
    """
    size = len(predicted)
    spectrum = np.fft.rfft(measured - measured.mean()) * np.conj(
        np.fft.rfft(predicted - predicted.mean())
    )
    correlation = np.fft.irfft(spectrum, size)
    peak = int(np.argmax(correlation))
    before, top, after = correlation[[peak - 1, peak, (peak + 1) % size]]
    curvature = before - 2.0 * top + after
    lag = peak + (0.5 * (before - after) / curvature if curvature < 0.0 else 0.0)
    if lag > size / 2:
        lag -= size
    return float(2.0 * np.pi * lag / size)


def _at(angle: Array, curve: Array) -> Array:
    return np.asarray(np.interp(angle, GRID, curve, period=2.0 * np.pi), dtype=np.float64)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values * values)))


DOUBTS = (ELASTIC_DOUBT * np.eye(2), FRICTION_DOUBT * np.array([[0.0, -1.0], [1.0, 0.0]]))
"""Errors of the size and of the direction; times the motion, one standard uncertainty each."""


def elastic_motions(
    parameters: Parameters, angles: Sequence[Array], forces: Sequence[Array]
) -> list[Array]:
    """Return the elastic motion (2, n) of the pin in the follower frame, m, in each revolution.

    angles (n,) each: crank angle, rad; forces (2, n) each: on the follower by the pin, crank frame,
    N. The clearance is left out of the follower's angle. Raises PredictionError, ModelError.
    """
    if not angles:
        return []
    if not all(np.isfinite(force).all() for force in forces):
        raise PredictionError(say("its forces are not all numbers"))
    motion = perfect_joint(parameters.mechanism, GRID, 1.0, 0.0, parameters.joint)
    seen = []
    for angle, force in zip(angles, forces, strict=True):
        turn = np.interp(angle, GRID, motion.follower_angle, period=2.0 * np.pi) - angle
        seen.append(into_frame(force, np.cos(turn), np.sin(turn)))
    together, crank = np.concatenate(seen, axis=1), np.concatenate(angles)
    usual = np.array([np.interp(GRID, crank, row, period=2.0 * np.pi) for row in together])
    bushing = bushing_ahead(parameters, usual, motion.slip_increments(parameters.joint.pin_radius))
    approach = RIGID if bushing is None else bushing.upto(0.0)
    if approach is None:
        raise PredictionError(say("the model has no indentation for this force"))
    lean = -float(np.arctan(parameters.joint.friction_coefficient))
    motions = []
    for force in seen:
        size = np.hypot(*force)
        normal = rotated(force / np.maximum(size, 1e-300), lean)
        motions.append(np.asarray(approach.at(0.0, size) * normal))
    return motions
