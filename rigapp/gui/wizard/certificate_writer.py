"""Buttons that write the certificate of a saved record."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QHBoxLayout, QPushButton

from rigapp.gui.wizard.parts import named, prose


class Saved(Protocol):
    """An outcome that may be saved."""

    @property
    def saved(self) -> Path | None:
        """Return the record's file."""
        ...


class WritingBench(Protocol):
    """What the buttons need of a bench."""

    @property
    def outcome(self) -> Saved | None:
        """Return what came out."""
        ...

    @property
    def said(self) -> SignalInstance:
        """Tell what went wrong."""
        ...

    def run(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Do work off the screen's thread."""
        ...


class CertificateWriter:
    """Write the certificate beside the record, as PDF or HTML; say where it is."""

    def __init__(self, bench: WritingBench, prefix: str, writing: str) -> None:
        """Make the buttons; prefix: of the widgets' names; writing: said meanwhile."""
        self._bench, self._writing = bench, writing
        self.pdf = QPushButton("Write the certificate as &PDF")
        named(self.pdf, f"{prefix}certificate_pdf", "Write the certificate as PDF")
        self.html = QPushButton("Write the certificate as &HTML")
        named(self.html, f"{prefix}certificate_html", "Write the certificate as HTML")
        self.words = prose(f"{prefix}certificate_words", "Where the certificate is")
        self.row = QHBoxLayout()
        self.row.addWidget(self.pdf)
        self.row.addWidget(self.html)
        self.row.addStretch(1)
        self.pdf.clicked.connect(lambda: self._write(".pdf"))
        self.html.clicked.connect(lambda: self._write(".html"))
        bench.said.connect(self.words.setText)

    def _write(self, suffix: str) -> None:
        outcome = self._bench.outcome
        if outcome is None or outcome.saved is None:
            return
        from rigapp.calibrating.certificates.certificate import write_certificate

        record, target = outcome.saved, outcome.saved.with_suffix(suffix)
        self.words.setText(self._writing)
        self._bench.run(
            lambda: write_certificate(record, target),
            lambda _: self.words.setText(f"The certificate is {target}."),
        )
