"""Make the pictures of docs/calibration.md: both wizards with the simulated operator."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

SETTINGS = """schema = 1
[cell]
name = "Pin cell"
[place]
gravity_m_s2 = 9.8123
"""
WITHIN_S = 400.0
LOAD_CELL_READINGS, PROBE_READINGS = 25, 40
LEAST_REACH_UM = 100.0
RESULT_HEIGHT = 420
"""Height of the picture; below it there are only paths of this computer."""


class Line:
    """Send requests to an engine of this process from a worker thread, as the window does."""

    def __init__(self, host: Any) -> None:
        from rigapp.viewer.tasks import TaskWorker

        self._host = host
        self.worker = TaskWorker("pictures", bound=64)

    def __call__(self, verb: str, arguments: dict[str, Any], handler: Any) -> None:
        """Queue a request."""
        from rigapp.schema.messages import Request

        request = Request(verb=verb, arguments=arguments, operator="E. Sample")
        self.worker.submit(lambda: self._host.handle(request), handler, _raise)


def _raise(error: Exception) -> None:
    raise error


def take_calibrations(folder: Path, rig: Path, images: Path) -> None:
    """Calibrate load cell and probes; write pictures half-way and at the end to ``images``."""
    from PySide6.QtWidgets import QApplication

    from rigapp.config.loading import read_rig
    from rigapp.gui.look.dress import apply_theme
    from rigapp.presentation.tokens import LIGHT
    from rigapp.service.host import EngineHost

    application = QApplication.instance() or QApplication([])
    assert isinstance(application, QApplication)
    apply_theme(application, LIGHT)
    host = EngineHost(read_rig(rig), 20.0)
    line = Line(host)
    try:
        host.connect()
        _load_cell(line, folder, rig, images, application)
        _probes(line, folder, rig, images, application)
    finally:
        line.worker.close()
        host.close()


@contextmanager
def _opened(line: Line, folder: Path, rig: Path, application: Any, **more: Any) -> Iterator[Any]:
    """Yield a visible wizard, and a function that waits for a condition."""
    from rigapp.calibrating.session import Rig
    from rigapp.gui.wizard.wizard import CalibrationWizard
    from rigapp.presentation.tokens import LIGHT

    virtual_rig = Rig("Simulated slider-crank", True, "E. Sample", rig)
    wizard = CalibrationWizard(line, virtual_rig, LIGHT, folder, **more)
    wizard.resize(1040, 820)
    wizard.show()
    yield wizard, partial(_pump, wizard, line, application)
    wizard.reject()


def _load_cell(line: Line, folder: Path, rig: Path, images: Path, application: Any) -> None:
    settings = folder / "settings.toml"
    settings.write_text(SETTINGS, "utf-8")
    with _opened(line, folder, rig, application, settings=settings) as (wizard, pump):
        live = wizard.live
        wizard.next()
        live.perform_step()
        pump(wizard.angle.isComplete, "the angle")
        wizard.next()
        live.goes_ahead = True
        pump(lambda: len(live.session.procedure.taken) > LOAD_CELL_READINGS, "half of the readings")
        live.goes_ahead = False
        pump(wizard.readings.record.isEnabled, "a steady reading")
        _grab(wizard, application, images / "calibration-reading.png")
        live.goes_ahead = True
        pump(wizard.readings.isComplete, "all readings")
        wizard.next()
        pump(lambda: live.outcome is not None, "the verdict")
        _grab(wizard, application, images / "calibration-result.png", RESULT_HEIGHT)


def _probes(line: Line, folder: Path, rig: Path, images: Path, application: Any) -> None:
    both = {"subject": "probes", "fields": {"which": "both"}}
    with _opened(line, folder, rig, application, **both) as (wizard, pump):
        live, reach = wizard.live, wizard.plan.fields["reach"]
        pump(lambda: reach.value() > LEAST_REACH_UM, "the probes' range")
        wizard.next()
        live.goes_ahead = True
        pump(lambda: len(live.session.procedure.taken) > PROBE_READINGS, "some of the steps")
        live.goes_ahead = False
        pump(wizard.readings.record.isEnabled, "a steady reading")
        _grab(wizard, application, images / "calibration-probes.png")


def _pump(wizard: Any, line: Line, application: Any, until: Callable[[], bool], what: str) -> None:
    deadline = time.monotonic() + WITHIN_S
    while not until():
        if time.monotonic() > deadline:
            raise TimeoutError(f"{what} did not come in {WITHIN_S:g} s: {wizard.live.readiness}")
        wizard.live.tick()
        line.worker.deliver()
        application.processEvents()
        time.sleep(0.005)


def _grab(wizard: Any, application: Any, path: Path, height: int = 0) -> None:
    for _ in range(20):
        application.processEvents()
        time.sleep(0.02)
    picture = wizard.grab()
    picture.copy(0, 0, picture.width(), height or picture.height()).save(str(path))
