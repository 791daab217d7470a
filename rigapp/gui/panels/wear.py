"""The tab of the wear: statement in words, depth with its bands, narrowing posterior."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from rigapp.gui.panel import Host
from rigapp.gui.plots.knownwear import DepthBandPanel, NarrowingPanel
from rigapp.gui.widgets.build import column, named, prose
from rigapp.gui.widgets.reflow import FoldingSplitter
from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import tr
from rigapp.viewer.knownwear import WearReader
from rigapp.viewer.news import News, Takes

BESIDE_FROM, TALL = 90 * STEP, 35 * STEP
"""Width for both plots beside each other, height of each below the other."""


class WearPanel(QWidget):
    """Say what is known of the wear, and draw it."""

    takes = Takes.HISTORY

    def __init__(self, theme: Theme, reader: WearReader) -> None:
        super().__init__()
        named(self, "wear_panel", "Wear")
        self._reader = reader
        self.sentence = prose("wear_sentence", "What is known of the wear")
        font = self.sentence.font()
        font.setBold(True)
        self.sentence.setFont(font)
        self.bands, self.narrowing = DepthBandPanel(theme), NarrowingPanel(theme)
        plots = FoldingSplitter("wear_split", BESIDE_FROM).divide(
            (self.bands, 800, TALL), (self.narrowing, 600, TALL)
        )
        column(self.sentence, (plots, 1), on=self)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.bands.dress(theme)
        self.narrowing.dress(theme)

    def show_news(self, news: News) -> None:
        """Draw what is known, and have it computed where there is something new."""
        self._reader.look(news)
        known = self._reader.known
        waiting = tr(
            "No revolution measured yet: the wear depth with its predicted band is drawn here."
        )
        if len(news.data.rows):
            waiting = tr("What is known of the wear is being computed …")
        sentence = self._reader.said
        if known.after:
            sentence += tr(" (By cycle {}.)", grouped(known.after))
        self.sentence.setText(sentence or waiting)
        self.bands.draw(known, news, waiting)
        self.narrowing.draw(known, sentence or waiting)


def wear_page(host: Host) -> QWidget:
    """Make the page of the wear."""
    return host.add("wear", WearPanel(host.theme, host.wear))
