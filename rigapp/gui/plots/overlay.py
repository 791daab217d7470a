"""Joint force over one revolution: measured solid, model dashed, their difference below."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.marks import CurveName, Spot, alarm_token, limit_lines
from rigapp.gui.plots.palette import MODEL, STALE_CURVE, LinePen
from rigapp.gui.plots.plotpanel import PlotPanel, detail, plot_heading
from rigapp.gui.plots.plotting import CursorPlot, NameRoom
from rigapp.gui.widgets.build import button, choice, column
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.columns import AGREEMENT_BIN_DEG
from rigapp.viewer.channels import SIZE
from rigapp.viewer.comparison import (
    CURVES,
    Floats,
    RevolutionCurves,
    binned,
    compose,
    joint_uncertainty,
    stacked,
    uncertainty_of,
    values_at,
)
from rigapp.viewer.frames import FRAME_NAMES, SHORT_NAMES, ForceFrame
from rigapp.viewer.news import News, Takes
from rigapp.viewer.pyramid import thinned
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.recording import StoredRevolution, TripCycles
from rigapp.viewer.series import Doubt

if TYPE_CHECKING:
    from rigapp.storage import LargestForce

PENS = dict(zip(CURVES, map(LinePen, ("main", "first", "second")), strict=True))
OTHER = LinePen("frozen")
"""Pen of a revolution drawn behind the newest one."""
WAITING: Final[Text] = (
    "No revolution measured yet: the joint force over one turn of the crank is drawn here."
)
NO_PREDICTION: Final[Text] = "No prediction yet: measured − model is drawn here."
UNFOLLOWED: Final[Text] = "the speed changes faster than the prediction can follow"
FORCE_HEIGHT = 24 * STEP
"""Height of the main plot on each page of forces."""
WHOLE_TURN = np.array([0.0, 360.0])
FROZEN, STORED, GOOD = marked("frozen"), marked("stored"), marked("last good")
SAVED = marked("last saved")
"""Kinds of revolutions drawn behind the newest one: frozen, from the file, before a trip."""
BEHIND = (FROZEN, STORED, GOOD, SAVED)


class AnglePlot(CursorPlot):
    """A plot over the crank angle whose cursor is moved by the arrow keys."""

    def own_key(self, event: QKeyEvent) -> bool:
        """Move the cursor by 1 deg, with Shift by 10 deg; remove it by Esc."""
        step = 10.0 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1.0
        at = self.cursor_line.value() if self.cursor_line.isVisible() else 180.0
        sign = {Qt.Key.Key_Left: -1.0, Qt.Key.Key_Right: 1.0}.get(Qt.Key(event.key()))
        if sign is None:
            return super().own_key(event)
        self._pointed((at + sign * step) % 360.0)
        return True

    def cursor_text(self, at: float) -> str:
        """Return the angle of the cursor."""
        return f"{at:.0f}°"


class OverlayPanel(PlotPanel):
    """Draw the newest revolution and the model's, with a strip for their difference."""

    takes = Takes.REVOLUTION

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_overlay_panel", "Joint force over one revolution")
        self._ratio: float | None = None
        self._stale = False
        self._uncertainty = math.nan
        self._doubt = Doubt()
        self._cursor: float | None = None
        self._others: dict[str, StoredRevolution] = {}
        self._newest: StoredRevolution | None = None
        self._tripped = False
        self._peak: LargestForce | None = None
        self._drawn: tuple[object, ...] = ()
        self.frame = ForceFrame.CRANK
        self.held = False
        self.shown: RevolutionCurves | None = None
        self._make_plots(prefix, theme)
        self._build(prefix)

    def _make_plots(self, prefix: str, theme: Theme) -> None:
        room = NameRoom()
        self.plot, self.residual_plot = (
            AnglePlot(f"{prefix}_{name}_plot", spoken, theme, self.set_cursor, room=room)
            for name, spoken in (
                ("force", marked("Joint force against crank angle")),
                ("residual", marked("Measured minus model against crank angle")),
            )
        )
        self.plot.setMinimumHeight(FORCE_HEIGHT)
        self.plot.show_crank_angle(label=False)
        self.plot.steady = SteadyRange(10.0)
        self.residual_plot.show_crank_angle()
        self.residual_plot.steady = SteadyRange(4.0, symmetric=True)
        self.plot.empty(WAITING)
        self.residual_plot.empty(NO_PREDICTION)
        self._model_bands = {name: self.plot.shade(MODEL) for name in CURVES}
        self._band = self.residual_plot.shade(MODEL)
        self._raw_residual = self.residual_plot.curve(LinePen("strong"))
        self._behind = {kind: {name: self.plot.curve(OTHER) for name in CURVES} for kind in BEHIND}
        self._measured = {name: self.plot.curve(pen) for name, pen in PENS.items()}
        self._model = {name: self.plot.curve(MODEL) for name in CURVES}
        self._residual = {name: self.residual_plot.curve(pen) for name, pen in PENS.items()}

    def _build(self, prefix: str) -> None:
        self.title = detail(f"{prefix}_overlay_title", "Revolutions shown")
        frames = [(text, frame) for frame, text in FRAME_NAMES.items()]
        self.frame_box = choice(
            f"{prefix}_frame", "Frame of the force components", frames, self._frame_chosen
        )
        self.freeze = button(
            f"{prefix}_freeze",
            "Free&ze",
            self._freeze,
            "Keep this revolution in grey behind the next ones",
            tip="Keep this revolution in grey behind the next ones.",
            checkable=True,
        )
        self.readout = detail(f"{prefix}_cursor", "Values at the cursor")
        self._difference = plot_heading("Measured − model")
        column(
            flowing(plot_heading("Force"), (self.title, 1), self.freeze, self.frame_box),
            (self.plot, 5),
            flowing(self._difference, (self.readout, 1)),
            (self.residual_plot, 2),
            on=self,
        )
        self._offer_follower_frame()
        self._read_out()

    def show_force_alone(self) -> None:
        """Hide the strip of the difference, where there is room for one plot only."""
        for part in (self._difference, self.residual_plot):
            part.hide()
        self.plot.show_crank_angle()

    def set_mechanism(self, crank_over_follower: float | None) -> None:
        """Set crank radius / follower length of the test; None: no follower frame."""
        if crank_over_follower != self._ratio:
            self._ratio = crank_over_follower
            self._offer_follower_frame()

    def compare_with(self, stored: StoredRevolution | None, kind: str = STORED) -> None:
        """Draw a revolution in grey behind the newest one; None: nothing."""
        self._others.pop(kind, None)
        if stored is not None:
            self._others[kind] = stored
        self._drawn = ()

    def show_news(self, news: News) -> None:
        """Draw the newest revolution if it is not drawn yet and the plot is not held."""
        self.set_mechanism(news.crank_over_follower)
        data = news.data
        first = self._data is None
        if self.take_data(data):
            self._start_afresh(first=first)
        if news.status is not None:
            self._uncertainty = uncertainty_of(news.status.rig.channels)
        if news.stale != self._stale:
            self._stale = news.stale
            self.plot.draw_with(self._model_pen, *self._model.values())
        prediction, cycle = data.prediction, data.cycle
        if prediction is not None and cycle is not None and not news.stale:
            cycle = data.partner(prediction) or cycle
        trip = news.trip if news.trip is not None and news.trip.cycle is not None else None
        self._tripped, self._peak = trip is not None, trip.peak if trip is not None else None
        if trip is not None:
            cycle = trip.cycle
        if cycle is None:
            self._clear()
            return
        if self.held and self.shown is not None:
            return
        doubt = data.doubt(prediction.revolution) if prediction is not None else Doubt()
        token = (
            cycle.revolution,
            prediction and prediction.revolution,
            self.frame,
            self._ratio,
            self._stale,
            repr((doubt, self._uncertainty)),
            len(news.events),
            news.recipe is None,
            trip.revolution if trip is not None else 0,
            alarm_token(news),
        )
        if token != self._drawn:
            self._drawn, self._doubt = token, doubt
            self._newest = StoredRevolution(cycle, prediction)
            self._put_behind(trip)
            self._draw_others()
            self.draw(compose(cycle, prediction, self.frame, self._ratio))
            self.plot.show_marks(limits=limit_lines(news, {f"{SIZE}_max"}))

    def _put_behind(self, trip: TripCycles | None) -> None:
        """Draw the last complete cycle before a trip behind that of the trip."""
        for kind in (GOOD, SAVED):
            self._others.pop(kind, None)
        if trip is not None and trip.before is not None:
            last = trip.before.revolution == trip.revolution - 1
            self._others[GOOD if last else SAVED] = StoredRevolution(trip.before, None)

    @property
    def _peak_N(self) -> float:
        """Return the largest force of a trip, which the curve may not show."""
        return self._peak.value_N if self._peak is not None else -math.inf

    def _start_afresh(self, *, first: bool) -> None:
        """Reset the ranges, marks and revolutions of another test."""
        if not first:
            self._others.clear()
            self.freeze.setChecked(False)
            for plot in (self.plot, self.residual_plot):
                plot.start_afresh()
        self._drawn = ()

    def _clear(self) -> None:
        self.title.show_text("")
        if self.shown is not None:
            self.shown, self._newest, self._drawn = None, None, ()
            clear(*self._measured.values())
            self._draw_others()
            self.plot.empty(WAITING)
            self._clear_model()

    def _clear_model(self) -> None:
        clear(*self._model.values(), *self._model_bands.values())
        clear(*self._residual.values(), self._raw_residual, self._band)
        self.residual_plot.empty(NO_PREDICTION)

    def draw(self, shown: RevolutionCurves) -> None:
        """Draw the curves of a revolution."""
        self.shown = shown
        buckets = max(self.plot.width(), 200)
        at, curves = thinned(shown.angle_deg, stacked(shown.measured), buckets)
        for name, values in zip(CURVES, curves, strict=True):
            self._measured[name].setData(at, values)
        shapes = [*shown.measured.values(), *(shown.model or {}).values()]
        low = min(float(values.min()) for values in shapes)
        self.plot.fit(low, max(self._peak_N, *(float(values.max()) for values in shapes)))
        self._draw_model(shown, buckets)
        self._show_words(shown)
        self._read_out()

    def set_cursor(self, angle_deg: float | None) -> None:
        """Place the cursor at a crank angle and show the values there; None removes it."""
        self._cursor = None if angle_deg is None else angle_deg % 360.0
        for plot in (self.plot, self.residual_plot):
            plot.show_cursor(self._cursor)
        if self.shown is not None:
            self._show_words(self.shown)
        self._read_out()

    def _draw_model(self, shown: RevolutionCurves, buckets: int) -> None:
        if shown.model is None or shown.residual is None or shown.model_angle_deg is None:
            self._clear_model()
            return
        sure = self._doubt.uncertainty_N
        at, means = binned(shown.angle_deg, stacked(shown.residual), AGREEMENT_BIN_DEG)
        for name, mean in zip(CURVES, means, strict=True):
            self._residual[name].setData(at, mean)
            model = shown.model[name]
            self._model[name].setData(shown.model_angle_deg, model)
            self._model_bands[name].setData(shown.model_angle_deg, model - sure, model + sure)
        raw = shown.residual[SIZE]
        self._raw_residual.setData(*thinned(shown.angle_deg, raw, buckets))
        both = self._agreement(shown)
        at = WHOLE_TURN if shown.agreement is None else shown.model_angle_deg
        self._band.setData(at, -both, both)
        worst = float(np.abs(raw).max())
        self.residual_plot.fit(-worst, worst)

    def _agreement(self, shown: RevolutionCurves) -> Floats:
        """Return the band of measured minus predicted, N: at the model's angles, or at both ends.

        An older prediction has only the contribution of the angle; the load cell's is added.
        """
        if shown.agreement is not None:
            return shown.agreement
        return np.full(2, joint_uncertainty(self._uncertainty, self._doubt.uncertainty_N))

    def _draw_others(self) -> None:
        buckets = max(self.plot.width(), 200)
        for kind, curves in self._behind.items():
            other = self._others.get(kind)
            if other is None:
                clear(*curves.values())
                continue
            shown = compose(other.cycle, None, self.frame, self._ratio)
            at, thin = thinned(shown.angle_deg, stacked(shown.measured), buckets)
            for name, values in zip(CURVES, thin, strict=True):
                curves[name].setData(at, values)

    def _show_words(self, shown: RevolutionCurves) -> None:
        """Show the title and the names at the curves."""
        title = tr("N, cycle {}", grouped(shown.measured_revolution))
        if self._tripped:
            title += tr(", tripped")
        if shown.model_revolution not in (None, shown.measured_revolution):
            title += tr(", model {}", grouped(shown.model_revolution or 0))
        held = tr("HELD") if self.held else "N"
        self.title.show_text(title + (tr(", HELD") if self.held else ""), held)
        names = self._names(shown)
        index = int(np.argmax(shown.measured[SIZE]))
        angle, largest, sign = float(shown.angle_deg[index]), float(shown.measured[SIZE][index]), ""
        if self._peak is not None and self._peak.value_N >= largest:
            largest, sign = self._peak.value_N, self._peak.sign
        peak = Spot(angle, largest, sign + tr("{:.1f} N at {:.0f}°", largest, angle), PENS[SIZE])
        self.plot.show_marks(names=tuple(names), spots=(peak,))
        both = float(self._agreement(shown)[-1])
        if shown.residual is not None and math.isfinite(both):
            self.residual_plot.show_marks(names=(CurveName(f"± {both:.2g} N", MODEL, both),))

    def _names(self, shown: RevolutionCurves) -> list[CurveName]:
        """Return the names at the curves, with values where there is a cursor."""
        names = []
        values = None if self._cursor is None else values_at(shown, self._cursor)
        for (name, pen), text in zip(PENS.items(), self._words, strict=True):
            read = "" if values is None else f" {values[name][0]:.1f}"
            names.append(CurveName(text + read, pen, float(shown.measured[name][-1])))
        if shown.model is not None:
            text = tr("model (stale)") if self._stale else tr("model")
            text += "" if values is None else f" {values[SIZE][1]:.1f}"
            if math.isfinite(self._doubt.uncertainty_N):
                text += f" ± {self._doubt.uncertainty_N:.2g} N"
            names.append(CurveName(text, self._model_pen, float(shown.model[SIZE][-1])))
        for kind, other in self._others.items():
            text = f"{tr(kind)} {grouped(other.cycle.revolution)}"
            names.append(CurveName(text, OTHER, float(other.cycle.channels[SIZE][-1])))
        return names

    @property
    def _words(self) -> tuple[str, ...]:
        """Return the names of the curves without the frame, which is shown above the plot."""
        return ("|F|", *(tr(name) for name in SHORT_NAMES[self.frame]))

    def _read_out(self) -> None:
        """Show measured minus model at the cursor, or the reason for their difference."""
        text, short = tr("N, grey: every sample"), "N"
        if self._doubt.unfollowed:
            text, short = f"▲ {tr(UNFOLLOWED)}", "▲"
        elif self._doubt.deviation and self._cursor is None:
            text, short = f"▲ {translate(self._doubt.deviation)}", "▲"
        elif self.shown is not None and self._cursor is not None and self.shown.model is not None:
            values = values_at(self.shown, self._cursor)
            text = "N: " + ", ".join(
                f"{word} {measured - model:+.1f}".replace("-", "−")
                for word, (measured, model) in zip(self._words, values.values(), strict=True)
            )
        self.readout.show_text(text, short)

    def _freeze(self, wanted: bool) -> None:
        if wanted and self._newest is None:
            self.freeze.setChecked(False)
        self.compare_with(self._newest if wanted else None, FROZEN)

    def _frame_chosen(self) -> None:
        self.frame = ForceFrame(self.frame_box.currentData())
        self.plot.steady.forget()
        self.residual_plot.steady.forget()
        self._drawn = ()

    def _offer_follower_frame(self) -> None:
        index = self.frame_box.findData(ForceFrame.FOLLOWER)
        known = self._ratio is not None
        flags = None if known else Qt.ItemFlag.NoItemFlags.value
        self.frame_box.setItemData(index, flags, Qt.ItemDataRole.UserRole - 1)
        if not known and self.frame is ForceFrame.FOLLOWER:
            self.frame_box.setCurrentIndex(self.frame_box.findData(ForceFrame.CRANK))

    @property
    def _model_pen(self) -> LinePen:
        return STALE_CURVE if self._stale else MODEL
