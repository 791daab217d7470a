"""Interface of a panel, and the requests that it may make to its window.

A tab is a row of ``window.tabs.TABS``; its page is made by a function whose argument is the window
as a ``Host``. Each widget that draws on the page is a ``Panel``, which receives the news.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

from PySide6.QtWidgets import QWidget

from rigapp.gui.look.preferences import Preferences
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text
from rigapp.viewer.knownwear import WearReader
from rigapp.viewer.news import News, Takes
from rigapp.viewer.recording import StoredRevolution
from rigapp.viewer.tasks import TaskWorker


class Panel(Protocol):
    """A widget that draws the part of the news named by ``takes``."""

    takes: Takes

    def isVisible(self) -> bool:
        """Return whether the panel is visible."""
        ...

    def show_news(self, news: News) -> None:
        """Draw what has changed; called as ``takes`` specifies."""
        ...


@runtime_checkable
class Themed(Protocol):
    """A panel that draws its own colours."""

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        ...


@runtime_checkable
class ThemedInParts(Protocol):
    """A large page whose parts are themed one after the other."""

    def parts(self) -> list[QWidget]:
        """Return all parts that need the theme."""
        ...


class StallCounter(Protocol):
    """Number and length of stalls of the window."""

    stalls: int
    worst_s: float


Added = TypeVar("Added", bound=Panel)
Read = Callable[[int, Callable[[StoredRevolution], None], Callable[[Exception], None]], None]


class Act(enum.StrEnum):
    """Action that a panel may request from the window."""

    TRY = "try"
    PREPARE = "prepare"
    CALIBRATE = "calibrate"
    RESULTS = "results"
    NEW_RIG = "new_rig"
    AGAIN = "again"
    TRIP = "trip"


class Panels(dict[str, "Panel"]):
    """The panels made so far, by name; the page of a missing one is made on access."""

    make: Callable[[str], None] | None = None

    def __missing__(self, name: str) -> Panel:
        if self.make is not None:
            self.make(name)
        if name not in self:
            raise KeyError(f"no page has a panel {name}")
        return self[name]


@dataclass(frozen=True, slots=True)
class Host:
    """Interface of the window for the functions that make pages.

    ask: send a request to the engine; the window shows the answer. say: show a sentence with the
    answers, and whether it reports success. read_revolution: read the saved cycle nearest to a
    revolution. results: the recorded tests. do: perform an action. help: show a section of
    docs/troubleshooting.md, by its anchor. preferences: of the user. wear: evaluates the wear. rig:
    the rig file, None in a replay. keys: each key of the window and its action.
    """

    theme: Theme
    results: ResultsIndex
    worker: TaskWorker
    stalls: StallCounter
    ask: Callable[[str, dict[str, Any]], None]
    say: Callable[[str, bool], None]
    read_revolution: Read
    do: Callable[[Act], None]
    help: Callable[[str], None]
    preferences: Preferences
    wear: WearReader
    rig: Path | None = None
    keys: tuple[tuple[Text, Text], ...] = ()
    panels: Panels = field(default_factory=Panels)

    @property
    def results_folder(self) -> Path:
        """Return the folder of the recorded tests."""
        return self.results.folder

    def add(self, name: str, panel: Added) -> Added:
        """Register a panel for news, apply the theme to it, and return it."""
        self.panels[name] = panel
        return panel
