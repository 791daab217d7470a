"""Ask what becomes of a running test when its window is closed; never in front of the state."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton


class CloseBar(QFrame):
    """Offer to leave the test running, to stop it first, or to stay."""

    leave = Signal()
    stop_first = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("close_bar")
        self.setAccessibleName("Close the window")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.text = QLabel("A test is under way. It goes on without this window.")
        self.stay = QPushButton("Stay")
        self.stay.setObjectName("close_stay")
        self.stay.setAccessibleName("Stay in the window")
        self.stay.clicked.connect(self.hide)
        keep = QPushButton("Close, the test goes on")
        keep.setObjectName("close_leave")
        keep.setAccessibleName("Close the window, the test goes on")
        keep.clicked.connect(self.leave)
        stop = QPushButton("Stop test, then close")
        stop.setObjectName("close_stop")
        stop.setAccessibleName("Stop the test, then close the window")
        stop.clicked.connect(self._stop)
        row = QHBoxLayout(self)
        row.addWidget(self.text, 1)
        for button in (keep, stop, self.stay):
            row.addWidget(button)
        self.hide()

    def ask(self) -> None:
        """Show the question with the focus on staying."""
        self.text.setText("A test is under way. It goes on without this window.")
        self.show()
        self.stay.setFocus(Qt.FocusReason.OtherFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc stays."""
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        else:
            super().keyPressEvent(event)

    def _stop(self) -> None:
        self.text.setText("Stopping the test; the window closes when the spindle stands.")
        self.stop_first.emit()
