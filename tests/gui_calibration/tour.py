"""Every page of every subject of the wizard, driven on scripted rigs, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.calibrating.run_out import GRID_DEG
from rigapp.calibrating.session import Outcome, Rig
from rigapp.gui.window.calibrating import CHOICES, CalibrationChooser
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.schema.messages import Reply
from tests.gui_calibration.conftest import SETTINGS, ScriptedRig
from tests.gui_calibration.test_probe_wizard import ScriptedProbes

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = Rig("Rig", True, "E. Sample", EXAMPLES / "simulated.toml", EXAMPLES / "quick.toml")


def rolling_rig(folder: Path) -> Rig:
    """Return the simulated rig whose files stand in a folder, for slow rolls."""
    simulated = "Simulated slider-crank"
    return Rig(simulated, True, "E. Sample", folder / "rig.toml", folder / "t.toml")


LOOKS = 3000
Made = Callable[..., CalibrationWizard]
"""Make a wizard: what answers it, the key of what is chosen, and more of its arguments."""


def make_wizard(window: Any, folder: Path, line: Any, which: str, **more: Any) -> CalibrationWizard:
    """Show the wizard of a choice in a window; only the caller ticks it."""
    choice = CHOICES[which]
    wizard = CalibrationWizard(
        line, RIG, window.theme, folder, parent=window,
        subject=choice.subject, fields=choice.fields, **more,
    )  # fmt: skip
    wizard.live._timer.stop()
    window.guide.wizard = wizard
    wizard.finished.connect(window.guide.end)
    window.stage.take(wizard)
    window.stage.dress(window.theme)
    window.guide.show(wizard)
    wizard.live.tick()
    return wizard


def looked(wizard: CalibrationWizard, until: Callable[[], object]) -> None:
    """Look at the rig until something is so."""
    for _ in range(LOOKS):
        wizard.live.tick()
        if until():
            return
    told = wizard.readings.problem.text(), wizard.live.readiness, wizard.result_page.problems.text()
    raise AssertionError(f"it did not come: {told}")


def ahead(wizard: CalibrationWizard, until: Callable[[], object]) -> None:
    """Let the simulated hands go ahead until something is so, and do the step that follows."""
    live = wizard.live
    live.goes_ahead = True
    looked(wizard, lambda: until() or wizard.readings.isComplete())
    live.goes_ahead = False
    live.perform_step()
    live.tick()
    live.tick()


def _ends(wizard: CalibrationWizard, what: str) -> Iterator[str]:
    """Go to the result and, where there is a record, to the certificate; then close."""
    wizard.next()
    looked(wizard, lambda: wizard.live.outcome is not None)
    yield f"{what}: result"
    if wizard.live.outcome.makes_record:
        wizard.next()
        wizard.certificate.use.click()
        yield f"{what}: certificate"
    wizard.reject()


def load_cell(make: Made, folder: Path) -> Iterator[str]:
    """Take the load cell from its plan to its certificate, creep included."""
    settings = folder / "settings.toml"
    settings.write_text(SETTINGS, "utf-8")
    wizard = make(ScriptedRig().line, "load cell", settings=settings)
    yield "load cell: plan"
    wizard.next()
    looked(wizard, wizard.angle.isComplete)
    wizard.angle.turn.click()
    yield "load cell: angle"
    wizard.next()
    ahead(wizard, lambda: len(wizard.live.session.procedure.taken) > 20)
    yield "load cell: readings"
    ahead(wizard, lambda: wizard.live.session.procedure.step.optional)
    yield "load cell: creep"
    ahead(wizard, wizard.readings.isComplete)
    yield "load cell: all readings"
    yield from _ends(wizard, "load cell")


def daily(make: Made, folder: Path) -> Iterator[str]:
    """Take the daily check of a cell whose sensitivity is not the one in use."""
    wizard = make(ScriptedRig().line, "daily")
    yield "daily: plan"
    wizard.next()
    looked(wizard, wizard.angle.isComplete)
    wizard.next()
    ahead(wizard, lambda: len(wizard.live.session.procedure.taken) > 1)
    yield "daily: readings"
    ahead(wizard, wizard.readings.isComplete)
    wizard.next()
    looked(wizard, lambda: wizard.result_page.chart is not None)
    yield "daily: result"
    wizard.reject()


def probes(make: Made, folder: Path) -> Iterator[str]:
    """Take both probes."""
    wizard = make(ScriptedProbes().line, "both")
    wizard.plan.fields["plan"].setCurrentIndex(0)
    yield "probes: plan"
    wizard.next()
    ahead(wizard, lambda: len(wizard.live.session.procedure.taken) > 10)
    yield "probes: readings"
    ahead(wizard, wizard.readings.isComplete)
    yield from _ends(wizard, "probes")


STANDS = {"state": "ready", "file": "", "revolution": 0, "reason": ""}
WAVE = 3.0 * np.sin(np.radians(np.arange(0.0, 360.0, GRID_DEG)))
MAP = Outcome(
    "run-out map",
    {"accepted": True, "problems": [], "map_um": [WAVE, WAVE]},
    (
        "Run-out of the pin: 6.0 um peak to peak along the follower, 6.0 um across it, from 24"
        " revolutions at 3, 6 rpm.",
        "Expanded uncertainty 0.4 um (k = 2).",
    ),
)


def run_out(make: Made, folder: Path) -> Iterator[str]:
    """Roll the pin; the map is given, for no spindle turns here."""
    wizard = make(lambda verb, told, handler: handler(Reply(ok=True, result=STANDS)), "run-out")
    yield "run-out: plan"
    wizard.next()
    assert wizard.currentPage() is wizard.readings, wizard.plan.problem.text()
    yield "run-out: rolls"
    wizard.live.session.judge = lambda: MAP
    wizard.live.session._outcome = MAP
    wizard.live.session.save = lambda outcome, to: outcome
    yield from _ends(wizard, "run-out")


def tour_of_choices(window: Any) -> Iterator[tuple[str, CalibrationChooser]]:
    """Yield what is asked before a wizard opens."""
    window.guide.open()
    yield "choices", window.findChild(CalibrationChooser)
    window.guide.end()


SUBJECTS = {"load cell": load_cell, "daily": daily, "probes": probes, "run-out": run_out}


def tour(window: Any, folder: Path, subject: str) -> Iterator[tuple[str, CalibrationWizard]]:
    """Yield the name of each page of a subject as it is seen in a window, and the wizard."""
    for name in SUBJECTS[subject](partial(make_wizard, window, folder), folder):
        yield name, window.guide.wizard
