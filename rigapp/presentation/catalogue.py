"""The catalogues of languages: read one, and use it for a block."""

from __future__ import annotations

from contextlib import AbstractContextManager
from pathlib import Path
from typing import Final
from xml.etree import ElementTree

from rigapp.presentation.translation import ENGLISH, speaking

LANGUAGES: Final = {ENGLISH: "English", "de": "Deutsch"}
"""Languages of window and report, by the code of ISO 639; all but English have a catalogue."""
WINDOW: Final = "rigapp"
SENTENCES: Final = "sentences"
"""Contexts of a catalogue: the texts of the window, and the templates of sentences."""


def catalogue_file(code: str) -> Path:
    """Return the file of a catalogue, stored with the window, whose Qt tools maintain it."""
    return Path(__file__).parents[1] / "gui" / "language" / f"{code}.ts"


def contexts(code: str) -> dict[str, dict[str, str]]:
    """Return the translations of a catalogue by context and English text.

    Unfinished ones are left out. Raises OSError when it cannot be read.
    """
    texts_by_context: dict[str, dict[str, str]] = {WINDOW: {}, SENTENCES: {}}
    shipped = catalogue_file(code).read_bytes()
    for context in ElementTree.fromstring(shipped).iter("context"):  # noqa: S314 - our own file
        texts = texts_by_context[context.findtext("name", WINDOW)]
        for message in context.iter("message"):
            translation = message.find("translation")
            if translation is not None and translation.text and "type" not in translation.attrib:
                texts[message.findtext("source", "")] = translation.text
    return texts_by_context


def translations(code: str) -> dict[str, str]:
    """Return all translations of a catalogue by their English texts; raise OSError."""
    known = contexts(code)
    return known[SENTENCES] | known[WINDOW]


def spoken(code: str) -> AbstractContextManager[None]:
    """Use a language until the block ends, then the previous one; raise OSError."""
    return speaking(None if code == ENGLISH else translations(code), code)
