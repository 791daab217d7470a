"""What the first pages share: begin anew or take up a journal, choose a settings file."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QWidget,
)


def settings_row(form: QFormLayout, settings: QLineEdit, browse: QPushButton) -> None:
    """Add the row for the settings file."""
    row = QHBoxLayout()
    row.addWidget(settings, 1)
    row.addWidget(browse)
    label = QLabel("&Settings file")
    label.setBuddy(settings)
    form.addRow(label, row)


def offer_journals(begin: QComboBox, new: str, folder: Path, stem: str) -> None:
    """Offer a new calibration and every journal without a record, the newest first."""
    begin.clear()
    begin.addItem(new, None)
    for path in sorted(folder.glob(f"{stem}-*.journal"), reverse=True):
        if not path.with_suffix(".json").exists():
            begin.addItem(f"Take up {path.stem}", str(path))


def chosen_journal(begin: QComboBox, folder: Path, stem: str) -> Path:
    """Return the journal to take up, or a new one named by the time."""
    chosen = begin.currentData()
    if chosen:
        return Path(chosen)
    stamp = time.strftime("%Y%m%d-%H%M%S")
    return folder / f"{stem}-{stamp}.journal"


def choose_settings(parent: QWidget, name: str, chosen: Callable[[str], None]) -> None:
    """Open the dialog for a settings file; ``chosen`` is told which."""
    dialog = QFileDialog(parent, "Choose settings", filter="Settings (*.toml)")
    dialog.setObjectName(name)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.setModal(False)
    dialog.fileSelected.connect(chosen)
    dialog.show()
