"""Form of the fields of a test file: a line for each, with unit, range and error."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QGroupBox,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from rigapp.config.rules import ALWAYS
from rigapp.gui.testfile.fields import (
    FieldSpec,
    form_fields,
    get_path,
    parse_value,
    set_path,
    show_value,
)
from rigapp.gui.widgets.build import choice, column, named, prose, row, set_property
from rigapp.gui.widgets.reflow import WrappingRow, together
from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.criteria import CRITERIA

Editor = QLineEdit | QComboBox | QCheckBox

CAPTION_WIDTH = 22 * STEP
WIDTHS = {"int": 14 * STEP, "float": 14 * STEP, "pair": 18 * STEP}
"""Widths of the fields for numbers; texts take the rest."""

TITLES: Final[dict[str, Text]] = {
    "": "Test",
    "run": "Run",
    "metadata": "Who and what",
    "cycles": "Complete cycles to store",
    "limits": "Always watched",
    "stop": "The first that is met ends the test; what is empty is off",
    "prediction": "Model and data",
    "prediction.prior": "Wear coefficient by earlier tests: rigapp identify prints it",
    "model.mechanism": "Mechanism",
    "model.spring": "Spring",
    "model.joint": "Joint",
    "model.bushing": "Bushing",
    "model.pin": "Pin",
    "model.wear": "Wear law",
    "model.pairing": "Where the pairing may run: beyond, a warning; what is empty is off",
}

IN_A_ROW, OVER = marked("in a row"), marked("over")
BESIDE = {
    f"stop.{stop.count or stop.window}": (f"stop.{key}", IN_A_ROW if stop.count else OVER)
    for key, stop in CRITERIA.items()
    if stop.count or stop.window
}
"""Fields placed in the line of another field, with the word before them."""

SENTENCES = {f"limits.{name}": rule.sentence for name, rule in ALWAYS.items()}
"""Fields whose caption is the start of a sentence."""


class FieldLine(QWidget):
    """A caption, one or two fields with units, and below them their range or error."""

    def __init__(self, field: FieldSpec, editor: Editor) -> None:
        super().__init__()
        self.fields = [field]
        label = named(
            QLabel(translate(SENTENCES.get(field.path, field.label))), f"caption_{field.path}", ""
        )
        label.setAccessibleName(label.text())
        label.setBuddy(editor)
        label.setToolTip(field.hint)
        if field.path not in SENTENCES:
            label.setFixedWidth(CAPTION_WIDTH)
            label.setWordWrap(True)
        self.note = prose(f"note_{field.path}", tr("Range or error of {}", field.label))
        self._line = WrappingRow()
        self._line.setSpacing(STEP)
        self._line.add(label, 0)
        self._add(field, editor)
        below = row(
            (self.note, 1),
            margins=(CAPTION_WIDTH + STEP if field.path not in SENTENCES else 0, 0, 0, 0),
        )
        column(self._line, below, on=self)
        self.show_errors({})

    def join(self, field: FieldSpec, word: Text, editor: Editor) -> None:
        """Add another field to the line."""
        self.fields.append(field)
        label = QLabel(tr(word))
        label.setBuddy(editor)
        self._add(field, editor, label)

    def _add(self, field: FieldSpec, editor: Editor, before: QLabel | None = None) -> None:
        """Add a field at the end, with the word before it and its unit."""
        wide = int(isinstance(editor, QLineEdit) and field.kind not in WIDTHS)
        unit = QLabel(field.unit) if field.unit else None
        self._line.add(together(before, (editor, wide), unit), wide)

    def show_errors(self, errors: Mapping[str, str]) -> None:
        """Show the errors of the fields of the line, or their range."""
        texts = [errors[field.path] for field in self.fields if field.path in errors]
        text = f"\u2717 {' '.join(texts)}" if texts else self.fields[0].allowed
        set_property(self.note, "role", "error" if texts else "caption")
        if text != self.note.text():
            self.note.setText(text)
        self.note.setVisible(bool(text))


class FieldForm:
    """Make, fill and read the editors of all fields; show every error at its field."""

    def __init__(self, changed: Callable[[], None]) -> None:
        self._changed = changed
        self.fields = form_fields()
        self.editors: dict[str, Editor] = {}
        self.sections: dict[str, QGroupBox] = {}
        self._lines: dict[str, FieldLine] = {}

    def section(self, name: str) -> QGroupBox:
        """Return a new card with the fields of a section."""
        title = TITLES[name]
        box = named(QGroupBox(tr(title)), f"section_{name or 'test'}", title)
        self.sections[name] = box
        lines: list[QWidget] = []
        for field in (f for f in self.fields if f.section == name):
            if field.optional and not box.isCheckable():
                box.setCheckable(True)
                box.toggled.connect(self._changed)
            editor = self._editor(field)
            owner, word = BESIDE.get(field.path, ("", ""))
            if owner in self._lines:
                self._lines[owner].join(field, word, editor)
                self._lines[field.path] = self._lines[owner]
            else:
                self._lines[field.path] = FieldLine(field, editor)
                lines.append(self._lines[field.path])
        column(*lines, on=box, margins=(GAP, STEP, GAP, GAP), spacing=STEP)
        return box

    def _editor(self, field: FieldSpec) -> Editor:
        name, spoken = f"field_{field.path}", f"{field.label} {field.unit}".strip()
        editor: Editor
        if field.kind == "choice":
            items = [(option.replace("_", " "), option) for option in field.choices]
            editor = choice(name, spoken, items, self._changed)
        elif field.kind == "bool":
            editor = QCheckBox()
            editor.toggled.connect(self._changed)
        else:
            editor = QLineEdit()
            if not field.needed and field.kind != "str":
                editor.setPlaceholderText(field.default_words)
            editor.textEdited.connect(self._changed)
            if field.kind in WIDTHS:
                editor.setFixedWidth(WIDTHS[field.kind])
        self.editors[field.path] = editor
        return named(editor, name, spoken, field.hint)

    def fill(self, tree: Mapping[str, Any]) -> None:
        """Show a test; missing keys have their defaults."""
        for field in self.fields:
            self._fill(field, get_path(tree, field.path))
        for name, box in self.sections.items():
            if box.isCheckable():
                box.setChecked(get_path(tree, name) is not None)

    def _fill(self, field: FieldSpec, value: Any) -> None:
        editor = self.editors[field.path]
        if value is None and not field.needed:
            value = field.default
        if isinstance(editor, QComboBox):
            editor.setCurrentIndex(editor.findData(str(value)))
        elif isinstance(editor, QCheckBox):
            editor.setChecked(bool(value))
        else:
            editor.setText("" if value is None else show_value(value))

    def read(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return nested tables of the readable values, and a sentence for each other field."""
        tree: dict[str, Any] = {}
        errors: dict[str, str] = {}
        for field in self.fields:
            if field.optional and not self._is_on(field.section):
                continue
            try:
                value = self._value(field)
            except ValueError as error:
                errors[field.path] = f"{error}."
                continue
            if value is not None:
                set_path(tree, field.path, value)
        return tree, errors

    def _value(self, field: FieldSpec) -> Any:
        editor = self.editors[field.path]
        if isinstance(editor, QComboBox):
            return editor.currentData()
        if isinstance(editor, QCheckBox):
            return editor.isChecked()
        text = editor.text().strip()
        if not text and field.kind != "str":
            if not field.needed:
                return None
            if not field.allowed:
                raise ValueError(tr("{} is missing", field.label))
            raise ValueError(tr("{} is missing; type {}", field.label, field.allowed))
        return parse_value(field, text)

    def is_typed(self, path: str) -> bool:
        """Return whether a field is filled in; True for anything but a text field of the form."""
        editor = self.editors.get(path)
        return not isinstance(editor, QLineEdit) or bool(editor.text().strip())

    def edit(self, path: str, text: str) -> None:
        """Set the text of a field."""
        editor = self.editors[path]
        assert isinstance(editor, QLineEdit)
        editor.setText(text)

    def show_errors(self, errors: Mapping[str, str]) -> None:
        """Show every error at its field."""
        for path, editor in self.editors.items():
            set_property(editor, "wrong", path in errors)
        for line in dict.fromkeys(self._lines.values()):
            line.show_errors(errors)

    def _is_on(self, name: str) -> bool:
        box = self.sections[name]
        return box.isChecked() if box.isCheckable() else True


def page_of(parts: Sequence[QWidget]) -> QWidget:
    """Return a page of cards below each other."""
    page = QWidget()
    layout = QVBoxLayout(page)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(GAP)
    for part in parts:
        layout.addWidget(part)
    layout.addStretch(1)
    return page
