"""The page on which readings are taken: what to do, whether it is steady, record, reject."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from PySide6.QtCore import Qt, SignalInstance
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
    QWidget,
    QWizardPage,
)

from calibration.load_cell.live import Readiness
from rigapp.calibrating.live_calibration import Rig
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.hands_panel import HandsPanel
from rigapp.gui.wizard.parts import Stability, larger, named, prose

RECORD = "&Record"


class Plan(Protocol):
    """What the page needs of a calibration in progress."""

    @property
    def done(self) -> bool:
        """Tell whether every step has been taken."""
        ...

    @property
    def progress(self) -> str:
        """Return where the calibration stands."""
        ...

    @property
    def steps(self) -> Sequence[Any]:
        """Return all steps."""
        ...

    @property
    def position(self) -> int:
        """Return the number of the step to do now, from 0."""
        ...

    @property
    def taken(self) -> Sequence[Any]:
        """Return all readings, those rejected as well."""
        ...


class Session(Protocol):
    """A calibration under way."""

    @property
    def procedure(self) -> Plan:
        """Return its state."""
        ...


class TakingBench(Protocol):
    """What the page needs of a bench."""

    rig: Rig
    readiness: Readiness | None
    goes_ahead: bool

    @property
    def session(self) -> Session | None:
        """Return the calibration under way."""
        ...

    @property
    def hands_busy(self) -> bool:
        """Tell whether the simulated hands are at work."""
        ...

    @property
    def looked(self) -> SignalInstance:
        """Tell after each look at the signals."""
        ...

    @property
    def moved(self) -> SignalInstance:
        """Tell after each step."""
        ...

    @property
    def said(self) -> SignalInstance:
        """Tell what stands against a step; empty when nothing does."""
        ...

    def reject(self, index: int, reason: str) -> bool:
        """Reject a reading with a reason."""
        ...


@dataclass(frozen=True, slots=True)
class TakingWords:
    """Names and words of the page. prefix: of the widgets' names; columns: of the table."""

    prefix: str
    progress: str
    live: str
    reject: str
    reason: str
    columns: tuple[str, ...]


class TakingPage(QWizardPage):
    """Hold the widgets of a page for readings; a page for one sensor says what they show."""

    _bench: TakingBench

    def __init__(self, bench: TakingBench, theme: Theme, words: TakingWords) -> None:
        super().__init__()
        self._bench, self._words = bench, words
        prefix = words.prefix
        self.setTitle("Readings")
        self.instruction = prose(f"{prefix}instruction", "What to do now")
        larger(self.instruction, 1.8, bold=True)
        self.instruction.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.instruction.setMinimumHeight(4 * self.instruction.fontMetrics().height())
        self.progress = QProgressBar()
        named(self.progress, words.progress, "Progress of the calibration")
        self.progress.setTextVisible(False)
        self.left = prose(f"{prefix}time_left", "Progress and time left")
        self.stability = Stability(theme)
        self.live = prose(f"{prefix}live_signal", words.live)
        self.record = QPushButton(RECORD)
        named(self.record, f"{prefix}record", "Record")
        self.record.setMinimumHeight(2 * self.record.fontMetrics().height() + 8)
        self.problem = prose(f"{prefix}reading_problem", "What stands against it")
        self.table = _readings_table(f"{prefix}readings_table", words.columns)
        self.reason = QLineEdit()
        self.reason.setPlaceholderText("why the selected reading does not count")
        named(self.reason, f"{prefix}reject_reason", "Reason of the rejection")
        self.reject_button = QPushButton("Re&ject and repeat its series")
        named(self.reject_button, f"{prefix}reject", words.reject)

    def lay_out(self, plot: QWidget, hands: HandsPanel, form: QFormLayout | None = None) -> None:
        """Put all in its place; ``form``: what is entered before a reading is recorded."""
        left = QVBoxLayout()
        left.addWidget(self.instruction)
        left.addWidget(self.stability)
        left.addWidget(self.live)
        if form is not None:
            left.addLayout(form)
        left.addWidget(self.record)
        left.addWidget(self.problem)
        left.addStretch(1)
        left.addWidget(self.left)
        left.addWidget(self.progress)
        upper = QHBoxLayout()
        upper.addLayout(left, 1)
        upper.addWidget(plot, 1)
        why = QLabel(self._words.reason)
        why.setBuddy(self.reason)
        row = QHBoxLayout()
        row.addWidget(why)
        row.addWidget(self.reason, 1)
        row.addWidget(self.reject_button)
        column = QVBoxLayout(self)
        column.addLayout(upper, 1)
        column.addWidget(self.table, 1)
        column.addLayout(row)
        column.addWidget(hands)

    def listen(
        self,
        take: Callable[[], object],
        look: Callable[[], None],
        move: Callable[[], None],
    ) -> None:
        """Connect the widgets and the bench: take a reading, show the signals, show the step."""

        def record() -> None:
            take()
            if self.record.isEnabled():
                self.record.setFocus()

        self.record.clicked.connect(record)
        self.reject_button.clicked.connect(self._reject)
        self.reason.textChanged.connect(self._enable)
        self.table.itemSelectionChanged.connect(self._enable)
        self._bench.looked.connect(look)
        self._bench.moved.connect(move)
        self._bench.said.connect(self.problem.setText)

    def isComplete(self) -> bool:
        """Tell whether all readings are taken."""
        session = self._bench.session
        return session is not None and session.procedure.done

    def show_step(self, procedure: Plan, instruction: str, record: str | None) -> None:
        """Show what to do and how far it is; ``record``: what the button says, unless done."""
        self.instruction.setText(instruction)
        self.left.setText(procedure.progress[:1].upper() + procedure.progress[1:])
        self.progress.setRange(0, len(procedure.steps))
        self.progress.setValue(procedure.position)
        if record is None:
            self.left.setText("All steps are done.")
        else:
            self.record.setText(record)
            self.record.setAccessibleName(record.replace("&", ""))

    def show_readiness(self, procedure: Plan) -> Readiness | None:
        """Show whether the signal is steady, offer to record then, keep the focus; return it."""
        bench, readiness = self._bench, self._bench.readiness
        self.stability.show_readiness(readiness, "no signals from the engine")
        usable = readiness is not None and readiness.ready and not procedure.done
        had_focus = self.record.hasFocus()
        self.record.setEnabled(usable and not bench.goes_ahead and not bench.hands_busy)
        if had_focus and not self.record.isEnabled():
            self.setFocus()
        elif self.record.isEnabled() and self.focusWidget() in (None, self, self.record):
            self.record.setFocus()
        return readiness

    def fill(self, procedure: Plan, cells: Callable[[int], tuple[str, ...]]) -> None:
        """Show all readings; ``cells``: the words of a reading before its state."""
        taken, last = procedure.taken, len(self._words.columns) - 1
        self.table.setRowCount(len(taken))
        for row, one in enumerate(taken):
            state = f"rejected: {one.rejected}" if one.rejected else "stands"
            known = self.table.item(row, last)
            if known is not None and known.text() == state and row != len(taken) - 1:
                continue
            for place, text in enumerate((*cells(row), state)):
                item = QTableWidgetItem(text)
                font = item.font()
                font.setStrikeOut(bool(one.rejected) and place < last)
                item.setFont(font)
                self.table.setItem(row, place, item)
        self.table.scrollToBottom()
        self._enable()

    def _reject(self) -> None:
        row = self.table.currentRow()
        if row >= 0 and self._bench.reject(row, self.reason.text()):
            self.reason.clear()
            self.table.clearSelection()

    def _enable(self) -> None:
        selected = self.table.currentRow() >= 0 and bool(self.table.selectedItems())
        self.reject_button.setEnabled(selected and bool(self.reason.text().strip()))


def _readings_table(name: str, columns: tuple[str, ...]) -> QTableWidget:
    table = QTableWidget(0, len(columns))
    named(table, name, "Readings")
    table.setHorizontalHeaderLabels(columns)
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setMinimumHeight(9 * table.fontMetrics().height())
    table.setTabKeyNavigation(False)
    table.verticalHeader().setAccessibleName("Number of the reading")
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setStretchLastSection(True)
    return table
