"""README.txt: what the package holds, in words that need no program."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence

from rigapp.publishing.packaged import PackagedTest
from rigapp.publishing.packed import PackedFile
from rigapp.publishing.publication import Publication

WIDTH = 88
STATUSES = {
    "complete": "made as planned",
    "stopped": "stopped before its planned end",
    "interrupted": "interrupted, its file never closed",
}


def readme(given: Publication, files: Sequence[PackedFile]) -> str:
    """Return the text; files: all files of the package that it explains."""
    blocks = [
        _heading(given.title, "="),
        _wrapped(given.summary),
        f"Authors: {'; '.join(one.name for one in given.authors)}",
        f"Licence: {given.licence.name} ({given.licence.identifier}), {given.licence.url}",
        *_tests(given.tests),
        _heading("Files", "-"),
        "\n".join(_listed((one.place, one.about) for one in files)),
        _heading("Columns of statistics.csv", "-"),
        _wrapped(
            "Numbers have a point; times are seconds; NaN or an empty field is a value that is not"
            " known. A revolution without trouble has quality 0, else a sum of the flags that"
            " docs/file-format.md of rigapp explains."
        ),
        "\n".join(_columns(given.tests)),
        _heading("Checking and reading", "-"),
        _wrapped(
            "sha256sum -c SHA256SUMS tells whether all files are as they were packed. The test"
            " files open in any program that reads HDF5, and in xarray; rows beyond the number"
            " committed in their group are not data."
        ),
    ]
    return "\n\n".join(blocks) + "\n"


def _heading(text: str, line: str) -> str:
    return f"{text}\n{line * len(text)}"


def _wrapped(text: str) -> str:
    return textwrap.fill(text, WIDTH, break_long_words=False)


def _tests(tests: Iterable[PackagedTest]) -> Iterator[str]:
    yield _heading("Tests", "-")
    for one in tests:
        facts = [
            f"{one.folder}/: {one.title}",
            *([f"specimen {one.about['specimen']}"] if one.about["specimen"] else []),
            f"started {str(one.summary['started'])[:19]} UTC",
            f"{one.summary['revolutions']} of {one.about['planned_revolutions']} revolutions",
            STATUSES.get(str(one.summary["status"]), str(one.summary["status"])),
            *(["the rig was simulated"] if one.about["simulated"] else []),
        ]
        yield _wrapped("; ".join(facts) + ".")


def _listed(pairs: Iterable[tuple[str, str]]) -> Iterator[str]:
    for name, about in pairs:
        yield name
        yield textwrap.fill(about, WIDTH, initial_indent="    ", subsequent_indent="    ")


def _columns(tests: Iterable[PackagedTest]) -> Iterator[str]:
    columns = {name: (unit, words) for one in tests for name, unit, words in one.columns}
    for name, (unit, words) in columns.items():
        yield f"{name}{f' [{unit}]' if unit not in ('', '1') else ''}: {words}"
