"""Last pages: what came out, saved or refused, and the certificate."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import (
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWizardPage,
)

from rigapp.calibrating.daily_history import STORE, History
from rigapp.calibrating.live_calibration import Outcome
from rigapp.calibrating.load_cell_result import cell_lines
from rigapp.calibrating.rig_file import name_record
from rigapp.config.errors import UnusableInput
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.bench import Bench
from rigapp.gui.wizard.certificate_writer import CertificateWriter
from rigapp.gui.wizard.chart_plot import ChartPlot
from rigapp.gui.wizard.parts import larger, named, prose

USE = "Write its name into the &rig file…"

REFUSED = (
    "Nothing is saved. Go back, select a reading of the series that is wrong, reject it with the"
    " reason, and take that series again. All readings so far stay in the journal."
)


class ResultPage(QWizardPage):
    """Show matrix, uncertainty, problems; save the record, or say why it is refused."""

    def __init__(self, bench: Bench, theme: Theme, folder: Path) -> None:
        super().__init__()
        self._bench = bench
        self._store = folder / STORE
        self.setTitle("Result")
        self.verdict = prose("verdict", "Verdict")
        larger(self.verdict, 1.8, bold=True)
        self.problems = prose("problems", "Problems")
        larger(self.problems, 1.15)
        self.matrix = QTableWidget(2, 3)
        named(self.matrix, "matrix", "Matrix and zero")
        self.matrix.setVerticalHeaderLabels(("Axis 1", "Axis 2"))
        self.matrix.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.matrix.setMaximumHeight(6 * self.matrix.fontMetrics().height())
        self.matrix.setTabKeyNavigation(False)
        self.words = prose("result_words", "Uncertainty and classification")
        self.chart = ChartPlot(theme)
        self.target = QLineEdit()
        named(self.target, "record_file", "Record to make")
        self.target_label = QLabel("Save the &record as")
        self.target_label.setBuddy(self.target)
        self.problem = prose("result_problem", "What is wrong on this page")
        row = QHBoxLayout()
        row.addWidget(self.target_label)
        row.addWidget(self.target, 1)
        column = QVBoxLayout(self)
        column.addWidget(self.verdict)
        column.addWidget(self.problems)
        column.addWidget(self.matrix)
        column.addWidget(self.words)
        column.addWidget(self.chart, 4)
        column.addStretch(1)
        column.addWidget(self.problem)
        column.addLayout(row)
        bench.judged.connect(self._show)
        bench.said.connect(self._said)

    def initializePage(self) -> None:
        """Fit and check all readings."""
        self.verdict.setText("Calculating …")
        for label in (self.problems, self.words, self.problem):
            label.clear()
        for widget in (self.matrix, self.target, self.target_label, self.chart):
            widget.hide()
        session = self._bench.session
        if session is not None:
            self.target.setText(str(session.journal.path.with_suffix(".json")))
        self._bench.judge()
        self.completeChanged.emit()

    def isComplete(self) -> bool:
        """Tell whether there is a result to go on with: a refused calibration is not one."""
        outcome = self._bench.outcome
        return outcome is not None and (outcome.accepted or outcome.check is not None)

    def nextId(self) -> int:
        """Go to the certificate only when there is something to save."""
        outcome = self._bench.outcome
        if outcome is None or (outcome.accepted and outcome.calibration is not None):
            return super().nextId()
        return -1

    def validatePage(self) -> bool:
        """Seal the record when the calibration is accepted."""
        outcome, session = self._bench.outcome, self._bench.session
        if outcome is None or session is None:
            return False
        if not outcome.accepted or outcome.calibration is None or outcome.saved is not None:
            return True
        try:
            self._bench.outcome = session.save(outcome, Path(self.target.text().strip()))
        except UnusableInput as error:
            self.problem.setText(str(error))
            self.target.setFocus()
            return False
        return True

    def _said(self, text: str) -> None:
        if self.isVisible() and text and self._bench.outcome is not None:
            self.problem.setText(text)
        if self.isVisible() and text and self._bench.outcome is None:
            self.verdict.setText("✗ There is no result")
            self.problems.setText(text)

    def _show(self) -> None:
        outcome = self._bench.outcome
        assert outcome is not None
        if outcome.check is not None:
            self.verdict.setText(_mark(outcome, "The daily check is passed", "The check failed"))
            self.problems.setText(outcome.check.sentence)
            self._keep_check(outcome)
        else:
            self.verdict.setText(_mark(outcome, "Accepted", "Refused"))
            self._show_calibration(outcome)
        self.completeChanged.emit()

    def _keep_check(self, outcome: Outcome) -> None:
        session = self._bench.session
        assert session is not None
        self._bench.run(lambda: session.keep_check(outcome, self._store), self._show_history)

    def _show_history(self, found: History) -> None:
        self.chart.show_history(found)
        self.chart.show()
        self.words.setText(f"The check is kept in {self._store}.")

    def _show_calibration(self, outcome: Outcome) -> None:
        found = outcome.calibration
        assert found is not None
        notes = [("• " if one.blocks else "Note: ") + one.sentence for one in found.problems]
        if not outcome.accepted:
            notes.append(REFUSED)
        self.problems.setText("\n".join(notes))
        for widget in (self.target, self.target_label):
            widget.setVisible(outcome.accepted)
        if found.fit is None or not outcome.accepted:
            self.words.setText(found.classification)
            return
        unit = outcome.settings.cell.signal_unit
        heads = (f"Signal 1 (N per {unit})", f"Signal 2 (N per {unit})", f"Zero ({unit})")
        self.matrix.setHorizontalHeaderLabels(heads)
        rows = zip(found.fit.matrix.tolist(), found.fit.zero.tolist(), strict=True)
        for row, (elements, zero) in enumerate(rows):
            for place, text in enumerate((*(f"{one:.4f}" for one in elements), f"{zero:.6f}")):
                self.matrix.setItem(row, place, QTableWidgetItem(text))
        self.matrix.show()
        lines = cell_lines(found, outcome.settings)
        self.words.setText("\n\n".join(lines[4:]))


def _mark(outcome: Outcome, good: str, bad: str) -> str:
    return f"✓ {good}" if outcome.accepted else f"✗ {bad}"


class CertificatePage(QWizardPage):
    """Write the certificate of the record."""

    def __init__(self, bench: Bench) -> None:
        super().__init__()
        self._bench = bench
        self.setTitle("Certificate")
        self.setSubTitle("The certificate is made from the record alone: the same bytes each time.")
        self.saved = prose("saved", "Where the record is")
        larger(self.saved, 1.15)
        writer = CertificateWriter(
            bench, "", "Writing the certificate; the first one takes some seconds …"
        )
        self.pdf, self.html, self.words = writer.pdf, writer.html, writer.words
        self.use = QPushButton(USE)
        named(self.use, "use_record", "Write the name of the record into the rig file")
        self.no = QPushButton("N&o, leave it")
        named(self.no, "leave_rig_file", "Leave the rig file as it is")
        self.used = prose("use_words", "What happens to the rig file")
        rig = QHBoxLayout()
        rig.addWidget(self.use)
        rig.addWidget(self.no)
        rig.addStretch(1)
        column = QVBoxLayout(self)
        column.addWidget(self.saved)
        column.addLayout(writer.row)
        column.addWidget(self.words)
        column.addSpacing(self.words.fontMetrics().height())
        column.addWidget(self.used)
        column.addLayout(rig)
        column.addStretch(1)
        self._asked = False
        self.use.clicked.connect(self._use)
        self.no.clicked.connect(self._leave)
        self.setFinalPage(True)

    def initializePage(self) -> None:
        """Name the record."""
        outcome = self._bench.outcome
        path = outcome.saved if outcome is not None else None
        simulated = (
            " It was made on a simulated rig, for practice." if self._bench.rig.simulated else ""
        )
        self.saved.setText(f"The record is saved and read-only: {path}.{simulated}")
        self.words.clear()
        self._leave()
        self.pdf.setFocus()
        self._bench.run(_load_writers, lambda _: None)

    def _leave(self) -> None:
        """Ask nothing; say what would put the record to use."""
        file = self._bench.rig.file
        self._asked = False
        self.no.hide()
        self.use.setVisible(file is not None)
        self.use.setText(USE)
        name = "the rig file" if file is None else str(file)
        self.used.setText(
            f"The record counts when {name} names it: section [load_cell], calibration = ..."
        )

    def _use(self) -> None:
        """Ask first, then write the record's name into the rig file."""
        file, outcome = self._bench.rig.file, self._bench.outcome
        if file is None or outcome is None or outcome.saved is None:
            return
        if not self._asked:
            self._asked = True
            self.used.setText(
                f"Write the name of this record into {file}? Comments and all else stay, and a copy"
                " of the file as it is now is kept beside it."
            )
            self.use.setText("&Yes, write it")
            self.no.show()
            return
        try:
            copy = name_record(file, outcome.saved)
        except UnusableInput as error:
            self._leave()
            self.used.setText(str(error))
            return
        self._asked = False
        self.use.hide()
        self.no.hide()
        self.used.setText(
            f"{file.name} names the record now; the former file is {copy.name}. It counts when the"
            " engine is started again: close all windows of this rig, and open one after a minute."
        )


def _load_writers() -> None:
    """Load what draws a certificate while the operator reads the page."""
    import matplotlib.figure  # noqa: F401

    import rigapp.calibrating.certificates.certificate
    import rigapp.report.page.html
    import rigapp.report.page.pdf  # noqa: F401
