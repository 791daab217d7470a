"""Second page: the angle reference, without which a common error of all angles stays unseen."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QCheckBox, QVBoxLayout

from rigapp.gui.widgets.build import button, filled, named, prose, row
from rigapp.gui.wizard.guide_page import TWO, GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.scenes import LevelScene, Picture
from rigapp.gui.wizard.simulated_operator import HandsPanel
from rigapp.gui.wizard.widgets import MeasuredCard, field, fields_form, number, sentence
from rigapp.presentation.tokens import GAP, Theme
from rigapp.presentation.translation import Text, tr

LEVEL: Text = (
    "Lay the level on the flat of the crank and turn the crank until the bubble is in the middle."
)
TAKEN: Text = "The angle reference has been taken already: begin the readings."
TURN: Text = "&Keep this angle; I turn the level end for end"
AGAIN: Text = "&Forget the first angle"


class AnglePage(GuidePage):
    """Enter the encoder's angle while the crank is level."""

    def __init__(self, live: LiveCalibration, theme: Theme) -> None:
        super().__init__("Angle reference")
        self._live = live
        self.instruction = self.asking("angle_instruction")
        why: Text = (
            "The encoder should show 0 degrees, or 360. Then turn the level end for end and do it"
            " again: the mean is free of the level's own error. 0.2 degrees of a common angle error"
            " turn every force by as much, and no reading shows it. Only a level does."
        )
        self.why = prose("angle_why", "Why a level", why)
        self.why.setProperty("role", "secondary")
        self.picture = Picture("angle_picture", "What it looks like", theme)
        self.measured = MeasuredCard("angle", "The encoder shows", theme)
        self.stability = self.measured.stability
        text: Text = "&Take the encoder's angle as it is now"
        self.follow = named(QCheckBox(tr(text)), "angle_follow", tr(text).replace("&", ""))
        self.follow.setChecked(True)
        angle: Text = "Angle that the encoder shows"
        self.shown = number("angle_shown", angle, -360.0, 360.0, 2, 0.1, "°")
        level: Text = "Standard uncertainty of the level"
        self.uncertainty = number("angle_uncertainty", level, 0.005, 5.0, 3, 0.01, "°")
        self.uncertainty.setValue(0.05)
        spoken: Text = "Keep this angle and turn the level end for end"
        self.turn = button("angle_turn", TURN, self._keep_first, spoken)
        self.first = sentence("angle_first", "The first angle")
        self._first_deg: float | None = None
        self.problem = sentence("angle_problem", "What is wrong on this page")
        self.hands = HandsPanel(live)
        form = fields_form()
        form.addRow(self.follow)
        field(form, "&Encoder shows", self.shown)
        field(form, "Standard &uncertainty of the level", self.uncertainty)
        questions = (self.measured, form, row(self.turn, None), self.first)
        now = filled(QVBoxLayout(), (*questions, None, self.problem))
        now.setSpacing(GAP)
        look = self.beside(TWO, (self.picture, 5), (now, 4))
        self.hold(self.instruction, self.why, (look, 1), self.hands)
        self.follow.toggled.connect(self._follow)
        self._follow(True)
        live.looked.connect(self._look)
        live.said.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Show the uncertainty of the settings."""
        session = self._live.session
        if session is not None:
            self.uncertainty.setValue(session.given.angle.standard_uncertainty_deg)
        self.hands.setVisible(self._live.trains)
        self._forget_first()
        self._look()

    def _keep_first(self) -> None:
        """Keep the angle as the first of two, or forget it."""
        if self._first_deg is not None:
            self._forget_first()
            return
        self.shown.interpretText()
        self._first_deg = self.shown.value()
        self.turn.setText(tr(AGAIN))
        self.uncertainty.setEnabled(False)
        self._tell_first()

    def _forget_first(self) -> None:
        self._first_deg = None
        self.turn.setText(tr(TURN))
        self.uncertainty.setEnabled(True)
        self._tell_first()

    def _tell_first(self) -> None:
        if self._first_deg is None:
            self.first.setText("")
            return
        session, second = self._live.session, self.shown.value()
        assert session is not None
        setting = session.given.angle.setting_standard_uncertainty_deg
        mean, own = 0.5 * (self._first_deg + second), 0.5 * (self._first_deg - second)
        self.first.setText(
            tr(
                "First {:+.2f} degrees, now {:+.2f} degrees with the level turned: mean {:+.2f} +-"
                " {:.3f} degrees; the level itself is off by {:+.2f} degrees.",
                self._first_deg,
                second,
                mean,
                setting / math.sqrt(2.0),
                own,
            )
        )

    def isComplete(self) -> bool:
        """Tell whether the crank stands at a known angle, or the reference was taken already."""
        live = self._live
        if live.session is None:
            return False
        if not self._due():
            return True
        return live.readiness is not None and live.readiness.ready and not live.hands_busy

    def validatePage(self) -> bool:
        """Take the reference, unless the journal holds it already."""
        for box in (self.shown, self.uncertainty):
            box.interpretText()
        if not self._due():
            return True
        shown, first = math.radians(self.shown.value()), self._first_deg
        if first is not None:
            one = math.radians(first)
            return self._live.attempt(lambda session: session.reference_reversed(one, shown))
        uncertainty = math.radians(self.uncertainty.value())
        return self._live.attempt(lambda session: session.reference(shown, uncertainty))

    def _due(self) -> bool:
        session = self._live.session
        return session is not None and bool(session.reference_is_due)

    def _follow(self, on: bool) -> None:
        self.shown.setEnabled(not on)
        self._look()

    def _look(self) -> None:
        live = self._live
        window, now = live.window, None
        self.stability.show_readiness(live.readiness)
        self.turn.setEnabled(self._due() and self.isComplete())
        taken = live.session is not None and not self._due()
        self.instruction.setText(tr(TAKEN if taken else LEVEL))
        if window is not None and window.angle is not None:
            now, degrees = window.angle, math.degrees(window.angle)
            if self.follow.isChecked():
                self.shown.setValue(degrees if degrees < 180.0 else degrees - 360.0)
        self._tell_first()
        told = "" if now is None else f"{math.degrees(math.remainder(now, math.tau)):+.2f}°"
        self.measured.show_value(told.replace("-", "\u2212"))
        self.picture.show_scene(LevelScene(now, turned=self._first_deg is not None))
        self.say_complete()
