"""Make the package of tests: files, words, sums; whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.names import name_refusal
from rigapp.publishing.archive import write_archive
from rigapp.publishing.authors import authors_of
from rigapp.publishing.citation import citation
from rigapp.publishing.crate import crate, crate_library
from rigapp.publishing.findings import Finding, findings
from rigapp.publishing.licences import licence_of
from rigapp.publishing.packaged import packaged_tests, refuse_changed
from rigapp.publishing.packed import JSON, TEXT, YAML, PackedFile, files_of, text_file
from rigapp.publishing.publication import Publication
from rigapp.publishing.readme import readme
from rigapp.storage import hidden_name, move_into_place

LICENCE, CITATION, README = "LICENSE", "CITATION.cff", "README.txt"
CRATE, SUMS = "ro-crate-metadata.json", "SHA256SUMS"
ABOUT_ITSELF = (README, "this text, with what each file and column means", TEXT)
ABOUT_CRATE = (CRATE, "the same for programs: an RO-Crate, as catalogues of data read it", JSON)
ABOUT_SUMS = (SUMS, "SHA-256 of every other file", TEXT)
DESCRIBING = (ABOUT_ITSELF, ABOUT_CRATE, ABOUT_SUMS)

Shown = Callable[[float, float], None]


def published(paths: Sequence[Path], authors: Sequence[str], licence: str) -> Publication:
    """Return what is to be published; raise UnusableInput for a test that runs, or has no author.

    authors: as "Family, Given"; without any the operators of the tests. licence: as SPDX names it.
    """
    crate_library()
    terms = licence_of(licence)
    tests = packaged_tests(paths)
    return Publication(tests, authors_of(authors, (one.operator for one in tests)), terms)


def private_in(given: Publication, computers: frozenset[str]) -> list[Finding]:
    """Return what is private in the tests; computers: names of computers to look for."""
    return findings(given.tests, given.authors, computers)


def refuse_target(to: Path) -> None:
    """Refuse a package that has another ending, is there already or has no folder."""
    if wrong := name_refusal(to):
        raise UnusableInput(f"--to: {wrong}.")
    if to.suffix.lower() != ".zip":
        raise UnusableInput(f"{to}: a package is a .zip file; name it so.")
    if os.path.lexists(to):
        raise UnusableInput(f"{to}: the file exists and is not overwritten; give another name.")
    if not to.parent.is_dir():
        raise UnusableInput(f"{to}: the folder {to.parent} does not exist; create it first.")


def write_package(given: Publication, to: Path, progress: Shown | None = None) -> list[PackedFile]:
    """Write the package and return its files; an existing one raises UnusableInput.

    progress(done, all): bytes. It appears under its name when it is whole.
    """
    refuse_target(to)
    with _in_its_folder(to) as (hidden, work):
        files = _all_files(given, work)
        total, done = 2 * sum(one.size for one in files), 0

        def tell(more: int) -> None:
            nonlocal done
            done += more
            if progress is not None:
                progress(done, total)

        digests = {one.place: one.digest(tell) for one in files}
        lines = (f"{digest}  {place}\n" for place, digest in sorted(digests.items()))
        sums = text_file(work, *ABOUT_SUMS, "".join(lines))
        digests[SUMS] = sums.digest(lambda _: None)
        files = sorted([*files, sums], key=lambda one: one.place)
        write_archive(hidden, files, digests, tell)
        refuse_changed(given.tests)  # report, table and sums are of the same file
        _sync(hidden)
        move_into_place(hidden, to)
    return files


def _all_files(given: Publication, work: Path) -> list[PackedFile]:
    """Return every file but the sums, those that describe the others last."""
    files = [one for test in given.tests for one in files_of(test, work)]
    about = "the licence of these data"
    files += [
        text_file(work, CITATION, "how to cite these data, for programs", YAML, citation(given)),
        text_file(work, LICENCE, about, TEXT, given.licence.text),
    ]
    named = [PackedFile(one, work / one, about, media) for one, about, media in DESCRIBING]
    text = readme(given, sorted([*files, *named], key=lambda one: one.place))
    files.append(text_file(work, *ABOUT_ITSELF, text))
    return [*files, text_file(work, *ABOUT_CRATE, crate(given, files))]


@contextmanager
def _in_its_folder(to: Path) -> Iterator[tuple[Path, Path]]:
    """Yield a hidden name beside the target and a folder to work in; nothing of them is left."""
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
