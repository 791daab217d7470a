"""The wizard's pages as they are seen: in the window's room, with their picture, read from afar."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton

from rigapp.calibrating.session import Rig
from rigapp.gui.wizard.scenes import (
    LevelScene,
    Picture,
    Piece,
    ProbeScene,
    RollScene,
    Scene,
    WeightScene,
    stack_of,
)
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.tokens import DARK, LIGHT
from tests.gui_calibration.test_probe_wizard import ScriptedProbes


def primary(wizard: CalibrationWizard) -> list[str]:
    """Return the names of the primary buttons that can be seen."""
    found = wizard.findChildren(QPushButton)
    return [
        one.objectName() for one in found if one.property("rank") == "primary" and one.isVisible()
    ]


def test_weights_are_drawn_as_they_stay_come_and_go() -> None:
    assert stack_of((5.0, 5.0, 2.0), (5.0, 1.0)) == [
        Piece("5 kg"),
        Piece("+ 5 kg", added=True),
        Piece("+ 2 kg", added=True),
        Piece("\u2212 1 kg", removed=True),
    ]
    assert stack_of((5.0,) * 8) == [Piece("+ 8 \u00d7 5 kg", added=True)]
    assert stack_of(()) == []


SCENES: tuple[Callable[[float], Scene], ...] = (
    lambda at: WeightScene(at, at - 1.0, (Piece("5 kg", added=True),), 49.0),
    lambda at: WeightScene(at, at - 1.0, turning=True),
    LevelScene,
    lambda at: ProbeScene(1, 100.0 * at, 800.0, 90.0 * at, back=at > 1.0),
    lambda at: RollScene(f"{at:g} rpm", turning=True),
)


@pytest.mark.parametrize("scene", SCENES)
def test_a_picture_follows_its_step_and_the_theme(
    scene: Callable[[float], Scene], qtbot: Any
) -> None:
    picture = Picture("picture", "What it looks like", LIGHT)
    qtbot.addWidget(picture)
    picture.resize(400, 300)
    seen = []
    for theme, at in ((LIGHT, 0.5), (LIGHT, 2.0), (DARK, 2.0)):
        picture.dress(theme)
        picture.show_scene(scene(at))
        seen.append(picture.grab().toImage())
    assert seen[0] != seen[1]
    assert seen[1] != seen[2]


def test_each_page_has_one_primary_button_and_what_is_measured_is_large(
    wizard: Any, scripted: Any, qtbot: Any
) -> None:
    assert primary(wizard) == ["wizard_next"]
    wizard.next()
    assert primary(wizard) == []
    for _ in range(3):
        wizard.live.tick()
    assert primary(wizard) == ["wizard_begin_readings"]
    wizard.next()
    live, page = wizard.live, wizard.readings
    assert primary(wizard) == ["record"]
    assert page.record.text() == "The pin is &turned"
    live.goes_ahead = True
    for _ in range(400):
        live.tick()
        if live.session.procedure.step.value > 20.0:
            break
    live.goes_ahead = False
    live.perform_step()
    live.tick()
    felt, wanted = page.measured.value.whole, live.session.expected()
    assert float(felt.removesuffix(" N")) == pytest.approx(wanted, rel=0.05)
    assert page.measured.value.font().pointSizeF() > 2.0 * page.font().pointSizeF()
    assert page.measured.wanted.text() == f"It should be {wanted:.1f} N"
    assert isinstance(page.picture.scene, WeightScene)
    assert page.picture.scene.weight_N == pytest.approx(wanted)
    assert wizard.steps.rows[2].line.whole.endswith(" of 112")


def test_probe_and_spindle_are_measured_and_drawn(qtbot: Any, tmp_path: Path) -> None:
    probes = ScriptedProbes()
    rig = Rig("Scripted rig", True, "E. Sample")
    wizard = CalibrationWizard(
        probes.line, rig, LIGHT, tmp_path, subject="probes", fields={"which": "2"}
    )
    qtbot.addWidget(wizard)
    wizard.live._timer.stop()
    wizard.show()
    wizard.live.tick()
    assert wizard.plan.values["which"] == "2"
    wizard.next()
    page, live = wizard.readings, wizard.live
    live.goes_ahead = True
    for _ in range(100):
        live.tick()
        if len(live.session.procedure.taken) > 2:
            break
    live.goes_ahead = False
    live.perform_step()
    live.tick()
    scene = page.picture.scene
    assert isinstance(scene, ProbeScene)
    assert scene.probe == 2
    assert scene.indicated_um == pytest.approx(scene.position_um, abs=60.0)
    assert page.measured.value.whole.endswith(" µm")
    assert primary(wizard) == ["probe_record"]
    wizard.dress(DARK)
    wizard.reject()
    rolls = CalibrationWizard(probes.line, rig, LIGHT, tmp_path, subject="run-out")
    qtbot.addWidget(rolls)
    rolls.live._timer.stop()
    rolls.show()
    assert isinstance(rolls.plan.picture.scene, RollScene)
    rolls.reject()


def test_every_choice_is_pressed_by_a_letter(qtbot: Any) -> None:
    from rigapp.gui.window.calibrating import CHOICES, CalibrationChooser

    chooser = CalibrationChooser()
    qtbot.addWidget(chooser)
    chooser.show()
    letters = [one.text.split("&")[1][0].lower() for one in CHOICES.values()]
    assert len(set(letters)) == len(letters)
    with qtbot.waitActive(chooser, timeout=PATIENCE_MS):
        chooser.activateWindow()
    with qtbot.waitSignal(chooser.chosen, timeout=PATIENCE_MS) as heard:
        qtbot.keyClick(chooser, Qt.Key.Key_D, Qt.KeyboardModifier.AltModifier)
    assert heard.args == ["daily"]
