"""CITATION.cff: how the data are cited, after the Citation File Format 1.2.0."""

from __future__ import annotations

import json
from collections.abc import Iterator

from rigapp.publishing.authors import Author
from rigapp.publishing.publication import KEYWORDS, VERSION, Publication


def citation(given: Publication) -> str:
    """Return the file; every text in it is quoted as JSON quotes it, which YAML reads alike."""
    return "\n".join(_lines(given)) + "\n"


def _lines(given: Publication) -> Iterator[str]:
    yield "cff-version: 1.2.0"
    yield 'message: "If you use these data, please cite them as below."'
    yield "type: dataset"
    yield f"title: {_quoted(given.title)}"
    yield f"abstract: {_quoted(given.summary)}"
    yield "authors:"
    for one in given.authors:
        yield from _author(one)
    yield f'version: "{VERSION}"'
    yield f'date-released: "{given.day}"'
    yield f"license: {given.licence.identifier}"
    yield "keywords:"
    yield from (f"  - {_quoted(one)}" for one in KEYWORDS)
    yield "identifiers:"
    for test in given.tests:
        yield "  - type: other"
        yield f"    value: {_quoted('urn:uuid:' + str(test.about['identifier']))}"
        yield f"    description: {_quoted(f'the test {test.title}, {test.path.name}')}"


def _author(one: Author) -> Iterator[str]:
    if not one.given:
        yield f"  - name: {_quoted(one.family)}"
        return
    yield f"  - family-names: {_quoted(one.family)}"
    yield f"    given-names: {_quoted(one.given)}"


def _quoted(text: str) -> str:
    return json.dumps(" ".join(text.split()), ensure_ascii=False)
