"""The overlay says how sure the predicted force is, and when the speed was too fast for it."""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np
import pytest
from snapshots import PREDICTION_NAMES, make_predictions, make_snapshot

from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.deviations import DEVIATIONS
from rigapp.viewer.news import News
from rigapp.viewer.series import LiveData


def seen(overlay: OverlayPanel, **columns: float) -> str:
    rows = make_predictions(1, 9)
    for name, value in columns.items():
        rows[:, PREDICTION_NAMES.index(name)] = value
    data = LiveData()
    data.take(msgspec.structs.replace(make_snapshot(1, 9), predictions=rows.tobytes()))
    overlay.show_news(News(data=data))
    return f"{overlay.plot.accessibleDescription()}; {overlay.readout.whole}"


@pytest.fixture
def overlay(qtbot: Any, qapp: Any) -> OverlayPanel:
    overlay = OverlayPanel("x", LIGHT)
    qtbot.addWidget(overlay)
    return overlay


def test_the_uncertainty_stands_beside_the_prediction(overlay: OverlayPanel) -> None:
    text = seen(overlay)
    assert "model ± 0.94" in text
    assert "faster" not in text
    band = overlay._model_bands["force"]
    assert band.high - band.low == pytest.approx(2 * 0.94)


def test_a_speed_that_is_not_followed_is_told_where_it_matters(overlay: OverlayPanel) -> None:
    text = seen(overlay, force_uncertainty=22.0, unfollowed_acceleration=54.0)
    assert "model ± 22" in text
    assert text.endswith("▲ the speed changes faster than the prediction can follow")
    assert "faster" not in seen(overlay, force_uncertainty=1.2, unfollowed_acceleration=2.0)


def test_a_file_of_before_says_nothing(overlay: OverlayPanel) -> None:
    text = seen(overlay, force_uncertainty=np.nan, unfollowed_acceleration=np.nan)
    assert "model" in text
    assert "±" not in text
    assert len(overlay._model_bands["force"].low) == 0


def test_what_explains_a_difference_stands_at_the_strip(overlay: OverlayPanel) -> None:
    place = float(list(DEVIATIONS).index("slider mass"))
    text = seen(overlay, deviation_cause=place, deviation=7.03, deviation_uncertainty=1.99)
    assert text.endswith("▲ beyond tolerances: slider mass +7.0 ± 2.0 % would explain it")
    assert "tolerances" not in seen(overlay, deviation_cause=0.0)
