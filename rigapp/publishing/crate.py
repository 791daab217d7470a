"""A package described for programs: the RO-Crate and CITATION.cff."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any
from urllib.parse import quote

from rigapp.config.errors import from_extra
from rigapp.publishing.packaged import PackagedTest
from rigapp.publishing.packed import PackedFile
from rigapp.publishing.publication import KEYWORDS, VERSION, Author, Publication

PROFILE = "1.1"
"""The version that repositories read today; the library's own default moves on."""
PROGRAM = "#rigapp"


def crate_library() -> Any:
    """Return the library; raise UnusableInput where it is not installed."""
    with from_extra("publish", "A package"):
        from rocrate import rocrate
    return rocrate


def crate(given: Publication, files: Sequence[PackedFile]) -> str:
    """Return ``ro-crate-metadata.json``; files: the files that it describes."""
    library = crate_library()
    found = library.ROCrate(version=PROFILE)
    root = found.root_dataset
    root["name"] = given.title
    root["description"] = given.summary
    root["datePublished"] = given.day
    root["version"] = VERSION
    root["keywords"] = ", ".join(KEYWORDS)
    root["identifier"] = [f"urn:uuid:{one.about['identifier']}" for one in given.tests]
    licence = given.licence
    about = {"@type": "CreativeWork", "name": licence.name, "identifier": licence.identifier}
    root["license"] = found.add(library.ContextEntity(found, licence.url, properties=about))
    root["author"] = [found.add(_author(library, found, one)) for one in given.authors]
    described = {one.place: _file(found, one) for one in files}
    for test in given.tests:
        _made_by(library, found, test, described)
    return json.dumps(found.metadata.generate(), indent=1, ensure_ascii=False) + "\n"


def _author(library: Any, found: Any, one: Author) -> Any:
    about = {"name": one.name, "familyName": one.family, "givenName": one.given}
    if not one.given:
        about = {"@type": "Organization", "name": one.name}
    where = "#" + quote("-".join(one.name.split()))
    return library.ContextEntity(found, where, properties={"@type": "Person", **about})


def _file(found: Any, one: PackedFile) -> Any:
    about = {"name": one.place.rpartition("/")[2], "description": one.about}
    size = {"contentSize": str(one.size), "encodingFormat": one.media}
    return found.add_file(dest_path=one.place, properties={**about, **size})


def _made_by(library: Any, found: Any, test: PackagedTest, described: dict[str, Any]) -> None:
    """Say by which version of the program a test was recorded, and when."""
    version = str(test.configuration.get("versions", {}).get("rigapp", "unknown"))
    program = found.get(f"{PROGRAM}-{version}") or found.add(
        library.ContextEntity(
            found,
            f"{PROGRAM}-{version}",
            properties={"@type": "SoftwareApplication", "name": "rigapp", "version": version},
        )
    )
    times = {"startTime": str(test.summary["started"])}
    if test.about["ended"]:
        times["endTime"] = str(test.about["ended"])
    name = f"#run-{test.about['identifier']}"
    about = {"@type": "CreateAction", "name": f"The test {test.title}", **times}
    action = found.add(library.ContextEntity(found, name, properties=about))
    action["instrument"] = program
    action["result"] = described[f"{test.folder}/{test.path.name}"]
    found.root_dataset.append_to("mentions", action)


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
        yield from _cited_author(one)
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


def _cited_author(one: Author) -> Iterator[str]:
    if not one.given:
        yield f"  - name: {_quoted(one.family)}"
        return
    yield f"  - family-names: {_quoted(one.family)}"
    yield f"    given-names: {_quoted(one.given)}"


def _quoted(text: str) -> str:
    return json.dumps(" ".join(text.split()), ensure_ascii=False)
