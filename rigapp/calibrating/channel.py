"""The result of a free channel's calibration: for ``--json`` and the record, and in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rigapp.calibrating.records import budget_result, problems_of
from rigapp.calibrating.session import Outcome
from rigapp.config.calibration_settings import ChannelFile
from rigapp.texts import say
from rigapp_calibration.channel import (
    CHANNEL_COLUMNS,
    ChannelCalibration,
    ChannelSettings,
    calibrate_channel,
    channel_table,
    rule_of,
)
from rigapp_calibration.taking.readings import read_table

Content = Mapping[str, Any]
KIND = "channel"


def fit_channel(text: str, file: ChannelFile, where: str, which: str) -> Outcome:
    """Fit a table of readings; raise ReadingsError."""
    channel = file.channel
    settings = ChannelSettings(
        channel.method, channel.reference_standard_uncertainty, channel.resolution_V
    )
    rows = channel_table(read_table(text, CHANNEL_COLUMNS))
    result = _result(calibrate_channel(rows, settings), file)
    return Outcome(KIND, result, tuple(_lines(result)))


def _result(calibration: ChannelCalibration, file: ChannelFile) -> dict[str, Any]:
    """Return the result for ``--json`` and the record; ``value`` in a key: in ``unit``."""
    table = None
    if calibration.points is not None and calibration.scale is None:
        table = calibration.points.T.tolist()
    return {
        "accepted": calibration.accepted,
        "problems": problems_of(calibration.problems),
        "unit": file.channel.unit,
        "scale_per_V": calibration.scale,
        "offset_V": calibration.offset,
        "table": table,
        **budget_result(calibration.budget, "value"),
        "residual_value": None if calibration.residual is None else calibration.residual.tolist(),
    }


def _lines(result: Content) -> list[str]:
    if result["expanded_uncertainty_value"] is None:
        return []
    return [
        say("{}.", rule_of(result)),
        say(
            "Expanded uncertainty of a value {:.3g} {} (k = {:.2f}).",
            result["expanded_uncertainty_value"],
            result["unit"],
            result["coverage_factor"],
        ),
    ]
