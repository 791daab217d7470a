"""Draw a recorded test into a picture, with the widgets of the window and without a display."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

from PySide6.QtWidgets import QApplication

from rigapp.gui.data.connection import EngineConnection
from rigapp.gui.data.showntest import ShownTest
from rigapp.gui.look.dress import apply_theme
from rigapp.gui.look.tokens import THEMES
from rigapp.gui.window.window import WINDOW, MainWindow
from rigapp.replay.client import ReplayClient

WAIT_S = 30.0  # far longer than reading takes


def save_picture(path_h5: Path, target_png: Path, *, theme: str = "light", tab: int = 0) -> None:
    """Draw the window as it stands at the end of a recorded test into a PNG of 1440 x 900.

    Raises UnusableInput when the file is not a readable test, TimeoutError when it cannot be read
    within half a minute, OSError when the picture cannot be written.
    """
    if QApplication.instance() is None:
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
        _keep.append(QApplication(sys.argv[:1]))
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    apply_theme(application, THEMES[theme])
    client = ReplayClient(path_h5, at_end=True)
    window = MainWindow(EngineConnection(lambda: client), ShownTest(), THEMES[theme])
    window.resize(*WINDOW)
    window.show()
    window.tabs.setCurrentIndex(tab)
    try:
        _wait_for_history(application, window, path_h5)
        application.processEvents()
        if not window.grab().save(str(target_png), "PNG"):
            raise OSError(f"{target_png}: the picture cannot be written; check folder and space.")
    finally:
        window.close()


_keep: list[QApplication] = []


def _wait_for_history(application: QApplication, window: MainWindow, path: Path) -> None:
    deadline = time.monotonic() + WAIT_S
    while not window.settled:
        if time.monotonic() > deadline:
            raise TimeoutError(f"{path} was not read and drawn within {WAIT_S:g} s.")
        window.tick()
        application.processEvents()
        time.sleep(0.02)
    window.draw_now()
