"""The tab of the wear: statement in words, depth with its bands, narrowing posterior."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QWidget

from rigapp.gui.panel import Host
from rigapp.gui.plots.knownwear import DepthBandPanel, NarrowingPanel
from rigapp.gui.widgets.build import column, named, prose
from rigapp.gui.widgets.reflow import FoldingSplitter
from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import tr, translate
from rigapp.viewer.knownwear import KnownWear, known_wear, newest_wear
from rigapp.viewer.news import News, Takes
from rigapp.viewer.tasks import TaskWorker

BESIDE_FROM, TALL = 90 * STEP, 35 * STEP
"""Width for both plots beside each other, height of each below the other."""
REST_S = 3.0
"""Between two computations: at the highest speed of a simulated rig bins come faster than that."""
NOTHING = KnownWear("")
Read = Callable[[Path, int], KnownWear]
"""Compute what is known of a test after a revolution, on a worker thread."""


class WearPanel(QWidget):
    """Say what is known of the wear, and draw it."""

    takes = Takes.HISTORY

    def __init__(self, theme: Theme, worker: TaskWorker, read: Read = known_wear) -> None:
        super().__init__()
        named(self, "wear_panel", "Wear")
        self._reader = read
        self._worker = worker
        self._known, self._said = NOTHING, ""
        self._read: tuple[Path | None, float] = (None, float("nan"))
        self._busy = False
        self._not_before = 0.0
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
        predictions = news.data.predictions
        newest = newest_wear(predictions)
        if self._read[0] != news.path:
            self._known, self._said, self._read = NOTHING, "", (news.path, float("nan"))
        self._have_computed(news, newest.revolution)
        waiting = tr(
            "No revolution measured yet: the wear depth with its predicted band is drawn here."
        )
        if len(news.data.rows):
            waiting = tr("What is known of the wear is being computed …")
        sentence = self._said
        if self._known.after:
            sentence += tr(" (By cycle {}.)", grouped(self._known.after))
        self.sentence.setText(sentence or waiting)
        self.bands.draw(self._known, news, waiting)
        self.narrowing.draw(self._known, sentence or waiting)

    def _have_computed(self, news: News, revolution: float) -> None:
        """Ask for the bands when the columns say something new; one computation at a time."""
        path = news.path
        rows = news.data.predictions.revolutions
        if path is None or not len(rows) or self._busy or time.monotonic() < self._not_before:
            return
        # Why nothing is known yet changes with the number of revolutions: look at each doubling.
        wanted = (path, revolution if math.isfinite(revolution) else -math.log2(len(rows)) // 1.0)
        if wanted == self._read:
            return
        after = int(rows[-1])
        self._busy = self._worker.submit(
            lambda: self._reader(path, after),
            lambda known: self._computed(wanted, known),
            lambda error: self._computed(wanted, KnownWear(tr("Not computed: {}", error))),
        )

    def _computed(self, wanted: tuple[Path, float], known: KnownWear) -> None:
        self._busy = False
        self._not_before = time.monotonic() + REST_S
        if self._read[0] == wanted[0]:
            self._read, self._known = wanted, known
            self._said = translate(known.sentence)


def wear_page(host: Host) -> QWidget:
    """Make the page of the wear."""
    return host.add("wear", WearPanel(host.theme, host.worker))
