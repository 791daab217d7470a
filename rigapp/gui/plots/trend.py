"""The whole life of a joint: maximum, RMS, minimum against cycle, with the prediction."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QPushButton

from rigapp.gui.data.channels import SIZE
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.pyramid import polyline
from rigapp.gui.data.quantities import TrendLine, TrendQuantity, trend_quantities
from rigapp.gui.data.ranges import SteadyRange, nice_step
from rigapp.gui.data.series import LiveData, SeriesTable
from rigapp.gui.data.texts import duration
from rigapp.gui.look.tokens import Theme
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotting import NO_REVOLUTION, CursorPlot, LegendRow, PlotPanel, Pointed
from rigapp.gui.widgets.build import button, choice, column, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.schema.channels import BASE, ChannelTable

Floats = NDArray[np.float64]

BUCKETS = 1200
FOLLOWED = 1000


class TrendPlot(CursorPlot):
    """A plot whose x axis can be moved and zoomed by mouse and by keys."""

    def __init__(self, name: str, theme: Theme, pointed: Pointed) -> None:
        super().__init__(name, "Statistics against cycle", theme, pointed)
        self.setMouseEnabled(x=True, y=False)
        self.label("bottom", "Cycle")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move by the arrows, zoom by plus and minus; Esc takes the cursor away."""
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
            super().keyPressEvent(event)
            return
        self.setXRange(*wanted, padding=0.0)
        self.getViewBox().sigRangeChangedManually.emit([True, False])


class TrendPanel(PlotPanel):
    """Draw one quantity over the whole test, the last cycles, or any range chosen by hand."""

    takes = Takes.HISTORY

    def __init__(
        self, prefix: str, theme: Theme, quantity: str = SIZE, *, access_keys: bool = True
    ) -> None:
        super().__init__(f"{prefix}_trend_panel", "Statistics against cycle")
        self._access_keys = access_keys
        self._name = quantity
        self._channels = BASE
        self._quantities = trend_quantities(BASE)
        self._mode = "whole"
        self._drawn: tuple[object, ...] = ()
        self._curves: list[tuple[TrendLine, bool, Any]] = []
        self._cursor: float | None = None
        self._data: LiveData | None = None
        self.plot = TrendPlot(f"{prefix}_trend_plot", theme, self.point_at)
        self.plot.getViewBox().sigRangeChangedManually.connect(self._moved_by_hand)
        self._build(prefix, theme)
        self._make_curves()

    def _build(self, prefix: str, theme: Theme) -> None:
        self.choice = choice(
            f"{prefix}_trend_quantity",
            "Quantity of the trend",
            [(quantity.title, name) for name, quantity in self._quantities.items()],
        )
        self.choice.setCurrentIndex(self.choice.findData(self._name))
        self.choice.currentIndexChanged.connect(self._quantity_chosen)
        self.modes = {
            mode: self._mode_button(prefix, mode, text, spoken)
            for mode, text, spoken in (
                ("whole", "Who&le test", "Show the whole test"),
                ("last", f"Last &{FOLLOWED}", f"Follow the last {FOLLOWED} cycles"),
            )
        }
        self.values = ElidedLabel(f"{prefix}_trend_values", "Newest values of the trend")
        caption = self._keyed("Tr&end of")
        top = row(caption, self.choice, *self.modes.values(), (self.values, 1))
        self.legend = LegendRow(f"{prefix}_trend_legend", theme)
        column(top, self.legend, (self.plot, 1), on=self)

    def _mode_button(self, prefix: str, mode: str, text: str, spoken: str) -> QPushButton:
        made = button(f"{prefix}_trend_{mode}", self._keyed(text), None, spoken, checkable=True)
        made.setChecked(mode == self._mode)
        made.clicked.connect(lambda: self._set_mode(mode))
        return made

    def _keyed(self, text: str) -> str:
        return text if self._access_keys else text.replace("&", "")

    @property
    def quantity(self) -> TrendQuantity:
        """Return what is shown."""
        return self._quantities[self._name]

    def show_news(self, news: News) -> None:
        """Draw if rows, quantity or view have changed since the last time."""
        data = news.data
        if data is not self._data:
            self._data = data
            self._drawn = ()
            self.plot.steady.forget()
        if data.channels is not self._channels:
            self._offer(data.channels)
        self._place_view(data.rows, data.predictions)
        view = tuple(self.plot.viewRange()[0])
        token = (self._name, len(data.rows), len(data.predictions), view)
        if token == self._drawn:
            return
        self._drawn = token
        low, high = np.inf, -np.inf
        texts = []
        for line, predicted, curve in self._curves:
            table = data.predictions if predicted else data.rows
            x, y = visible(table, line.column, *view)
            known = np.isfinite(y)
            complete = bool(known.all())
            curve.setData(x, y, connect="all" if complete else "finite")
            if known.any():
                low = min(low, float(np.nanmin(y)))
                high = max(high, float(np.nanmax(y)))
            value = self._value(table, line.column)
            if np.isfinite(value):
                model = "model " if predicted and self.quantity.measured else ""
                if self._cursor is not None or not model:
                    texts.append(f"{model}{line.text} {value:.4g}{self._doubt(table, line)}")
        when = "Now" if self._cursor is None else f"At cycle {self._cursor:.0f}"
        self.values.show_text(f"{when}: " + ", ".join(texts) if texts else "")
        self.plot.fit(low, high)
        if not np.isfinite(low) and (self._mode != "free" or not len(data.rows)):
            self.plot.empty(self._nothing(len(data.rows)))

    def _nothing(self, revolutions: int) -> str:
        """Return why nothing is drawn."""
        title = self.quantity.title
        if not revolutions:
            return f"{NO_REVOLUTION}: {title} against cycle is drawn here."
        teller = "" if self.quantity.measured else ", which the model beside the test tells"
        return f"No value yet of {title}{teller}."

    def _offer(self, table: ChannelTable) -> None:
        """Offer what a table has; what was chosen stays, where it is still there."""
        self._channels, self._quantities = table, trend_quantities(table)
        chosen = self._name if self._name in self._quantities else SIZE
        self.choice.blockSignals(True)
        self.choice.clear()
        for name, quantity in self._quantities.items():
            self.choice.addItem(quantity.title, name)
        self.choice.setCurrentIndex(self.choice.findData(chosen))
        self.choice.blockSignals(False)
        self._quantity_chosen()

    def point_at(self, cycle: float | None) -> None:
        """Read the values at a cycle; None: the newest again."""
        self._cursor = None if cycle is None else float(round(cycle))
        self.plot.show_cursor(self._cursor)
        self._drawn = ()

    def _value(self, table: SeriesTable, column: str) -> float:
        if self._cursor is None or not len(table):
            return table.last(column)
        place = int(np.searchsorted(table.revolutions, self._cursor))
        if place >= len(table) or table.revolutions[place] != self._cursor:
            return float("nan")
        return float(table.series(column).values[place])

    def _doubt(self, table: SeriesTable, line: TrendLine) -> str:
        doubt = self._value(table, line.doubt) if line.doubt else float("nan")
        age_s = self._value(table, line.age) if line.age else float("nan")
        old = f", {duration(age_s)} old" if np.isfinite(age_s) else ""
        return f" ± {doubt:.2g} (k = 2)" if np.isfinite(doubt) else old

    def _place_view(self, rows: SeriesTable, predictions: SeriesTable) -> None:
        if self._mode == "free":
            return
        known = rows.revolutions if len(rows) else predictions.revolutions
        if len(known) == 0:
            return
        first, last = float(known[0]), float(known[-1])
        if self._mode == "last":
            step = FOLLOWED / 10
            high = step * np.ceil((last + 1) / step)
            wanted = (high - FOLLOWED, high)
        else:
            step = nice_step(max(last - first, 10.0), 10)
            wanted = (first, first + step * np.ceil((last - first + 1) / step))
        shown = self.plot.viewRange()[0]
        if abs(shown[0] - wanted[0]) > 1e-6 or abs(shown[1] - wanted[1]) > 1e-6:
            self.plot.setXRange(*wanted, padding=0.0)

    def _moved_by_hand(self) -> None:
        self._set_mode("free")

    def _set_mode(self, mode: str) -> None:
        self._mode = mode
        for name, one in self.modes.items():
            one.setChecked(name == mode)
        self.plot.steady.forget()
        self._drawn = ()

    def _quantity_chosen(self) -> None:
        self._name = str(self.choice.currentData())
        self._drawn = ()
        self._make_curves()

    def _make_curves(self) -> None:
        for _, _, curve in self._curves:
            self.plot.take_out(curve)
        lines = [(line, False) for line in self.quantity.measured]
        lines += [(line, True) for line in self.quantity.predicted]
        self._curves = [
            (line, predicted, self.plot.curve(self._pen(line, predicted)))
            for line, predicted in lines
        ]
        self.plot.steady = SteadyRange(self.quantity.minimum_span)
        self.plot.label("left", self.quantity.axis)
        self._show_legend()

    def _pen(self, line: TrendLine, predicted: bool) -> LinePen:
        model = line.role == "model" or (predicted and self.quantity.measured)
        return MODEL if model else LinePen(line.role)

    def _show_legend(self) -> None:
        both = bool(self.quantity.predicted and self.quantity.measured)
        entries = [
            (line.text, self._pen(line, predicted))
            for line, predicted, _ in self._curves
            if not (predicted and both)
        ]
        self.legend.show_entries([*entries, ("model", MODEL)] if both else entries)


def visible(table: SeriesTable, column: str, low: float, high: float) -> tuple[Floats, Floats]:
    """Return the points to draw of one series between two revolutions, one row beyond each end."""
    revolutions = table.revolutions
    start = int(np.searchsorted(revolutions, low)) - 1
    stop = int(np.searchsorted(revolutions, high, side="right")) + 1
    return polyline(revolutions, table.series(column).envelope(max(start, 0), stop, BUCKETS))
