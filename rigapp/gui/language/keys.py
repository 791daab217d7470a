"""Names of the keys of a test file and of the columns of its results."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from rigapp.config.ranges import keys_of
from rigapp.config.recipe import TestFile
from rigapp.config.rules import quantities
from rigapp.presentation.translation import Text
from rigapp.schema.channels import BASE, STATISTICS
from rigapp.schema.units import stem_of
from rigapp.texts import capitalised

ENDINGS: Final = sorted(STATISTICS, key=len, reverse=True)
"""Suffixes of a channel's columns, the longest first."""


def key_name(key: str) -> Text:
    """Return a key in words, without its unit."""
    words = stem_of(key).replace("_", " ").replace("youngs", "Young's")
    words = words.replace("poissons", "Poisson's")
    return capitalised(words)


def key_texts() -> Iterator[Text]:
    """Yield the names, meanings and choices of the keys of a test file."""
    for key in keys_of(TestFile):
        yield key_name(key.path.rsplit(".", 1)[-1])
        yield key.words
        yield from (choice.replace("_", " ") for choice in key.choices)


def column_texts() -> Iterator[Text]:
    """Yield the names of columns without a channel, without their statistics."""
    for column in quantities(BASE):
        ending = next((statistic for statistic in ENDINGS if column.endswith(f"_{statistic}")), "")
        name = column.removesuffix(f"_{ending}")
        if name not in BASE:
            yield name.replace("_", " ")
