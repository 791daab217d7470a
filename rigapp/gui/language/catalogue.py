"""Choose the language of the window and load its catalogue, with that of Qt's own dialogs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from PySide6.QtCore import (
    QCoreApplication,
    QLibraryInfo,
    QLocale,
    QTranslator,
    QXmlStreamReader,
)

from rigapp.presentation.translation import speak

ENGLISH: Final = "en"
LANGUAGES: Final = {ENGLISH: "English", "de": "Deutsch"}
"""What the window speaks, by the code of ISO 639; all but English has a catalogue beside this."""


def chosen_language(wanted: str, system: Sequence[str] | None = None) -> str:
    """Return the code of the language to speak.

    wanted: as chosen by the user, empty: as the system. system: its languages, the best first
    (``de-DE``), asked for unless given. English where none of them is spoken.
    """
    asked = [wanted] if wanted else system if system is not None else QLocale.system().uiLanguages()
    codes = (one.replace("_", "-").partition("-")[0] for one in asked)
    return next((code for code in codes if code in LANGUAGES), ENGLISH)


def catalogue_file(language: str) -> Path:
    """Return the file of a catalogue."""
    return Path(__file__).with_name(f"{language}.ts")


WINDOW: Final = "rigapp"
SENTENCES: Final = "sentences"
"""Under which texts stand in a catalogue: those of the window, and the templates of sentences."""


def contexts(language: str) -> dict[str, dict[str, str]]:
    """Return the translations of a catalogue by their English texts, by what they stand under.

    Unfinished ones are left out. Raises OSError when it cannot be read.
    """
    reader = QXmlStreamReader(catalogue_file(language).read_text("utf-8"))
    found: dict[str, dict[str, str]] = {WINDOW: {}, SENTENCES: {}}
    text, under = "", WINDOW
    while reader.readNextStartElement() or not reader.atEnd():
        if not reader.isStartElement():
            continue
        if reader.name() == "name":
            under = reader.readElementText()
        elif reader.name() == "source":
            text = reader.readElementText()
        elif reader.name() == "translation":
            finished = not reader.attributes().hasAttribute("type")
            said = reader.readElementText()
            if finished and said:
                found[under][text] = said
    return found


def translations(language: str) -> dict[str, str]:
    """Return all translations of a catalogue by their English texts; raise OSError."""
    found = contexts(language)
    return found[SENTENCES] | found[WINDOW]


def speak_language(application: QCoreApplication, language: str) -> None:
    """Let the window, and Qt's own dialogs, speak a language from the next widget on.

    Raises OSError when its catalogue cannot be read.
    """
    for old in application.findChildren(QTranslator):
        application.removeTranslator(old)
        old.deleteLater()
    if language == ENGLISH:
        speak(None)
        return
    dialogs = QTranslator(application)
    folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
    if dialogs.load(f"qtbase_{language}", folder):
        application.installTranslator(dialogs)
    speak(translations(language))
