"""A wizard as a program of its own, to be killed: it goes ahead and tells how far it is."""

from __future__ import annotations

import os
import sys
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

# The source before the tests, whose folders bear the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[2]))

from typing import Any

from PySide6.QtWidgets import QApplication

from rigapp.calibrating import subjects
from rigapp.config.loading import read_rig
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.tokens import LIGHT
from rigapp.service.host import EngineHost
from tests.gui_calibration.test_probe_wizard import RIG, ScriptedProbes
from tests.gui_calibration.test_rolling import FEW
from tests.gui_calibration.test_story import HostLine
from tests.gui_calibration.tour import rolling_rig


def begun(subject: str, folder: Path) -> CalibrationWizard:
    """Return the wizard of a subject at its readings."""
    if subject == "probes":
        line: Any = ScriptedProbes().line
        wizard = CalibrationWizard(line, RIG, LIGHT, folder, subject=subject)
        wizard.show()
        wizard.live.tick()
    else:
        subjects.REVOLUTIONS = FEW
        host = EngineHost(read_rig(folder / "rig.toml"), 20.0)
        host.connect()
        line = HostLine(host)
        wizard = CalibrationWizard(line, rolling_rig(folder), LIGHT, folder, subject=subject)
        wizard.live.looked.connect(line.worker.deliver)
        wizard.live._timer.timeout.connect(line.worker.deliver)
        wizard.show()
        wizard.plan.fields["speeds"].setText("15")
    wizard.next()
    assert wizard.currentPage() is wizard.readings, wizard.plan.problem.text()
    return wizard


if __name__ == "__main__":
    application = QApplication([])
    shown = begun(sys.argv[1], Path(sys.argv[2]))
    shown.live.looked.connect(lambda: print(shown.readings.progress_words(), flush=True))
    if sys.argv[1] == "probes":
        shown.live.goes_ahead = True
    else:
        shown.readings.roll.click()
    application.exec()
