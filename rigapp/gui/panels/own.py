"""Page arranged by the operator: tiles and plots of any channel, statistic and prediction."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Final

from PySide6.QtCore import QSize
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QFrame, QPushButton, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import MOST_PLOTS, MOST_TILES, ViewSection
from rigapp.gui.look.fonts import sized
from rigapp.gui.panel import Host
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.plotmenu import offer_menus
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.widgets.build import (
    add_group,
    button,
    choice,
    choose,
    column,
    named,
    prose,
    row,
    searched,
)
from rigapp.gui.widgets.labels import ElidedLabel, FittedLabel
from rigapp.gui.widgets.reflow import WrappingGrid, flowing
from rigapp.presentation.numbers import COEFFICIENT_SCALE, COEFFICIENT_UNIT, UNKNOWN
from rigapp.presentation.tokens import CAPTION_PT, GAP, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.details import error_text
from rigapp.viewer.knownwear import COEFFICIENT, REMAINING, newest_wear
from rigapp.viewer.news import News, Takes
from rigapp.viewer.quantities import (
    compared_columns,
    grouped_quantities,
    scale_of,
    trend_quantities,
)
from rigapp.viewer.series import LiveData

CYCLE: Final = "cycle"
"""The plot of the newest revolution; the others are trends, by their quantity."""
EMPTY_PAGE: Final[Text] = (
    "Arrange this page: add tiles and plots, move them, and save them with the test file."
)
TILE_WIDTH, PLOT_WIDTH, PLOT_HEIGHT = 20 * STEP, 52 * STEP, 36 * STEP
TILES_ACROSS = 6
SMALL = QSize(3 * STEP, 3 * STEP)
MOVES: Final[tuple[tuple[str, str, Text], ...]] = (
    ("earlier", "‹", "Move to the front"),
    ("later", "›", "Move to the back"),
    ("away", "×", "Remove"),
)
"""Buttons of each part: name, sign, and description."""

SaveView = Callable[[ViewSection], str]
"""Writes an arrangement into the test file; returns the file's name, raises UnusableInput."""


class OwnPart(QFrame):
    """A tile or plot with buttons to move and remove it."""

    def __init__(
        self, name: str, title: str, inside: QWidget, act: Callable[[str, str], None]
    ) -> None:
        super().__init__()
        named(self, f"own_{name}", title, role="card")
        self.inside = inside
        self.moves: dict[str, QPushButton] = {}
        for what, sign, tip in MOVES:
            move = button(
                f"own_{name}_{what}",
                sign,
                partial(act, name, what),
                tr("{}: {}", title, tr(tip)),
                tip=tip,
                rank="quiet",
            )
            move.setFixedSize(SMALL)
            self.moves[what] = move
        self.title = ElidedLabel(f"own_{name}_title", title)
        self.title.show_text(title)
        self.title.setFont(sized(self.title.font(), CAPTION_PT))
        head = row((self.title, 1), *self.moves.values(), spacing=0)
        column(head, (inside, 1), on=self, margins=(GAP, STEP // 2), spacing=0)


class OwnPage(QWidget):
    """Show the arrangement of the test, and let the operator change and save it."""

    takes = Takes.HISTORY | Takes.REVOLUTION

    def __init__(self, host: Host) -> None:
        super().__init__()
        self._host = host
        self.save_view: SaveView = _no_file
        self._theme = host.theme
        self._table: ChannelTable = BASE
        self._columns, self._quantities = tile_columns(BASE), trend_quantities(BASE)
        self._taken: ViewSection | None = None
        self._drawn: tuple[object, ...] = ()
        self.view = ViewSection()
        self._trends = TrendView()
        self._made: dict[str, OwnPart] = {}
        named(self, "own_page", "My page")
        self.tile = searched(choice("own_tile", "Tile to add", ()))
        self.plot = searched(choice("own_plot", "Plot to add", ()))
        self.add_tile = button("own_add_tile", "Add tile", self._add_tile)
        self.add_plot = button("own_add_plot", "Add plot", self._add_plot)
        self.save = button("own_save", "Save with the test file", self._save, rank="primary")
        self.hint = prose("own_told", "The page of one's own", EMPTY_PAGE, role="caption")
        self._tiles, self._plots = QWidget(), QWidget()
        self._tile_grid = WrappingGrid(TILE_WIDTH, TILES_ACROSS, on=self._tiles)
        self._plot_grid = WrappingGrid(PLOT_WIDTH, 2, on=self._plots)
        head = flowing((self.tile, 1), self.add_tile, (self.plot, 1), self.add_plot, self.save)
        column(head, self.hint, self._tiles, self._plots, None, on=self, spacing=GAP)
        self._offer()
        self._arrange()

    def dress(self, theme: Theme) -> None:
        """Apply a theme, also to plots made later."""
        self._theme = theme
        for part in self._made.values():
            if isinstance(part.inside, OverlayPanel | TrendPanel):
                part.inside.dress(theme)

    def take_view(self, view: ViewSection) -> None:
        """Show the arrangement of a test file, unless it was applied last."""
        if view != self._taken:
            self._taken = view
            self._show(view)

    def show_news(self, news: News) -> None:
        """Draw what has changed; a running or replayed test has its own arrangement."""
        if news.recipe is not None and news.recipe.view != ViewSection():
            self.take_view(news.recipe.view)
        if news.data.channels is not self._table:
            self._table = news.data.channels
            self._columns = tile_columns(self._table)
            self._quantities = trend_quantities(self._table)
            self._offer()
            self._arrange()
        for name, part in self._made.items():
            if isinstance(part.inside, OverlayPanel):
                part.inside.show_news(news)
            elif isinstance(part.inside, FittedLabel):
                part.inside.show_text(_value(news.data, name, self._columns[name]))
        token = (len(news.data.rows), len(news.data.predictions), len(news.events))
        if token != self._drawn:
            self._drawn = token
            for part in self._made.values():
                if isinstance(part.inside, TrendPanel):
                    part.inside.show_news(news)

    def _offer(self) -> None:
        for box, items in (
            (self.tile, self._columns),
            (self.plot, {CYCLE: tr("Force over the crank angle"), **self._titles()}),
        ):
            chosen = box.currentData()
            box.clear()
            for names in grouped_quantities(items, self._table):
                add_group(box, {name: items[name] for name in names})
            choose(box, chosen)

    def _titles(self) -> dict[str, str]:
        return {key: tr("{} against cycle", item.title) for key, item in self._quantities.items()}

    def _add_tile(self) -> None:
        self._change(tiles=_added(self.view.tiles, self.tile.currentData(), MOST_TILES))

    def _add_plot(self) -> None:
        self._change(plots=_added(self.view.plots, self.plot.currentData(), MOST_PLOTS))

    def _move(self, kind: str, name: str, what: str) -> None:
        names = list(getattr(self.view, kind))
        index = names.index(name)
        names.remove(name)
        if what != "away":
            names.insert(max(index + (1 if what == "later" else -1), 0), name)
        self._change(**{kind: tuple(names)})

    def _change(self, **parts: tuple[str, ...]) -> None:
        now = {"tiles": self.view.tiles, "plots": self.view.plots, **parts}
        self._show(ViewSection(**now))

    def _show(self, view: ViewSection) -> None:
        self.view = view
        self._arrange()

    def _arrange(self) -> None:
        """Arrange all parts; existing ones are moved, not recreated."""
        wanted = [name for name in self.view.tiles if name in self._columns]
        plots = [
            f"plot {plot}" for plot in self.view.plots if plot == CYCLE or plot in self._quantities
        ]
        for name in self._made.keys() - {*wanted, *plots}:
            part = self._made.pop(name)
            part.hide()
            part.setParent(None)
            part.deleteLater()
        for grid, names in ((self._tile_grid, wanted), (self._plot_grid, plots)):
            while grid.count():
                grid.takeAt(0)
            for name in names:
                part = self._made.get(name) or self._make(name)
                grid.addWidget(part)
                part.show()
        self._drawn = ()
        lost = {*self.view.tiles, *self.view.plots} - {*self._columns, *self._quantities, CYCLE}
        text = tr("This rig does not have: {}.", ", ".join(sorted(lost))) if lost else ""
        self.hint.setText(text or tr(EMPTY_PAGE))
        self.hint.setVisible(bool(lost) or not self._made)
        self._tiles.setVisible(bool(wanted))
        self._plots.setVisible(bool(plots))

    def _make(self, name: str) -> OwnPart:
        quantity = name.removeprefix("plot ")
        inside: QWidget
        if name == f"plot {CYCLE}":
            title, inside = tr("Force over the crank angle"), OverlayPanel("own", self._theme)
            inside.show_force_alone()
        elif name.startswith("plot "):
            title = self._titles()[quantity]
            inside = TrendPanel(
                f"own_{quantity}", self._theme, quantity, view=self._trends, leads=False
            )
            inside.choice.hide()
        else:
            title = self._columns[name].rpartition(" (")[0] or self._columns[name]
            bold = sized(self.font(), VALUE_PT, QFont.Weight.DemiBold)
            inside = FittedLabel(f"own_{name}_value", title, bold)
        kind = "plots" if name.startswith("plot ") else "tiles"
        part = OwnPart(name.replace(" ", "_"), title, inside, lambda _, what: self._move(
            kind, name.removeprefix("plot "), what))  # fmt: skip
        if kind == "plots":
            part.setFixedHeight(PLOT_HEIGHT)
            offer_menus(part, self._host.say)
        self._made[name] = part
        return part

    def _save(self) -> None:
        try:
            file = self.save_view(self.view)
        except UnusableInput as error:
            self._host.say(translate(error_text(error, "The page cannot be saved.")), False)
            return
        self._taken = self.view
        self._host.say(tr("Saved with {}.", file), True)


def tile_columns(table: ChannelTable) -> dict[str, str]:
    """Return the columns for tiles: every statistic and prediction, with name and unit."""
    return {
        **compared_columns(table),
        COEFFICIENT: f"{tr('Wear coefficient')} ({COEFFICIENT_UNIT})",
        REMAINING: f"{tr('Until the final wear depth')} ({tr('rev')})",
    }


def _added(names: Sequence[str], name: str | None, most: int) -> tuple[str, ...]:
    return tuple(names) if name is None or name in names else (*names, name)[:most]


def _value(data: LiveData, column_name: str, title: str) -> str:
    """Return the newest value of a column of rows or predictions, with the unit of its title."""
    table = data.rows if column_name in data.rows.names else data.predictions
    if column_name not in table.names or not len(table):
        return UNKNOWN
    stated = column_name in (COEFFICIENT, REMAINING)
    value = newest_wear(data.predictions)[column_name] if stated else table.last(column_name)
    value *= COEFFICIENT_SCALE if column_name == COEFFICIENT else scale_of(column_name)
    unit = title.rpartition(" (")[2].removesuffix(")") if title.endswith(")") else ""
    return f"{value:.4g} {unit}".rstrip() if math.isfinite(value) else UNKNOWN


def _no_file(view: ViewSection) -> str:
    raise UnusableInput("No test file is open. Open or save one in Prepare first.")


def own_page(host: Host) -> QWidget:
    """Make the operator's own page; the page of the open test file sets its ``save_view``."""
    return host.add("own", OwnPage(host))
