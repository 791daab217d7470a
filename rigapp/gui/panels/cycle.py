"""Panel of one revolution: overlay, hold, any stored revolution, statistics, vector, probes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from rigapp.gui.panel import Host
from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotpanel import NO_REVOLUTION, PlotPanel, detail, plot_heading
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import button, choice, column, named, page, split, whole_number
from rigapp.gui.widgets.reflow import FoldingSplitter, flowing
from rigapp.presentation.numbers import true_minus, unit_text
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.channels import BASE, PROBES, Channel, ChannelTable, Kind
from rigapp.viewer.channels import COMPONENTS as FORCES
from rigapp.viewer.channels import SIZE, span_of, title_of
from rigapp.viewer.comparison import RevolutionCurves, statistics
from rigapp.viewer.frames import COMPONENT_NAMES, ForceFrame
from rigapp.viewer.news import News, Takes
from rigapp.viewer.pyramid import thinned
from rigapp.viewer.ranges import SteadyRange, nice_step
from rigapp.viewer.recording import StoredRevolution
from rigapp.viewer.series import MeasuredCycle

ROLES = ("first", "second")


@dataclass(frozen=True, slots=True)
class CurveGroup:
    """Channels drawn together; centred: without their means, since only the movement matters."""

    title: str
    channels: tuple[Channel, ...]
    texts: tuple[str, ...]
    centred: bool = False


def curve_groups(table: ChannelTable) -> tuple[CurveGroup, ...]:
    """Return the groups that can be drawn: the pair of probes, then each free channel."""
    names = table.names_of(PROBES)
    directions = zip(names, COMPONENT_NAMES[ForceFrame.FOLLOWER], strict=True)
    texts = tuple(f"{title_of(table[name])}, {tr(direction)}" for name, direction in directions)
    probes = CurveGroup(tr("Pin position"), tuple(table[n] for n in names), texts, centred=True)
    return probes, *(
        CurveGroup(title_of(channel), (channel,), (title_of(channel),))
        for channel in table.free
        if channel.kind is not Kind.SLOW
    )


class ChannelCurvePanel(PlotPanel):
    """Draw one group of channels against crank angle."""

    takes = Takes.REVOLUTION

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_channel_panel", "Other channels over one revolution")
        self._table = BASE
        self._groups = curve_groups(BASE)
        self._means: tuple[float, ...] = ()
        self._drawn: MeasuredCycle | None = None
        self.plot = QuietPlot(f"{prefix}_channel_plot", "Channel against crank angle", theme)
        self.plot.show_crank_angle()
        self.choice = choice(
            f"{prefix}_channel", "Channel against crank angle", (), self._group_chosen
        )
        self.title = detail(f"{prefix}_channel_title", "Unit and mean")
        self._curves = [self.plot.curve(LinePen(role)) for role in ROLES]
        column(flowing(self.choice, (self.title, 1)), (self.plot, 1), on=self)
        self._offer(BASE)
        self._nothing(NO_REVOLUTION)

    @property
    def group(self) -> CurveGroup:
        """Return the group that is drawn."""
        return self._groups[max(self.choice.currentIndex(), 0)]

    def show_news(self, news: News) -> None:
        """Draw the newest revolution if it is not drawn yet."""
        if news.data.channels is not self._table:
            self._offer(news.data.channels)
        cycle = news.data.cycle
        if cycle is self._drawn:
            return
        self._drawn = cycle
        if cycle is None:
            self._nothing(NO_REVOLUTION)
            return
        angle = cycle.angle_deg.astype(np.float64)
        shown = [
            cycle.channels[channel.name].astype(np.float64)
            for channel in self.group.channels
            if channel.name in cycle.channels
        ]
        if not shown:
            self._nothing(tr("Revolution {} does not have it", cycle.revolution))
        self._means = tuple(float(values.mean()) for values in shown)
        if self.group.centred:
            shown = [values - mean for values, mean in zip(shown, self._means, strict=True)]
        for curve, values in zip(self._curves, shown, strict=False):
            curve.setData(*thinned(angle, values, max(self.plot.width(), 200)))
        self._show_names([float(values[-1]) for values in shown])
        low = min((float(values.min()) for values in shown), default=np.nan)
        high = max((float(values.max()) for values in shown), default=np.nan)
        self.plot.fit(low, high)

    def _offer(self, table: ChannelTable) -> None:
        """List the groups of a table; the selection stays where it still exists."""
        chosen = self.choice.currentText()
        self._table, self._groups = table, curve_groups(table)
        self.choice.blockSignals(True)
        self.choice.clear()
        self.choice.addItems([group.title for group in self._groups])
        self.choice.setCurrentIndex(max(self.choice.findText(chosen), 0))
        self.choice.blockSignals(False)
        self.choice.setEnabled(len(self._groups) > 1)
        self._group_chosen()

    def _group_chosen(self) -> None:
        group = self.group
        self._means = ()
        self._drawn = None
        clear(*self._curves)
        self.plot.start_afresh()
        self.plot.steady = SteadyRange(span_of(group.channels[0]), symmetric=group.centred)
        self.title.show_text("")

    def _nothing(self, why: Text) -> None:
        clear(*self._curves)
        waiting = tr("{} over one turn of the crank is drawn here.", self.group.title)
        self.plot.empty(f"{tr(why)}: {waiting}")

    def _show_names(self, ends: list[float]) -> None:
        """Label the curves at their ends; unit and means are above."""
        group = self.group
        means = ", ".join(f"{mean:.1f}" for mean in self._means)
        unit = unit_text(group.channels[0].unit)
        mean = tr("{} less means {}") if group.centred else tr("{}, mean {}")
        self.title.show_text(mean.format(unit, means), unit)
        self.plot.show_marks(
            names=tuple(
                CurveName(text.split(",")[0], LinePen(role), end)
                for text, role, end in zip(group.texts, ROLES, ends, strict=False)
            )
        )


STATISTICS: Final[tuple[Text, ...]] = ("max", "min", "RMS")
BESIDE_FROM = 112 * STEP
TALL = 60 * STEP
"""Height of curves and of vector and channels, where they are below each other."""
KINDS: Final[tuple[Text, ...]] = ("meas.", "model", "diff.")

COMPONENTS, VALUES = 3, len(STATISTICS) * len(KINDS)
UPRIGHT_BELOW = 104 * STEP
"""Width below which the table of values is transposed, pixels: ten columns and their names."""


class ValueTable(QTableWidget):
    """Statistics of the overlay in numbers, also for screen readers and the clipboard.

    A row for each component; in a narrow window, where its values would be cut, a column.
    """

    def __init__(self, prefix: str) -> None:
        super().__init__(COMPONENTS, VALUES)
        self._upright = False
        self._names: list[str] = [""] * COMPONENTS
        self._headed: tuple[list[str], list[str]] = ([], [])
        named(self, f"{prefix}_values", "Statistics of the revolution shown, in N")
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._fill([["–"] * VALUES] * COMPONENTS)

    def show_values(self, shown: RevolutionCurves | None, frame: ForceFrame) -> None:
        """Fill the table, with dashes when nothing is shown."""
        first, second = map(tr, COMPONENT_NAMES[frame])
        self._names = ["|F| (N)", f"{first} (N)", f"{second} (N)"]
        unknown = [float("nan")] * VALUES
        table = [unknown] * COMPONENTS
        if shown is not None:
            table = [list(values) for _, values in statistics(shown)]
        self._fill([[_signed(value, index) for index, value in enumerate(line)] for line in table])

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Transpose the table where its values need it; while hidden its width is not final."""
        super().resizeEvent(event)
        if self.isVisible():
            self._turn()

    def showEvent(self, event: QShowEvent) -> None:
        """Transpose the table where its values need it."""
        self._turn()
        super().showEvent(event)

    def _turn(self) -> None:
        upright = self.width() < UPRIGHT_BELOW
        if upright is not self._upright:
            texts = self.texts()
            self._upright = upright
            self.setRowCount(VALUES if upright else COMPONENTS)
            self.setColumnCount(COMPONENTS if upright else VALUES)
            self._fill(texts)

    def texts(self) -> list[list[str]]:
        """Return the shown texts, a list for each component."""
        return [
            [
                item.text() if (item := self._cell(component, index)) is not None else "–"
                for index in range(VALUES)
            ]
            for component in range(COMPONENTS)
        ]

    def _cell(self, component: int, index: int) -> QTableWidgetItem | None:
        return self.item(index, component) if self._upright else self.item(component, index)

    def _head(self) -> None:
        """Set the headings only when they change, since this lays out the whole table."""
        between = " " if self._upright else "\n"
        kinds = [f"{tr(name)}{between}{tr(kind)}" for name in STATISTICS for kind in KINDS]
        names = (self._names, kinds) if self._upright else (kinds, self._names)
        if names != self._headed:
            self._headed = names
            self.setHorizontalHeaderLabels(names[0])
            self.setVerticalHeaderLabels(names[1])

    def _fill(self, texts: list[list[str]]) -> None:
        self._head()
        for component, values in enumerate(texts):
            for index, text in enumerate(values):
                item = self._cell(component, index)
                if item is None:
                    item = QTableWidgetItem()
                    item.setTextAlignment(
                        Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
                    )
                    cell = (index, component) if self._upright else (component, index)
                    self.setItem(*cell, item)
                if item.text() != text:
                    item.setText(text)
        height = self.horizontalHeader().sizeHint().height() + 4
        rows = (
            max(self.sizeHintForRow(row), self.rowHeight(row)) for row in range(self.rowCount())
        )
        self.setFixedHeight(height + sum(rows) + 6)


def _signed(value: float, index: int) -> str:
    sign = "+" if index % len(KINDS) == 2 else ""
    return "–" if value != value else true_minus(f"{value:{sign}.2f}")


CIRCLE = np.linspace(0.0, 2.0 * np.pi, 91)
POINTS = 720
WAITING: Final[Text] = "No revolution measured yet: the force is drawn here where it points."


class PolarPanel(PlotPanel):
    """Draw both force components against each other, with circles of equal force."""

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_polar_panel", "Force vector over one revolution")
        self._drawn: RevolutionCurves | None = None
        self._radius = 0.0
        self.plot = QuietPlot(f"{prefix}_polar_plot", "Force vector, polar", theme)
        self.plot.setAspectLocked(True)
        self._circles = [self.plot.curve(LinePen("grid")) for _ in range(2)]
        self.plot.empty(WAITING)
        self._measured = self.plot.curve(LinePen("main"))
        self._model = self.plot.curve(MODEL)
        column(plot_heading("Force vector"), (self.plot, 1), on=self)

    def refresh(self, shown: RevolutionCurves | None, frame: ForceFrame) -> None:
        """Draw the revolution that the overlay shows."""
        if shown is self._drawn:
            return
        self._drawn = shown
        if shown is None:
            clear(self._measured, self._model)
            self.plot.empty(WAITING)
            return
        self.plot.empty("")
        first, second = map(tr, COMPONENT_NAMES[frame])
        self.plot.label("bottom", tr("Force {} (N)", first))
        self.plot.label("left", tr("Force {} (N)", second))
        step = max(1, len(shown.angle_deg) // POINTS)
        self._measured.setData(*(shown.measured[name][::step] for name in FORCES))
        if shown.model is not None:
            self._model.setData(*(shown.model[name] for name in FORCES))
        else:
            clear(self._model)
        self._place_circles(float(shown.measured[SIZE].max()))

    def _place_circles(self, largest: float) -> None:
        step = nice_step(largest, 2)
        radius = step * np.ceil(largest / step)
        if radius == self._radius:
            return
        self._radius = radius
        for circle, part in zip(self._circles, (0.5, 1.0), strict=True):
            circle.setData(part * radius * np.cos(CIRCLE), part * radius * np.sin(CIRCLE))
        bound = 1.05 * radius
        self.plot.setRange(xRange=(-bound, bound), yRange=(-bound, bound), padding=0.0)


class CyclePanel(FoldingSplitter):
    """The overlay with its tools on the left, vector and other channels on the right."""

    revolution_wanted = Signal(int)
    takes = Takes.REVOLUTION

    def __init__(self, theme: Theme) -> None:
        super().__init__("cycle_split", BESIDE_FROM, "One revolution")
        self.overlay = OverlayPanel("cycle", theme)
        self.values = ValueTable("cycle")
        self.polar = PolarPanel("cycle", theme)
        self.channels = ChannelCurvePanel("cycle", theme)
        self._valued: RevolutionCurves | None = None
        self._add_tools()
        self.right = split(
            "cycle_right",
            Qt.Orientation.Vertical,
            [300, 300],
            self.polar,
            self.channels,
            spoken="Vector and other channels",
        )
        left = page(self.tools, (self.overlay, 1), self.values)
        self.divide((left, 860, TALL), (self.right, 500, TALL))

    def _add_tools(self) -> None:
        self.hold = button("cycle_hold", "&Hold", self._held, "Freeze the picture", checkable=True)
        self.stored = whole_number(
            "cycle_stored", "Stored revolution to compare with", 1, 1_000_000_000
        )
        self.show_stored = button(
            "cycle_compare",
            "Compare",
            self._compare,
            "Compare with the stored revolution",
            checkable=True,
        )
        self.tools = flowing(self.hold, "Stored revol&ution", self.stored, self.show_stored, None)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        for panel in (self.overlay, self.polar, self.channels):
            panel.dress(theme)

    def show_news(self, news: News) -> None:
        """Draw the newest revolution."""
        self.overlay.show_news(news)
        shown = self.overlay.shown
        if shown is not self._valued:
            self._valued = shown
            self.values.show_values(shown, self.overlay.frame)
            self.polar.refresh(shown, self.overlay.frame)
        if not self.overlay.held:
            self.channels.show_news(news)

    def show_revolution(self, stored: StoredRevolution) -> None:
        """Compare with a stored revolution that has been read."""
        self.stored.setValue(stored.cycle.revolution)
        self.overlay.compare_with(stored)

    def no_revolution(self) -> None:
        """Release the button when there is no revolution to compare with."""
        self.show_stored.setChecked(False)

    def _held(self, held: bool) -> None:
        self.overlay.held = held

    def _compare(self, wanted: bool) -> None:
        if wanted:
            self.stored.interpretText()
            self.revolution_wanted.emit(self.stored.value())
        else:
            self.overlay.compare_with(None)


def cycle_page(host: Host) -> QWidget:
    """Make the page of one revolution."""
    panel = host.add("cycle", CyclePanel(host.theme))

    def failed(error: Exception) -> None:
        host.say(tr("No stored revolution: {}", error), False)
        panel.no_revolution()

    panel.revolution_wanted.connect(
        lambda revolution: host.read_revolution(revolution, panel.show_revolution, failed)
    )
    return panel
