"""One revolution of the joint force: measured solid, model dashed, their difference below."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from rigapp.gui.data.channels import SIZE
from rigapp.gui.data.comparison import (
    CURVES,
    RevolutionCurves,
    binned,
    compose,
    uncertainty_of,
    values_at,
)
from rigapp.gui.data.frames import COMPONENT_NAMES, ForceFrame
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.pyramid import thinned
from rigapp.gui.data.ranges import SteadyRange
from rigapp.gui.data.recording import StoredRevolution
from rigapp.gui.look.tokens import Theme
from rigapp.gui.plots.palette import MODEL_CURVE, STALE_CURVE, LinePen
from rigapp.gui.plots.plotting import NO_REVOLUTION, CursorPlot, LegendRow, PlotPanel, clear
from rigapp.gui.widgets.build import choice, column, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.schema.messages import ChannelView

RESIDUAL_BIN_DEG = 2.0
"""Short enough for the model's sharpest turn, long enough that noise averages out."""

PENS = dict(zip(CURVES, map(LinePen, ("main", "first", "second")), strict=True))
STORED = LinePen("frozen")
NO_PREDICTION = "No prediction yet: measured − model is drawn here."


class AnglePlot(CursorPlot):
    """A plot over the crank angle whose cursor the arrows move."""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the cursor by 1 deg, with Shift by 10 deg; Esc takes it away."""
        step = 10.0 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1.0
        at = self.cursor_line.value() if self.cursor_line.isVisible() else 180.0
        sign = {Qt.Key.Key_Left: -1.0, Qt.Key.Key_Right: 1.0}.get(Qt.Key(event.key()))
        if sign is None:
            super().keyPressEvent(event)
        else:
            self._pointed((at + sign * step) % 360.0)


class OverlayPanel(PlotPanel):
    """Draw the newest revolution and the model's, with a strip for their difference."""

    takes = Takes.REVOLUTION

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_overlay_panel", "Joint force over one revolution")
        self._ratio: float | None = None
        self._stale = False
        self._uncertainty: float | None = None
        self._cursor: float | None = None
        self._reference: StoredRevolution | None = None
        self._drawn: tuple[object, ...] = ()
        self._doubt = ""
        self.frame = ForceFrame.CRANK
        self.held = False
        self.shown: RevolutionCurves | None = None
        self._make_plots(prefix, theme)
        self._build(prefix, theme)

    def _make_plots(self, prefix: str, theme: Theme) -> None:
        self.plot = AnglePlot(
            f"{prefix}_force_plot", "Joint force against crank angle", theme, self.set_cursor
        )
        self.plot.label("left", "Force (N)")
        self.plot.show_crank_angle(label=False)
        self.plot.guide(0.0, horizontal=True)
        self.plot.steady = SteadyRange(10.0)
        self.residual_plot = AnglePlot(
            f"{prefix}_residual_plot",
            "Measured minus model against crank angle",
            theme,
            self.set_cursor,
        )
        self.residual_plot.label("left", "ΔF (N)")
        self.residual_plot.show_crank_angle()
        self.residual_plot.guide(0.0, horizontal=True)
        self.residual_plot.steady = SteadyRange(4.0, symmetric=True)
        self.plot.empty(
            f"{NO_REVOLUTION}: the joint force over one turn of the crank is drawn here."
        )
        self.residual_plot.empty(NO_PREDICTION)
        self._band = self.residual_plot.band()
        self._raw_residual = self.residual_plot.curve(LinePen("grid"))
        self._references = {name: self.plot.curve(STORED) for name in CURVES}
        self._measured = {name: self.plot.curve(pen) for name, pen in PENS.items()}
        self._model = {name: self.plot.curve(MODEL_CURVE) for name in CURVES}
        self._residual = {name: self.residual_plot.curve(pen) for name, pen in PENS.items()}

    def _build(self, prefix: str, theme: Theme) -> None:
        self.title = ElidedLabel(f"{prefix}_overlay_title", "Revolutions shown")
        frames = [(f"{frame.value} frame", frame) for frame in ForceFrame]
        self.frame_box = choice(
            f"{prefix}_frame", "Frame of the force components", frames, self._frame_chosen
        )
        self.tools = row((self.title, 1), "Fra&me", self.frame_box)
        self.legend = LegendRow(f"{prefix}_overlay_legend", theme)
        self.readout = ElidedLabel(f"{prefix}_cursor", "Values at the cursor")
        self.readout.show_text(
            "Lower strip: measured − model, grey every sample.  Click a plot, or Tab to it and use"
            " ← →, to read values."
        )
        column(
            self.tools,
            self.legend,
            (self.plot, 5),
            (self.residual_plot, 2),
            self.readout,
            on=self,
        )
        self._offer_follower_frame()
        self._show_legend()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        super().dress(theme)
        self._band.setBrush(theme.band)

    def set_mechanism(self, crank_over_follower: float | None) -> None:
        """Take crank radius / follower length of the test; None: the follower frame is closed."""
        if crank_over_follower != self._ratio:
            self._ratio = crank_over_follower
            self._offer_follower_frame()

    def set_channels(self, channels: tuple[ChannelView, ...]) -> None:
        """Take the channels' uncertainties: the band of the strip is what cannot be told apart."""
        uncertainty = uncertainty_of(channels)
        if uncertainty != self._uncertainty:
            self._uncertainty = uncertainty
            self._band.setVisible(uncertainty is not None)
            if uncertainty is not None:
                self._band.setRegion((-uncertainty, uncertainty))
            self._show_legend()

    def compare_with(self, reference: StoredRevolution | None) -> None:
        """Draw a stored revolution in grey behind the newest one; None: nothing."""
        self._reference = reference
        self._drawn = ()
        self._show_legend()

    def show_news(self, news: News) -> None:
        """Draw the newest revolution if it is not drawn yet and the picture is not held."""
        self.set_mechanism(news.crank_over_follower)
        if news.status is not None:
            self.set_channels(news.status.channels)
        data, stale = news.data, news.stale
        if stale != self._stale:
            self._stale = stale
            self.plot.draw_with(self._model_pen, *self._model.values())
            self._show_legend()
        prediction, cycle = data.prediction, data.cycle
        if prediction is not None and cycle is not None and not stale:
            cycle = data.partner(prediction) or cycle
        if cycle is None:
            self._clear()
            return
        if self.held and self.shown is not None:
            return
        doubt = data.doubt(prediction.revolution) if prediction is not None else ""
        token = (cycle.revolution, prediction and prediction.revolution, self.frame, self._ratio)
        if token != self._drawn or doubt != self._doubt:
            self._drawn, self._doubt = token, doubt
            self._draw_reference()
            self.draw(compose(cycle, prediction, self.frame, self._ratio))

    def _clear(self) -> None:
        self.title.show_text(NO_REVOLUTION)
        if self.shown is not None:
            self.shown, self._drawn = None, ()
            clear(*self._measured.values())
            self.plot.empty(f"{NO_REVOLUTION}.")
            self._clear_model()

    def _clear_model(self) -> None:
        clear(*self._model.values(), *self._residual.values(), self._raw_residual)
        self.residual_plot.empty(NO_PREDICTION)

    def draw(self, shown: RevolutionCurves) -> None:
        """Draw arrays."""
        self.shown = shown
        buckets = max(self.plot.width(), 200)
        for name in CURVES:
            self._measured[name].setData(*thinned(shown.angle_deg, shown.measured[name], buckets))
        shapes = [*shown.measured.values(), *(shown.model or {}).values()]
        low = min(float(values.min()) for values in shapes)
        self.plot.fit(low, max(float(values.max()) for values in shapes))
        self._draw_model(shown, buckets)
        self._show_title(shown)
        self._read_out()

    def set_cursor(self, angle_deg: float | None) -> None:
        """Put the cursor at a crank angle and read the values there; None takes it away."""
        self._cursor = None if angle_deg is None else angle_deg % 360.0
        for plot in (self.plot, self.residual_plot):
            plot.show_cursor(self._cursor)
        self._read_out()

    def _draw_model(self, shown: RevolutionCurves, buckets: int) -> None:
        if shown.model is None or shown.residual is None:
            self._clear_model()
            return
        for name in CURVES:
            self._model[name].setData(shown.model_angle_deg, shown.model[name])
            self._residual[name].setData(
                *binned(shown.angle_deg, shown.residual[name], RESIDUAL_BIN_DEG)
            )
        raw = shown.residual[SIZE]
        self._raw_residual.setData(*thinned(shown.angle_deg, raw, buckets))
        worst = float(np.abs(raw).max())
        self.residual_plot.fit(-worst, worst)

    def _draw_reference(self) -> None:
        if self._reference is None:
            clear(*self._references.values())
            return
        shown = compose(self._reference.cycle, None, self.frame, self._ratio)
        buckets = max(self.plot.width(), 200)
        for name, curve in self._references.items():
            curve.setData(*thinned(shown.angle_deg, shown.measured[name], buckets))

    def _show_title(self, shown: RevolutionCurves) -> None:
        text = f"Measured: revolution {shown.measured_revolution}"
        if shown.model is None:
            text += ".  No prediction yet"
        else:
            text += f".  Model: revolution {shown.model_revolution}"
            text += f", {self._doubt}" if self._doubt else ""
        if self._reference is not None:
            text += f".  Grey: revolution {self._reference.cycle.revolution}"
        self.title.show_text(text + (".  HELD" if self.held else ""))

    def _read_out(self) -> None:
        if self.shown is not None and self._cursor is not None:
            first, second = COMPONENT_NAMES[self.frame]
            self.readout.show_text(values_at(self.shown, self._cursor, first, second))

    def _frame_chosen(self) -> None:
        self.frame = ForceFrame(self.frame_box.currentData())
        self.plot.steady.forget()
        self.residual_plot.steady.forget()
        self._drawn = ()
        self._show_legend()

    def _offer_follower_frame(self) -> None:
        index = self.frame_box.findData(ForceFrame.FOLLOWER)
        known = self._ratio is not None
        flags = None if known else Qt.ItemFlag.NoItemFlags.value
        self.frame_box.setItemData(index, flags, Qt.ItemDataRole.UserRole - 1)
        if not known and self.frame is ForceFrame.FOLLOWER:
            self.frame_box.setCurrentIndex(self.frame_box.findData(ForceFrame.CRANK))

    @property
    def _model_pen(self) -> LinePen:
        return STALE_CURVE if self._stale else MODEL_CURVE

    def _show_legend(self) -> None:
        names = ("|F|", *COMPONENT_NAMES[self.frame])
        entries = list(zip(names, PENS.values(), strict=True))
        entries.append(("model (stale)" if self._stale else "model", self._model_pen))
        if self._reference is not None:
            entries.append(("stored", STORED))
        if self._uncertainty is not None:
            entries.append((f"±{self._uncertainty:.3g} N", LinePen("band")))
        self.legend.show_entries(entries)
