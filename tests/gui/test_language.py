"""The window's languages: every text is in the catalogue, translated, the engine's words too."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from pathlib import Path
from string import Formatter
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QGroupBox,
    QLabel,
    QLineEdit,
    QTableView,
    QWidget,
)

from rigapp.checks.start import preflight
from rigapp.config.names import login_name
from rigapp.config.ranges import refusal
from rigapp.gui.language import chosen_language, speak_language
from rigapp.gui.language.collect import all_templates, all_texts, has_words, texts_of
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.window.tabs import NUMBERS, TABS, Tab
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.catalogue import LANGUAGES, SENTENCES, WINDOW, contexts, translations
from rigapp.presentation.numbers import unit_text
from rigapp.presentation.translation import ENGLISH, speak, tr, translate
from rigapp.schema.alarms import KINDS, exceeded, make_alarm
from rigapp.schema.criteria import CRITERIA
from rigapp.schema.messages import Alarm, RunState, Severity
from rigapp.schema.units import UNITS
from rigapp.texts import Sentence, say
from rigapp_calibration.load_cell.plans import LoadCellPlan, PlanKind

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
    what = "make translations, then translate in de.ts"
    texts, told = gathered()
    assert set(texts) - contexts(language)[WINDOW].keys() == set(), what
    assert set(told) - contexts(language)[SENTENCES].keys() == set(), what


def test_every_text_is_collected_without_its_details() -> None:
    assert [one for one in gathered()[0] if "‹" in one or "›" in one] == []


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
    assert texts_of().loose == []


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
    assert {text for text in texts.texts if text != "In the call"} == {
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
    assert tr("{name} has control", name="Ann {B}") == "Ann {B} hat die Steuerung"
    speak_language(qapp, ENGLISH)
    assert tr("{} of {}", 3, 5) == "3 of 5"


def test_the_alarms_of_the_engine_are_said_with_their_values(qapp: Any) -> None:
    speak_language(qapp, "de")
    overload = make_alarm("overload", force_N=391.04, limit_N=380.0)
    assert translate(overload.sentence) == (
        "Die Gelenkkraft erreichte 391.0 N; die Grenze ist 380 N."
    )
    limit = exceeded("force_max", Severity.WARNING, 96.2, 95.0, True, "warn")
    assert translate(limit.title) == "force_max über der Grenze"
    assert translate(limit.sentence) == "force_max ist 96.2, über der Grenze (Warnung) von 95."
    more = say(" and {} more", 2)
    asked = say('Acknowledge "{}"{}: confirm that you have seen it.', overload.title, more)
    assert translate(asked).startswith("„Überlast“ und 2 weitere quittieren")
    assert translate("Nobody knows this sentence.") == "Nobody knows this sentence."
    assert [
        one
        for kind in KINDS.values()
        for one in (kind.consequence, kind.action)
        if translate(Sentence(one)) == one
    ] == []


def test_sentences_of_files_checks_and_calibrations_are_known_again(qapp: Any) -> None:
    speak_language(qapp, "de")
    assert translate(refusal("run.speed_rpm", 9999.0)) == (
        "run.speed_rpm = 9999 liegt außerhalb von 0.1 bis 3000 rpm;"
        " war Umdrehungen/h gemeint? Dann 166.65 schreiben"
    )
    assert translate(CRITERIA["force_N"].sentence(212.0, 200.0, 3)) == (
        "Das Maximum von |F| lag bei oder über 200 N in 3 Umdrehungen in Folge, zuletzt bei 212 N."
    )
    found = [translate(one.sentence) for one in preflight(None, None, None, None)]
    assert found == ["noch nicht brauchbar", "nicht erreichbar"]
    plan = LoadCellPlan(PlanKind.FULL, 40.0, (20.0, 10.0, 5.0, 2.0, 2.0, 1.0))
    steps = {translate(step.words) for step in plan.steps()}
    assert [one for one in steps if " the " in one or " and " in one] == []


def texts_on(widget: QWidget) -> Iterator[tuple[str, str]]:
    """Yield what a widget and all on it say, to eyes and ears, with the name of who says it."""
    for one in (widget, *widget.findChildren(QWidget)):
        said = [one.accessibleName(), one.toolTip(), one.accessibleDescription(), *_shown_by(one)]
        yield from ((one.objectName(), text) for text in said)


def _shown_by(one: QWidget) -> list[str]:
    """Return the texts of a widget by what it is."""
    match one:
        case ElidedLabel():
            return [one.whole]
        case QLabel() | QAbstractButton():
            return [one.text()]
        case QLineEdit():
            return [one.placeholderText()]
        case QGroupBox():
            return [one.title()]
        case QComboBox():
            return [one.itemText(at) for at in range(one.count())]
        case QuietPlot():
            captions = [one._axes[side].text for side in ("left", "bottom")]
            return [one.instead, one.marks.words, *captions]
        case QTableView() if one.objectName() not in RECORDS:
            return list(_cells(one.model()))
    return []


def _cells(model: Any) -> Iterator[str]:
    for way, many in ((Qt.Orientation.Horizontal, model.columnCount()),
                      (Qt.Orientation.Vertical, model.rowCount())):  # fmt: skip
        yield from (str(model.headerData(at, way, TEXT) or "") for at in range(many))
    for row, at in product(range(model.rowCount()), range(model.columnCount())):
        yield str(model.index(row, at).data() or "")


TEXT = Qt.ItemDataRole.DisplayRole
RECORDS = ("log_table", "journal_table")
"""What stands in the file of the test, as it stands there."""


NAMES = (
    "Simulated slider-crank", "The paper's wear test", "paper-20270101-080000.h5", "E. Sample",
    "quick.toml", "paper.toml", "force max", "force_max", "deg", "Ctrl", "Alt", "Force is high",
    "force_max is 212 N, warns above 200 N", "At 300 N for 3 cycles the test stops",
    "Look at the joint; lower the speed or stop the test",
    "GSV-8 1.44", "RoboClaw 4.3", "daq", "drive", "PTFE bushing 1", "/dev/pts/3", "socket://127",
    "examples/quick.toml", "title", *LANGUAGES.values(), login_name(),
)  # fmt: skip
"""What is not the window's own in what it shows: names of rig, test, people, files and keys, and
an alarm that no engine raises."""


SIGNS = {text for one in UNITS for text in (one.words, unit_text(one.words)) if len(text) > 1}
"""Units, as files and window write them."""


def outside_brackets(text: str) -> str:
    """Return what is left of a text without brackets, one in another, and without names."""
    while text != (text := re.sub(r"⟦[^⟦⟧]*⟧", "", text)):
        pass
    text = text.replace("\N{NON-BREAKING HYPHEN}", "-")  # of the rig's name on the narrow rail
    for name in sorted(NAMES, key=len, reverse=True):
        text = text.replace(name, "")
    text = re.sub(r"\b[a-z]+(?:[._][A-Za-z0-9_]+)+", "", text)  # keys of files, names of channels
    for sign in sorted(SIGNS, key=len, reverse=True):
        text = text.replace(sign, "")
    return text


@cache
def gathered() -> tuple[list[str], list[str]]:
    """Return the texts of the window, and the templates of what others tell."""
    return all_texts(), all_templates()


def bracketed() -> None:
    """Put the texts of the catalogue into brackets: what has words outside of them is not in it."""
    texts, told = gathered()
    speak({text: f"⟦{text}⟧" for text in (*texts, *told)})


@pytest.mark.sampled
@pytest.mark.parametrize("tab", TABS, ids=[tab.name for tab in TABS])
def test_everything_on_a_page_is_said_by_the_catalogue(
    tab: Tab, engine: Any, recorded: Path, request: pytest.FixtureRequest
) -> None:
    bracketed()
    window: MainWindow = request.getfixturevalue("window")
    attach: Callable[[], None] = request.getfixturevalue("attach")
    page = window.tabs.widget(NUMBERS[tab.name])
    bare = {one for one in texts_on(page) if has_words(outside_brackets(one[1]))}
    engine.say(first=1, count=300, file=str(recorded))
    attach()
    window.tabs.show_page(tab.name)
    window.draw_now()
    bare |= {one for one in texts_on(page) if has_words(outside_brackets(one[1]))}
    assert bare == set()


@pytest.mark.long
def test_everything_on_the_shell_is_said_by_the_catalogue(
    engine: Any, alarm: Alarm, request: pytest.FixtureRequest
) -> None:
    bracketed()
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
