"""The armed test: the one file that form, checks and start mean, as it was read from the disk."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import judged_test
from rigapp.config.reading import read_text
from rigapp.config.recipe import TestFile
from rigapp.config.toml import toml_tree
from rigapp.gui.testfile.fields import differences, in_form_words
from rigapp.presentation.told import retold
from rigapp.presentation.translation import tr


@dataclass(frozen=True, slots=True)
class ArmedTest:
    """A test file as read: its text, its tables, and the test; None with the problem if unusable.

    Whoever starts it, starts the file on the disk, not what a form makes of it.
    """

    path: Path
    text: str
    tree: Mapping[str, Any]
    test: TestFile | None
    problem: str = ""

    def on_disk(self) -> list[str]:
        """Read the file again; return what differs now, a line each, nothing where it is the same.

        Where it cannot be read any more, the one line says why.
        """
        try:
            text = read_text(self.path)
            if text == self.text:
                return []
            return differences(self.tree, toml_tree(text, self.path)) or [tr("comments only")]
        except UnusableInput as error:
            return [retold(str(error))]


def read_armed(path: Path, text: str | None = None) -> ArmedTest:
    """Return a test file, read from the disk unless its text is told; raise UnusableInput."""
    text = read_text(path) if text is None else text
    tree = toml_tree(text, path)
    test, wrong = judged_test(tree)
    return ArmedTest(path, text, tree, test, retold(in_form_words(wrong[0])) if wrong else "")
