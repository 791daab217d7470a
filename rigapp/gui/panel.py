"""What a panel is, and what it may ask of the window that it is in.

A tab is a row of ``window.tabs.TABS``; its page is made by a function that is given the window as
a ``Host``, and whatever draws on it is a ``Panel``, told the news by the one Protocol.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

from PySide6.QtWidgets import QWidget

from rigapp.gui.look.preferences import Preferences
from rigapp.gui.results.results_index import ResultShelf
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text
from rigapp.viewer.knownwear import WearReader
from rigapp.viewer.news import News, Takes
from rigapp.viewer.recording import StoredRevolution
from rigapp.viewer.tasks import TaskWorker


class Panel(Protocol):
    """Draw what one takes of the news."""

    takes: Takes

    def isVisible(self) -> bool:
        """Tell whether it can be seen."""
        ...

    def show_news(self, news: News) -> None:
        """Draw what has changed; called when ``takes`` says."""
        ...


@runtime_checkable
class Themed(Protocol):
    """A panel that has colours of its own."""

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        ...


@runtime_checkable
class ThemedInParts(Protocol):
    """A page with so much on it that its parts are put in a theme one after the other."""

    def parts(self) -> list[QWidget]:
        """Return the parts; nothing that has a look of its own stands beside them."""
        ...


class StallCounter(Protocol):
    """Tell how often and how long the window stood still."""

    stalls: int
    worst_s: float


Added = TypeVar("Added", bound=Panel)
Read = Callable[[int, Callable[[StoredRevolution], None], Callable[[Exception], None]], None]


class Act(enum.StrEnum):
    """What a panel may ask the window to do."""

    TRY = "try"
    PREPARE = "prepare"
    CALIBRATE = "calibrate"
    RESULTS = "results"
    NEW_RIG = "new_rig"
    AGAIN = "again"
    TRIP = "trip"


class Panels(dict[str, "Panel"]):
    """The panels that are made so far, by name; who asks for another has its page made."""

    make: Callable[[str], None] | None = None

    def __missing__(self, name: str) -> Panel:
        if self.make is not None:
            self.make(name)
        if name not in self:
            raise KeyError(f"no page has a panel {name}")
        return self[name]


@dataclass(frozen=True, slots=True)
class Host:
    """The window, as the makers of pages see it.

    ask: a request to the engine, whose answer the window shows. say: a sentence where answers
    stand, and whether it is a good one. read_revolution: the saved cycle nearest to a revolution.
    results: the recorded tests. do: go somewhere, begin something. help: show a section of
    docs/troubleshooting.md, by its anchor. preferences: the user's choices. wear: has computed what
    is known of it. rig: the rig file, None in a replay. keys: each key of the window, and what it
    does.
    """

    theme: Theme
    results: ResultShelf
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
        """Tell a panel the news from now on, and dress it; return it."""
        self.panels[name] = panel
        return panel
