"""Page of the angle reference; fields and pictures of each calibration type."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from PySide6.QtWidgets import QCheckBox, QVBoxLayout

from rigapp.calibrating.probe_session import usual_reach_um
from rigapp.calibrating.rolls import ORDERS, RollPlan, RollSession
from rigapp.config.calibration_settings import (
    CellSection,
    LoadCellFile,
    ProbeFile,
    ProbeSection,
    RunOutFile,
    load_cell_meaning,
)
from rigapp.gui.widgets.build import button, choice, edit, filled, named, prose, row, whole_number
from rigapp.gui.wizard.guide_page import TWO, GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.plan_page import RIG, Field, Questions, Values
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
from rigapp.gui.wizard.simulated_operator import SimulatedOperatorPanel
from rigapp.gui.wizard.taking_page import RollingCalibration, RollingPage, TakingPage, TakingWords
from rigapp.gui.wizard.widgets import MeasuredCard, PlotNames, field, fields_form, number, sentence
from rigapp.presentation.tokens import GAP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp_calibration.load_cell.plans import LoadCellPlan
from rigapp_calibration.load_cell.settings import GRAVITY
from rigapp_calibration.probes.plans import ProbePlan
from rigapp_calibration.probes.readings import FEWEST_POSITIONS
from rigapp_calibration.taking.procedure import Step, StepKind, duration_words
from rigapp_calibration.taking.signals import Readiness

LEVEL: Text = (
    "Lay the level on the flat of the crank and turn the crank until the bubble is in the middle."
)
TAKEN: Text = "The angle reference is already taken: begin the readings."
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
        self.hands = SimulatedOperatorPanel(live)
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
        live.reported.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Show the uncertainty of the settings."""
        session = self._live.session
        if session is not None:
            self.uncertainty.setValue(session.settings_file.angle.standard_uncertainty_deg)
        self.hands.setVisible(self._live.trains)
        self._forget_first()
        self._look()

    def _keep_first(self) -> None:
        """Store the angle as the first of two, or discard it."""
        if self._first_deg is not None:
            self._forget_first()
            return
        self.shown.interpretText()
        self._first_deg = self.shown.value()
        self.turn.setText(tr(AGAIN))
        self.uncertainty.setEnabled(False)
        self._show_first()

    def _forget_first(self) -> None:
        self._first_deg = None
        self.turn.setText(tr(TURN))
        self.uncertainty.setEnabled(True)
        self._show_first()

    def _show_first(self) -> None:
        if self._first_deg is None:
            self.first.setText("")
            return
        session, second = self._live.session, self.shown.value()
        assert session is not None
        setting = session.settings_file.angle.setting_standard_uncertainty_deg
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
        """Return whether the crank is stationary at a known angle, or the reference exists."""
        live = self._live
        if live.session is None:
            return False
        if not self._due():
            return True
        return live.readiness is not None and live.readiness.ready and not live.hands_busy

    def validatePage(self) -> bool:
        """Take the reference, unless the journal has it already."""
        for box in (self.shown, self.uncertainty):
            box.interpretText()
        if not self._due():
            return True
        shown, first = math.radians(self.shown.value()), self._first_deg
        if first is not None:
            before = math.radians(first)
            return self._live.attempt(lambda session: session.reference_reversed(before, shown))
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
        self._show_first()
        text = "" if now is None else f"{math.degrees(math.remainder(now, math.tau)):+.2f}°"
        self.measured.show_value(text.replace("-", "\u2212"))
        self.picture.show_scene(LevelScene(now, turned=self._first_deg is not None))
        self.say_complete()


MOST_POSITIONS = 41
"""Maximum number of positions in the window; the command line allows more."""
ROUNDED_GRAVITY = 9.81


@dataclass(frozen=True, slots=True)
class SubjectView:
    """Presentation of a subject of ``SUBJECTS`` in the window.

    what: name in the wizard's title. readings: makes the page on which they are taken. angle:
    whether there is an angle reference. sketch: picture of the procedure. plot: of the residuals;
    fitted: whether it is also shown with the result. session: of a subject without steps. live:
    class that polls the engine.
    """

    what: Text
    asks: Questions
    readings: Callable[[Any, Theme], TakingPage | RollingPage]
    plot: PlotNames
    sketch: Scene
    angle: bool = False
    fitted: bool = True
    session: type[RollSession] | None = None
    live: type[LiveCalibration] = LiveCalibration


def _taken(steps: tuple[Step, ...]) -> str:
    readings = sum(1 for step in steps if step.kind is StepKind.READING)
    return tr("{} readings, about {}.", readings, duration_words(steps))


# --- the load cell --------------------------------------------------------------------------------


def _describe_load_cell(plan: LoadCellPlan, values: Values, settings: LoadCellFile) -> str:
    steps = plan.steps()
    most = max(step.value for step in steps)
    words: Text = "{} pieces, {:g} kg in all. The heaviest load is {:g} kg; {}"
    text = tr(words, len(plan.pieces), sum(plan.pieces), most, _taken(steps))
    stated = settings.place.gravity_m_s2 is not None
    if stated and abs(values["gravity"] - ROUNDED_GRAVITY) < 1e-6:
        text += tr(
            "\n9.81 m/s² is a rounded value, up to 0.3 % off: write the gravity of this place,"
            " or name a settings file with latitude and height."
        )
    return text


def _gravity(settings: LoadCellFile) -> Values:
    """Return the gravity computed from latitude and height."""
    if settings.place.gravity_m_s2 is not None or settings.place.latitude_deg is None:
        return {}
    return {"gravity": load_cell_meaning(settings, "settings").place.gravity}


def weight_scene(session: Any, window: Any, readiness: Readiness | None) -> Scene:
    """Return the picture of crank and weights for the present step."""
    procedure, step = session.procedure, session.procedure.step
    before = procedure.steps[procedure.position - 1].pieces if procedure.position else ()
    now = None if window is None else window.angle
    turning = step.kind is StepKind.SET_UP
    return WeightScene(
        step.set_up or 0.0,
        now,
        tuple(stack_of(step.pieces, before)),
        0.0 if turning or not step.pieces else session.expected(),
        turning,
    )


_WEIGHING_PLANS: tuple[tuple[Text, str], ...] = (
    ("Daily check: one weight at 4 pin angles", "daily"),
    ("Routine: 8 pin angles, two of them twice, 5 loads up and down", "routine"),
    ("Full: 12 pin angles, two of them twice, 10 loads up and down", "full"),
)
_WEIGHTS: Text = "Weights, kilograms; 5x8 are eight of 5 kg"
_MASS = partial(number, low=0.0, high=20.0, decimals=4, step=0.1, unit="kg")
_GRAVITY = partial(number, low=GRAVITY.low, high=GRAVITY.high, decimals=5, step=0.0001, unit="m/s²")
WEIGHING = Questions(
    stem="calibration",
    journals="calibration",
    title="Plan and weights",
    subtitle="Every reading is saved at once. You can close the wizard and continue the"
    " calibration later.",
    defaults=LoadCellFile(schema=1, cell=CellSection(name="Load cell")),
    fields=(
        Field("cell", "&Load cell", edit, "Load cell", "cell.name", "Name of the load cell"),
        Field("plan", "&Plan", partial(choice, items=_WEIGHING_PLANS), "routine"),
        Field("weights", "W&eights (kg)", edit, "5x8, 2, 2, 1, 0.5", spoken=_WEIGHTS),
        Field("hanger", "&Hanger", _MASS, 0.0, "weights.hanger_mass_kg", "Mass of the hanger"),
        Field("gravity", "Local &gravity", _GRAVITY, ROUNDED_GRAVITY, "place.gravity_m_s2"),
    ),
    culprit="weights",
    describe=_describe_load_cell,
    derived=_gravity,
)

# --- the probes -----------------------------------------------------------------------------------


def _describe_probes(plan: ProbePlan, values: Values, settings: ProbeFile) -> str:
    text = tr("Steps of {:g} µm; {}", 1e6 * plan.step_size, _taken(plan.steps()))
    if len(plan.probes) > 1:
        text += tr(" With both probes the stage moves along the follower first, then across it.")
    return text


def _propose_range(view: Any, values: Values, settings: ProbeFile) -> Values:
    """Propose 80 % of the range, when the engine has reported the sensitivity in use."""
    known, range_V = view["sensitivity_um_per_V"], settings.probe.range_V
    return {"reach": usual_reach_um(known, range_V, values["positions"])}


def probe_scene(session: Any, window: Any, readiness: Readiness | None) -> Scene:
    """Return the picture of probe and micrometer for the present step."""
    step = session.procedure.step
    return ProbeScene(
        int(step.set_up or 1),
        1e6 * step.value,
        1e6 * session.procedure.plan.reach,
        math.nan if readiness is None else 1e6 * readiness.felt,
        step.falling or step.number == 1,
    )


_PROBES: tuple[tuple[Text, str], ...] = (
    ("Probe 1, along the follower", "1"),
    ("Probe 2, across the follower", "2"),
    ("Both probes, and the angle between them", "both"),
)
_MEASURING_PLANS: tuple[tuple[Text, str], ...] = (
    ("Routine: once up and down", "routine"),
    ("Full: three times up and down", "full"),
)
_POSITIONS = partial(whole_number, low=FEWEST_POSITIONS, high=MOST_POSITIONS)
_REACH = partial(number, low=1.0, high=10000.0, decimals=1, step=10.0, unit="µm")
_SCALE = partial(number, low=0.01, high=100.0, decimals=2, step=0.1, unit="µm")
_SCALE_KEY = "probe.micrometer_standard_uncertainty_um"
_SCALE_SPOKEN: Text = "Standard uncertainty of the micrometer"
MEASURING = Questions(
    stem="probe",
    journals="probes",
    title="Probe and plan",
    subtitle=(
        "A micrometer moves the target in equal steps, up and down; the voltage is read"
        " at each step. Every reading is saved at once: you can close and continue"
        " later."
    ),
    defaults=ProbeFile(schema=1, probe=ProbeSection(name="Probe")),
    fields=(
        Field("which", "&Calibrate", partial(choice, items=_PROBES), "1", spoken="Which probe"),
        Field("name", "N&ame", edit, "Probe", "probe.name", "Name of the probe"),
        Field("plan", "&Plan", partial(choice, items=_MEASURING_PLANS), "full"),
        Field("positions", "Posi&tions of a run", _POSITIONS, 11),
        Field("reach", "From − to + th&is position", _REACH, 1.0, spoken="Largest position"),
        Field("micrometer", "u of the &micrometer", _SCALE, 0.5, _SCALE_KEY, _SCALE_SPOKEN),
    ),
    culprit="reach",
    describe=_describe_probes,
    propose=_propose_range,
)

# --- the run-out ----------------------------------------------------------------------------------


def _describe_rolls(plan: RollPlan, values: Values, settings: RunOutFile) -> str:
    text = tr("The spindle turns for about {:.0f} min.", plan.seconds / 60.0)
    if len(plan.speeds) == 1:
        text += tr(" With one speed only, what inertia adds to the run-out is not known.")
    return text


_ROLLING_PLANS: tuple[tuple[Text, str], ...] = (
    ("Routine: 12 revolutions at each speed", "routine"),
    ("Full: 30 revolutions at each speed", "full"),
)
_SPEEDS: Text = "Speeds of the rolls, revolutions per minute"
_ORDERS = partial(whole_number, low=1, high=32)
_ORDERS_SPOKEN: Text = "Fourier orders of the map"
_TEST_HINT: Text = "its mechanism gives the elastic motion, its limits stay"
_TEST = partial(edit, hint=_TEST_HINT)
ROLLING = Questions(
    stem="run_out",
    journals="run-out",
    title="Rolls",
    subtitle=(
        "The spindle turns slowly with the follower on the pin and an unworn bushing,"
        " so the probes measure the pin's own run-out. Two speeds separate inertia from"
        " run-out."
    ),
    defaults=RunOutFile(schema=1),
    fields=(
        Field("name", "Name of the &pin", edit, "pin", "pin.name"),
        Field("plan", "P&lan", partial(choice, items=_ROLLING_PLANS), "routine"),
        Field("speeds", "Sp&eeds (rpm)", edit, "3, 6", spoken=_SPEEDS),
        Field("orders", "Or&ders of the map", _ORDERS, ORDERS, spoken=_ORDERS_SPOKEN),
        Field("test", "&Test file", _TEST, "", RIG, "Test file of this mechanism"),
    ),
    culprit="speeds",
    describe=_describe_rolls,
)

# --- all of them ----------------------------------------------------------------------------------

CELL_PLOT = PlotNames("residual", "Residuals of the readings so far, N", "N", "Reading")
PROBE_PLOT = PlotNames("probe_residual", "Residuals so far, micrometres", "µm", "Position (µm)")
RUN_OUT_PLOT = PlotNames(
    "run_out", "Run-out map, micrometres", "µm", "Crank angle (degrees)", "Run-out"
)
WITH_WEIGHTS = TakingWords(
    stem=WEIGHING.stem,
    live="Signals now",
    measured="The cell reads",
    unit="N",
    scene=weight_scene,
    reject="Reject the selected reading and repeat its series",
    reason="Rea&son",
    columns=("Series", "Step", "Mass (kg)", "Angle (deg)", "Signal 1", "Signal 2", "State"),
    buttons={StepKind.SET_UP: "The pin is &turned", StepKind.PRELOAD: "The preload is d&one"},
)
WITH_MICROMETER = TakingWords(
    stem=MEASURING.stem,
    live="Voltages now",
    measured="The probe reads",
    unit="µm",
    factor=1e6,
    scene=probe_scene,
    reject="Reject the selected reading, repeat its series",
    reason="Re&ason",
    columns=("Series", "Step", "Position (µm)", "Probe 1 (V)", "Probe 2 (V)", "State"),
    buttons={StepKind.SET_UP: "The &target is in front of the probe"},
    do="T&urn the micrometer",
    read_off=True,
)
SUBJECT_VIEWS = {
    "load cell": SubjectView(
        what="the load cell",
        asks=WEIGHING,
        readings=partial(TakingPage, words=WITH_WEIGHTS, plot=CELL_PLOT),
        plot=CELL_PLOT,
        sketch=WeightScene(0.0, None, (Piece("5 kg"), Piece("2 kg"))),
        angle=True,
        fitted=False,
    ),
    "probes": SubjectView(
        what="the probes",
        asks=MEASURING,
        readings=partial(TakingPage, words=WITH_MICROMETER, plot=PROBE_PLOT),
        plot=PROBE_PLOT,
        sketch=ProbeScene(1, 0.0, 800.0),
    ),
    "run-out": SubjectView(
        what="the pin's run-out",
        asks=ROLLING,
        readings=RollingPage,
        plot=RUN_OUT_PLOT,
        sketch=RollScene(""),
        session=RollSession,
        live=RollingCalibration,
    ),
}
