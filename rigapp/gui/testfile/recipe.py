"""Prepare a test: every key of the test file with unit, range and default; checked as one types."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFileDialog,
    QGridLayout,
    QGroupBox,
    QLabel,
    QLineEdit,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import as_test
from rigapp.config.reading import read_text
from rigapp.config.recipe import TestFile
from rigapp.config.toml import toml_tree
from rigapp.config.writing import whole_file
from rigapp.gui.look.tokens import Theme
from rigapp.gui.testfile.fields import (
    FieldSpec,
    changes,
    form_fields,
    get_path,
    parse_value,
    set_path,
    show_value,
)
from rigapp.gui.testfile.rules import RuleTable
from rigapp.gui.testfile.tomltext import edited
from rigapp.gui.testfile.unsaved import UnsavedBar
from rigapp.gui.widgets.build import button, filled, named, prose, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.schema.criteria import CRITERIA

COLUMNS = (
    ("", "run", "metadata", "cycles", "prediction", "model.spring", "model.joint"),
    (
        "limits",
        "stop",
        "model.mechanism",
        "model.bushing",
        "model.pin",
        "model.wear",
        "model.pairing",
    ),
)
TITLES = {
    "": "Test",
    "run": "Run",
    "metadata": "Who and what",
    "cycles": "Whole cycles to keep",
    "limits": "Always watched (drive off)",
    "stop": "Stop criteria: the first that is met ends the test (empty: off)",
    "prediction": "Model beside the data",
    "model.mechanism": "Mechanism",
    "model.spring": "Spring",
    "model.joint": "Joint",
    "model.bushing": "Bushing",
    "model.pin": "Pin",
    "model.wear": "Wear law",
    "model.pairing": "Where the pairing may run (beyond, a warning; empty: off)",
}

BESIDE = {
    f"stop.{one.count or one.window}": (f"stop.{key}", "in a row" if one.count else "over")
    for key, one in CRITERIA.items()
    if one.count or one.window
}
"""Fields that stand in the row of the field they belong to, with the word before them."""

Editor = QLineEdit | QComboBox | QCheckBox


class RecipePanel(QWidget):
    """Edit a test file."""

    start_wanted = Signal(Path)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._tree: dict[str, Any] = {}
        self._text = ""
        self._good = True
        self._path: Path | None = None
        self.test: TestFile | None = None
        self.fields = form_fields()
        self.editors: dict[str, Editor] = {}
        self.sections: dict[str, QGroupBox] = {}
        named(self, "recipe_panel", "Prepare a test")
        self._build()
        self._judge()

    @property
    def path(self) -> Path | None:
        """Return the file that is edited."""
        return self._path

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self._colour()

    def unsaved(self) -> list[str]:
        """Return the changes that are not saved, a line each; what cannot be read counts too."""
        if self._path is None:
            return []
        try:
            tree = self.tree()
        except ValueError as error:
            return [str(error)]
        return changes(self._tree, _explicit(tree, self._tree))

    def ask_before(self, what: str, then: Callable[[], None]) -> bool:
        """Do something that loses unsaved changes, after a question when there are any.

        Returns whether it was done at once.
        """
        lost = self.unsaved()
        if lost:
            self.unsaved_bar.ask(lost, what, then)
            return False
        then()
        return True

    def open_file(self, path: Path) -> None:
        """Load a test file into the form; the sentence below says when it cannot be used.

        Changes that are not saved are lost; ``ask_before`` asks first.
        """
        try:
            text = read_text(path)
            tree = toml_tree(text, path)
        except UnusableInput as error:
            self._say(str(error), good=False)
            return
        self._path, self._tree, self._text = path, tree, text
        for field in self.fields:
            self._fill(field, get_path(tree, field.path))
        for name, box in self.sections.items():
            if box.isCheckable():
                box.setChecked(get_path(tree, name) is not None)
        self.rules.fill(_rules(get_path(tree, "limits.rule")))
        self._judge()

    def tree(self) -> dict[str, Any]:
        """Return the test as nested tables; raise ValueError with one sentence."""
        tree: dict[str, Any] = {"schema": self._tree.get("schema", 1)}
        for field in self.fields:
            if field.optional and not self._section_on(field.section):
                continue
            value = self._value(field)
            if value is not None:
                set_path(tree, field.path, value)
        set_path(tree, "model.schema", get_path(self._tree, "model.schema") or 1)
        rules = self.rules.rules()
        if rules:
            set_path(tree, "limits.rule", rules)
        return tree

    def save(self, path: Path) -> bool:
        """Write the test, comments kept; False and a sentence when that is not possible.

        A file that another program has changed since it was opened is not overwritten.
        """
        self._judge()
        if self.test is None:
            return False
        try:
            text = edited(self._text, _explicit(self.tree(), self._tree), self._optional)
            if path == self._path and path.exists() and self._changed_elsewhere(path):
                self._say(
                    f"{path} was changed by another program since it was opened. Save it as"
                    " another file, or open it again, which loses what was changed here.",
                    good=False,
                )
                return False
            with whole_file(path) as part:
                part.write_text(text, encoding="utf-8")
        except UnusableInput as error:
            self._say(str(error), good=False)
            return False
        self._path, self._tree, self._text = path, tomllib.loads(text), text
        self._judge()
        return True

    def _changed_elsewhere(self, path: Path) -> bool:
        try:
            return read_text(path) != self._text
        except UnusableInput:
            return True

    @property
    def _optional(self) -> frozenset[str]:
        return frozenset(field.section for field in self.fields if field.optional)

    def _build(self) -> None:
        self.unsaved_bar = UnsavedBar(self._save)
        self.name = ElidedLabel("recipe_file", "Test file that is edited")
        self.verdict = prose("recipe_verdict", "Is the test usable?")
        self.rules = RuleTable()
        self.rules.changed.connect(self._judge)
        self.buttons = {
            name: button(f"recipe_{name}", text, call, spoken)
            for name, text, spoken, call in (
                ("open", "Op&en…", "Open a test file", self._ask_open),
                ("save", "Save  Ctrl+S", "Save the test file", self._save),
                ("save_as", "Save as…", "Save as another test file", self._ask_save),
                ("start", "Start t&his test…", "Start this test", self._start),
            )
        }
        top = row((self.name, 1), *self.buttons.values())
        shortcut = QShortcut(QKeySequence.StandardKey.Save, self)
        shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        shortcut.activated.connect(self.buttons["save"].click)
        inside = QWidget()
        columns = [
            (filled(QVBoxLayout(), (*map(self._section, names), None)), 1)
            for names in self._columns()
        ]
        row(*columns, on=inside)
        area = named(QScrollArea(), "recipe_area", "Settings of the test")
        area.setWidgetResizable(True)
        area.setWidget(inside)
        filled(QVBoxLayout(self), (top, self.unsaved_bar, self.verdict, (area, 1)))

    def _columns(self) -> list[list[str]]:
        """Return the sections of every column; those that nobody placed come last."""
        columns = [list(names) for names in COLUMNS]
        placed = {name for names in columns for name in names}
        columns[-1] += dict.fromkeys(f.section for f in self.fields if f.section not in placed)
        return columns

    def _section(self, name: str) -> QGroupBox:
        title = title_of(name)
        box = named(QGroupBox(title), f"section_{name or 'test'}", title)
        self.sections[name] = box
        grid = QGridLayout(box)
        rows: dict[str, int] = {}
        for field in (f for f in self.fields if f.section == name):
            if field.optional and not box.isCheckable():
                box.setCheckable(True)
                box.toggled.connect(self._judge)
            owner, word = BESIDE.get(field.path, ("", field.label))
            row = rows.get(owner, grid.rowCount())
            rows[field.path] = row
            self._place(field, word, grid, row, 3 if owner in rows else 0)
        return box

    def _place(self, field: FieldSpec, word: str, grid: QGridLayout, row: int, left: int) -> None:
        editor = self._editor(field)
        label = QLabel(word)
        label.setBuddy(editor)
        label.setToolTip(field.hint)
        grid.addWidget(label, row, left)
        grid.addWidget(editor, row, left + 1)
        grid.addWidget(QLabel(field.unit), row, left + 2)

    def _editor(self, field: FieldSpec) -> Editor:
        editor: Editor
        if field.kind == "choice":
            editor = QComboBox()
            editor.addItems(field.choices)
            editor.currentIndexChanged.connect(self._judge)
        elif field.kind == "bool":
            editor = QCheckBox()
            editor.toggled.connect(self._judge)
        else:
            editor = QLineEdit()
            if field.default is not msgspec.NODEFAULT and field.kind != "str":
                editor.setPlaceholderText(show_value(field.default) or "off")
            editor.textEdited.connect(self._judge)
        self.editors[field.path] = editor
        spoken = f"{field.label} {field.unit}".strip()
        return named(editor, f"field_{field.path}", spoken, field.hint)

    def _fill(self, field: FieldSpec, value: Any) -> None:
        editor = self.editors[field.path]
        if value is None and field.default is not msgspec.NODEFAULT:
            value = field.default
        if isinstance(editor, QComboBox):
            editor.setCurrentText(str(value))
        elif isinstance(editor, QCheckBox):
            editor.setChecked(bool(value))
        else:
            editor.setText("" if value is None else show_value(value))

    def _value(self, field: FieldSpec) -> Any:
        editor = self.editors[field.path]
        if isinstance(editor, QComboBox):
            return editor.currentText()
        if isinstance(editor, QCheckBox):
            return editor.isChecked()
        text = editor.text().strip()
        if not text and field.kind != "str":
            if field.default is not msgspec.NODEFAULT:
                return None
            raise ValueError(f"{title_of(field.section)}: {field.label} is missing")
        return parse_value(field, text)

    def _section_on(self, name: str) -> bool:
        box = self.sections[name]
        return box.isChecked() if box.isCheckable() else True

    def _judge(self) -> None:
        """Check the whole form; the verdict is one sentence."""
        self.test = None
        differences: list[str] = []
        self.name.show_text(str(self._path) if self._path else "No file opened yet")
        try:
            tree = self.tree()
            name = self._path.name if self._path else "test"
            test = as_test(tree, name)
        except (ValueError, UnusableInput) as error:
            self._say(f"Not usable yet. {error}", good=False)
        else:
            self.test = test
            differences = changes(self._tree, _explicit(tree, self._tree))
            text = "Usable. " + (
                "Not saved: " + "; ".join(differences) if differences else "As in the file."
            )
            self._say(text, good=True)
        start = "Save and start t&his test…" if differences else "Start t&his test…"
        self.buttons["start"].setText(start)
        for name, one in self.buttons.items():
            usable = self.test is not None and (name == "save_as" or self._path is not None)
            one.setEnabled(name == "open" or usable)

    def _say(self, sentence: str, *, good: bool) -> None:
        self._good = good
        self.verdict.setText(sentence if good else f"▲ {sentence}")
        self._colour()

    def _colour(self) -> None:
        colour = self._theme.text if self._good else self._theme.critical
        sheet = f"color: {colour};"
        if sheet != self.verdict.styleSheet():
            self.verdict.setStyleSheet(sheet)

    def _save(self) -> bool:
        return self._path is not None and self.save(self._path)

    def _start(self) -> None:
        if self._path is None:
            return
        if self.unsaved() and not self.save(self._path):
            return
        self.start_wanted.emit(self._path)

    def _ask_open(self) -> None:
        dialog = self._dialog("Open a test", QFileDialog.AcceptMode.AcceptOpen)
        dialog.fileSelected.connect(self._open_wanted)
        dialog.show()

    def _open_wanted(self, name: str) -> None:
        path = Path(name)
        self.ask_before(f"opening {path.name}", lambda: self.open_file(path))

    def _ask_save(self) -> None:
        dialog = self._dialog("Save the test as", QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix("toml")
        dialog.fileSelected.connect(lambda name: self.save(Path(name)))
        dialog.show()

    def _dialog(self, title: str, mode: QFileDialog.AcceptMode) -> QFileDialog:
        folder = str(self._path.parent) if self._path else ""
        dialog = QFileDialog(self, title, folder, "Tests (*.toml)")
        dialog.setAcceptMode(mode)
        dialog.setModal(False)
        return dialog


def title_of(section: str) -> str:
    """Return the title of a section of the form."""
    return TITLES.get(section, section.replace("_", " ").replace(".", ", ").capitalize())


def _explicit(tree: dict[str, Any], file: dict[str, Any]) -> dict[str, Any]:
    """Return a form's tree without the defaults that the file leaves out."""
    kept: dict[str, Any] = {}
    defaults = {field.path: field.default for field in form_fields()}
    for path in _paths(tree, ""):
        value = get_path(tree, path)
        given = get_path(file, path)
        default = defaults.get(path)
        default = list(default) if isinstance(default, tuple) else default
        if given is None and value == default:
            continue
        set_path(kept, path, given if given == value else value)
    return kept


def _rules(value: Any) -> list[dict[str, Any]]:
    """Return what a file has as rules; nothing where it has something else."""
    return [one for one in value if isinstance(one, dict)] if isinstance(value, list) else []


def _paths(tree: dict[str, Any], prefix: str) -> list[str]:
    found = []
    for key, value in tree.items():
        path = f"{prefix}{key}"
        found += _paths(value, f"{path}.") if isinstance(value, dict) else [path]
    return found
