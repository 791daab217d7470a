"""`rigapp identify`: the wear coefficient of recorded tests, and of their pairing."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rigapp.commands.progress import bar
from rigapp.config.errors import UnusableInput
from rigapp.config.toml import toml_text
from rigapp.config.writing import whole_file


def identify_tests(
    paths: Sequence[Path], to: Path | None, *, as_json: bool, after: int | None = None
) -> int:
    """Say what is known of the wear of tests, and write it; return the exit status.

    after: as it was known after a revolution. Status 1 when nothing can be told of one of them.
    Raises UnusableInput for a file that is no test, or a target that cannot be written.
    """
    make = _maker(to) if to is not None else None
    from rigapp.report.testreport.identified import identified_tests

    with bar("Identify") as progress:
        found = identified_tests(paths, after, progress)
    if to is not None and make is not None:
        data = make(found)
        with whole_file(to) as part:
            part.write_bytes(data)
    if as_json:
        print(json.dumps(_tree(found)))
    else:
        _say(found)
        if to is not None:
            print(f"Written to {to}.")
    return 1 if any(one.refused for one in found.tests) else 0


def _tree(found: Any) -> dict[str, Any]:
    from rigapp.report.testreport.identifiedtree import as_tree

    return as_tree(found)


def _json(found: Any) -> bytes:
    return json.dumps(_tree(found), indent=1).encode() + b"\n"


def _csv(found: Any) -> bytes:
    from rigapp.report.testreport.identifiedtree import as_csv

    return as_csv(found)


def _html(found: Any) -> bytes:
    from rigapp.report.page.document import as_html
    from rigapp.report.testreport.identifiedsections import identified_document

    return as_html(identified_document(found))


def _pdf(found: Any) -> bytes:
    from rigapp.report.page.pdf import as_pdf
    from rigapp.report.testreport.identifiedsections import identified_document

    return as_pdf(identified_document(found))


FORMS: dict[str, Callable[[Any], bytes]] = {
    ".html": _html,
    ".pdf": _pdf,
    ".csv": _csv,
    ".json": _json,
}
"""What is written, by the ending of the name."""


def _maker(to: Path) -> Callable[[Any], bytes]:
    """Return what makes the target, before anything is computed; raise UnusableInput."""
    form = FORMS.get(to.suffix.lower())
    if form is None:
        raise UnusableInput(f"--to {to}: the name must end with one of {', '.join(FORMS)}.")
    if to.is_dir() or not to.absolute().parent.is_dir():
        raise UnusableInput(f"--to {to}: there is no such folder, or it is one itself.")
    return form


def _say(found: Any) -> None:
    from rigapp.report.testreport.identifiedsections import (
        credible_text,
        pairing_rows,
        remaining_text,
    )

    for test in found.tests:
        print(f"{test.path}: {test.said}")
        if test.known is not None:
            print(f"  wear coefficient  {credible_text(test.known.coefficient)}")
            print(f"  remaining         {remaining_text(test)}")
    if len(found.tests) > 1:
        for name, text in pairing_rows(found):
            print(f"{name}: {text}")
        if found.why_not:
            print(f"Not counted: {found.why_not}")
    if found.pairing is not None:
        print("What the test file of the next test may begin with:")
        print(_prior_lines(found.pairing.prior))


def _prior_lines(prior: Any) -> str:
    """Return a prior as the section of a test file."""
    from rigapp.config.recipe import PriorSection
    from rigapp.report.testreport.identifiedtree import PER_UNIT

    coefficient, spread = float(f"{PER_UNIT * prior.coefficient:.4g}"), float(f"{prior.spread:.3g}")
    return (
        f"[prediction.prior]\n{toml_text(PriorSection(coefficient, spread, prior.source))}".rstrip()
    )
