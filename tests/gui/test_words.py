"""The words of the alarm list mean the same in the window and in the operator's guide."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

from rigapp.engine.judging.alarms import AlarmBook
from rigapp.gui.panels.alarms import AlarmPanel
from rigapp.schema.alarms import KINDS, make_alarm
from rigapp.schema.words import WORDS

GUIDE = Path(__file__).parents[2] / "docs" / "operator.md"


def test_the_guide_has_the_table_of_words() -> None:
    text = GUIDE.read_text(encoding="utf-8")
    for word, meaning in WORDS.items():
        assert f"| *{word}* | {meaning} |\n" in text


def test_every_state_of_an_alarm_is_in_the_table() -> None:
    now = [1000.0]
    book = AlarmBook(lambda: now[0], lambda alarm, change, who: None)
    seen: set[str] = set()

    def look() -> None:
        seen.update(alarm.state for alarm in book.alarms())

    book.raise_alarm(make_alarm("drive_warning", drive="drive", warnings="hot"))
    book.raise_alarm(make_alarm("index_missed", revolutions=3.0))
    look()
    book.acknowledge("index_missed", "Ada")
    look()
    book.clear("index_missed")
    book.clear("drive_warning")
    look()
    book.shelve("drive_warning", "known", 60.0, "Ada")
    look()
    assert seen == {"unacknowledged", "acknowledged", "latched", "returned", "shelved"}
    assert seen <= set(WORDS)
    assert KINDS["drive_warning"].title in WORDS


def test_the_window_explains_a_word_where_it_stands(qtbot: Any, qapp: Any, alarm: Any) -> None:
    panel = AlarmPanel()
    qtbot.addWidget(panel)
    panel.show_alarms((msgspec.structs.replace(alarm, state="latched", title="Drive warning"),))
    card = panel.cards.cards[0]
    for label in (card.state, card.title):
        assert label.toolTip() == f"{label.text()}: {WORDS[label.text()]}"
