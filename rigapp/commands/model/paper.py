"""`rigapp model paper`: the paper's comparisons as plots and tables."""

from __future__ import annotations

import sys
from pathlib import Path

from rigapp.commands.progress import check_time_limit, watched
from rigapp.report.paper import make_paper


def write_paper(folder: Path, recorded: Path | None, time_limit_s: float | None) -> int:
    """Write the comparisons into a folder and print the files' names.

    recorded: a test file for Figs 20 and 21. Returns the exit status: 0, or 1 when time ran out.
    Raises UnusableInput naming what cannot be used.
    """
    check_time_limit(time_limit_s)
    with watched("comparisons", time_limit_s) as tell:
        made = make_paper(folder, recorded, tell)
    for path in made.files:
        print(path)
    if made.complete:
        return 0
    print(
        f"--time-limit-s {time_limit_s:g}: over before all comparisons were made; the pages hold"
        " those that were.",
        file=sys.stderr,
    )
    return 1
