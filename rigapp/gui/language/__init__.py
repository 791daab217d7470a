"""The language of the window: English texts are in the source, all others in catalogues.

``presentation.translation.tr`` translates a text; this module chooses a language and loads its
catalogue, with that of Qt's own dialogs. ``collect`` gathers the texts from the source (``make
translations``). Texts of files, logs and terminals stay English.
"""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import (
    QCoreApplication,
    QLibraryInfo,
    QLocale,
    QTranslator,
)

from rigapp.presentation.catalogue import LANGUAGES, translations
from rigapp.presentation.translation import ENGLISH, speak


def chosen_language(wanted: str, system: Sequence[str] | None = None) -> str:
    """Return the code of the language to show.

    wanted: the user's choice, empty: as the system. system: its languages in order of preference
    (``de-DE``), by default those of Qt. English where none of them has a catalogue.
    """
    requested = (
        [wanted] if wanted else system if system is not None else QLocale.system().uiLanguages()
    )
    codes = (tag.replace("_", "-").partition("-")[0] for tag in requested)
    return next((code for code in codes if code in LANGUAGES), ENGLISH)


def speak_language(application: QCoreApplication, language: str) -> None:
    """Show the window, and Qt's own dialogs, in a language from the next widget on.

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
    speak(translations(language), language)
