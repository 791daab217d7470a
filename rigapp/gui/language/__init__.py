"""The language of the window: what it says in English stands in the source, all else in catalogues.

``presentation.translation.tr`` says a text; here a language is chosen and its catalogue is loaded,
with that of Qt's own dialogs. ``collect`` gathers the texts out of the source (``make
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
    """Return the code of the language to speak.

    wanted: as chosen by the user, empty: as the system. system: its languages, the best first
    (``de-DE``), asked for unless given. English where none of them is spoken.
    """
    requested = (
        [wanted] if wanted else system if system is not None else QLocale.system().uiLanguages()
    )
    codes = (one.replace("_", "-").partition("-")[0] for one in requested)
    return next((code for code in codes if code in LANGUAGES), ENGLISH)


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
    speak(translations(language), language)
