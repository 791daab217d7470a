"""Help on F1: guides with their pictures, links between them, the keys."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QPoint, QUrl
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from rigapp.config.errors import UnusableInput
from rigapp.gui.window import help as help_module
from rigapp.gui.window.help import HelpWindow, anchor_of
from rigapp.prepare.shipped import guides_folder
from rigapp_drivers.api import HELP


@pytest.fixture
def shown(qtbot: QtBot) -> HelpWindow:
    window = HelpWindow()
    qtbot.addWidget(window)
    window.show()
    qtbot.waitExposed(window, timeout=PATIENCE_MS)
    return window


def press(window: HelpWindow, name: str) -> None:
    button = window.findChild(QPushButton, name)
    assert button is not None
    assert button.isEnabled()
    button.click()


def test_it_begins_with_the_operators_guide_and_its_pictures_fit(shown: HelpWindow) -> None:
    browser = shown.browser
    title = (guides_folder() / "operator.md").read_text("utf-8").splitlines()[0]
    assert browser.toPlainText().startswith(title.removeprefix("# "))
    pictures = list((guides_folder() / "images").glob("guide-*.png"))
    assert pictures
    for one in pictures:
        picture = browser.loadResource(2, QUrl.fromLocalFile(str(one)))
        assert 100 < picture.width() <= browser.viewport().width()


def test_a_link_leads_to_another_guide_and_back(shown: HelpWindow) -> None:
    browser = shown.browser
    first = browser.toPlainText()
    browser.anchorClicked.emit(QUrl("rig.md#a-test-of-several-steps"))
    assert Path(browser.source().toLocalFile()).name == "rig.md"
    assert browser.toPlainText() != first
    press(shown, "help_back")
    assert browser.toPlainText() == first


@pytest.mark.parametrize("section", sorted(HELP.values()))
def test_a_device_error_leads_to_the_top_of_its_section(shown: HelpWindow, section: str) -> None:
    shown.show_section(section)
    browser = shown.browser
    assert Path(browser.source().toLocalFile()).name == "troubleshooting.md"
    bar = browser.verticalScrollBar()
    first = browser.cursorForPosition(QPoint(browser.width() // 2, 8)).block()
    assert anchor_of(first.text()) == section or bar.value() == bar.maximum()
    assert bar.value() > 0


def test_what_to_do_about_a_device_opens_the_guide(window: Any) -> None:
    window.tabs.help_wanted.emit("nothing-answers")
    told = window._help.browser
    assert Path(told.source().toLocalFile()).name == "troubleshooting.md"
    assert told.verticalScrollBar().value() > 0


@pytest.mark.parametrize("link", ["https://example.org/", "missing.md", "images/guide-log.png"])
def test_other_links_lead_nowhere(shown: HelpWindow, link: str) -> None:
    before = shown.browser.source()
    shown.browser.anchorClicked.emit(QUrl(link))
    assert shown.browser.source() == before


def test_without_guides_it_says_where_the_keys_are(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> Path:
        raise UnusableInput("not installed")

    monkeypatch.setattr(help_module, "guides_folder", missing)
    window = HelpWindow()
    qtbot.addWidget(window)
    assert "Ctrl+," in window.browser.toPlainText()
    guide = window.findChild(QPushButton, "help_guide")
    assert guide is not None
    assert not guide.isEnabled()
