"""A window that hangs weights on the simulated rig's pin and tells so, to be killed then."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

# The source before the tests, whose folders bear the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[2]))

from collections.abc import Callable

from patience import PATIENCE_S
from PySide6.QtWidgets import QApplication, QPushButton

from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.messages import RunState
from rigapp.service.client import Client
from rigapp.service.launch import find_engine
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest


def until(condition: Callable[[], object], what: str, said: Callable[[], str] = str) -> None:
    """Let the window work until something is so; said: what it says in its place."""
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, f"{what} did not come: {said()}"
        QApplication.processEvents()
        time.sleep(0.005)


def hang_weights(window: MainWindow) -> None:
    """Open the calibration of the load cell and let the hands work until a weight hangs."""
    connection = window._connection
    until(lambda: connection.status is not None, "the engine")
    until(
        lambda: connection.status.engine.state in (RunState.READY, RunState.STOPPED), "the devices"
    )
    window.guide.open()
    window.stage.findChild(QPushButton, "choose_load_cell").click()
    until(lambda: window.guide.wizard is not None, "the wizard", window.controls.answer.text)
    wizard = window.guide.wizard
    until(wizard.plan.isVisible, "the plan")
    wizard.next()
    wizard.live.perform_step()
    until(wizard.angle.isComplete, "the angle")
    wizard.next()
    wizard.live.goes_ahead = True
    until(lambda: len(wizard.live.session.procedure.taken) > 2, "readings under load")


if __name__ == "__main__":
    application = QApplication([])
    rig, folder = Path(sys.argv[1]), Path(sys.argv[2])

    def client() -> Client:
        """Return a line to the engine that runs."""
        entry = find_engine(rig)
        assert entry is not None
        return Client(entry, "Ada")

    shown = MainWindow(
        EngineConnection(client), ShownTest(), LIGHT, rig=rig, tests=[], results_folder=folder
    )
    shown.show()
    shown.start()
    hang_weights(shown)
    print("weights hang", flush=True)
    application.exec()
