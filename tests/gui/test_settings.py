"""The page of settings: what is chosen counts at once or is said to count later, and is kept."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QSettings, Qt

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document
from rigapp.config.notify import NotifyFile, NotifySection
from rigapp.gui.look.preferences import Preference, Preferences
from rigapp.gui.panels.limits import LimitPanel
from rigapp.gui.settings.page import PinPart, SettingsPage
from rigapp.gui.window import window as window_module
from rigapp.gui.window.app import _results_folder
from rigapp.gui.window.window import MainWindow
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.notify import channels
from rigapp.service.pins import fits, pins_in
from rigapp.viewer.news import News

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def page(window: MainWindow) -> SettingsPage:
    window.tabs.show_page("settings")
    return window.tabs.settings


def pick(box: Any, value: str) -> None:
    """Choose an item as a person does: the box tells it by ``activated``."""
    box.setCurrentIndex(box.findData(value))
    box.activated.emit(box.currentIndex())


def test_a_theme_counts_at_once_and_its_key_shows_on_the_page(
    window: MainWindow, page: SettingsPage, qtbot: Any
) -> None:
    pick(page.theme, "dark")
    assert window.theme.name == "dark"
    qtbot.keyClick(window, Qt.Key.Key_F9)
    assert window.theme.name == "light"
    assert page.theme.currentData() == "light"


def test_the_language_counts_later_and_the_window_opens_again_with_it(
    window: MainWindow, page: SettingsPage, monkeypatch: pytest.MonkeyPatch
) -> None:
    launched: list[list[str]] = []
    monkeypatch.setattr(window_module, "launch_process", launched.append)
    assert page.later.isHidden()
    assert page.again.isHidden()
    pick(page.language, "de")
    assert not page.later.isHidden()
    page.again.click()
    assert launched == [window._again]
    assert not window.isVisible()


def test_the_name_of_the_operator_goes_with_every_request(
    window: MainWindow, page: SettingsPage, attach: Callable[[], None], engine: Any
) -> None:
    engine.say()
    attach()
    page.operator.setText("E. Sample")
    page.operator.editingFinished.emit()
    client = window._connection._client
    assert client is not None
    assert client.operator == "E. Sample"


def test_the_training_mode_offers_hands_on_a_simulated_rig_only() -> None:
    live = LiveCalibration.__new__(LiveCalibration)
    for simulated, offered, trains in (
        (True, True, True),
        (True, False, False),
        (False, True, False),
    ):
        live.rig, live.hands_offered = type("Rig", (), {"simulated": simulated})(), offered
        assert live.trains is trains


def test_choices_are_kept_for_the_next_window(tmp_path: Path) -> None:
    place = str(tmp_path / "rigapp.ini")
    Preferences(QSettings(place, QSettings.Format.IniFormat)).put(Preference.THEME, "dark")
    again = Preferences(QSettings(place, QSettings.Format.IniFormat))
    assert again.theme.name == "dark"


def test_a_folder_that_cannot_be_made_leaves_the_results_where_they_were(tmp_path: Path) -> None:
    preferences = Preferences()
    preferences.put(Preference.RESULTS_FOLDER, str(tmp_path / "new" / "results"))
    assert _results_folder(preferences, tmp_path) == tmp_path / "new" / "results"
    (tmp_path / "file").write_text("", "utf-8")
    preferences.put(Preference.RESULTS_FOLDER, str(tmp_path / "file" / "results"))
    assert _results_folder(preferences, tmp_path) == tmp_path


def test_a_way_is_added_and_removed_in_the_users_file(
    page: SettingsPage, qtbot: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(channels, "user_folder", lambda: tmp_path)
    own = tmp_path / "notify.toml"
    own.write_text("# mine\nschema = 1\n", "utf-8")
    card = page.messages
    card.name.setText("lab")
    card.url.setText("json://lab.example/hook")
    card.when["warning"].setChecked(True)
    card.add.click()
    (way,) = read_document(own, NotifyFile).record.notify
    assert (way.name, way.url) == ("lab", "json://lab.example/hook")
    assert way.when == ("critical", "warning", "end", "pause", "silence", "disk")
    assert own.read_text("utf-8").startswith("# mine\n")
    card.look()
    qtbot.waitUntil(lambda: _delivered(card) and card.table.rowCount() == 1, timeout=PATIENCE_MS)
    assert card.table.texts()[0][:2] == ["lab", "json://lab.example"]
    card.table.selectRow(0)
    card.remove.click()
    assert read_document(own, NotifyFile).record.notify == ()


def test_a_way_that_cannot_be_used_is_refused_and_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(channels, "user_folder", lambda: tmp_path)
    with pytest.raises(UnusableInput, match="password"):
        channels.add_way(NotifySection(name="lab", url="mailtos://me:secret@lab.example"))
    assert not (tmp_path / "notify.toml").exists()
    with pytest.raises(UnusableInput, match="lab"):
        channels.remove_way("lab")


def test_every_key_of_the_buttons_is_listed(page: SettingsPage, window: MainWindow) -> None:
    told = dict(window.tabs.settings._host.keys)
    assert {"F4", "F5", "F6", "F12", "F7", "F9"} <= told.keys()


def _delivered(card: Any) -> bool:
    card._worker.deliver()
    return True


def test_a_pin_is_set_for_the_operator_where_the_rig_wants_one(
    tmp_path: Path, qtbot: Any, light_application: Any
) -> None:
    text = (EXAMPLES / "simulated.toml").read_text("utf-8")
    rig = tmp_path / "rig.toml"
    rig.write_text(f'{text}\n[operators]\nfile = "operators.toml"\n', "utf-8")
    choices = Preferences()
    choices.put(Preference.OPERATOR, "Ada")
    part = PinPart(rig, choices)
    qtbot.addWidget(part)
    part.show()
    assert part.by_pin.isHidden()
    part.pin.setText("27")
    part.set.click()
    assert "4 characters" in part.holders.text()
    part.pin.setText("2718")
    part.set.click()
    assert "Ada" in part.holders.text()
    assert not part.by_pin.isHidden()
    assert fits("2718", pins_in(tmp_path / "operators.toml")["Ada"])


def test_the_limits_ask_for_a_pin_where_the_rig_wants_one(
    window: MainWindow, engine: Any, attach: Callable[[], None], make_status: Any
) -> None:
    panel = window.tabs.panels["limits"]
    assert isinstance(panel, LimitPanel)
    window.tabs.show_page("limits")
    status = make_status()
    for wanted in (True, False):
        rig = msgspec.structs.replace(status.rig, limits_need_pin=wanted)
        panel.show_news(News(msgspec.structs.replace(status, rig=rig)))
        assert panel.pin.isHidden() is not wanted
