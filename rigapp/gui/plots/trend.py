"""Trends over a test: maximum, RMS, minimum against cycle, with the prediction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton

from rigapp.gui.plots.curves import ShadedBand, Trace
from rigapp.gui.plots.marks import CurveName, Spot, alarm_token, limit_lines
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotpanel import NO_REVOLUTION, PlotPanel, detail
from rigapp.gui.plots.plotting import CursorPlot, NameRoom, Pointed
from rigapp.gui.plots.trendview import FOLLOWED, FREE, LAST, WHOLE, TrendView
from rigapp.gui.widgets.build import add_group, button, choice, column, row
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.numbers import grouped, true_minus, with_uncertainty
from rigapp.presentation.times import duration
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, marked, tr
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.viewer.channels import SIZE
from rigapp.viewer.lines import Drawn, Flagged, View, banded, drawn
from rigapp.viewer.moments import moments
from rigapp.viewer.news import News, Takes
from rigapp.viewer.quantities import (
    TrendLine,
    TrendQuantity,
    grouped_quantities,
    trend_quantities,
)
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.series import LiveData, SeriesTable

BUCKETS = 1200
"""Maximum number of points of a line: about one for each pixel of a plot on a wide screen."""
FLAGGED = LinePen("muted")
"""Pen of values of flagged revolutions, which do not range the axis."""
BAND_BUCKETS = 240
"""Maximum number of points of a band, whose edges change slowly and are expensive to fill."""


class TrendPlot(CursorPlot):
    """A plot whose x axis can be moved and zoomed by mouse and by keys."""

    def __init__(self, name: str, theme: Theme, pointed: Pointed, room: NameRoom) -> None:
        super().__init__(name, "Statistics against cycle", theme, pointed, lane=True, room=room)
        self.setMouseEnabled(x=True, y=False)
        self.label("bottom", "Cycle")

    def own_key(self, event: QKeyEvent) -> bool:
        """Move by the arrow keys, zoom by plus and minus, remove the cursor by Esc."""
        low, high = self.viewRange()[0]
        span = high - low
        moves = {
            Qt.Key.Key_Left: (low - span / 4, high - span / 4),
            Qt.Key.Key_Right: (low + span / 4, high + span / 4),
            Qt.Key.Key_Plus: (low + span / 4, high - span / 4),
            Qt.Key.Key_Minus: (low - span / 2, high + span / 2),
        }
        wanted = moves.get(Qt.Key(event.key()))
        if wanted is None:
            return super().own_key(event)
        self.zoom_back()
        self.setXRange(*wanted, padding=0.0)
        self.getViewBox().sigRangeChangedManually.emit([True, False])
        return True


@dataclass(slots=True)
class _Curve:
    """A line on the plot: quantity, curve, and uncertainty band."""

    line: TrendLine
    predicted: bool
    trace: Trace
    band: ShadedBand | None


class TrendPanel(PlotPanel):
    """Draw one quantity over the whole test, the last cycles, or a manually selected range.

    Panels with a common ``view`` move together; the panel that ``leads`` has its buttons.
    """

    takes = Takes.HISTORY

    def __init__(
        self,
        prefix: str,
        theme: Theme,
        quantity: str = SIZE,
        *,
        view: TrendView | None = None,
        leads: bool = True,
    ) -> None:
        super().__init__(f"{prefix}_trend_panel", "Statistics against cycle")
        self._name = quantity
        self._channels = BASE
        self._quantities = trend_quantities(BASE)
        self._drawn: tuple[object, ...] = ()
        self._curves: list[_Curve] = []
        self.words = ""
        self.view = view or TrendView()
        self.view.changed.append(self._view_changed)
        self.plot = TrendPlot(f"{prefix}_trend_plot", theme, self.view.point_at, self.view.room)
        self.plot.getViewBox().sigRangeChangedManually.connect(self._moved_by_hand)
        self._build(prefix, leads=leads)
        self._make_curves()

    def _build(self, prefix: str, *, leads: bool) -> None:
        self.choice = choice(f"{prefix}_trend_quantity", "Quantity of the trend", ())
        self._list_quantities()
        self.choice.setCurrentIndex(self.choice.findData(self._name))
        self.choice.currentIndexChanged.connect(self._quantity_chosen)
        self.modes: dict[str, QPushButton] = {}
        if leads:
            self.modes = {
                mode: self._mode_button(prefix, mode, text, spoken)
                for mode, text, spoken in (
                    (WHOLE, marked("Who&le test"), marked("Show the complete test")),
                    (
                        LAST,
                        tr("Last &{}", grouped(FOLLOWED)),
                        tr("Follow the last {} cycles", FOLLOWED),
                    ),
                )
            }
        self.title = detail(f"{prefix}_trend_title", "Unit of the trend")
        wraps = flowing if leads else row
        head = wraps(self.choice, (self.title, 1), *self.modes.values())
        column(head, (self.plot, 1), on=self)

    def _mode_button(self, prefix: str, mode: str, text: Text, spoken: Text) -> QPushButton:
        mode_button = button(f"{prefix}_trend_{mode}", text, None, spoken, checkable=True)
        mode_button.setChecked(mode == self.view.mode)
        mode_button.clicked.connect(lambda: self.view.show(mode))
        return mode_button

    @property
    def quantity(self) -> TrendQuantity:
        """Return the shown quantity."""
        return self._quantities[self._name]

    def show_news(self, news: News) -> None:
        """Draw if rows, quantity or view have changed since the last call."""
        data = news.data
        first = self._data is None
        if self.take_data(data):
            if not first:
                self.plot.start_afresh()
                self.view.start_afresh()
            self._drawn = ()
        if data.channels is not self._channels:
            self._offer(data.channels)
        self._place_view(data.rows, data.predictions)
        view: View = tuple(self.plot.viewRange()[0])
        token = (self._name, len(data.rows), len(data.predictions), data.loaded, view,
                 self.view.cursor, len(news.events), news.recipe is None,
                 alarm_token(news))  # fmt: skip
        if token == self._drawn:
            return
        self._drawn = token
        buckets = min(max(self.plot.width(), 200), BUCKETS)
        flagged = Flagged(data.rows, view, buckets)
        lines = [(curve, self._draw(curve, data, view, flagged, buckets)) for curve in self._curves]
        extremes = [line for _, line in lines if np.isfinite(line.low)]
        low = min((line.low for line in extremes), default=np.nan)
        high = max((line.high for line in extremes), default=np.nan)
        self.plot.fit(low, high)
        self._show_marks(news, lines)
        if not extremes and (self.view.mode != FREE or not len(data.rows)):
            self.plot.empty(self._nothing(len(data.rows)))

    def _draw(
        self, curve: _Curve, data: LiveData, view: View, flagged: Flagged, buckets: int
    ) -> Drawn:
        """Draw a line with its band; return its points in the unit of the quantity."""
        table = data.predictions if curve.predicted else data.rows
        line, scale = curve.line, self.quantity.scale
        points = drawn(table, line.column, flagged, view, buckets, scale)
        curve.trace.setData(points.x, points.y)
        if curve.band is not None:
            curve.band.setData(*banded(table, line.column, line.doubt, view, BAND_BUCKETS, scale))
        return points

    def _show_marks(self, news: News, lines: list[tuple[_Curve, Drawn]]) -> None:
        names, texts, spots = [], [], []
        low, high = self.plot.viewRange()[1]
        both = bool(self.quantity.predicted and self.quantity.measured)
        for curve, points in lines:
            line, pen = curve.line, self._pen(curve.line, predicted=curve.predicted)
            table = news.data.predictions if curve.predicted else news.data.rows
            value = self.quantity.scale * self._value(table, line.column)
            text = f"{line.text} {self._written(value, table, line)}"
            if np.isfinite(value):
                if not (curve.predicted and both):
                    names.append(CurveName(text, pen, value))
                    texts.append(text)
                elif self.view.cursor is not None:
                    texts.append(tr("model {}", text))
            if curve.predicted and both and line is self.quantity.predicted[0]:
                last = points.y[-1] if len(points.y) else np.nan
                if np.isfinite(last):
                    model = tr("model ± U") if curve.band else tr("model")
                    names.append(CurveName(model, pen, last))
            spots += [
                Spot(*at, f"{at[1]:.4g} {self.quantity.unit}", FLAGGED)
                for at in (points.above, points.under)
                if at is not None and not low <= at[1] <= high
            ]
        columns = {line.column for line in (*self.quantity.measured, *self.quantity.predicted)}
        limits = limit_lines(news, columns)
        self.plot.show_marks(
            names=tuple(names), limits=limits, moments=moments(news.events), spots=tuple(spots)
        )
        cursor = self.view.cursor
        when = tr("Now") if cursor is None else tr("At cycle {:.0f}", cursor)
        self.words = f"{when}: " + ", ".join(texts) if texts else ""
        self.title.show_text(self.quantity.unit, self.quantity.unit)

    def _nothing(self, revolutions: int) -> str:
        """Return why nothing is drawn."""
        title = self.quantity.title
        if not revolutions:
            return f"{tr(NO_REVOLUTION)}: {tr('{} against cycle is drawn here.', title)}"
        if self.quantity.measured:
            return tr("No value yet of {}.", title)
        return tr("No value of {} yet; it is computed by the model.", title)

    def _offer(self, table: ChannelTable) -> None:
        """List the quantities of a table; a selection that still exists stays."""
        self._channels, self._quantities = table, trend_quantities(table)
        chosen = self._name if self._name in self._quantities else SIZE
        self.choice.blockSignals(True)
        self.choice.clear()
        self._list_quantities()
        self.choice.setCurrentIndex(self.choice.findData(chosen))
        self.choice.blockSignals(False)
        self._quantity_chosen()

    def _list_quantities(self) -> None:
        titles = {name: quantity.title for name, quantity in self._quantities.items()}
        for names in grouped_quantities(titles, self._channels):
            add_group(self.choice, {name: titles[name] for name in names})

    def _value(self, table: SeriesTable, column: str) -> float:
        cursor = self.view.cursor
        if cursor is None or not len(table):
            return table.last(column)
        index = table.revolutions.searchsorted(cursor)
        if index >= len(table) or table.revolutions[index] != cursor:
            return float("nan")
        return table.at(column, index)

    def _written(self, value: float, table: SeriesTable, line: TrendLine) -> str:
        """Return a value with its unit, and its uncertainty or age where known."""
        uncertainty = self.quantity.scale * self._value(table, line.doubt) if line.doubt else np.nan
        if np.isfinite(uncertainty):
            return true_minus(with_uncertainty(value, uncertainty, self.quantity.unit))
        age_s = self._value(table, line.age) if line.age else np.nan
        old = tr(", {} old", duration(age_s)) if np.isfinite(age_s) else ""
        return true_minus(f"{value:.4g} {self.quantity.unit}".rstrip()) + old

    def _place_view(self, rows: SeriesTable, predictions: SeriesTable) -> None:
        wanted = self.view.range_of(rows.revolutions if len(rows) else predictions.revolutions)
        shown = self.plot.viewRange()[0]
        if wanted is not None and max(abs(wanted[side] - shown[side]) for side in (0, 1)) > 1e-6:
            self.plot.show_range("x", *wanted)

    def _moved_by_hand(self) -> None:
        self.view.move(*self.plot.viewRange()[0])

    def _view_changed(self) -> None:
        """Update to the common view of the panels of a page."""
        for name, control in self.modes.items():
            control.setChecked(name == self.view.mode)
        self.plot.show_cursor(self.view.cursor)
        self._drawn = ()
        data = None if self._data is None else self._data()
        if data is not None:
            self._place_view(data.rows, data.predictions)

    def _quantity_chosen(self) -> None:
        self._name = str(self.choice.currentData())
        self._drawn = ()
        self._make_curves()

    def _make_curves(self) -> None:
        for curve in self._curves:
            self.plot.take_out(curve.trace)
            if curve.band is not None:
                self.plot.take_out(curve.band)
        lines = [(line, False) for line in self.quantity.measured]
        lines += [(line, True) for line in self.quantity.predicted]
        self._curves = []
        for line, predicted in lines:
            pen = self._pen(line, predicted=predicted)
            # Measured lines of a quantity that is also predicted have no separate uncertainty.
            shaded = line.doubt and (predicted or not self.quantity.predicted)
            band = self.plot.shade(pen) if shaded else None
            self._curves.append(_Curve(line, predicted, self.plot.curve(pen), band))
        self.plot.start_afresh()
        self.plot.steady = SteadyRange(self.quantity.minimum_span)

    def _pen(self, line: TrendLine, *, predicted: bool) -> LinePen:
        model = line.role == "model" or (predicted and self.quantity.measured)
        return MODEL if model else LinePen(line.role)
