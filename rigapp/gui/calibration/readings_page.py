"""Third page: what to hang next, whether it is steady, record; all readings and what is left."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWizardPage,
)

from calibration.plans import StepKind
from rigapp.commands.practice import Mistake
from rigapp.gui.calibration.bench import Bench
from rigapp.gui.calibration.hands_panel import HandsPanel
from rigapp.gui.calibration.parts import ResidualPlot, Stability, larger, named, prose
from rigapp.gui.palette import Theme

COLUMNS = ("Series", "Step", "Mass (kg)", "Angle (deg)", "Signal 1", "Signal 2", "State")
RECORD = {
    StepKind.TURN: "The pin is &turned",
    StepKind.PRELOAD: "The preload is d&one",
    StepKind.READING: "&Record",
}


class ReadingsPage(QWizardPage):
    """Take all readings of the plan."""

    def __init__(self, bench: Bench, theme: Theme) -> None:
        super().__init__()
        self._bench = bench
        self._shown = -1
        self.setTitle("Readings")
        self.instruction = prose("instruction", "What to do now")
        larger(self.instruction, 1.8, bold=True)
        self.instruction.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.instruction.setMinimumHeight(4 * self.instruction.fontMetrics().height())
        self.progress = QProgressBar()
        named(self.progress, "calibration_progress", "Progress of the calibration")
        self.progress.setTextVisible(False)
        self.left = prose("time_left", "Progress and time left")
        self.stability = Stability(theme)
        self.live = prose("live_signal", "Signals now")
        self.record = QPushButton(RECORD[StepKind.READING])
        named(self.record, "record", "Record")
        self.record.setMinimumHeight(2 * self.record.fontMetrics().height() + 8)
        self.problem = prose("reading_problem", "What stands against it")
        self.table = QTableWidget(0, len(COLUMNS))
        named(self.table, "readings_table", "Readings")
        self.table.setHorizontalHeaderLabels(COLUMNS)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.setMinimumHeight(9 * self.table.fontMetrics().height())
        self.table.setTabKeyNavigation(False)
        self.table.verticalHeader().setAccessibleName("Number of the reading")
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.table.horizontalHeader().setStretchLastSection(True)
        self.reason = QLineEdit()
        self.reason.setPlaceholderText("why the selected reading does not count")
        named(self.reason, "reject_reason", "Reason of the rejection")
        self.reject_button = QPushButton("Re&ject and repeat its series")
        named(self.reject_button, "reject", "Reject the selected reading and repeat its series")
        self.plot = ResidualPlot(theme)
        self.hands = HandsPanel(bench, Mistake)
        self._build()

    def _build(self) -> None:
        left = QVBoxLayout()
        left.addWidget(self.instruction)
        left.addWidget(self.stability)
        left.addWidget(self.live)
        left.addWidget(self.record)
        left.addWidget(self.problem)
        left.addStretch(1)
        left.addWidget(self.left)
        left.addWidget(self.progress)
        upper = QHBoxLayout()
        upper.addLayout(left, 1)
        upper.addWidget(self.plot, 1)
        why = QLabel("Rea&son")
        why.setBuddy(self.reason)
        row = QHBoxLayout()
        row.addWidget(why)
        row.addWidget(self.reason, 1)
        row.addWidget(self.reject_button)
        column = QVBoxLayout(self)
        column.addLayout(upper, 1)
        column.addWidget(self.table, 1)
        column.addLayout(row)
        column.addWidget(self.hands)
        self.record.clicked.connect(self._record)
        self.reject_button.clicked.connect(self._reject)
        self.reason.textChanged.connect(self._enable)
        self.table.itemSelectionChanged.connect(self._enable)
        self._bench.looked.connect(self._look)
        self._bench.moved.connect(self._move)
        self._bench.said.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Show what is there; Enter records."""
        self.hands.setVisible(self._bench.rig.simulated)
        self._shown = -1
        self._move()
        self._look()
        self.record.setFocus()

    def isComplete(self) -> bool:
        """Tell whether all readings are taken."""
        session = self._bench.session
        return session is not None and session.procedure.done

    def _record(self) -> None:
        self._bench.take()
        if self.record.isEnabled():
            self.record.setFocus()

    def _reject(self) -> None:
        row = self.table.currentRow()
        if row >= 0 and self._bench.reject(row, self.reason.text()):
            self.reason.clear()
            self.table.clearSelection()

    def _move(self) -> None:
        session = self._bench.session
        if session is None:
            return
        procedure = session.procedure
        self.instruction.setText(procedure.instruction)
        self.left.setText(procedure.progress[:1].upper() + procedure.progress[1:])
        self.progress.setRange(0, len(procedure.steps))
        self.progress.setValue(procedure.position)
        if not procedure.done:
            text = RECORD.get(procedure.step.kind, RECORD[StepKind.READING])
            self.record.setText(text)
            self.record.setAccessibleName(text.replace("&", ""))
        else:
            self.left.setText("All steps are done.")
        for widget in (self.stability, self.record):
            widget.setVisible(not procedure.done)
        self._fill()
        self.plot.show_session(session)
        self.completeChanged.emit()

    def _look(self) -> None:
        bench, session = self._bench, self._bench.session
        if session is None or not self.isVisible():
            return
        readiness = bench.readiness
        self.stability.show_readiness(readiness, "no signals from the engine")
        usable = readiness is not None and readiness.ready and not session.procedure.done
        by_hand = not bench.goes_ahead and not bench.hands_busy
        had_focus = self.record.hasFocus()
        self.record.setEnabled(usable and by_hand)
        if had_focus and not self.record.isEnabled():
            self.setFocus()
        elif self.record.isEnabled() and self.focusWidget() in (None, self, self.record):
            self.record.setFocus()
        if readiness is None or math.isnan(readiness.felt):
            self.live.setText("")
            return
        one, two = readiness.steadiness.mean
        unit = session.given.cell.signal_unit
        text = f"Signals {one:+.5f}, {two:+.5f} {unit}: the cell feels {readiness.felt:.1f} N"
        expected = session.expected_force()
        if not session.procedure.done and session.procedure.step.kind is not StepKind.TURN:
            text += f"; what should hang weighs {expected:.1f} N"
        self.live.setText(text + ".")

    def _enable(self) -> None:
        row = self.table.currentRow()
        selected = row >= 0 and bool(self.table.selectedItems())
        self.reject_button.setEnabled(selected and bool(self.reason.text().strip()))

    def _fill(self) -> None:
        session = self._bench.session
        assert session is not None
        procedure = session.procedure
        self.table.setRowCount(len(procedure.taken))
        for row, one in enumerate(procedure.taken):
            step = procedure.steps[one.step]
            state = f"rejected: {one.rejected}" if one.rejected else "stands"
            cells = (
                step.series,
                str(step.number),
                f"{one.mass:g}",
                f"{math.degrees(one.angle):.1f}",
                f"{one.signal[0]:+.5f}",
                f"{one.signal[1]:+.5f}",
                state,
            )
            known = self.table.item(row, len(COLUMNS) - 1)
            if known is not None and known.text() == state and row != len(procedure.taken) - 1:
                continue
            for place, text in enumerate(cells):
                item = QTableWidgetItem(text)
                font = item.font()
                font.setStrikeOut(bool(one.rejected) and place < len(COLUMNS) - 1)
                item.setFont(font)
                self.table.setItem(row, place, item)
        self.table.scrollToBottom()
        self._enable()
