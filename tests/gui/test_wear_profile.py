"""The worn profile on the screen: recorded ones with their uncertainty, and files without."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.gui.panels.trends import WearProfilePanel
from rigapp.presentation.tokens import LIGHT
from rigapp.replay.client import read_recording
from rigapp.replay.messages import profile_message
from rigapp.schema.columns import PROFILE_ANGLES_DEG, PROFILE_CURVES, profile_columns
from rigapp.storage import open_test
from rigapp.viewer.news import News
from rigapp.viewer.recording import load_history
from rigapp.viewer.series import LiveData, shown_profile

ANGLES = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)


def columns(*revolutions: int) -> dict[str, np.ndarray]:
    """Profiles as ``TestReader.profiles`` gives them, deeper with each revolution."""
    found = {one.name: np.array(revolutions) for one in profile_columns()}
    for name in PROFILE_CURVES:
        depth = np.array([[0.001 * n] * ANGLES.size for n in revolutions], dtype=np.float32)
        depth[:, np.abs(ANGLES) > 20.0] = np.nan if name == "measured" else 0.0
        found[name] = depth
    return found


def test_a_profile_travels_as_a_message() -> None:
    shown = shown_profile(profile_message(columns(10, 20), 1))
    assert shown.revolution == 20
    assert np.isnan(shown.measured[0])
    assert shown.measured[180] == pytest.approx(0.02)
    assert shown.deepest == pytest.approx(0.04)


def test_the_panel_draws_only_what_the_pin_reached(qtbot: Any) -> None:
    panel = WearProfilePanel("test", LIGHT)
    qtbot.addWidget(panel)
    data = LiveData()
    data.profile = shown_profile(profile_message(columns(20), 0))
    panel.show_news(News(data=data))
    angle, depth = panel._measured.x, panel._measured.y
    assert np.isnan(depth[np.abs(angle) > 20.0]).all()
    assert depth[np.abs(angle) <= 20.0] == pytest.approx(20.0)
    assert panel._band.high == pytest.approx(40.0)
    assert len(panel._band.high) == 41
    assert "measured 20 ± 20 µm" in panel.plot.accessibleDescription()
    words = panel.title.text()
    assert "cycle 20" in words
    assert "-20° to 20°" in words


def test_unknown_profiles_say_so(qtbot: Any) -> None:
    panel = WearProfilePanel("test", LIGHT)
    qtbot.addWidget(panel)
    data = LiveData()
    nothing = columns(3)
    for name in PROFILE_CURVES:
        nothing[name][:] = np.nan
    data.profile = shown_profile(profile_message(nothing, 0))
    panel.show_news(News(data=data))
    words = panel.title.text()
    assert "measured: not known yet, cycle 3" in words
    assert "model: not known" in words
    panel.dress(LIGHT)


def test_old_files_have_no_profile(recorded: Path) -> None:
    assert load_history(recorded).data.profile is None
    with open_test(recorded) as test:
        assert read_recording(test).profiles["measured"].shape == (0, ANGLES.size)
