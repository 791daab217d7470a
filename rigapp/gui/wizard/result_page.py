"""Page of the result, accepted or refused, with the control chart of a daily check."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import (
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from rigapp.calibrating.daily_history import STORE, DailyHistory, verdict_lines
from rigapp.calibrating.records_in_use import RecordPlace, name_record
from rigapp.calibrating.session import NumberTable, Outcome
from rigapp.config.errors import UnusableInput
from rigapp.gui.plots.palette import line_pen
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import button, column, edit, named, prose, row
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.wizard.guide_page import GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.widgets import ResidualPlot, caption, sentence, taking_what_is_left
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.texts import sentence_of_error


class ChartPlot(QWidget):
    """Show the sensitivity of all checks and of the calibration in use, and the verdict."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.plot = QuietPlot("daily_chart", tr("Sensitivity of the daily checks"), theme)
        self.plot.label("bottom", tr("Check"))
        self._line = pg.PlotDataItem(symbol="o", symbolSize=8)
        self.plot.addItem(self._line)
        self._guides: list[pg.InfiniteLine] = []
        self._history: DailyHistory | None = None
        self.dress(theme)
        self.words = sentence("daily_words", "What the control charts say")
        column(
            caption("Measured / applied force"),
            (taking_what_is_left(self.plot), 1),
            self.words,
            on=self,
        )

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme, colour = theme, theme.curves["first"]
        self.plot.dress(theme)
        self._line.setPen(line_pen(colour))
        self._line.setSymbolPen(colour)
        self._line.setSymbolBrush(colour)
        if self._history is not None:
            self.show_history(self._history)

    def show_history(self, history: DailyHistory) -> None:
        """Show the checks, the limits, and the sentences."""
        self._history = history
        chart = history.charts["sensitivity_ratio"]
        self._line.setData(np.arange(1.0, len(chart.values) + 1.0), chart.values)
        for guide in self._guides:
            self.plot.removeItem(guide)
        self._guides = []
        levels = [chart.promised]
        self._level(chart.promised, "by the calibration")
        if chart.expanded is not None:
            for sign in (-1.0, 1.0):
                levels.append(chart.promised + sign * chart.expanded)
                self._level(levels[-1], "its U", dotted=True)
        for limit in chart.limits or ():
            levels.append(limit)
            self._level(limit, "limit of the history", dotted=True)
        low = min(float(chart.values.min()), *levels)
        high = max(float(chart.values.max()), *levels)
        margin = max(0.15 * (high - low), 1e-4)
        self.plot.setXRange(0.5, max(8.5, len(chart.values) + 0.5), padding=0.0)
        self.plot.setYRange(low - margin, high + margin, padding=0.0)
        self.words.setText("\n".join(map(translate, verdict_lines(history))))

    def _level(self, value: float, words: Text, *, dotted: bool = False) -> None:
        pen = line_pen(self._theme.text, dotted=dotted)
        guide = pg.InfiniteLine(
            value,
            angle=0,
            pen=pen,
            label=tr(words),
            labelOpts={"position": 0.88, "color": self._theme.text},
        )
        self.plot.addItem(guide)
        self._guides.append(guide)


USE: Text = "Write its name into the &rig file…"


class CertificatePage(GuidePage):
    """Write the certificate beside the record, as PDF or HTML; bring the record into use."""

    def __init__(self, live: LiveCalibration, prefix: str, usage: RecordPlace) -> None:
        """Make the widgets; prefix: of their names; usage: place of the record in a rig file."""
        super().__init__("Certificate")
        self._live, self._usage = live, usage
        alone: Text = "The certificate is made from the record alone: the same bytes each time."
        about = prose(f"{prefix}certificate_about", "What a certificate is", alone)
        about.setProperty("role", "secondary")
        self.saved = sentence(f"{prefix}saved", "Where the record is", 1.15)
        for_pdf, for_html = (
            marked("Write the certificate as &PDF"),
            marked("Write the certificate as &HTML"),
        )
        self.pdf = button(f"{prefix}certificate_pdf", for_pdf, lambda: self._write(".pdf"))
        self.html = button(f"{prefix}certificate_html", for_html, lambda: self._write(".html"))
        self.words = sentence(f"{prefix}certificate_words", "Where the certificate is")
        spoken: Text = "Write the name of the record into the rig file"
        self.use = button(f"{prefix}use_record", USE, self._use, spoken)
        leave: Text = "Leave the rig file as it is"
        self.no = button(f"{prefix}leave_rig_file", "N&o, leave it", self._leave, leave)
        self.used = sentence(f"{prefix}use_words", "What happens to the rig file")
        upper = (about, self.saved, flowing(self.pdf, self.html), self.words)
        self.hold(*upper, self.used, flowing(self.use, self.no), None)
        self._requested = False
        live.reported.connect(self.words.setText)
        self.setFinalPage(True)

    def initializePage(self) -> None:
        """Show the name of the record."""
        outcome = self._live.outcome
        path = outcome.saved if outcome is not None else None
        practice: Text = " It was made on a simulated rig, for practice."
        saved = tr("The record is saved and read-only: {}.", path)
        self.saved.setText(saved + (tr(practice) if self._live.rig.simulated else ""))
        self.words.clear()
        self._leave()
        self.pdf.setFocus()
        self._live.run(_load_writers, lambda _: None)

    def _write(self, suffix: str) -> None:
        outcome = self._live.outcome
        if outcome is None or outcome.saved is None:
            return
        from rigapp.calibrating.certificate import write_certificate

        record, target = outcome.saved, outcome.saved.with_suffix(suffix)
        self.words.setText(tr("Writing the certificate; the first one takes some seconds …"))
        self._live.run(
            lambda: write_certificate(record, target),
            lambda mark: self.words.setText(
                tr("The certificate is {}.", target)
                + (tr(" Each page is marked {}.", mark) if mark else "")
            ),
        )

    def _leave(self) -> None:
        """Withdraw the question; show how to bring the record into use."""
        file, outcome = self._live.rig.file, self._live.outcome
        alone = outcome is not None and self._usage.alone(outcome.kind)
        self._requested = False
        self.no.hide()
        self.use.setVisible(file is not None and alone)
        self.use.setText(tr(USE))
        name = tr("the rig file") if file is None else str(file)
        value = "..." if alone else f'[{tr("this record")}, "{tr("the other probe")}"]'
        self.used.setText(
            tr(
                "The record counts when {} names it: section [{}], {} = {}",
                name,
                self._usage.section,
                self._usage.key,
                value,
            )
        )

    def _use(self) -> None:
        """Write the record's name into the rig file, after confirmation."""
        file, outcome = self._live.rig.file, self._live.outcome
        if file is None or outcome is None or outcome.saved is None:
            return
        if not self._requested:
            self._requested = True
            findings = " ".join(map(translate, outcome.as_found[1])) if outcome.changed else ""
            self.used.setText(
                f"{findings}\n" * bool(findings)
                + tr(
                    (
                        "Write the name of this record into {}? Comments and everything else"
                        " stay, and a copy of the present file is kept beside it."
                    ),
                    file,
                )
            )
            self.use.setText(tr("&Yes, write it"))
            self.no.show()
            return
        try:
            copy = name_record(file, outcome.saved, self._usage)
        except UnusableInput as error:
            self._leave()
            self.used.setText(translate(sentence_of_error(error)))
            return
        self._requested = False
        self.use.hide()
        self.no.hide()
        words = tr("{} names the record now; the former file is {}.", file.name, copy.name)
        self.used.setText(words)
        self._live.ask(
            "use_records", lambda reply: self.used.setText(f"{words} {translate(reply.sentence)}")
        )


def _load_writers() -> None:
    """Import the modules that draw a certificate while the operator reads the page."""
    import matplotlib.figure  # noqa: F401

    import rigapp.calibrating.certificate
    import rigapp.report.page.document
    import rigapp.report.page.pdf  # noqa: F401


class ResultPage(GuidePage):
    """Show figures, uncertainty and problems; save the record, or show why it is refused."""

    def __init__(
        self,
        live: LiveCalibration,
        theme: Theme,
        folder: Path,
        prefix: str,
        plot: ResidualPlot | None = None,
    ) -> None:
        """Make the widgets; prefix: of their names; plot: of the residuals, if there is one."""
        super().__init__("Result")
        self._live, self.plot, self.theme = live, plot, theme
        self._store = folder / STORE
        self.verdict = sentence(f"{prefix}verdict", "Verdict", 1.8, bold=True)
        self.problems = sentence(f"{prefix}problems", "Problems", 1.15)
        self.matrix = named(QTableWidget(), f"{prefix}matrix", "Matrix and zero")
        self.matrix.setTabKeyNavigation(False)
        self.words = sentence(f"{prefix}result_words", "Numbers and uncertainty")
        self.chart: ChartPlot | None = None
        self._charts = column()
        self.target = edit(f"{prefix}record_file", "Record to make")
        self.target_label = QLabel(tr("Save the &record as"))
        self.target_label.setBuddy(self.target)
        self.problem = sentence(f"{prefix}result_problem", "What is wrong on this page")
        upper = (self.verdict, self.problems, self.matrix, self.words)
        plots = ((part, 4) for part in (plot, self._charts) if part is not None)
        last = row(self.target_label, (self.target, 1))
        self.hold(*upper, *plots, None, self.problem, last)
        live.evaluated.connect(self._show)
        live.reported.connect(self._show_report)

    def initializePage(self) -> None:
        """Fit and check all readings."""
        self.verdict.setText(tr("Calculating …"))
        for label in (self.problems, self.words, self.problem):
            label.clear()
            label.show()
        for widget in (self.matrix, self.target, self.target_label, self.chart):
            if widget is not None:
                widget.hide()
        session = self._live.session
        if session is not None:
            self.target.setText(str(session.journal.path.with_suffix(".json")))
            if self.plot is not None:
                self.plot.show_residuals(session.residuals())
        self._live.evaluate()
        self.completeChanged.emit()

    def isComplete(self) -> bool:
        """Return whether there is an accepted result or a daily check."""
        outcome = self._live.outcome
        return outcome is not None and (outcome.accepted or outcome.check is not None)

    def nextId(self) -> int:
        """Return the certificate page only when there is a record to save."""
        outcome = self._live.outcome
        return super().nextId() if outcome is None or outcome.makes_record else -1

    def validatePage(self) -> bool:
        """Seal the record when the calibration is accepted."""
        outcome, session = self._live.outcome, self._live.session
        if outcome is None or session is None:
            return False
        if not outcome.makes_record or outcome.saved is not None:
            return True
        try:
            self._live.outcome = session.save(outcome, Path(self.target.text().strip()))
        except UnusableInput as error:
            self.problem.setText(translate(sentence_of_error(error)))
            self.target.setFocus()
            return False
        return True

    def _show_report(self, text: str) -> None:
        if not (self.isVisible() and text):
            return
        if self._live.outcome is not None:
            self.problem.setText(text)
        else:
            self.verdict.setText(tr("✗ There is no result"))
            self.problems.setText(text)

    def _show(self) -> None:
        outcome, session = self._live.outcome, self._live.session
        assert outcome is not None
        words: tuple[Text, Text] = ("Accepted", "Refused")
        if outcome.check is not None:
            words = (marked("The daily check is passed"), marked("The check failed"))
            self.problems.setText("\n".join(map(translate, outcome.lines)))
            self._live.run(lambda: session.keep_check(outcome, self._store), self._show_history)
        else:
            self._show_calibration(outcome)
        self.verdict.setText(f"✓ {tr(words[0])}" if outcome.accepted else f"✗ {tr(words[1])}")
        self.problems.setHidden(not self.problems.text())
        self.setFinalPage(not outcome.makes_record)
        self.completeChanged.emit()

    def _show_history(self, history: DailyHistory) -> None:
        if self.chart is None:
            self.chart = ChartPlot(self.theme)
            self._charts.addWidget(self.chart)
        self.chart.show_history(history)
        self.chart.show()
        outcome = self._live.outcome
        if outcome is not None and outcome.accepted and not history.in_control:
            self.verdict.setText(tr("✗ The check is passed, but the cell changes"))
        self.words.setText(tr("The check is kept in {}.", self._store))

    def _show_calibration(self, outcome: Outcome) -> None:
        notes = [
            ("• " if problem["blocks"] else tr("Note: ")) + translate(str(problem["sentence"]))
            for problem in outcome.result["problems"]
        ]
        if not outcome.accepted:
            notes.append(translate(self._live.session.refused))
        if outcome.changed:
            notes += [f"• {translate(line)}" for line in outcome.as_found[1]]
        self.problems.setText("\n".join(notes))
        for widget in (self.target, self.target_label):
            widget.setVisible(outcome.accepted)
        if not outcome.accepted:
            return
        if self.plot is not None:
            self.plot.show_residuals(self._live.session.residuals())
        if outcome.table is not None:
            self._fill(outcome.table)
        lines = outcome.lines[outcome.table.in_lines if outcome.table is not None else 0 :]
        findings = () if outcome.changed else outcome.as_found[1]
        self.words.setText("\n".join(map(translate, (*lines, *findings))).replace(" um", " µm"))

    def _fill(self, table: NumberTable) -> None:
        self.matrix.setRowCount(len(table.rows))
        self.matrix.setColumnCount(len(table.columns) - 1)
        headings = [translate(heading).replace(" (", "\n(", 1) for heading in table.columns[1:]]
        self.matrix.setHorizontalHeaderLabels(headings)
        self.matrix.setVerticalHeaderLabels([translate(name) for name, *_ in table.rows])
        self.matrix.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        for axis, (_, *texts) in enumerate(table.rows):
            for index, text in enumerate(texts):
                self.matrix.setItem(axis, index, QTableWidgetItem(text))
        rows = (
            self.matrix.verticalHeader().length()
            + self.matrix.horizontalHeader().sizeHint().height()
        )
        self.matrix.setFixedHeight(rows + 2 * self.matrix.frameWidth())
        self.matrix.show()
