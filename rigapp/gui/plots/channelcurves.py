"""One revolution of what is no force: the pin in the bushing, or a free channel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotting import NO_REVOLUTION, PlotPanel, QuietPlot, detail
from rigapp.gui.widgets.build import choice, column
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.numbers import unit_text
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.channels import BASE, PROBES, Channel, ChannelTable, Kind
from rigapp.viewer.channels import span_of, title_of
from rigapp.viewer.frames import COMPONENT_NAMES, ForceFrame
from rigapp.viewer.news import News, Takes
from rigapp.viewer.pyramid import thinned
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.series import MeasuredCycle

ROLES = ("first", "second")


@dataclass(frozen=True, slots=True)
class CurveGroup:
    """Channels drawn together; centred: each less its mean, for what moves matters, not where."""

    title: str
    channels: tuple[Channel, ...]
    texts: tuple[str, ...]
    centred: bool = False


def curve_groups(table: ChannelTable) -> tuple[CurveGroup, ...]:
    """Return what can be drawn: the pair of probes, then each free channel of its own."""
    names = table.names_of(PROBES)
    directions = zip(names, COMPONENT_NAMES[ForceFrame.FOLLOWER], strict=True)
    texts = tuple(f"{title_of(table[name])}, {tr(direction)}" for name, direction in directions)
    probes = CurveGroup(tr("Pin position"), tuple(table[n] for n in names), texts, centred=True)
    return probes, *(
        CurveGroup(title_of(one), (one,), (title_of(one),))
        for one in table.free
        if one.kind is not Kind.SLOW
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
        """Return what is drawn."""
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
            cycle.channels[one.name].astype(np.float64)
            for one in self.group.channels
            if one.name in cycle.channels
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
        """Offer what a table has; what was chosen stays, where it is still there."""
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
        """Name the curves where they end; unit and means stand above."""
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
