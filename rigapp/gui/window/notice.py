"""One line, whole, below the state: why the test stands, and what became of a lost engine."""

from __future__ import annotations

from rigapp.gui.data.texts import grouped
from rigapp.gui.plots.palette import Theme
from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button
from rigapp.schema.messages import RunState, Status
from rigapp.schema.states import ACTIVE

WORTH_SAYING = frozenset({RunState.FAULT, RunState.STOPPED, RunState.PAUSED, RunState.PAUSING})


class NoticeBar(Bar):
    """Show the reason of a state in full; a restart of the engine stays until it is put away."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("notice", "What happened")
        self._theme = theme
        self._last: Status | None = None
        self._restart = ""
        self._bad = False
        self._told = False
        self.away = button("notice_away", "Understood", self._put_away, "Put the notice away")
        self.lay_out((self.away,))

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
        self.say(text)
        self.show_when(bool(text))
        self._paint()

    def _paint(self) -> None:
        edge = self._theme.critical if self._bad else self._theme.border
        self.frame_in(self._theme.base, f"2px solid {edge}")

    def _put_away(self) -> None:
        self._restart = ""
        self._show()


def restart_sentence(last: Status) -> str:
    """Return what to say when another engine process answers than the one before."""
    if last.state not in ACTIVE:
        return ""
    return (
        f"The engine ended while {last.test or 'a test'} was {last.state.value}, and a new one was"
        f" started. The drive's own watchdog stops the spindle. {grouped(last.committed)}"
        f" revolutions are safe in {last.file}. To go on with it: Results (Ctrl+8), Go on with it."
    )
