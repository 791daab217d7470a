"""`rigapp report`: the report of a test as one HTML or PDF file, or as JSON."""

from __future__ import annotations

import json
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.report.page.manuscript import Manuscript

ENDINGS = (".html", ".pdf")


def write_report(path: Path, to: Path | None, *, as_json: bool = False) -> int:
    """Write the report of a test file; an earlier report of that name is replaced as a whole.

    as_json: print its texts and tables, in place of the sentence. Returns the exit status. Raises
    UnusableInput for another ending, a file that is not a test, a target that cannot be written,
    and where nothing is asked for.
    """
    if to is None and not as_json:
        raise UnusableInput("Name the report to write, --to REPORT.html or .pdf, or ask for --json")
    ending = _checked_ending(to) if to is not None else ""
    from rigapp.report.page.plain import plain
    from rigapp.report.testreport import report_of

    document = report_of(path, vector=ending != ".pdf")
    if to is not None:
        _write(document, to, ending)
    if as_json:
        print(json.dumps(plain(document), indent=2, ensure_ascii=False))
    else:
        print(f"The report is {to}.")
    return 0


def _checked_ending(to: Path) -> str:
    ending = to.suffix.lower()
    if ending not in ENDINGS:
        raise UnusableInput(f"{to}: a report is .html or .pdf; name it so")
    if to.is_dir():
        raise UnusableInput(f"{to}: this is a folder; name the report's file")
    if not to.parent.is_dir():
        raise UnusableInput(f"{to}: the folder {to.parent} does not exist; create it first")
    return ending


def _write(document: Manuscript, to: Path, ending: str) -> None:
    if ending == ".html":
        from rigapp.report.page.html import as_html

        data = as_html(document)
    else:
        from rigapp.report.page.pdf import as_pdf

        data = as_pdf(document)
    with whole_file(to) as part:
        part.write_bytes(data)
