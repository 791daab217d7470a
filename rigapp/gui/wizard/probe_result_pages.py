"""Last pages for probes: what came out, saved or refused, and the certificate."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWizardPage,
)

from rigapp.calibrating.live_probes import outcome_lines
from rigapp.config.errors import UnusableInput
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.certificate_writer import CertificateWriter
from rigapp.gui.wizard.parts import larger, named, prose
from rigapp.gui.wizard.probe_bench import ProbeBench
from rigapp.gui.wizard.probe_parts import ProbeResidualPlot
from rigapp.gui.wizard.result_pages import REFUSED


class ProbeResultPage(QWizardPage):
    """Show sensitivity, uncertainty, problems; save the record, or say why it is refused."""

    def __init__(self, bench: ProbeBench, theme: Theme) -> None:
        super().__init__()
        self._bench = bench
        self.setTitle("Result")
        self.verdict = prose("probe_verdict", "Verdict")
        larger(self.verdict, 1.8, bold=True)
        self.problems = prose("probe_problems", "Problems")
        larger(self.problems, 1.15)
        self.words = prose("probe_result_words", "Sensitivity and uncertainty")
        self.plot = ProbeResidualPlot(theme)
        self.target = QLineEdit()
        named(self.target, "probe_record_file", "Record to make")
        self.target_label = QLabel("Save the &record as")
        self.target_label.setBuddy(self.target)
        self.problem = prose("probe_result_problem", "What is wrong on this page")
        row = QHBoxLayout()
        row.addWidget(self.target_label)
        row.addWidget(self.target, 1)
        column = QVBoxLayout(self)
        column.addWidget(self.verdict)
        column.addWidget(self.problems)
        column.addWidget(self.words)
        column.addWidget(self.plot, 1)
        column.addWidget(self.problem)
        column.addLayout(row)
        bench.judged.connect(self._show)
        bench.said.connect(self._said)

    def initializePage(self) -> None:
        """Fit and check all readings."""
        self.verdict.setText("Calculating …")
        for label in (self.problems, self.words, self.problem):
            label.clear()
        for widget in (self.target, self.target_label):
            widget.hide()
        session = self._bench.session
        self.plot.show_session(session)
        if session is not None:
            self.target.setText(str(session.journal.path.with_suffix(".json")))
        self._bench.judge()
        self.completeChanged.emit()

    def isComplete(self) -> bool:
        """Tell whether the result is there."""
        return self._bench.outcome is not None

    def nextId(self) -> int:
        """Go to the certificate only when there is something to save."""
        outcome = self._bench.outcome
        return super().nextId() if outcome is None or outcome.accepted else -1

    def validatePage(self) -> bool:
        """Seal the record when the calibration is accepted."""
        outcome, session = self._bench.outcome, self._bench.session
        if outcome is None or session is None:
            return False
        if not outcome.accepted or outcome.saved is not None:
            return True
        try:
            self._bench.outcome = session.save(outcome, Path(self.target.text().strip()))
        except UnusableInput as error:
            self.problem.setText(str(error))
            self.target.setFocus()
            return False
        return True

    def _said(self, text: str) -> None:
        if self.isVisible() and text and self._bench.outcome is None:
            self.verdict.setText("✗ There is no result")
            self.problems.setText(text)

    def _show(self) -> None:
        outcome = self._bench.outcome
        assert outcome is not None
        self.verdict.setText("✓ Accepted" if outcome.accepted else "✗ Refused")
        notes = [
            ("• " if one["blocks"] else "Note: ") + str(one["sentence"])
            for one in outcome.result["problems"]
        ]
        if not outcome.accepted:
            notes.append(REFUSED)
        self.problems.setText("\n".join(notes))
        self.words.setText("\n".join(outcome_lines(outcome)).replace(" um", " µm"))
        for widget in (self.target, self.target_label):
            widget.setVisible(outcome.accepted)
        self.setFinalPage(not outcome.accepted)
        self.completeChanged.emit()


class ProbeCertificatePage(QWizardPage):
    """Write the certificate of the record; say how the record is used."""

    def __init__(self, bench: ProbeBench) -> None:
        super().__init__()
        self._bench = bench
        self.setTitle("Certificate")
        self.setSubTitle("The certificate is made from the record alone: the same bytes each time.")
        self.saved = prose("probe_saved", "Where the record is")
        larger(self.saved, 1.15)
        writer = CertificateWriter(bench, "probe_", "Writing …")
        self.pdf, self.html, self.words = writer.pdf, writer.html, writer.words
        column = QVBoxLayout(self)
        column.addWidget(self.saved)
        column.addLayout(writer.row)
        column.addWidget(self.words)
        column.addStretch(1)
        self.setFinalPage(True)

    def initializePage(self) -> None:
        """Name the record."""
        outcome, session = self._bench.outcome, self._bench.session
        path = outcome.saved if outcome is not None else None
        simulated = (
            " It was made on a simulated rig, for practice." if self._bench.rig.simulated else ""
        )
        pair = session is not None and len(session.procedure.plan.probes) > 1
        line = (
            f'calibration = "{path}"' if pair else f'calibration = ["{path}", "the other probe\'s"]'
        )
        self.saved.setText(
            f"The record is saved and read-only: {path}.{simulated}\nTo use it, name it in the rig"
            f" file, section [probes]:\n{line}"
        )
        self.words.clear()
        self.pdf.setFocus()
