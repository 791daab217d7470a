"""Measurement and model: the arrays of one revolution, their difference, values at an angle."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import AGREEMENT
from rigapp.schema.messages import ChannelView
from rigapp.viewer.channels import COMPONENTS, SIZE
from rigapp.viewer.frames import ForceFrame, to_frame
from rigapp.viewer.series import MeasuredCycle, PredictedCycle

Floats = NDArray[np.float64]

CURVES = (SIZE, *COMPONENTS)
"""The size of the force and its components: measured, and predicted too."""


@dataclass(frozen=True, slots=True)
class RevolutionCurves:
    """The arrays on the screen: crank angle, |F| and components of measurement and model.

    ``model`` is on the model's own angles, ``residual`` (measured - model) on the measured ones.
    agreement: within which a healthy rig is from its model, N, on the model's angles; None where
    the prediction has none.
    """

    angle_deg: Floats
    measured: dict[str, Floats]
    measured_revolution: int
    model_angle_deg: Floats | None = None
    model: dict[str, Floats] | None = None
    residual: dict[str, Floats] | None = None
    model_revolution: int | None = None
    agreement: Floats | None = None


def compose(
    cycle: MeasuredCycle,
    prediction: PredictedCycle | None,
    frame: ForceFrame,
    crank_over_follower: float | None,
) -> RevolutionCurves:
    """Return measurement, model and their difference over one revolution in a frame."""
    angle = cycle.angle_deg.astype(np.float64)
    measured = _in_frame(angle, cycle.channels, frame, crank_over_follower)
    if prediction is None:
        return RevolutionCurves(angle, measured, cycle.revolution)
    model_angle = np.append(prediction.angle_deg, 360.0)
    curves = {name: np.append(values, values[0]) for name, values in prediction.curves.items()}
    on_measured = {name: prediction.at(angle, name) for name in CURVES}
    model = _in_frame(angle, on_measured, frame, crank_over_follower)
    return RevolutionCurves(
        angle,
        measured,
        cycle.revolution,
        model_angle,
        _in_frame(model_angle, curves, frame, crank_over_follower),
        {name: measured[name] - model[name] for name in CURVES},
        prediction.revolution,
        curves[AGREEMENT.name].astype(np.float64) if AGREEMENT.name in curves else None,
    )


def stacked(curves: Mapping[str, Floats]) -> Floats:
    """Return curves of one length as rows (3, n), in the order of ``CURVES``."""
    return np.stack([curves[name] for name in CURVES])


def binned(angle_deg: Floats, curves: Floats, width_deg: float) -> tuple[Floats, Floats]:
    """Return means over bins of crank angle: bin middles (m,) and means (k, m) of curves (k, n).

    Empty bins are left out.
    """
    count = round(360.0 / width_deg)
    part = np.maximum(np.minimum((angle_deg / width_deg).astype(np.intp), count - 1), 0)
    number = np.bincount(part, minlength=count)
    filled = number > 0
    middles = width_deg * (np.arange(count, dtype=np.float64) + 0.5)
    totals = [np.bincount(part, weights=values, minlength=count) for values in curves]
    return middles[filled], np.stack(totals)[:, filled] / number[filled]


def values_at(shown: RevolutionCurves, angle_deg: float) -> dict[str, tuple[float, float]]:
    """Return per curve the measured and the predicted value at a crank angle (NaN: no model)."""
    result = {}
    for name in CURVES:
        model = math.nan
        if shown.model is not None and shown.model_angle_deg is not None:
            model = _at(shown.model_angle_deg, shown.model[name], angle_deg)
        result[name] = _at(shown.angle_deg, shown.measured[name], angle_deg), model
    return result


def statistics(shown: RevolutionCurves) -> list[tuple[str, list[float]]]:
    """Return per curve maximum, minimum, RMS: measured, model, difference (NaN: no model)."""
    table = []
    for name in CURVES:
        row = []
        model = shown.model[name][:-1] if shown.model is not None else None
        for operation in (np.max, np.min, _rms):
            measured = float(operation(shown.measured[name]))
            predicted = float(operation(model)) if model is not None else float("nan")
            row += [measured, predicted, measured - predicted]
        table.append((name, row))
    return table


def uncertainty_of(channels: Sequence[ChannelView]) -> float:
    """Return U of the joint force in N: of |F|, else the larger of its components; NaN: unknown."""
    known = {
        channel.name: channel.uncertainty
        for channel in channels
        if channel.uncertainty is not None and channel.uncertainty > 0.0
    }
    if SIZE in known:
        return known[SIZE]
    return max((known[name] for name in COMPONENTS if name in known), default=math.nan)


def joint_uncertainty(*uncertainties: float) -> float:
    """Return U of a difference of independent values, of the known ones; NaN without any."""
    known = [uncertainty for uncertainty in uncertainties if math.isfinite(uncertainty)]
    return math.hypot(*known) if known else math.nan


def _in_frame(
    angle_deg: Floats,
    curves: Mapping[str, NDArray[np.floating]],
    frame: ForceFrame,
    crank_over_follower: float | None,
) -> dict[str, Floats]:
    along, across = (curves[name] for name in COMPONENTS)
    turned = to_frame(along, across, angle_deg, frame, crank_over_follower)
    size = curves[SIZE].astype(np.float64)
    return dict(zip(CURVES, (size, *turned), strict=True))


def _at(angle_deg: Floats, values: Floats, at_deg: float) -> float:
    return float(np.interp(at_deg, angle_deg, values, period=360.0))


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values * values)))
