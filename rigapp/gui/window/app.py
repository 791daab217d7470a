"""Start the operator's window, which is shown before it attaches to an engine."""

from __future__ import annotations

import logging
import sys
from pathlib import Path

from PySide6.QtCore import QSettings, QTimer
from PySide6.QtWidgets import QApplication

from rigapp.config.errors import UnusableInput
from rigapp.gui.language import chosen_language, speak_language
from rigapp.gui.look.dress import apply_theme
from rigapp.gui.look.preferences import Preference, Preferences
from rigapp.gui.window.selftest import run_self_test
from rigapp.gui.window.window import PROGRAM, MainWindow
from rigapp.presentation.catalogue import LANGUAGES
from rigapp.process.ending import end_at_once, termination_signals
from rigapp.process.memory import collect_when_due, end_of_loading, stop_automatic_collection
from rigapp.viewer.connection import ClientFactory, EngineConnection
from rigapp.viewer.showntest import ShownTest

log = logging.getLogger(__name__)

POLL_MS = 200  # delay of Ctrl-C that is not noticed
COLLECT_MS = 1000
LOADED_MS = 3000
"""Time after which the window is drawn and the engine has answered: its objects are then frozen."""


def main(
    client_factory: ClientFactory,
    *,
    rig_path: Path,
    tests: list[Path],
    results_folder: Path,
    start_test: Path | None = None,
    language: str = "",
) -> int:
    """Show the window until it is closed; return the exit status.

    client_factory: makes a client of the engine, on a worker thread, at the start and after every
    loss of the engine; it may be slow and may raise.
    start_test: a test to start as soon as the engine answers. language: its code, stored for the
    next start; empty: the stored one, or the system's.
    Return 1 without a window when the self test of the GUI library fails. Raises UnusableInput for
    a language without a catalogue.
    """
    application = QApplication.instance() or QApplication(sys.argv[:1])
    assert isinstance(application, QApplication)
    collect_between_events(application)
    application.setApplicationName("rigapp")
    application.setOrganizationName("rigapp")
    problems = run_self_test()
    if problems:
        sys.stderr.write("\n".join(problems) + "\n")
        return 1
    settings = QSettings()
    if language:
        if language not in LANGUAGES:
            raise UnusableInput(
                f"--language {language}: the window speaks {' and '.join(LANGUAGES)}; name one."
            )
        settings.setValue(Preference.LANGUAGE.value, language)
    preferences = Preferences(settings)
    speak_language(application, chosen_language(preferences.get(Preference.LANGUAGE)))
    theme = preferences.theme
    apply_theme(application, theme)
    rig = rig_path if rig_path.suffix == ".toml" else None
    window = MainWindow(
        EngineConnection(client_factory),
        ShownTest(),
        theme,
        rig=rig,
        tests=tests,
        results_folder=_results_folder(preferences, results_folder) if rig else results_folder,
        preferences=preferences,
        settings=settings,
        again=["gui", "--rig", str(rig)] if rig else ["replay", str(rig_path)],
    )
    window.setWindowTitle(f"{PROGRAM} – {rig_path.stem}")
    if start_test is not None:
        window.start_when_idle(start_test)
    window.show_first_page()
    window.show()
    QTimer.singleShot(0, window.start)
    QTimer.singleShot(LOADED_MS, window, end_of_loading)
    with termination_signals() as signals:
        look = QTimer(window)
        look.timeout.connect(lambda: _end_on_signal(signals, window, application))
        look.start(POLL_MS)
        return application.exec()


def collect_between_events(application: QApplication) -> QTimer:
    """Collect garbage by a timer in place of the automatic collection; return the timer."""
    stop_automatic_collection()
    timer = QTimer(application)
    timer.timeout.connect(collect_when_due)
    timer.start(COLLECT_MS)
    return timer


def _results_folder(preferences: Preferences, started: Path) -> Path:
    """Return the folder chosen by the user, created where missing; else that of the start."""
    chosen = preferences.get(Preference.RESULTS_FOLDER)
    if not chosen:
        return started
    try:
        Path(chosen).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        log.warning("%s cannot be used, results go to %s: %s", chosen, started, error)
        return started
    return Path(chosen)


def _end_on_signal(signals: list[str], window: MainWindow, application: QApplication) -> None:
    """Close for Ctrl-C, kill and a closed terminal; at a second signal end immediately."""
    if len(signals) > 1:
        end_at_once(f"interrupted twice by {signals[-1]}; the engine goes on.")
    if signals:
        window.close_without_question()
        application.quit()
