"""`rigapp report`: the report of a test as one HTML or PDF file."""

from __future__ import annotations

from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file

ENDINGS = (".html", ".pdf")


def write_report(path: Path, to: Path) -> int:
    """Write the report of a test file; an earlier report of that name is replaced as a whole.

    Returns the exit status. Raises UnusableInput for another ending, a file that is not a test, a
    target that cannot be written.
    """
    ending = to.suffix.lower()
    if ending not in ENDINGS:
        raise UnusableInput(f"{to}: a report is .html or .pdf; name it so")
    if to.is_dir():
        raise UnusableInput(f"{to}: this is a folder; name the report's file")
    if not to.parent.is_dir():
        raise UnusableInput(f"{to}: the folder {to.parent} does not exist; create it first")
    from rigapp.report.page.html import as_html
    from rigapp.report.testreport import report_of

    document = report_of(path, vector=ending == ".html")
    if ending == ".html":
        data = as_html(document)
    else:
        from rigapp.report.page.pdf import as_pdf

        data = as_pdf(document)
    with whole_file(to) as part:
        part.write_bytes(data)
    print(f"The report is {to}.")
    return 0
