"""One line, whole, below the state: why the test stands, and what became of a lost engine."""

from __future__ import annotations

from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QSizePolicy

from rigapp.gui.data.texts import grouped
from rigapp.gui.plots.palette import Theme
from rigapp.schema.messages import ACTIVE_STATES, RunState, Status

WORTH_SAYING = frozenset({RunState.FAULT, RunState.STOPPED, RunState.PAUSED, RunState.PAUSING})


class NoticeBar(QFrame):
    """Show the reason of a state in full; a restart of the engine stays until it is put away."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._last: Status | None = None
        self._restart = ""
        self._bad = False
        self._told = False
        self.setObjectName("notice_bar")
        self.setAccessibleName("What happened")
        self.text = QLabel()
        self.text.setObjectName("notice_text")
        self.text.setAccessibleName("What happened")
        self.text.setWordWrap(True)
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        self.away = QPushButton("Understood")
        self.away.setObjectName("notice_away")
        self.away.setAccessibleName("Put the notice away")
        self.away.clicked.connect(self._put_away)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 2, 8, 2)
        row.addWidget(self.text, 1)
        row.addWidget(self.away)
        self.hide()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self._paint()

    def take_status(self, status: Status, *, told: bool = False) -> None:
        """Take the newest status; told: its reason is shown elsewhere."""
        self._told = told
        last, self._last = self._last, status
        if last is not None and last.engine_pid != status.engine_pid:
            self._restart = restart_sentence(last)
        self._show()

    def _show(self) -> None:
        status = self._last
        text = self._restart
        self._bad = bool(self._restart)
        worth = status is not None and status.state in WORTH_SAYING and not self._told
        if not text and worth and status is not None and status.reason:
            text = f"{status.state.value.capitalize()}: {status.reason}"
            self._bad = status.state is RunState.FAULT
        self.away.setVisible(bool(self._restart))
        if text != self.text.text():
            self.text.setText(text)
        if self.isHidden() == bool(text):
            self.setVisible(bool(text))
        self._paint()

    def _paint(self) -> None:
        theme = self._theme
        edge = theme.critical if self._bad else theme.border
        sheet = (
            f"#notice_bar {{ background: {theme.base}; border: 2px solid {edge};"
            " border-radius: 4px; }"
        )
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)

    def _put_away(self) -> None:
        self._restart = ""
        self._show()


def restart_sentence(last: Status) -> str:
    """Return what to say when another engine process answers than the one before."""
    if last.state not in ACTIVE_STATES:
        return ""
    return (
        f"The engine ended while {last.test or 'a test'} was {last.state.value}, and a new one was"
        f" started. The drive's own watchdog stops the spindle. {grouped(last.committed)}"
        f" revolutions are safe in {last.file}. To go on with it: Results (Ctrl+8), Go on with it."
    )
