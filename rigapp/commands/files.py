"""Show, export and report a recorded test."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path

from rigapp.commands.progress import bar
from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.presentation.numbers import bytes_text
from rigapp.presentation.results import key_numbers, outcome_text, trust_lines
from rigapp.report.page.document import Manuscript
from rigapp.report.results import result_of_open, sequence_of, step_numbers
from rigapp.storage import AS_EVER, Dialect, export_test, open_test
from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty


def print_info(path: Path, *, as_json: bool) -> int:
    """Print the summary of a test file; return the exit status."""
    with open_test(path) as test:
        summary = test.summary()
        found = force_uncertainty(test.calibration(), test.configuration())
        file = path.stat()
        result = result_of_open(test, file.st_mtime, file.st_size, closely=not as_json)
    if as_json:
        summary["force_uncertainty"] = None if found is None else asdict(found)
    elif found is not None:
        summary["force_uncertainty"] = found.words
    if as_json:
        print(json.dumps(summary))
    else:
        summary["outcome"] = outcome_text(result)
        summary |= {one.caption: f"{one.value}, {one.line}" for one in key_numbers(result)}
        summary |= {one.text: one.line for one in trust_lines(result) if not one.good}
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
    """Write a table of a test file and say how much was written; return the exit status."""
    separator = "\t" if separator in ("tab", "\\t") else separator
    dialect = Dialect(separator or AS_EVER.separator, decimal or AS_EVER.decimal)
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
    """Write the report of a test file; an earlier report of that name is replaced as a whole.

    as_json: print its texts and tables, in place of the sentence. settings: a report.toml, else the
    one beside the test or of the user. language: its code, else the one of the settings. Returns
    the exit status. Raises
    UnusableInput for another ending, a file that is not a test, a target that cannot be written,
    and where nothing is asked for.
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
            _write(document, to, ending)
    if as_json:
        print(json.dumps(plain(document), indent=2, ensure_ascii=False))
    else:
        print(f"The report is {to}.")
    return 0


def draw_figure(path: Path, to: Path, figure: str, width_mm: float) -> int:
    """Draw a figure of a test file, the first one without a name; return the exit status.

    Raises UnusableInput for another name or ending, a file that is not a test, and a target that
    cannot be written.
    """
    ending = _checked_ending(to, "a figure", (".svg", ".pdf", ".png"))
    from rigapp.report.testreport.pictures import FIGURES, figure_of

    if figure and figure not in FIGURES:
        raise UnusableInput("--figure {}: is none of {}.", figure, ", ".join(FIGURES))
    drawn = figure_of(path, figure)
    with whole_file(to) as part:
        part.write_bytes(drawn.draw(ending[1:], width_mm))
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


def _write(document: Manuscript, to: Path, ending: str) -> None:
    if ending == ".html":
        from rigapp.report.page.document import as_html

        data = as_html(document)
    else:
        from rigapp.report.page.pdf import as_pdf

        data = as_pdf(document)
    with whole_file(to) as part:
        part.write_bytes(data)
