"""Where the pages stand; a guide (a calibration) takes their room while it is under way."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QScrollArea, QStackedWidget, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.tokens import Theme
from rigapp.gui.panel import Dressed
from rigapp.gui.widgets.build import named


class Stage(QStackedWidget):
    """The pages of the places, and one guide that can be left for them and come back to."""

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
        """Tell whether the guide is seen."""
        return self.currentIndex() == 1

    def take(self, guide: QWidget, theme: Theme) -> None:
        """Put a guide in the place of the one before it, unseen; its sheet is set here, once."""
        self._let_go()
        guide.setWindowFlags(Qt.WindowType.Widget)
        self._area.setWidget(guide)
        self.dress(theme)

    def guide(self, guide: QWidget) -> None:
        """Show the guide that was taken in the place of the pages."""
        guide.show()
        self.setCurrentIndex(1)
        (guide.focusWidget() or guide).setFocus()

    def dress(self, theme: Theme) -> None:
        """Take a theme; the focus stays, though a wizard hides its page meanwhile."""
        guide, held = self._area.widget(), self.window().focusWidget()
        for bar in (self._area.verticalScrollBar(), self._area.horizontalScrollBar()):
            dress_part(bar, theme)
        if isinstance(guide, Dressed):
            guide.dress(theme)
        elif guide is not None:
            dress_part(guide, theme)
        if held is not None and held.isVisible():
            held.setFocus()

    def end(self) -> None:
        """Let the guide go, and show the pages."""
        self._let_go()
        self.show_pages()

    def _let_go(self) -> None:
        over = self._area.takeWidget()
        if over is not None:
            over.deleteLater()

    def show_pages(self) -> None:
        """Show the pages; the guide goes on unseen."""
        self.setCurrentIndex(0)
