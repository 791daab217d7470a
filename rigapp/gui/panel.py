"""What a panel is, and what it may ask of the window that it is in.

A tab is a row of ``window.tabs.TABS``; its page is made by a function that is given the window as
a ``Host``, and whatever draws on it is a ``Panel``, told the news by the one Protocol.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.recording import StoredRevolution
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.plots.palette import Theme


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
class Dressed(Protocol):
    """A panel that has colours of its own."""

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        ...


class StallCounter(Protocol):
    """Tell how often and how long the window stood still."""

    stalls: int
    worst_s: float


Added = TypeVar("Added", bound=Panel)


class Host(Protocol):
    """The window, as the makers of pages see it."""

    theme: Theme
    results_folder: Path
    worker: TaskWorker
    stalls: StallCounter

    def add(self, name: str, panel: Added) -> Added:
        """Tell a panel the news from now on, and dress it; return it."""
        ...

    def ask(self, verb: str, arguments: dict[str, Any]) -> None:
        """Ask the engine; the answer is shown by the window."""
        ...

    def say(self, sentence: str, good: bool) -> None:
        """Show a sentence where answers stand."""
        ...

    def offer_start(self, test: Path) -> None:
        """Ask for the start of a test file."""
        ...

    def read_revolution(
        self,
        revolution: int,
        done: Callable[[StoredRevolution], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Read the saved cycle nearest to a revolution."""
        ...
