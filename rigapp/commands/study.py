"""`rigapp study`: a parameter study on Dask with table, plots and sensitivities."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rigapp.commands.progress import bar
from rigapp.config.errors import from_extra

if TYPE_CHECKING:
    from rigapp.study.running import StudyEnd


def make_study(path: Path, folder: Path, scheduler: str, workers: int | None) -> int:
    """Run or resume a study; return the exit status.

    0: all points have a result; 1: some have none, or the study was interrupted. Raises
    UnusableInput.
    """
    with from_extra("studies", "A study"):
        from rigapp.study.running import read_study, run_study
    study = read_study(path)
    try:
        with bar("Study") as progress:
            end = run_study(study, folder, scheduler, workers, progress, _remark)
    except KeyboardInterrupt:
        print(
            f"Interrupted: what is done is safe in {folder}; the same command goes on with it.",
            file=sys.stderr,
        )
        return 1
    _say(end)
    return 1 if end.failed else 0


def _remark(words: str) -> None:
    print(f"{words}.", file=sys.stderr)


def _say(end: StudyEnd) -> None:
    good = end.done - end.failed
    print(f"{end.done:,} of {end.points:,} points are done, {good:,} with a result.")
    if end.failed:
        print(f"{end.failed:,} have none; the column `problem` says why.")
    if end.noted:
        print(f"{end.noted:,} have notes that belong to the result; the column `notes` has them.")
    for sentence in end.unresolved:
        print(f"{sentence}.")
    for path in end.files:
        print(path)
