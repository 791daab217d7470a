"""Columns of the twin's prediction and of worn profiles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.channels import Column
from rigapp.schema.deviations import deviation_columns
from rigapp.texts import joined, say


def in_order(columns: Sequence[Column], values: Mapping[str, float]) -> NDArray[np.float64]:
    """Return values by name in the order of columns, (len(columns),); KeyError names one missing.

    Raises ValueError for a name that is not a column.
    """
    if unknown := values.keys() - {column.name for column in columns}:
        raise ValueError(say("no such column: {}", joined(", ", sorted(unknown))))
    return np.array([values[column.name] for column in columns], dtype="<f8")


def by_name(columns: Sequence[Column], row: NDArray[np.float64]) -> dict[str, float]:
    """Return a row, (len(columns),), as a mapping by column name."""
    return dict(zip((column.name for column in columns), row.tolist(), strict=True))


@cache
def prediction_columns() -> tuple[Column, ...]:
    """Return the columns of ``/entry/prediction``, in storage order."""
    head = (
        Column("revolution", "<i8", "1", "number of the revolution predicted"),
        Column("residual_rms", "<f8", "N", "RMS of measured minus predicted |F|"),
        Column("residual_1_rms", "<f8", "N", "RMS of measured minus predicted force_1"),
        Column("residual_2_rms", "<f8", "N", "RMS of measured minus predicted force_2"),
        Column("phase_shift", "<f8", "deg", "shift of the measured |F| against the predicted"),
        Column("wear_depth", "<f8", "mm", "predicted wear depth at the contact point"),
        Column("measured_wear_depth", "<f8", "mm", "wear depth from the probes, NaN when unknown"),
        Column(
            "measured_wear_depth_uncertainty",
            "<f8",
            "mm",
            "expanded uncertainty (k = 2) of the measured wear depth",
        ),
        Column("driven_wear_depth", "<f8", "mm", "wear depth by the model from measured forces"),
    )
    body = tuple(
        Column(f"{channel}_{statistic}", "<f8", "N", f"predicted {statistic} of {channel}")
        for channel in ("force_1", "force_2", "force")
        for statistic in ("max", "min", "rms")
    )
    sure = (
        Column(
            "force_uncertainty",
            "<f8",
            "N",
            "largest expanded uncertainty (k = 2) of the predicted force over the revolution, from"
            " the uncertainty of the measured angle",
        ),
        Column(
            "unfollowed_acceleration",
            "<f8",
            "rad/s^2",
            "largest acceleration of the crank that the angle shows and the prediction does not"
            " follow, 0 when none",
        ),
        Column(f"{AGREEMENT.name}_max", "<f8", "N", f"largest {AGREEMENT.description}"),
    )
    return head + body + sure + deviation_columns() + _joint_columns() + identified_columns()


def _joint_columns() -> tuple[Column, ...]:
    """Return the columns of the joint by the measured force of a revolution."""
    return (
        Column(
            "friction_coefficient",
            "<f8",
            "1",
            "friction coefficient of the joint, from the measured force that the model without"
            " friction does not explain; NaN while the load cell has no stated uncertainty",
        ),
        Column(
            "friction_coefficient_uncertainty",
            "<f8",
            "1",
            "expanded uncertainty (k = 2) of the friction coefficient",
        ),
        *(
            Column(f"{curve.name}_max", "<f8", curve.unit, f"largest {curve.description}")
            for curve in JOINT_CURVES
        ),
    )


@cache
def identified_columns() -> tuple[Column, ...]:
    """Return the columns of the wear identified so far; NaN while unknown."""
    level = f"{IDENTIFIED_LEVEL:.0%} limit"
    return (
        *_with_limits("wear_coefficient", "mm^3/(N m)", "wear coefficient now", level),
        *_with_limits(
            "remaining_revolutions", "1", "revolutions until stop.wear_depth_um is reached", level
        ),
        Column(
            "wear_consistency",
            "<f8",
            "1",
            "deviation of newer depths together from what the earlier ones predict, in standard"
            " deviations; positive where the joint wears faster",
        ),
        Column(
            "wear_model",
            "<f8",
            "1",
            "what explains the depth best: "
            + ", ".join(f"{n} {name}" for n, name in enumerate(WEAR_MODELS)),
        ),
        Column("wear_model_weight", "<f8", "1", "probability of that among these, 0 to 1"),
        Column("wear_change_revolution", "<f8", "1", "revolution at which the wear changed, if so"),
        Column(
            "wear_departure_revolution",
            "<f8",
            "1",
            "revolution from which the wear of the joint has changed, once detected",
        ),
    )


def _with_limits(name: str, unit: str, words: str, level: str) -> tuple[Column, ...]:
    """Return a column and those of its credible limits."""
    return (
        Column(name, "<f8", unit, words),
        Column(f"{name}_low", "<f8", unit, f"lower {level} of it"),
        Column(f"{name}_high", "<f8", unit, f"upper {level} of it"),
    )


WEAR_MODELS = ("constant", "running-in", "change")
"""Statements on the wear coefficient over a test; ``wear_model`` is an index of it."""

IDENTIFIED_LEVEL = 0.95
"""Probability within the credible limits of identified quantities."""

PREDICTION_POINTS = 360
"""Points of a predicted curve, crank angles 0 .. 359 degrees."""

JOINT_CURVES = (
    Column("nominal_pressure", "<f4", "MPa", "measured |F| over pin diameter and bushing width"),
    Column("sliding_speed", "<f4", "m/s", "speed of the pin's surface in the bushing"),
    Column("pressure_velocity", "<f4", "MPa m/s", "product of nominal pressure and sliding speed"),
)
"""Load of the joint over the crank angle."""

AGREEMENT = Column(
    "agreement_uncertainty",
    "<f4",
    "N",
    "expanded uncertainty (k = 2) of measured minus predicted |F|, means over 2 degrees: angle,"
    " tolerances of the mechanism, friction, index, latency, load cell and noise",
)
"""Limits within which a healthy rig agrees with its model."""

AGREEMENT_BIN_DEG = 2.0
"""Bins over which measured minus predicted is averaged: narrow enough for the model's sharpest
turn, wide enough that noise averages out."""

CURVES = (
    *(Column(name, "<f4", "N", f"predicted {name}") for name in ("force_1", "force_2", "force")),
    *JOINT_CURVES,
    AGREEMENT,
)
"""The stored curves of a whole revolution, on PREDICTION_POINTS crank angles."""

PREDICTED_CURVES = tuple(curve.name for curve in CURVES)

PROFILE_ANGLES_DEG = tuple(range(-180, 181))
"""Angles of a worn profile, 0 at the initial contact point: the follower frame turned by 180."""

PROFILE_CURVES = ("measured", "predicted", "driven", "uncertainty")
"""Curves of a stored profile at each angle, mm."""

PROFILES_PER_DECADE = 24
"""Number of worn profiles stored in each decade of revolutions, evenly spaced in the logarithm."""


@cache
def profile_columns() -> tuple[Column, ...]:
    """Return the values of a worn profile, in storage order; its curves are PROFILE_CURVES."""
    return (
        Column("revolution", "<i8", "1", "number of the last revolution in the worn profile"),
        Column("revolutions", "<i8", "1", "revolutions averaged in the measured profile"),
        Column("approach", "<f8", "um", "elastic approach at the largest force, by the model"),
        Column(
            "approach_change",
            "<f8",
            "um",
            "its change since the reference, taken out of the measured depth",
        ),
        Column("centre_1", "<f8", "um", "reading of probe_1 at the bushing's centre"),
        Column("centre_2", "<f8", "um", "reading of probe_2 at the bushing's centre"),
        Column("run_out", "<f8", "um", "run-out of the pin that was taken out of the readings"),
        Column("centred", "<i8", "1", "1: the probes' zero tells the direction, 0: the forces do"),
    )
