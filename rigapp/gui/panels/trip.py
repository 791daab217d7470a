"""The seconds around a trip: force, pin, speed and drive current over time, and the cause."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtWidgets import QWidget

from rigapp.gui.panel import Host
from rigapp.gui.plots.curves import Trace
from rigapp.gui.plots.marks import CurveName, Spot
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotpanel import PlotPanel, detail, plot_heading
from rigapp.gui.plots.plotting import NameRoom, QuietPlot
from rigapp.gui.widgets.build import column, named, page, prose, row
from rigapp.gui.widgets.labels import heading
from rigapp.gui.widgets.reflow import FoldingSplitter
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.numbers import UNKNOWN, grouped
from rigapp.presentation.times import MOMENT, dated, duration
from rigapp.presentation.tokens import GAP, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.details import error_text
from rigapp.viewer.channels import title_of
from rigapp.viewer.news import News, Takes
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.recording import load_capture
from rigapp.viewer.tasks import TaskWorker

if TYPE_CHECKING:
    from rigapp.storage import TripCapture, TripPiece

Floats = NDArray[np.float64]

BESIDE_FROM, FACTS_WIDTH, FACTS_HEIGHT = 110 * STEP, 42 * STEP, 36 * STEP
PLOTS_HEIGHT = 84 * STEP
BEFORE, TRIGGER = LinePen("frozen"), LinePen("critical")
GREY: Final = ("force", "speed")
"""Channels also drawn for the previous revolution."""
NO_TRIP: Final[Text] = "No tripped test is chosen. Choose one under Results, then press Trip."
NOT_KEPT: Final[Text] = "This test did not trip, or its file has no samples of the trip."


@dataclass(frozen=True, slots=True)
class TripRow:
    """One plot: title, unit, the minimum range of its values, and its curves by channel.

    centred: without their means, since only the movement matters.
    """

    name: str
    title: Text
    unit: Text
    span: float
    curves: tuple[tuple[str, Text, str], ...]
    centred: bool = False


ROWS: Final = (
    TripRow(
        "force",
        "Force",
        "N",
        10.0,
        (
            ("force_1", "along", "first"),
            ("force_2", "across", "second"),
            ("force", "|F|", "main"),
        ),
    ),
    TripRow(
        "pin",
        "Pin position",
        marked("µm, each less its mean"),
        10.0,
        (("probe_1", "along follower", "first"), ("probe_2", "across follower", "second")),
        centred=True,
    ),
    TripRow("speed", "Speed", "rpm", 5.0, (("speed", "crank", "main"),)),
)
"""Plots of every trip; a drive that reports its current adds one."""


class TripPlot(PlotPanel):
    """Draw channels over the time from the trip, with the previous revolution in grey."""

    def __init__(self, spec: TripRow, theme: Theme, room: NameRoom) -> None:
        super().__init__(f"trip_{spec.name}_panel", spec.title)
        self.spec = spec
        self.plot = QuietPlot(f"trip_{spec.name}_plot", spec.title, theme, room=room)
        self.plot.label("bottom", "Time from the trip (s)")
        self.plot.draw_with(TRIGGER, self.plot.guide(0.0, horizontal=False))
        self._traces: list[Trace] = []
        self.unit = detail(f"trip_{spec.name}_unit", "Unit")
        self.unit.show_text(tr(spec.unit))
        column(row(plot_heading(spec.title), (self.unit, 1)), (self.plot, 1), on=self)

    def show_capture(self, capture: TripCapture) -> bool:
        """Draw the capture; return whether it has any data."""
        for trace in self._traces:
            self.plot.take_out(trace)
        self._traces = []
        self.plot.start_afresh()
        self.plot.steady = SteadyRange(self.spec.span)
        names: list[CurveName] = []
        for name, text, role in self.spec.curves:
            if name in capture.currents:
                self._draw(*capture.currents[name], text, LinePen(role), names)
            elif capture.series((name,)):
                parts = [piece for piece in capture.pieces if not piece.before]
                self._draw(*_joined(parts, name), text, LinePen(role), names)
                earlier = [piece for piece in capture.pieces if piece.before]
                if name in GREY:
                    self._draw(*_joined(earlier, name), "", BEFORE, names)
        known = [trace.y[np.isfinite(trace.y)] for trace in self._traces]
        values = np.concatenate([values for values in known if len(values)] or [np.empty(0)])
        if not len(values):
            return False
        times = [end for piece in capture.pieces for end in (piece.time_s[0], piece.time_s[-1])]
        low, high = float(values.min()), float(values.max())
        trigger = capture.trip.trigger_N
        spots: tuple[Spot, ...] = ()
        if self.spec.name == "force" and math.isfinite(trigger):
            spots = (Spot(0.0, trigger, tr("trip at {:.1f} N", trigger), TRIGGER),)
            high = max(high, trigger)
        self.plot.show_range("x", min(times), max(times), 0.01)
        self.plot.fit(low, high)
        self.plot.show_marks(names=tuple(names), spots=spots)
        return True

    def _draw(self, x: Floats, y: Floats, text: Text, pen: LinePen, names: list[CurveName]) -> None:
        if not len(x):
            return
        y = y - np.nanmean(y) if self.spec.centred else y
        trace = self.plot.curve(pen)
        trace.setData(x, y)
        self._traces.append(trace)
        known = y[np.isfinite(y)]
        if text and len(known):
            names.append(CurveName(tr(text), pen, float(known[-1])))


def _joined(pieces: Sequence[TripPiece], name: str) -> tuple[Floats, Floats]:
    """Return the samples of a channel in all pieces, separated by NaN."""
    x: list[Floats] = [np.empty(0)]
    y: list[Floats] = [np.empty(0)]
    for piece in pieces:
        x += [piece.time_s, piece.time_s[-1:]]
        y += [piece.values[name].astype(np.float64), np.array([np.nan])]
    return np.concatenate(x), np.concatenate(y)


class TripPage(QWidget):
    """Show the trip of the selected test, else of the shown one."""

    takes = Takes.HISTORY

    def __init__(self, theme: Theme, worker: TaskWorker) -> None:
        super().__init__()
        self._worker = worker
        self._theme = theme
        self.path: Path | None = None
        self._chosen = False
        named(self, "trip_page", "Trip")
        self.title = heading("trip_title", "Trip", VALUE_PT)
        self.sentence = prose("trip_sentence", "What tripped", NO_TRIP)
        self.table = PlainTable(
            "trip_facts", "Details of the trip", ("What", "Value"), stretch=(1,)
        )
        room = NameRoom()
        self.plots = [TripPlot(spec, theme, room) for spec in ROWS]
        current = TripRow("current", "Drive current", "A", 0.5, ())
        self.current = TripPlot(current, theme, room)
        facts = page(self.title, self.sentence, (self.table, 1))
        self._drawn = QWidget()
        column(*((plot, 1) for plot in (*self.plots, self.current)), on=self._drawn, spacing=GAP)
        both = FoldingSplitter("trip_split", BESIDE_FROM).divide(
            (facts, FACTS_WIDTH, FACTS_HEIGHT), (self._drawn, 900, PLOTS_HEIGHT)
        )
        both.setStretchFactor(1, 1)
        column(both, on=self, spacing=GAP)
        self._clear(NO_TRIP)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        for plot in (*self.plots, self.current):
            plot.dress(theme)

    def show_news(self, news: News) -> None:
        """Show the trip of the shown test, unless another one was selected."""
        if not self._chosen and news.trip is not None and news.path not in (None, self.path):
            assert news.path is not None
            self._load(news.path)

    def show_test(self, path: Path) -> None:
        """Show the trip of a test."""
        self._chosen = True
        self._load(path)

    def _load(self, path: Path) -> None:
        self.path = path
        self._clear("Reading the trip …")
        self._worker.submit(
            lambda: load_capture(path),
            lambda capture: self._take(path, capture),
            lambda error: self._clear(translate(error_text(error, "The file cannot be read."))),
        )

    def _clear(self, why: Text) -> None:
        self.sentence.setText(tr(why))
        self._drawn.hide()
        self.table.show_rows([])
        self.table.hide()

    def _take(self, path: Path, capture: TripCapture | None) -> None:
        if path != self.path:
            return
        if capture is None:
            self._clear(NOT_KEPT)
            return
        self.sentence.setText(translate(capture.sentence))
        self.table.show_rows(_facts(path, capture))
        self._drawn.show()
        self.table.show()
        self.current.spec = TripRow("current", "Drive current", "A", 0.5, _current_curves(capture))
        for plot in (*self.plots, self.current):
            plot.setVisible(plot.show_capture(capture))


def _current_curves(capture: TripCapture) -> tuple[tuple[str, Text, str], ...]:
    """Return the current channels, sampled or reported once a revolution."""
    roles = ("main", "first", "second")
    channels = [channel for channel in capture.table.free if channel.unit == "A"]
    return tuple(
        (item.name, title_of(item), role) for item, role in zip(channels, roles, strict=False)
    )


def _facts(path: Path, capture: TripCapture) -> list[tuple[str, str]]:
    trip, moment = capture.trip, UNKNOWN
    if math.isfinite(capture.happened):
        logged = time.localtime(capture.happened)
        moment = f"{dated(MOMENT, logged)}:{capture.happened % 60.0:06.3f}"
    peak = UNKNOWN
    if capture.series(("force",)):
        force = _joined([piece for piece in capture.pieces if not piece.before], "force")[1]
        largest = float(np.nanmax(force, initial=-np.inf))
        peak = f"{largest:.1f} N" if math.isfinite(largest) else UNKNOWN
    if trip.peak is not None:
        peak = f"{trip.peak.sign}{trip.peak.value_N:.1f} N"
        if math.isfinite(trip.peak.angle_deg):
            peak += tr(" at {:.0f}°", trip.peak.angle_deg)
    turned = duration(capture.turned_s, exact=True)
    rest = duration(capture.stood_s, exact=True)
    before = grouped(trip.before.revolution) if trip.before is not None else UNKNOWN
    off = tr("commanded at once, before the alarm was logged")
    return [
        (tr("File"), path.name),
        (tr("Revolution"), grouped(trip.revolution)),
        (tr("Alarm logged"), moment),
        (tr("Largest force"), peak),
        (tr("Drive off"), off if math.isfinite(capture.happened) else UNKNOWN),
        (tr("Last movement"), tr("{} after the trip, by the device's clock", turned)),
        (tr("Confirmed at rest"), tr("{} after the alarm, by the log", rest)),
        (tr("Grey: revolution before it"), before),
    ]


def trip_page(host: Host) -> QWidget:
    """Make the page of a trip."""
    return host.add("trip", TripPage(host.theme, host.worker))
