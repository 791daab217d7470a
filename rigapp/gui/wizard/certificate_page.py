"""The last page: the certificate of the record, and the record's name into the rig file."""

from __future__ import annotations

from rigapp.calibrating.records_in_use import RecordPlace, name_record
from rigapp.config.errors import UnusableInput
from rigapp.gui.widgets.build import button, prose
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.wizard.guide_page import GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.widgets import sentence
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.texts import sentence_of_error

USE: Text = "Write its name into the &rig file…"


class CertificatePage(GuidePage):
    """Write the certificate beside the record, as PDF or HTML; put the record to use."""

    def __init__(self, live: LiveCalibration, prefix: str, place: RecordPlace) -> None:
        """Make the widgets; prefix: of their names; place: where a rig file names the record."""
        super().__init__("Certificate")
        self._live, self._place = live, place
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
        self._asked = False
        live.said.connect(self.words.setText)
        self.setFinalPage(True)

    def initializePage(self) -> None:
        """Name the record."""
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
        """Ask nothing; say what would put the record to use."""
        file, outcome = self._live.rig.file, self._live.outcome
        whole = outcome is not None and self._place.alone(outcome.kind)
        self._asked = False
        self.no.hide()
        self.use.setVisible(file is not None and whole)
        self.use.setText(tr(USE))
        name = tr("the rig file") if file is None else str(file)
        value = "..." if whole else f'[{tr("this record")}, "{tr("the other probe")}"]'
        self.used.setText(
            tr(
                "The record counts when {} names it: section [{}], {} = {}",
                name,
                self._place.section,
                self._place.key,
                value,
            )
        )

    def _use(self) -> None:
        """Ask first, then write the record's name into the rig file."""
        file, outcome = self._live.rig.file, self._live.outcome
        if file is None or outcome is None or outcome.saved is None:
            return
        if not self._asked:
            self._asked = True
            found = " ".join(map(translate, outcome.as_found[1])) if outcome.changed else ""
            self.used.setText(
                f"{found}\n" * bool(found)
                + tr(
                    "Write the name of this record into {}? Comments and all else stay, and a copy"
                    " of the file as it is now is kept beside it.",
                    file,
                )
            )
            self.use.setText(tr("&Yes, write it"))
            self.no.show()
            return
        try:
            copy = name_record(file, outcome.saved, self._place)
        except UnusableInput as error:
            self._leave()
            self.used.setText(translate(sentence_of_error(error)))
            return
        self._asked = False
        self.use.hide()
        self.no.hide()
        words = tr("{} names the record now; the former file is {}.", file.name, copy.name)
        self.used.setText(words)
        self._live.ask(
            "use_records", lambda reply: self.used.setText(f"{words} {translate(reply.sentence)}")
        )


def _load_writers() -> None:
    """Load what draws a certificate while the operator reads the page."""
    import matplotlib.figure  # noqa: F401

    import rigapp.calibrating.certificate
    import rigapp.report.page.document
    import rigapp.report.page.pdf  # noqa: F401
