"""Stack of the pages and of a guide (a calibration) that replaces them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QScrollArea, QStackedWidget, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.panel import Themed, ThemedInParts
from rigapp.gui.widgets.build import named
from rigapp.presentation.tokens import Theme


class PageStack(QStackedWidget):
    """The pages of the places, and one guide; either of them is shown."""

    def __init__(self, pages: QWidget) -> None:
        super().__init__()
        named(self, "stage", "Page")
        self._area = named(QScrollArea(), "guide_area", "Calibration")
        self._area.setWidgetResizable(True)
        self._area.setFrameShape(QScrollArea.Shape.NoFrame)
        self._area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.addWidget(pages)
        self.addWidget(self._area)

    @property
    def guiding(self) -> bool:
        """Return whether the guide is shown."""
        return self.currentIndex() == 1

    def take(self, guide: QWidget) -> None:
        """Set another guide without showing it; see ``dress_calls``."""
        self._release_guide()
        guide.setWindowFlags(Qt.WindowType.Widget)
        self._area.setWidget(guide)

    def guide(self, guide: QWidget) -> None:
        """Show a guide set by ``take`` in place of the pages."""
        guide.show()
        self.setCurrentIndex(1)
        (guide.focusWidget() or guide).setFocus()

    def dress(self, theme: Theme) -> None:
        """Apply a theme to the guide immediately."""
        for call in self.dress_calls(theme):
            call()

    def dress_calls(self, theme: Theme) -> Iterator[Callable[[], object]]:
        """Yield calls that theme the guide part by part; they do nothing after its end."""
        guide = self._area.widget()
        if guide is None:
            return
        inside = guide.parts() if isinstance(guide, ThemedInParts) else [guide]
        for part in (*inside, self._area.verticalScrollBar(), self._area.horizontalScrollBar()):
            yield partial(self._while_held, guide, partial(dress_part, part, theme))
        if isinstance(guide, Themed):
            yield partial(self._while_held, guide, partial(guide.dress, theme))

    def _while_held(self, guide: QWidget, call: Callable[[], object]) -> None:
        if self._area.widget() is guide:
            call()

    def end(self) -> None:
        """Delete the guide, and show the pages."""
        self._release_guide()
        self.show_pages()

    def _release_guide(self) -> None:
        guide = self._area.takeWidget()
        if guide is not None:
            guide.deleteLater()

    def show_pages(self) -> None:
        """Show the pages; the guide continues hidden."""
        self.setCurrentIndex(0)
