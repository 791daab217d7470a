"""The window's languages: every text is in the catalogue, translated, the engine's words too."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from string import Formatter
from typing import Any

import pytest
from PySide6.QtWidgets import QAbstractButton, QLabel, QLineEdit, QWidget

from rigapp.gui.language.catalogue import (
    ENGLISH,
    LANGUAGES,
    chosen_language,
    speak_language,
    translations,
)
from rigapp.gui.language.collect import all_texts, has_words, texts_of, texts_of_tables
from rigapp.gui.language.told import retold, templates
from rigapp.gui.language.words import speak, tr
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.window.window import MainWindow
from rigapp.schema.alarms import because, exceeded
from rigapp.schema.messages import Alarm, RunState, Severity

CONVERTED = ("window/", "widgets/", "wizard/", "language/", "look/", "panel.py")
"""Rooms all of whose texts are in the catalogue."""

TRANSLATED = sorted(LANGUAGES.keys() - {ENGLISH})


@pytest.fixture(autouse=True)
def _english_afterwards(qapp: Any) -> Iterator[None]:
    yield
    speak_language(qapp, ENGLISH)


def fields(text: str) -> list[str]:
    """Return what a text puts in the place of its braces, numbered where they have no name."""
    named = [name for _, name, _, _ in Formatter().parse(text) if name is not None]
    return sorted(name or str(number) for number, name in enumerate(named))


@pytest.mark.parametrize("language", TRANSLATED)
def test_every_text_of_the_window_is_translated(language: str) -> None:
    found = translations(language)
    here = {text for text, place in texts_of().found.items() if place[0].startswith(CONVERTED)}
    wanted = here.union(one for one in texts_of_tables() if has_words(one))
    assert wanted - found.keys() == set(), "make translations, then translate in de.ts"


@pytest.mark.parametrize("language", TRANSLATED)
def test_a_translation_keeps_values_access_keys_dots_and_units(language: str) -> None:
    for text, said in translations(language).items():
        assert fields(said) == fields(text), text
        assert text.count("&") == said.count("&"), text
        assert text.endswith("…") == said.endswith("…"), text
        unit = re.compile(r"(?<![\w&])(?:N|µm|mm|rpm|Hz|kg|°C|%)(?![\w&])")
        assert sorted(unit.findall(said)) == sorted(unit.findall(text)), text


def test_no_text_of_the_window_is_shown_past_the_catalogue() -> None:
    """See that no literal, and no sentence glued together, reaches the screen untranslated."""
    assert [place for place in texts_of().loose if place[0].startswith(CONVERTED)] == []


def test_the_gathering_finds_texts_and_what_is_glued_together(tmp_path: Path) -> None:
    (tmp_path / "sample.py").write_text(
        "TABLE: Final[dict[str, Text]] = {'a_key': 'In a table'}\n"
        "class Part:\n"
        "    def __init__(self, name: str, spoken: Text = 'By default') -> None: ...\n"
        "class Other(Part):\n"
        "    def __init__(self) -> None:\n"
        "        super().__init__('other_part', 'To a base')\n"
        "def make(count: int) -> Text:\n"
        "    Part('a_name', tr('In the call') if count else 'Chosen')\n"
        "    label.setText('Past it')\n"
        "    Part('b_name', f'{count} pieces')\n"
        "    return 'Returned'\n",
        "utf-8",
    )
    texts = texts_of(tmp_path)
    assert {text for text in texts.found if text != "In the call"} == {
        "In a table",
        "By default",
        "To a base",
        "Chosen",
        "Returned",
    }
    assert [line for _, line in texts.loose] == [9, 10]


def test_the_language_is_the_chosen_one_or_that_of_the_system() -> None:
    assert chosen_language("de", ["en-GB"]) == "de"
    assert chosen_language("", ["fr-FR", "de-AT", "en-GB"]) == "de"
    assert chosen_language("", ["de_DE"]) == "de"
    assert chosen_language("", ["C"]) == ENGLISH
    assert chosen_language("", []) == ENGLISH


def test_what_no_catalogue_knows_is_said_as_it_is_and_values_are_filled_in(qapp: Any) -> None:
    speak_language(qapp, "de")
    assert tr("quick-20270101.h5 {") == "quick-20270101.h5 {"
    assert tr("{} of {}", 3, 5) == "3 von 5"
    assert tr("{name} is in command", name="Ann {B}") == "Ann {B} hat das Kommando"
    speak_language(qapp, ENGLISH)
    assert tr("{} of {}", 3, 5) == "3 of 5"


def test_the_alarms_of_the_engine_are_said_with_their_values(qapp: Any) -> None:
    speak_language(qapp, "de")
    overload = because("overload", force_N=391.04, limit_N=380.0)
    assert retold(overload.sentence) == ("Die Gelenkkraft erreichte 391.0 N; die Grenze ist 380 N.")
    limit = exceeded("force_max", Severity.WARNING, 96.2, 95.0, True, "warn")
    assert retold(limit.title) == "force_max über der Grenze"
    assert retold(limit.sentence) == "force_max ist 96.2, über der Grenze (warning) von 95."
    asked = 'Acknowledge "Overload" and 2 more: say that you have seen it.'
    assert retold(asked).startswith("„Überlast“ und 2 weitere quittieren")
    assert retold("Nobody knows this sentence.") == "Nobody knows this sentence."
    assert [
        one for one in templates() if "{" not in one and has_words(one) and retold(one) == one
    ] == []


def texts_on(widget: QWidget) -> Iterator[tuple[str, str]]:
    """Yield what a widget and all on it say, to eyes and ears, with the name of who says it."""
    for one in (widget, *widget.findChildren(QWidget)):
        said = [one.accessibleName(), one.toolTip(), one.accessibleDescription()]
        if isinstance(one, ElidedLabel):
            said.append(one.whole)
        elif isinstance(one, QLabel | QAbstractButton):
            said.append(one.text())
        if isinstance(one, QLineEdit):
            said.append(one.placeholderText())
        yield from ((one.objectName(), text) for text in said)


NAMES = (
    "Simulated slider-crank", "The paper's wear test", "paper-20270101-080000.h5", "E. Sample",
    "quick.toml", "paper.toml", "force max", "force_max", "deg", "Ctrl", "Alt", "Force is high",
    "force_max is 212 N, warns above 200 N", "At 300 N for 3 cycles the test stops",
    "Look at the joint; lower the speed or stop the test",
    "GSV-8 1.44", "RoboClaw 4.3", "daq", "drive",
)  # fmt: skip
"""What is not the window's own in what it shows: names of rig, test, people, files and keys, and
an alarm that no engine raises."""


def outside_brackets(text: str) -> str:
    """Return what is left of a text without brackets, one in another, and without names."""
    while text != (text := re.sub(r"⟦[^⟦⟧]*⟧", "", text)):
        pass
    for name in sorted(NAMES, key=len, reverse=True):
        text = text.replace(name, "")
    return text


def test_everything_on_the_shell_is_said_by_the_catalogue(
    engine: Any, alarm: Alarm, request: pytest.FixtureRequest
) -> None:
    """Put the catalogue's texts into brackets: what has words outside of them is not in it."""
    speak({text: f"⟦{text}⟧" for text in all_texts()})
    window: MainWindow = request.getfixturevalue("window")
    attach: Callable[[], None] = request.getfixturevalue("attach")
    shell = (
        window.header, window.messages, window.controls, window.side, window.rail, window.start_bar,
        window.page_bar, window.replay_bar,
    )  # fmt: skip
    bare: set[tuple[str, str]] = set()
    for number, state in enumerate(RunState, 1):
        engine.say(first=number, count=1, state=state, alarms=(alarm,) if number % 2 else ())
        attach()
        for part in shell:
            for name, text in texts_on(part):
                if has_words(outside_brackets(text)):
                    bare.add((name, text))
    assert bare == set()
