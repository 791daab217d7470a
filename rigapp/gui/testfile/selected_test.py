"""The selected test file as read from the disk, and its text with edited values.

Form, checks and start use the same file; an edit leaves everything else in it unchanged.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tomlkit import aot, document, dumps, item, nl, parse, table
from tomlkit.items import AoT

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import validated_test
from rigapp.config.reading import read_text
from rigapp.config.recipe import TestFile
from rigapp.config.toml import toml_tree
from rigapp.gui.testfile.fields import differences, in_form_words
from rigapp.presentation.translation import tr, translate
from rigapp.texts import sentence_of_error


@dataclass(frozen=True, slots=True)
class SelectedTest:
    """A test file as read: text, tables, and the test, which is None with a problem if unusable.

    A start runs the file on the disk, not the contents of the form.
    """

    path: Path
    text: str
    tree: Mapping[str, Any]
    test: TestFile | None
    problem: str = ""

    def on_disk(self) -> list[str]:
        """Read the file again; return the differences, a line for each.

        Where it is no longer readable, the only line is the reason.
        """
        try:
            text = read_text(self.path)
            if text == self.text:
                return []
            return differences(self.tree, toml_tree(text, self.path)) or [tr("comments only")]
        except UnusableInput as error:
            return [translate(sentence_of_error(error))]


def read_selected(path: Path, text: str | None = None) -> SelectedTest:
    """Return a test file, read from the disk unless its text is given; raise UnusableInput."""
    text = read_text(path) if text is None else text
    tree = toml_tree(text, path)
    test, wrong = validated_test(tree)
    return SelectedTest(path, text, tree, test, in_form_words(translate(wrong[0])) if wrong else "")


def edited(text: str, tree: Mapping[str, Any], optional: frozenset[str] = frozenset()) -> str:
    """Return ``text`` with the values of ``tree``; comments, order and unchanged numbers stay.

    tree: nested tables, lists and plain values of the result. optional: dotted paths of tables that
    are removed when the tree lacks them; other tables keep their header when they become empty.
    Where the layout of the text cannot be edited in place, its comments are lost.
    Raises tomlkit.exceptions.ParseError when the text is not TOML.
    """
    parsed = parse(text) if text.strip() else document()
    _edit(parsed, tree, "", optional)
    result = dumps(parsed)
    if _means(result) == _filled(tree):
        return result
    fresh = document()
    _edit(fresh, tree, "", optional)
    return dumps(fresh)


def _means(text: str) -> dict[str, Any] | None:
    try:
        return _filled(tomllib.loads(text))
    except tomllib.TOMLDecodeError:
        return None


def _filled(tree: Mapping[str, Any]) -> dict[str, Any]:
    """Return a tree without its empty tables."""
    filled = {
        key: _filled(value) if isinstance(value, Mapping) else value for key, value in tree.items()
    }
    return {key: value for key, value in filled.items() if value != {}}


def _edit(container: Any, tree: Mapping[str, Any], where: str, optional: frozenset[str]) -> None:
    for key in list(container):
        if key in tree:
            continue
        if isinstance(container[key], Mapping) and f"{where}{key}" not in optional:
            _edit(container[key], {}, f"{where}{key}.", optional)
        else:
            container.remove(key)
    for key, value in tree.items():
        old = container.get(key)
        if isinstance(value, Mapping):
            if not isinstance(old, Mapping):
                old = table()
                _edit(old, value, f"{where}{key}.", optional)
                container[key] = old
            else:
                _edit(old, value, f"{where}{key}.", optional)
        elif _is_tables(value):
            _edit_tables(container, key, value)
        elif old is None or _plain(old) != value:
            container[key] = item(value)


def _edit_tables(container: Any, key: str, rows: list[Mapping[str, Any]]) -> None:
    """Change an array of tables row by row, so that rows keep their comments."""
    old = container.get(key)
    if not isinstance(old, AoT):
        old = aot()
        container[key] = old
        old = container[key]
    while len(old) > len(rows):
        del old[len(old) - 1]
    for index, row in enumerate(rows):
        if index < len(old):
            _edit(old[index], row, "", frozenset())
        else:
            fresh = table()
            _edit(fresh, row, "", frozenset())
            last = old[len(old) - 1] if len(old) else container
            if last.as_string().endswith("\n\n"):
                fresh.add(nl())  # an empty line after it; the one before exists
            else:
                fresh.trivia.indent = "\n"
            old.append(fresh)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], Mapping)


def _plain(value: Any) -> Any:
    return value.unwrap() if hasattr(value, "unwrap") else value
