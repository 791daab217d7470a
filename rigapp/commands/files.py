"""Work on recorded tests: show, verify, salvage, export, report, publish, identify."""

from __future__ import annotations

import json
import socket
import sys
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rigapp.commands.progress import bar
from rigapp.config.errors import UnusableInput
from rigapp.config.toml import toml_text
from rigapp.config.writing import whole_file
from rigapp.presentation.numbers import bytes_text
from rigapp.presentation.results import key_numbers, outcome_text, trust_lines
from rigapp.report.page.document import Manuscript
from rigapp.report.results import result_of_open, sequence_of, step_numbers
from rigapp.storage import (
    DEFAULT_DIALECT,
    Dialect,
    StorageFailed,
    broken_seals,
    close_test,
    compact_test,
    export_test,
    find_damage,
    open_test,
    salvage_test,
    seal_description,
)
from rigapp.texts import say, sentence_of_error
from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty

if TYPE_CHECKING:
    from rigapp.report.testreport.identified import IdentifiedTests


def print_info(path: Path, *, as_json: bool) -> int:
    """Print the summary of a test file; return the exit status."""
    with open_test(path) as test:
        summary = test.summary()
        uncertainty = force_uncertainty(test.calibration(), test.configuration())
        file = path.stat()
        result = result_of_open(test, file.st_mtime, file.st_size, closely=not as_json)
    if as_json:
        summary["force_uncertainty"] = None if uncertainty is None else asdict(uncertainty)
    elif uncertainty is not None:
        summary["force_uncertainty"] = uncertainty.words
    if as_json:
        print(json.dumps(summary))
    else:
        summary["outcome"] = outcome_text(result)
        summary |= {key.caption: f"{key.value}, {key.line}" for key in key_numbers(result)}
        summary |= {line.text: line.line for line in trust_lines(result) if not line.good}
        summary["size"] = bytes_text(result.size_bytes)
        width = max(len(key) for key in summary)
        for key, value in summary.items():
            print(f"{key.replace('_', ' '):<{width}}  {value}")
    return 0


def export_file(
    path: Path,
    target: Path,
    *,
    cycles: bool,
    points: int | None = None,
    decimal: str = "",
    separator: str = "",
) -> int:
    """Write a table of a test file and print its size; return the exit status."""
    separator = "\t" if separator in ("tab", "\\t") else separator
    dialect = Dialect(separator or DEFAULT_DIALECT.separator, decimal or DEFAULT_DIALECT.decimal)
    with open_test(path) as test:
        sequence = sequence_of(test)
    steps = partial(step_numbers, sequence) if sequence is not None else None
    with bar("Export") as progress:
        rows = export_test(
            path,
            target,
            cycles=cycles,
            progress=progress,
            points=points,
            steps=steps,
            dialect=dialect,
        )
    what = "samples" if cycles else "revolutions"
    if points is not None:
        what = f"{points} crank angles a cycle"
    print(f"{target}: {rows} rows ({what}).")
    return 0


ENDINGS = (".html", ".pdf")


def write_report(
    path: Path,
    to: Path | None,
    *,
    as_json: bool = False,
    settings: Path | None = None,
    language: str = "",
) -> int:
    """Write the report of a test file, replacing an earlier report; return the exit status.

    as_json: print its texts and tables instead of a sentence. settings: a report.toml, by default
    the one beside the test or of the user. language: its code, by default that of the settings.
    Raises UnusableInput for another suffix, a file that is not a test, a target that cannot be
    written, and without target and ``as_json``.
    """
    if to is None and not as_json:
        raise UnusableInput("Name the report to write, --to REPORT.html or .pdf, or ask for --json")
    ending = _checked_ending(to) if to is not None else ""
    from rigapp.presentation.catalogue import LANGUAGES, spoken
    from rigapp.report.page.document import plain
    from rigapp.report.testreport import report_of, report_settings

    if language and language not in LANGUAGES:
        raise UnusableInput(
            "--language {}: reports speak {}; name one.", language, " and ".join(LANGUAGES)
        )
    with spoken(language or report_settings(path, settings)[0].report.language):
        document = report_of(path, settings)
        if to is not None:
            _write(to, _laid_out(document, ending))
    if as_json:
        print(json.dumps(plain(document), indent=2, ensure_ascii=False))
    else:
        print(f"The report is {to}.")
    return 0


def draw_figure(path: Path, to: Path, figure: str, width_mm: float) -> int:
    """Draw a figure of a test file, by default the first available; return the exit status.

    Raises UnusableInput for another name or suffix, a file that is not a test, and a target that
    cannot be written.
    """
    ending = _checked_ending(to, "a figure", (".svg", ".pdf", ".png"))
    from rigapp.report.testreport.compose import FIGURES, figure_of

    if figure and figure not in FIGURES:
        raise UnusableInput("--figure {}: is none of {}.", figure, ", ".join(FIGURES))
    drawn = figure_of(path, figure)
    _write(to, drawn.draw(ending[1:], width_mm))
    print(f"{to}: {drawn.title}. {drawn.caption}".rstrip())
    return 0


def _checked_ending(to: Path, what: str = "a report", endings: Sequence[str] = ENDINGS) -> str:
    ending = to.suffix.lower()
    if ending not in endings:
        *first, last = endings
        raise UnusableInput(f"{to}: {what} is {', '.join(first)} or {last}; name it so")
    if to.is_dir():
        raise UnusableInput(f"{to}: this is a folder; name the report's file")
    if not to.parent.is_dir():
        raise UnusableInput(f"{to}: the folder {to.parent} does not exist; create it first")
    return ending


def _laid_out(document: Manuscript, ending: str) -> bytes:
    if ending == ".html":
        from rigapp.report.page.document import as_html

        return as_html(document)
    from rigapp.report.page.pdf import as_pdf

    return as_pdf(document)


def _write(to: Path, data: bytes) -> None:
    with whole_file(to) as part:
        part.write_bytes(data)


NAMES = {
    "revolutions": say("revolutions"),
    "cycles": say("complete cycles"),
    "unfinished": say("unfinished revolutions"),
    "prediction": say("predicted rows"),
    "curves": say("predicted curves"),
    "profiles": say("worn profiles"),
    "events": say("rows of the log"),
}


def verify_file(path: Path, *, as_json: bool) -> int:
    """Check a file by its checksums and print the differing parts; return 1 where one differs."""
    with open_test(path) as reader:
        checksums, compressed = reader.plan.checksums, reader.compressed
        damage = list(find_damage(reader))
        try:
            damage += broken_seals(reader)
            sealed = seal_description(reader)
        except UnusableInput as error:
            damage.append(sentence_of_error(error))
            sealed = ""
    if as_json:
        print(json.dumps({"checksums": checksums, "damage": damage, "seal": sealed}))
    elif damage:
        for sentence in damage:
            print(sentence)
        print(say("Salvage the rest: rigapp salvage {} --to NEW.h5", path))
    elif checksums:
        print(say("{}: rows, cycles, log and configuration are as they were written.", path))
        print(sealed)
    else:
        what = (
            say("what was compressed can be read") if compressed else say("only the log is checked")
        )
        print(
            say(
                "{}: this file is of an older version, in which rows cannot be proved; {}.",
                path,
                what,
            )
        )
    return 1 if damage else 0


def close_file(path: Path) -> int:
    """Close a file whose writer has ended, and trim it; return the exit status."""
    close_test(path)
    try:
        trimmed = compact_test(path)
    except StorageFailed as error:
        print(f"rigapp: {error}", file=sys.stderr)
        return 1
    with open_test(path) as reader:
        revolutions = reader.committed()
        status = reader.stored_status()
    if not trimmed:
        raise UnusableInput("{}: the test has ended and its file is trimmed already", path)
    print(say("{}: {} with {} revolutions; the file is trimmed.", path, status, revolutions))
    return 0


def salvage_file(path: Path, to: Path) -> int:
    """Write the confirmed data into a new file, print the losses and return the exit status."""
    salvaged = salvage_test(path, to)
    print(say("{}: salvaged from {}.", to, path))
    for name, rows in salvaged.kept.items():
        if rows or salvaged.lost[name]:
            print(say("{}: {} kept, {} lost", NAMES[name], rows, salvaged.lost[name]))
    for part in salvaged.missing:
        print(say("Lost: {}", part))
    for sentence in salvaged.damage:
        print(sentence)
    return 0


SHORTEST_NAME = 4
"""Minimum length of a computer's name; shorter ones occur in many words by chance."""


def package_tests(
    paths: Sequence[Path], to: Path, authors: Sequence[str], licence: str, *, allow_private: bool
) -> int:
    """Write the package of tests; return the exit status, 1 when they contain private data.

    Raises UnusableInput for a running test, no author, an unknown licence, an existing target.
    """
    from rigapp.publishing.package import private_in, published, refuse_target, write_package

    refuse_target(to)
    package = published(paths, authors, licence)
    findings = private_in(package, _this_computer())
    for finding in findings:
        print(f"{'note' if allow_private else 'rigapp'}: {finding.sentence}", file=sys.stderr)
    if findings and not allow_private:
        print(
            "rigapp: nothing is written. Name people as authors (--author 'Family, Given'), or"
            " publish it all the same (--allow-private); the test files stay as they are.",
            file=sys.stderr,
        )
        return 1
    with bar("Package") as progress:
        files = write_package(package, to, progress)
    names = "; ".join(author.name for author in package.authors)
    print(f"The package is {to}: {len(files)} files, by {names}, {package.licence.identifier}.")
    return 0


def _this_computer() -> frozenset[str]:
    """Return the names of this computer that identify it."""
    name = socket.gethostname()
    names = {name, name.partition(".")[0]}
    return frozenset(name for name in names if len(name) >= SHORTEST_NAME and name != "localhost")


def identify_tests(
    paths: Sequence[Path], to: Path | None, *, as_json: bool, after: int | None = None
) -> int:
    """Print and write the identified wear of tests; return the exit status.

    after: use only data up to a revolution. Status 1 when a test is not identifiable. Raises
    UnusableInput for a file that is not a test, or a target that cannot be written.
    """
    ending = _checked_form(to) if to is not None else ""
    from rigapp.report.testreport.identified import identified_tests

    with bar("Identify") as progress:
        result = identified_tests(paths, after, progress)
    if to is not None:
        _write(to, _identified_as(result, ending))
    if as_json:
        from rigapp.report.testreport.identifiedtree import as_tree

        print(json.dumps(as_tree(result)))
    else:
        _say(result)
        if to is not None:
            print(f"Written to {to}.")
    return 1 if any(test.refused for test in result.tests) else 0


FORMS = (*ENDINGS, ".csv", ".json")


def _checked_form(to: Path) -> str:
    """Return the target's suffix, checked before the computation; raises UnusableInput."""
    ending = to.suffix.lower()
    if ending not in FORMS:
        raise UnusableInput(f"--to {to}: the name must end with one of {', '.join(FORMS)}.")
    if to.is_dir() or not to.absolute().parent.is_dir():
        raise UnusableInput(f"--to {to}: there is no such folder, or it is one itself.")
    return ending


def _identified_as(identified: IdentifiedTests, ending: str) -> bytes:
    from rigapp.report.testreport.identifiedsections import identified_document
    from rigapp.report.testreport.identifiedtree import as_csv, as_tree

    if ending == ".csv":
        return as_csv(identified)
    if ending == ".json":
        return json.dumps(as_tree(identified), indent=1).encode() + b"\n"
    return _laid_out(identified_document(identified), ending)


def _say(identified: IdentifiedTests) -> None:
    from rigapp.report.testreport.identifiedsections import (
        credible_text,
        pairing_rows,
        remaining_text,
    )

    for test in identified.tests:
        print(f"{test.path}: {test.said}")
        if test.known is not None:
            print(f"  wear coefficient  {credible_text(test.known.coefficient)}")
            print(f"  remaining         {remaining_text(test)}")
    if len(identified.tests) > 1:
        for name, text in pairing_rows(identified):
            print(f"{name}: {text}")
        if identified.why_not:
            print(f"Not counted: {identified.why_not}")
    if identified.pairing is not None:
        print("What the test file of the next test may begin with:")
        print(_prior_lines(identified.pairing.prior))


def _prior_lines(prior: Any) -> str:
    """Return a prior as the section of a test file."""
    from rigapp.config.recipe import PriorSection
    from rigapp.report.testreport.identifiedtree import PER_UNIT

    coefficient, spread = float(f"{PER_UNIT * prior.coefficient:.4g}"), float(f"{prior.spread:.3g}")
    return (
        f"[prediction.prior]\n{toml_text(PriorSection(coefficient, spread, prior.source))}".rstrip()
    )
