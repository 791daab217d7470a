"""Write the package of recorded tests: its texts, its files and the ZIP archive."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
import textwrap
import zipfile
import zlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Self
from urllib.parse import quote

from rigapp.config.errors import UnusableInput, from_extra
from rigapp.config.names import name_refusal
from rigapp.publishing.findings import Finding, findings
from rigapp.publishing.packaged import (
    JSON,
    TEXT,
    YAML,
    PackagedTest,
    PackedFile,
    Progress,
    files_of,
    packaged_tests,
    refuse_changed,
    text_file,
)
from rigapp.publishing.publication import (
    KEYWORDS,
    VERSION,
    Author,
    Publication,
    authors_of,
    licence_of,
)
from rigapp.storage import hidden_name, move_into_place

PROFILE = "1.1"
"""The version that repositories read today; the library's own default changes."""
PROGRAM = "#rigapp"


def crate_library() -> Any:
    """Return the library; raise UnusableInput where it is not installed."""
    with from_extra("publish", "A package"):
        from rocrate import rocrate
    return rocrate


def crate(data: Publication, files: Sequence[PackedFile]) -> str:
    """Return ``ro-crate-metadata.json``; files: the files that it describes."""
    library = crate_library()
    result = library.ROCrate(version=PROFILE)
    root = result.root_dataset
    root["name"] = data.title
    root["description"] = data.summary
    root["datePublished"] = data.day
    root["version"] = VERSION
    root["keywords"] = ", ".join(KEYWORDS)
    root["identifier"] = [f"urn:uuid:{test.about['identifier']}" for test in data.tests]
    licence = data.licence
    about = {"@type": "CreativeWork", "name": licence.name, "identifier": licence.identifier}
    root["license"] = result.add(library.ContextEntity(result, licence.url, properties=about))
    root["author"] = [result.add(_author(library, result, author)) for author in data.authors]
    described = {file.path: _file(result, file) for file in files}
    for test in data.tests:
        _made_by(library, result, test, described)
    return json.dumps(result.metadata.generate(), indent=1, ensure_ascii=False) + "\n"


def _author(library: Any, container: Any, author: Author) -> Any:
    about = {"name": author.name, "familyName": author.family, "givenName": author.given}
    if not author.given:
        about = {"@type": "Organization", "name": author.name}
    where = "#" + quote("-".join(author.name.split()))
    return library.ContextEntity(container, where, properties={"@type": "Person", **about})


def _file(container: Any, file: PackedFile) -> Any:
    about = {"name": file.path.rpartition("/")[2], "description": file.about}
    size = {"contentSize": str(file.size), "encodingFormat": file.media}
    return container.add_file(dest_path=file.path, properties={**about, **size})


def _made_by(library: Any, container: Any, test: PackagedTest, described: dict[str, Any]) -> None:
    """Describe the version of the program that recorded a test, and the time."""
    version = str(test.configuration.get("versions", {}).get("rigapp", "unknown"))
    program = container.get(f"{PROGRAM}-{version}") or container.add(
        library.ContextEntity(
            container,
            f"{PROGRAM}-{version}",
            properties={"@type": "SoftwareApplication", "name": "rigapp", "version": version},
        )
    )
    times = {"startTime": str(test.summary["started"])}
    if test.about["ended"]:
        times["endTime"] = str(test.about["ended"])
    name = f"#run-{test.about['identifier']}"
    about = {"@type": "CreateAction", "name": f"The test {test.title}", **times}
    action = container.add(library.ContextEntity(container, name, properties=about))
    action["instrument"] = program
    action["result"] = described[f"{test.folder}/{test.path.name}"]
    container.root_dataset.append_to("mentions", action)


def citation(data: Publication) -> Iterator[str]:
    """Yield the lines; every text in them is quoted as in JSON, which YAML reads equally."""
    yield "cff-version: 1.2.0"
    yield 'message: "If you use these data, please cite them as below."'
    yield "type: dataset"
    yield f"title: {_quoted(data.title)}"
    yield f"abstract: {_quoted(data.summary)}"
    yield "authors:"
    for author in data.authors:
        yield from _cited_author(author)
    yield f'version: "{VERSION}"'
    yield f'date-released: "{data.day}"'
    yield f"license: {data.licence.identifier}"
    yield "keywords:"
    yield from (f"  - {_quoted(keyword)}" for keyword in KEYWORDS)
    yield "identifiers:"
    for test in data.tests:
        yield "  - type: other"
        yield f"    value: {_quoted('urn:uuid:' + str(test.about['identifier']))}"
        yield f"    description: {_quoted(f'the test {test.title}, {test.path.name}')}"


def _cited_author(author: Author) -> Iterator[str]:
    if not author.given:
        yield f"  - name: {_quoted(author.family)}"
        return
    yield f"  - family-names: {_quoted(author.family)}"
    yield f"    given-names: {_quoted(author.given)}"


def _quoted(text: str) -> str:
    return json.dumps(" ".join(text.split()), ensure_ascii=False)


EPOCH = (1980, 1, 1, 0, 0, 0)
"""The earliest time in a ZIP file: the time of packing is no property of the data."""
READABLE = 0o100644 << 16
UNIX = 3


def write_archive(
    target: Path, files: Sequence[PackedFile], digests: Mapping[str, str], progress: Progress
) -> None:
    """Write the files in the order of their paths; compressed ones are only stored.

    digests: earlier SHA-256 by path. Raises UnusableInput for a file that has changed.
    """
    with zipfile.ZipFile(target, "x") as archive:
        for file in sorted(files, key=lambda packed: packed.path):
            about = zipfile.ZipInfo(file.path, EPOCH)
            about.create_system, about.external_attr = UNIX, READABLE
            about.compress_type = zipfile.ZIP_STORED if file.packed else zipfile.ZIP_DEFLATED
            about.file_size = file.size  # decides whether the entry needs 64 bits
            digest = hashlib.sha256()
            with _Deflate() as deflate, archive.open(about, "w") as entry:
                if not file.packed and hasattr(entry, "_compressor"):
                    entry._compressor = deflate  # zipfile itself has one core only
                for part in file.parts():
                    entry.write(part)
                    digest.update(part)
                    progress(len(part))
            if digest.hexdigest() != digests[file.path]:
                raise UnusableInput(f"{file.source}: was changed while it was packed.")


class _Deflate:
    """Compress as ``zlib.compressobj`` does, on all cores; the bytes do not depend on their number.

    Each piece is compressed separately, with the end of the previous one as its dictionary.
    """

    def __init__(self) -> None:
        self._cores = os.cpu_count() or 1
        self._pool = ThreadPoolExecutor(self._cores)
        self._pieces: deque[Future[bytes]] = deque()
        self._before = b""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.shutdown(cancel_futures=True)

    def compress(self, data: bytes) -> bytes:
        """Process a piece; return the compressed part of earlier ones."""
        self._pieces.append(self._pool.submit(_deflated, data, self._before))
        self._before = data[-DICTIONARY:]
        return self._pieces.popleft().result() if len(self._pieces) > 2 * self._cores else b""

    def flush(self) -> bytes:
        """Return the rest, and the end of the stream."""
        rest = b"".join(piece.result() for piece in self._pieces)
        return rest + zlib.compressobj(wbits=-zlib.MAX_WBITS).flush()


DICTIONARY = 1 << 15
"""Window of deflate in bytes."""


def _deflated(data: bytes, before: bytes) -> bytes:
    work = zlib.compressobj(wbits=-zlib.MAX_WBITS, zdict=before)
    return work.compress(data) + work.flush(zlib.Z_SYNC_FLUSH)


WIDTH = 88
STATUSES = {
    "complete": "made as planned",
    "stopped": "stopped before its planned end",
    "interrupted": "interrupted, its file never closed",
}


def readme(data: Publication, files: Sequence[PackedFile]) -> str:
    """Return the text; files: all files of the package that it explains."""
    blocks = [
        _heading(data.title, "="),
        _wrapped(data.summary),
        f"Authors: {'; '.join(author.name for author in data.authors)}",
        f"Licence: {data.licence.name} ({data.licence.identifier}), {data.licence.url}",
        *_tests(data.tests),
        _heading("Files", "-"),
        "\n".join(_listed((file.path, file.about) for file in files)),
        _heading("Columns of statistics.csv", "-"),
        _wrapped(
            "Numbers have a point; times are seconds; NaN or an empty field is a value that is not"
            " known. A revolution without trouble has quality 0, else a sum of the flags that"
            " docs/file-format.md of rigapp explains."
        ),
        "\n".join(_columns(data.tests)),
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
    for test in tests:
        facts = [
            f"{test.folder}/: {test.title}",
            *([f"specimen {test.about['specimen']}"] if test.about["specimen"] else []),
            f"started {str(test.summary['started'])[:19]} UTC",
            f"{test.summary['revolutions']} of {test.about['planned_revolutions']} revolutions",
            STATUSES.get(str(test.summary["status"]), str(test.summary["status"])),
            *(["the rig was simulated"] if test.about["simulated"] else []),
        ]
        yield _wrapped("; ".join(facts) + ".")


def _listed(pairs: Iterable[tuple[str, str]]) -> Iterator[str]:
    for name, about in pairs:
        yield name
        yield textwrap.fill(about, WIDTH, initial_indent="    ", subsequent_indent="    ")


def _columns(tests: Iterable[PackagedTest]) -> Iterator[str]:
    columns = {name: (unit, words) for test in tests for name, unit, words in test.columns}
    for name, (unit, words) in columns.items():
        yield f"{name}{f' [{unit}]' if unit not in ('', '1') else ''}: {words}"


LICENCE, CITATION, README = "LICENSE", "CITATION.cff", "README.txt"
CRATE, SUMS = "ro-crate-metadata.json", "SHA256SUMS"
ABOUT_ITSELF = (README, "this text, with what each file and column means", TEXT)
ABOUT_CRATE = (CRATE, "the same for programs: an RO-Crate, as catalogues of data read it", JSON)
ABOUT_SUMS = (SUMS, "SHA-256 of every other file", TEXT)
DESCRIBING = (ABOUT_ITSELF, ABOUT_CRATE, ABOUT_SUMS)

Shown = Callable[[float, float], None]


def published(paths: Sequence[Path], authors: Sequence[str], licence: str) -> Publication:
    """Return the publication of tests; raise UnusableInput for a running test or a missing author.

    authors: as "Family, Given"; without any the operators of the tests. licence: as SPDX names it.
    """
    crate_library()
    terms = licence_of(licence)
    tests = packaged_tests(paths)
    return Publication(tests, authors_of(authors, (test.operator for test in tests)), terms)


def private_in(data: Publication, computers: frozenset[str]) -> list[Finding]:
    """Return the private data in the tests; computers: names of computers to search for."""
    return findings(data.tests, data.authors, computers)


def refuse_target(to: Path) -> None:
    """Refuse a package that has another suffix, exists already or has no folder."""
    if wrong := name_refusal(to):
        raise UnusableInput(f"--to: {wrong}.")
    if to.suffix.lower() != ".zip":
        raise UnusableInput(f"{to}: a package is a .zip file; name it so.")
    if os.path.lexists(to):
        raise UnusableInput(f"{to}: the file exists and is not overwritten; give another name.")
    if not to.parent.is_dir():
        raise UnusableInput(f"{to}: the folder {to.parent} does not exist; create it first.")


def write_package(data: Publication, to: Path, progress: Shown | None = None) -> list[PackedFile]:
    """Write the package and return its files; an existing one raises UnusableInput.

    progress(done, all): bytes. It appears under its name when it is complete.
    """
    refuse_target(to)
    with _in_its_folder(to) as (hidden, work):
        files = _all_files(data, work)
        total, done = 2 * sum(file.size for file in files), 0

        def tell(more: int) -> None:
            nonlocal done
            done += more
            if progress is not None:
                progress(done, total)

        digests = {file.path: file.digest(tell) for file in files}
        lines = (f"{digest}  {path}\n" for path, digest in sorted(digests.items()))
        sums = text_file(work, *ABOUT_SUMS, "".join(lines))
        digests[SUMS] = sums.digest(lambda _: None)
        files = sorted([*files, sums], key=lambda file: file.path)
        write_archive(hidden, files, digests, tell)
        refuse_changed(data.tests)  # report, table and sums are of the same file
        _sync(hidden)
        move_into_place(hidden, to)
    return files


def _all_files(data: Publication, work: Path) -> list[PackedFile]:
    """Return every file except the sums, those that describe the others last."""
    files = [file for test in data.tests for file in files_of(test, work)]
    about = "the licence of these data"
    cited = "\n".join((*citation(data), ""))
    files += [
        text_file(work, CITATION, "how to cite these data, for programs", YAML, cited),
        text_file(work, LICENCE, about, TEXT, data.licence.text),
    ]
    named = [PackedFile(name, work / name, about, media) for name, about, media in DESCRIBING]
    text = readme(data, sorted([*files, *named], key=lambda file: file.path))
    files.append(text_file(work, *ABOUT_ITSELF, text))
    return [*files, text_file(work, *ABOUT_CRATE, crate(data, files))]


@contextmanager
def _in_its_folder(to: Path) -> Iterator[tuple[Path, Path]]:
    """Yield a hidden name beside the target and a folder to work in; both are removed."""
    hidden = hidden_name(to)
    try:
        with tempfile.TemporaryDirectory(dir=to.parent, prefix=f"{hidden.name}-") as work:
            yield hidden, Path(work)
    except FileExistsError as error:
        raise UnusableInput(
            f"{to}: the file exists and is not overwritten; give another name."
        ) from error
    except OSError as error:
        raise UnusableInput(
            f"{to}: the package cannot be written ({error.strerror}) ‹{error}›."
        ) from error
    finally:
        hidden.unlink(missing_ok=True)


def _sync(path: Path) -> None:
    with path.open("r+b") as stream:
        os.fsync(stream.fileno())
