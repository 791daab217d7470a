"""Second page for probes: where to turn the micrometer, whether it is steady, record."""

from __future__ import annotations

import math

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFormLayout,
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

from calibration.probe_procedure import ProbeStepKind, ProbeTaken
from rigapp.commands.live_probes import LiveProbeSession
from rigapp.commands.probe_practice import ProbeMistake
from rigapp.gui.calibration.hands_panel import HandsPanel
from rigapp.gui.calibration.parts import Stability, field, larger, named, number, prose
from rigapp.gui.calibration.probe_bench import ProbeBench
from rigapp.gui.calibration.probe_parts import ProbeResidualPlot
from rigapp.gui.palette import Theme

COLUMNS = ("Series", "Step", "Position (µm)", "Probe 1 (V)", "Probe 2 (V)", "State")
RECORD = {
    ProbeStepKind.MOUNT: "The &target stands before the probe",
    ProbeStepKind.READING: "&Record",
}


class ProbeReadingsPage(QWizardPage):
    """Take all readings of the plan."""

    def __init__(self, bench: ProbeBench, theme: Theme) -> None:
        super().__init__()
        self._bench = bench
        self.setTitle("Readings")
        self.instruction = prose("probe_instruction", "What to do now")
        larger(self.instruction, 1.8, bold=True)
        self.instruction.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.instruction.setMinimumHeight(4 * self.instruction.fontMetrics().height())
        self.progress = QProgressBar()
        named(self.progress, "probe_progress", "Progress of the calibration")
        self.progress.setTextVisible(False)
        self.left = prose("probe_time_left", "Progress and time left")
        self.stability = Stability(theme)
        self.live = prose("probe_live_signal", "Voltages now")
        self.shown = number(-20000.0, 20000.0, 1, 1.0, "µm")
        named(self.shown, "probe_shown", "Position that the micrometer shows, micrometres")
        self.record = QPushButton(RECORD[ProbeStepKind.READING])
        named(self.record, "probe_record", "Record")
        self.record.setMinimumHeight(2 * self.record.fontMetrics().height() + 8)
        self.problem = prose("probe_reading_problem", "What stands against it")
        self.table = QTableWidget(0, len(COLUMNS))
        named(self.table, "probe_readings_table", "Readings")
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
        named(self.reason, "probe_reject_reason", "Reason of the rejection")
        self.reject_button = QPushButton("Re&ject and repeat its series")
        named(self.reject_button, "probe_reject", "Reject the selected reading, repeat its series")
        self.plot = ProbeResidualPlot(theme)
        self.hands = HandsPanel(bench, ProbeMistake, "probe_hands", "T&urn the micrometer")
        self._build()

    def _build(self) -> None:
        form = QFormLayout()
        field(form, "Micrometer &shows", self.shown)
        left = QVBoxLayout()
        left.addWidget(self.instruction)
        left.addWidget(self.stability)
        left.addWidget(self.live)
        left.addLayout(form)
        left.addWidget(self.record)
        left.addWidget(self.problem)
        left.addStretch(1)
        left.addWidget(self.left)
        left.addWidget(self.progress)
        upper = QHBoxLayout()
        upper.addLayout(left, 1)
        upper.addWidget(self.plot, 1)
        why = QLabel("Re&ason")
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
        """Show the step under way, with the focus where it records."""
        self.hands.setVisible(self._bench.rig.simulated)
        self._move()
        self._look()
        self.record.setFocus()

    def isComplete(self) -> bool:
        """Tell whether all readings are taken."""
        session = self._bench.session
        return session is not None and session.procedure.done

    def _record(self) -> None:
        self.shown.interpretText()
        self._bench.take(1e-6 * self.shown.value())
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
        self.instruction.setText(procedure.instruction.replace(" um", " µm"))
        self.left.setText(procedure.progress[:1].upper() + procedure.progress[1:])
        self.progress.setRange(0, len(procedure.steps))
        self.progress.setValue(procedure.position)
        if procedure.done:
            self.left.setText("All steps are done.")
            self.shown.setEnabled(False)
        else:
            text = RECORD[procedure.step.kind]
            self.record.setText(text)
            self.record.setAccessibleName(text.replace("&", ""))
            self.shown.setValue(1e6 * procedure.step.position)
            self.shown.setEnabled(procedure.step.kind is ProbeStepKind.READING)
        self._fill(session)
        self.plot.show_session(session)
        self.completeChanged.emit()

    def _look(self) -> None:
        bench, session = self._bench, self._bench.session
        if session is None or not self.isVisible():
            return
        readiness = bench.readiness
        self.stability.show_readiness(readiness, "no signals from the engine")
        usable = readiness is not None and readiness.ready and not session.procedure.done
        had_focus = self.record.hasFocus()
        self.record.setEnabled(usable and not bench.goes_ahead and not bench.hands_busy)
        if had_focus and not self.record.isEnabled():
            self.setFocus()
        elif self.record.isEnabled() and self.focusWidget() in (None, self, self.record):
            self.record.setFocus()
        if readiness is None or math.isnan(readiness.felt) or session.procedure.done:
            self.live.setText("")
            return
        one, two = readiness.steadiness.mean
        step = session.procedure.step
        self.live.setText(
            f"Probe 1 {one:+.4f} V, probe 2 {two:+.4f} V. By the calibration in use probe"
            f" {step.probe} stands at {1e6 * readiness.felt:+.1f} µm."
        )

    def _enable(self) -> None:
        selected = self.table.currentRow() >= 0 and bool(self.table.selectedItems())
        self.reject_button.setEnabled(selected and bool(self.reason.text().strip()))

    def _fill(self, session: LiveProbeSession) -> None:
        taken = session.procedure.taken
        self.table.setRowCount(len(taken))
        for row, one in enumerate(taken):
            state = f"rejected: {one.rejected}" if one.rejected else "stands"
            known = self.table.item(row, len(COLUMNS) - 1)
            if known is None or known.text() != state or row == len(taken) - 1:
                self._fill_row(session, row, one, state)
        self.table.scrollToBottom()
        self._enable()

    def _fill_row(self, session: LiveProbeSession, row: int, one: ProbeTaken, state: str) -> None:
        step = session.procedure.steps[one.step]
        cells = (
            step.series,
            str(step.number),
            f"{1e6 * one.position:.1f}",
            f"{one.signal[0]:+.5f}",
            f"{one.signal[1]:+.5f}",
            state,
        )
        for place, text in enumerate(cells):
            item = QTableWidgetItem(text)
            font = item.font()
            font.setStrikeOut(bool(one.rejected) and place < len(COLUMNS) - 1)
            item.setFont(font)
            self.table.setItem(row, place, item)
