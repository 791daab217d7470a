"""The line below the strip: one message, of one height, so that nothing moves when it changes.

In a window too narrow for a sentence the line is as high as its words need.
"""

from __future__ import annotations

import time

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import named, row
from rigapp.presentation.times import dated
from rigapp.presentation.tokens import CAPTION_PT, GAP, MARGIN, STEP, Theme

HEIGHT = 13 * STEP // 2
"""Of the line: ``MESSAGE_LINES`` of text, as many as a cause and its remedy have at 1366 pixels."""


class MessageLine(QFrame):
    """Hold the bars that tell or ask something, the answer to the last command, and the time.

    bars: what asks first; while a bar is shown the next ones wait, and so does the answer.
    """

    def __init__(self, bars: tuple[Bar, ...], answer: QWidget, theme: Theme) -> None:
        super().__init__()
        named(self, "message_line", "Messages")
        self.setMinimumHeight(HEIGHT)
        self.clock = named(QLabel(), "clock", "Time")
        self.clock.setFixedWidth(18 * STEP)
        self.clock.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        *asking, telling = bars
        self._asking, self._told = tuple(asking), QWidget()
        self._shares = told = row((telling, 1), (answer, 1), on=self._told)
        told.setContentsMargins(0, 0, 0, 0)
        told.setSpacing(GAP)
        self.give_room(refused=False)
        self._row = row(*((bar, 1) for bar in asking), (self._told, 1), self.clock, on=self)
        self._row.setSpacing(GAP)
        self.make_room(tight=False)
        for bar in bars:
            bar.setMinimumHeight(HEIGHT - 1)
            bar.installEventFilter(self)
        self.dress(theme)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Show one bar at a time."""
        if event.type() in (QEvent.Type.ShowToParent, QEvent.Type.HideToParent):
            asking = any(not bar.isHidden() for bar in self._asking)
            if self._told.isHidden() is not asking:
                self._told.setHidden(asking)
        return super().eventFilter(watched, event)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        dress_part(
            self,
            theme,
            f"#message_line {{ background: {theme.alternate};"
            f" border-bottom: 1px solid {theme.hairline}; }}"
            f" #clock {{ color: {theme.muted}; font-size: {CAPTION_PT}pt; }}",
        )

    def make_room(self, *, tight: bool) -> None:
        """Leave the whole line to the message in a tight window."""
        self.clock.setVisible(not tight)
        self._row.setContentsMargins(0, 0, 0 if tight else MARGIN, 1)

    def give_room(self, *, refused: bool) -> None:
        """Share the line between message and answer: the reason of a refusal has half of it."""
        for at, share in enumerate((1, 1) if refused else (5, 2)):
            self._shares.setStretch(at, share)

    def show_time(self) -> None:
        """Show the time of day."""
        now = dated("%a %d %b  %H:%M:%S", time.localtime())
        if now != self.clock.text():
            self.clock.setText(now)
