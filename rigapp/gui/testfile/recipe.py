"""Prepare a test in steps: every key of the test file with unit, range and default.

The form is checked at every edit, and every error is shown at its field. The file on the disk is
the selected test (see ``selected_test``); edits are part of it only when saved.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QFileDialog,
    QFrame,
    QScrollArea,
    QSizePolicy,
    QStackedWidget,
    QWidget,
)

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import validated_test
from rigapp.config.recipe import TestFile, ViewSection
from rigapp.config.writing import whole_file
from rigapp.gui.look.fonts import sized
from rigapp.gui.testfile.fields import (
    differences,
    fields_named,
    form_fields,
    get_path,
    in_form_words,
    set_path,
    tables_in,
)
from rigapp.gui.testfile.form import FieldForm, page_of
from rigapp.gui.testfile.rules import LimitSentences
from rigapp.gui.testfile.selected_test import SelectedTest, edited, read_selected
from rigapp.gui.testfile.sequence import MODEL, STEPS, SequenceCard, StepBar
from rigapp.gui.testfile.unsaved import UnsavedBar
from rigapp.gui.widgets.build import button, column, named, prose, row, scrolling, set_property
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import BODY_PT, GAP, MARGIN, STEP
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.texts import sentence_of_error

NO_FILE: Final[Text] = "New test, not saved yet"
LEAST_HEIGHT = 24 * STEP
"""Minimum height of a step, which scrolls: three lines."""
EMPTY: Final = {"schema": 1, "title": ""}
CHECKS: Final[Text] = "Checks"
"""Additional last step, where the checks have no room beside the form."""


class RecipePanel(QWidget):
    """Edit a test file; ``selection_changed``: another file or a newer state of it is selected."""

    selection_changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.selected: SelectedTest | None = None
        self.test: TestFile | None = None
        self._begun: dict[str, Any] = dict(EMPTY)
        self._text = ""
        self._now = 0
        self._words = [""] * len(STEPS)
        self._checked = ("", 0)
        named(self, "recipe_panel", "Prepare a test")
        self.form = FieldForm(self._validate)
        self.rules = LimitSentences()
        self.rules.changed.connect(self._validate)
        self.sequence = SequenceCard()
        self.sequence.changed.connect(self._validate)
        self.steps = StepBar([*(step.title for step in STEPS), CHECKS])
        self.steps.chosen.connect(self.show_step)
        self.pages = named(QStackedWidget(), "step_pages", "The open step")
        self.pages.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
        self.pages.setMinimumHeight(LEAST_HEIGHT)
        self._filled = False
        self._build()
        self._filled = True
        self._validate()

    @property
    def path(self) -> Path | None:
        """Return the edited file; None for a test without a file."""
        return self.selected.path if self.selected is not None else None

    def unsaved(self) -> list[str]:
        """Return the unsaved changes, a line for each, unreadable values included."""
        tree, errors = self._read()
        typed = {path: text for path, text in errors.items() if self.form.is_typed(path)}
        lost = differences(self._tree, _explicit(tree, self._tree))
        return [*typed.values(), *(line for line in lost if line.partition(":")[0] not in typed)]

    def ask_before(self, what: str, then: Callable[[], None]) -> bool:
        """Call ``then``, which discards unsaved changes; ask first when there are any.

        Return whether it was called immediately.
        """
        lost = self.unsaved()
        if lost:
            self.unsaved_bar.ask(lost, what, then)
            return False
        then()
        return True

    def open_file(self, path: Path) -> bool:
        """Load a test file into the form; show a sentence and return False if it is unusable.

        Unsaved changes are lost; ``ask_before`` asks first.
        """
        try:
            selected = read_selected(path)
        except UnusableInput as error:
            self._say(translate(sentence_of_error(error)), good=False)
            return False
        self._take(selected)
        return True

    def begin(self, tree: dict[str, Any]) -> None:
        """Begin a test without a file; none is selected until it is saved."""
        self._begun, self._text = tree, ""
        self._fill(tree)
        self._select(None)

    def _take(self, selected: SelectedTest) -> None:
        self._text = selected.text
        self._fill(selected.tree)
        self._select(selected)

    def _select(self, selected: SelectedTest | None) -> None:
        self.selected = selected
        self._words = [""] * len(STEPS)
        self._validate()
        self.selection_changed.emit()

    def _fill(self, tree: Any) -> None:
        """Show a test; the caller checks it when it is complete."""
        self._filled = False
        try:
            self.form.fill(tree)
            self.rules.fill(tables_in(get_path(tree, "limits.rule")))
            self.sequence.fill(tables_in(get_path(tree, "run.step")))
        finally:
            self._filled = True

    @property
    def _tree(self) -> dict[str, Any]:
        """Return the tables of the file, or those from which a new test was started."""
        return dict(self.selected.tree) if self.selected is not None else self._begun

    def _read(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return the readable values of the test as nested tables, and the errors by field."""
        tree, errors = self.form.read()
        tree = {"schema": self._tree.get("schema", 1), **tree}
        set_path(tree, "model.schema", get_path(self._tree, "model.schema") or 1)
        if "view" in self._tree:
            tree["view"] = self._tree["view"]
        steps, wrong = self.sequence.read()
        if steps:
            set_path(tree, "run.step", steps)
        if wrong:
            errors["run.step"] = tr("{} of the steps cannot be used.", wrong)
        rules, wrong = self.rules.validate(None)
        if rules:
            set_path(tree, "limits.rule", rules)
        if wrong:
            errors["limits.rule"] = tr("{} of the limits cannot be used.", wrong)
        return tree, errors

    def save_view(self, view: ViewSection) -> str:
        """Write only the operator's own page into the open test file; return the file's name.

        Raises UnusableInput where no file is open, or it has unsaved changes.
        """
        selected = self.selected
        if selected is None:
            raise UnusableInput("No test file is open. Open or save one in Prepare first.")
        if self.unsaved() or selected.on_disk():
            raise UnusableInput(
                "{} has changes that are not saved. Save or discard them in Prepare first.",
                selected.path.name,
            )
        tree = {**selected.tree, "view": {"tiles": list(view.tiles), "plots": list(view.plots)}}
        text = edited(selected.text, tree, self._optional)
        with whole_file(selected.path) as part:
            part.write_text(text, encoding="utf-8", newline="")
        self.open_file(selected.path)
        return selected.path.name

    def save(self, path: Path) -> bool:
        """Write the test, comments kept; return False and show a sentence when that fails.

        A file changed by another program since it was opened is not overwritten.
        """
        self._validate()
        if self.test is None:
            return False
        selected = self.selected
        try:
            tree = _explicit(self._read()[0], self._tree)
            text = edited(self._text, tree, self._optional)
            ours = selected if selected is not None and path == selected.path else None
            if ours is not None and path.exists() and ours.on_disk():
                changed = tr(
                    (
                        "{} was changed by another program since it was opened. Save it as"
                        " another file, or open it again and lose the changes made here."
                    ),
                    path,
                )
                self._say(changed, good=False)
                return False
            with whole_file(path) as part:
                part.write_text(text, encoding="utf-8")
            self._text = text
            self._select(read_selected(path, text))
        except UnusableInput as error:
            self._say(translate(sentence_of_error(error)), good=False)
            return False
        return True

    @property
    def _optional(self) -> frozenset[str]:
        return frozenset(field.section for field in form_fields() if field.optional)

    def parts(self) -> list[QWidget]:
        """Return the parts themed one by one: each card of a step, and the tools."""
        cards = [*self.form.sections.values(), self.sequence, self.rules, self.unfold]
        areas = (self.pages.widget(number) for number in range(self.pages.count()))
        bars = [area.verticalScrollBar() for area in areas if isinstance(area, QScrollArea)]
        return [self.steps, self._tools, *cards, *bars]

    def show_step(self, index: int) -> None:
        """Open a step; the index after the last one is the page of the checks."""
        self._now = max(0, min(index, self.pages.count() - 1))
        self.pages.setCurrentIndex(self._now)
        self._validate()

    def _build(self) -> None:
        for step in STEPS[:MODEL]:
            cards: list[QWidget] = [self.form.section(name) for name in step.sections]
            if step.title == "Limits":
                cards.append(self.rules)
            elif step.title == "Run":
                cards.append(self.sequence)
            self.pages.addWidget(_scrolling(page_of(cards), step.title))
        self.pages.addWidget(_scrolling(page_of(self._model()), STEPS[MODEL].title))
        self.name = ElidedLabel("recipe_file", "Test file that is edited")
        self.name.setProperty("role", "title")
        self.verdict = prose("recipe_verdict", "Is the test usable?")
        self.verdict.setFixedHeight(5 * STEP)
        self.buttons = {
            name: button(f"recipe_{name}", text, call, spoken)
            for name, text, spoken, call in (
                ("new", marked("New"), marked("New test"), self._ask_new),
                ("duplicate", marked("Duplicate"), marked("Duplicate the test"), self._duplicate),
                ("open", marked("Op&en…"), marked("Open a test file"), self._ask_open),
                ("save", marked("Save  Ctrl+S"), marked("Save the test file"), self._save),
                (
                    "save_as",
                    marked("Save as…"),
                    marked("Save as another test file"),
                    self._ask_save,
                ),
                (
                    "back",
                    marked("Back"),
                    marked("Step before"),
                    lambda: self.show_step(self._now - 1),
                ),
                (
                    "next",
                    marked("Next"),
                    marked("Step after"),
                    lambda: self.show_step(self._now + 1),
                ),
            )
        }
        shortcut = QShortcut(QKeySequence.StandardKey.Save, self)
        shortcut.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        shortcut.activated.connect(self.buttons["save"].click)
        tools = QWidget()
        buttons = list(self.buttons.values())
        flowing(*buttons[:3], None, *buttons[3:], on=tools)
        self.unsaved_bar = UnsavedBar(self._save, tools)
        card = self._tools = named(QFrame(), "recipe_tools", "Test file")
        card.setProperty("role", "card")
        head = row((self.name, 1), (self.verdict, 3), spacing=GAP)
        column(head, tools, self.unsaved_bar, on=card, margins=(MARGIN, STEP // 2, MARGIN, STEP))
        column(self.steps, (self.pages, 1), card, on=self, spacing=GAP)

    def _model(self) -> list[QWidget]:
        """Return the cards of the last step: mechanism and all remaining sections are folded."""
        placed = {name for step in STEPS for name in step.sections}
        names = dict.fromkeys(f.section for f in self.form.fields if f.section not in placed)
        shown = [self.form.section(name) for name in STEPS[MODEL].sections]
        folded = [self.form.section(name) for name in names]
        inside = page_of(folded)
        self.unfold = button(
            "model_unfold", "", inside.setVisible, "Show mechanism and materials", checkable=True
        )
        title = tr("Mechanism, joint and materials")
        self.unfold.toggled.connect(
            lambda on: self.unfold.setText(f"▾ {title}" if on else f"▸ {title}")
        )
        self.unfold.setText(f"▸ {title}")
        inside.hide()
        bold = QFontMetrics(sized(self.unfold.font(), BODY_PT, QFont.Weight.DemiBold))
        self.unfold.setMinimumWidth(bold.horizontalAdvance(f"▾ {title}") + 4 * STEP)
        head = QWidget()
        row(self.unfold, None, on=head, margins=0)
        return [*shown, head, inside]

    def _validate(self) -> None:
        """Check the whole form; show every error at its field, and their number."""
        if not self._filled:
            return
        tree, errors = self._read()
        self.test, wrong = validated_test(
            tree if not errors else self._with_file_values(tree, errors)
        )
        others = self._place_faults(wrong, errors)
        if errors:
            self.test = None
        self.rules.validate(self.test.limits if self.test is not None else None)
        self.sequence.show_places(self.test)
        self.form.show_errors(errors)
        self._show_steps(errors)
        self._show_verdict(errors, others, differences(self._tree, _explicit(tree, self._tree)))

    def _with_file_values(self, tree: dict[str, Any], errors: Iterable[str]) -> dict[str, Any]:
        """Return a test with the file's values in place of unreadable ones, to check the others."""
        complete = copy.deepcopy(tree)
        for path in errors:
            value = get_path(self._tree, path)
            if value is not None:
                set_path(complete, path, value)
        return complete

    def offer_checks(self, checks: QWidget | None) -> None:
        """Add the checks after the last step; None removes them."""
        if checks is not None:
            self.pages.addWidget(checks)
        elif (last := self.pages.widget(len(STEPS))) is not None:
            self.pages.removeWidget(last)
        self.steps.offer(len(STEPS) + (checks is not None))
        self.show_step(self._now)

    def show_checks(self, words: str, blocking: int) -> None:
        """Show a summary of the checks in the bar of steps; blocking: number of blocking checks."""
        if (words, blocking) != self._checked:
            self._checked = (words, blocking)
            self._validate()

    def _place_faults(self, wrong: list[str], errors: dict[str, str]) -> list[str]:
        """Show each fault at the first field it names; return the faults without a field."""
        others = []
        for fault in wrong:
            named_fields = [path for path in fields_named(fault) if path in self.form.editors]
            sentence = f"{in_form_words(translate(fault)).rstrip('.')}."
            if any(path in errors for path in named_fields):
                continue  # already shown, or a consequence of the value there
            if named_fields:
                errors[named_fields[0]] = sentence
            elif not errors:
                others.append(sentence)
        return others

    def _show_steps(self, errors: dict[str, str]) -> None:
        counts = [0] * len(STEPS)
        for path in errors:
            section = "limits" if path == "limits.rule" else path.rpartition(".")[0]
            index = next((n for n, step in enumerate(STEPS) if section in step.sections), MODEL)
            counts[index] += 1
            if index == MODEL and section not in STEPS[MODEL].sections:
                self.unfold.setChecked(True)
        if self.test is not None:
            self._words = [step.words(self.test) for step in STEPS]
        texts = list(self._words)
        if self.rules.draft is not None:
            texts[[step.title for step in STEPS].index("Limits")] += tr(", 1 draft")
        words, blocking = self._checked
        self.steps.show_steps(self._now, [*texts, words], [*counts, blocking])
        self.buttons["back"].setEnabled(self._now > 0)
        self.buttons["next"].setEnabled(self._now < self.pages.count() - 1)

    def _show_verdict(
        self, errors: dict[str, str], others: list[str], differences: list[str]
    ) -> None:
        self.name.show_text(self.path.name if self.path else NO_FILE)
        self.name.setToolTip(str(self.path) if self.path else tr(NO_FILE))
        if errors or others:
            count = len(errors) + len(others)
            where = " ".join([*others, *list(errors.values())[: 1 if not others else 0]])
            more = tr(" ({} mistakes; each is shown at its field)", count) if count > 1 else ""
            self._say(tr("Not usable yet. {}{}", where, more), good=False)
        elif self.selected is None:
            self._say(tr("Usable. Save it to arm it for a start."), good=True)
        else:
            drafted: Text = " One draft limit is not part of it."
            draft = tr(drafted) if self.rules.draft is not None else ""
            more = tr("; and {} more", len(differences) - 1) if len(differences) > 1 else ""
            changed = tr("Not saved: {}{}.", differences[0], more) if differences else ""
            state = changed or tr("As in the file.")
            self._say(tr("Usable. {}{}", state, draft), good=True)
        usable = self.test is not None
        self.buttons["save"].setEnabled(usable and (self.selected is None or bool(differences)))
        for name in ("save_as", "duplicate"):
            self.buttons[name].setEnabled(usable)

    def _say(self, sentence: str, *, good: bool) -> None:
        set_property(self.verdict, "role", "secondary" if good else "error")
        self.verdict.setText(sentence if good else f"▲ {sentence}")
        self.verdict.setToolTip(sentence)

    def _save(self) -> bool:
        if self.path is None:
            self._ask_save()
            return False
        return self.save(self.path)

    def _ask_new(self) -> None:
        """Start an empty test with the model of the open one, since the mechanism is the rig's."""
        model = self._tree.get("model", {})
        self.ask_before(tr("a new test"), lambda: self.begin({**EMPTY, "model": model}))

    def _duplicate(self) -> None:
        """Start a copy of the test in the form, unsaved changes included."""
        self._begun = self._tree
        title = self.test.title if self.test is not None else ""
        self.form.edit("title", tr("{} (copy)", title))
        self._select(None)

    def _ask_open(self) -> None:
        dialog = self._dialog(tr("Open a test"), QFileDialog.AcceptMode.AcceptOpen)
        dialog.fileSelected.connect(lambda name: self.open_wanted(Path(name)))
        dialog.show()

    def open_wanted(self, path: Path) -> bool:
        """Open a file, asking first where changes would be lost; return whether it is open."""
        return self.ask_before(tr("opening {}", path.name), lambda: self._open(path))

    def _open(self, path: Path) -> None:
        self.open_file(path)

    def _ask_save(self) -> None:
        dialog = self._dialog(tr("Save the test as"), QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix("toml")
        dialog.fileSelected.connect(lambda name: self.save(Path(name)))
        dialog.show()

    def _dialog(self, title: str, mode: QFileDialog.AcceptMode) -> QFileDialog:
        folder = str(self.path.parent) if self.path else ""
        dialog = QFileDialog(self, title, folder, tr("Tests (*.toml)"))
        dialog.setAcceptMode(mode)
        dialog.setModal(False)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        return dialog


def _scrolling(page: QWidget, title: Text) -> QWidget:
    return scrolling(f"step_area_{title.lower()}", title, page)


def _explicit(tree: dict[str, Any], file: dict[str, Any]) -> dict[str, Any]:
    """Return a form's tree without defaults that the file omits."""
    kept: dict[str, Any] = {}
    defaults = {field.path: field.default for field in form_fields()}
    for path in _paths(tree, ""):
        value = get_path(tree, path)
        stated = get_path(file, path)
        default = defaults.get(path)
        default = list(default) if isinstance(default, tuple) else default
        if stated is None and value == default:
            continue
        set_path(kept, path, stated if stated == value else value)
    return kept


def _paths(tree: dict[str, Any], prefix: str) -> list[str]:
    paths = []
    for key, value in tree.items():
        path = f"{prefix}{key}"
        paths += _paths(value, f"{path}.") if isinstance(value, dict) else [path]
    return paths
