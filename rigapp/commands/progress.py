"""Progress and time limit of long work on a terminal."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic

from rigapp.config.errors import UnusableInput


def check_time_limit(limit_s: float | None) -> None:
    """Refuse a time limit that is not finite and above 0."""
    if limit_s is not None and not (math.isfinite(limit_s) and limit_s > 0.0):
        raise UnusableInput(f"--time-limit-s {limit_s:g}: give a finite time above 0.")


@contextmanager
def bar(label: str) -> Iterator[Callable[[float, float], None] | None]:
    """Yield a function that shows the progress as a bar on a terminal, None on a pipe."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as shown:
        task = shown.add_task(label, total=None)
        yield lambda done, total: shown.update(task, completed=done, total=total)


@contextmanager
def watched(label: str, limit_s: float | None) -> Iterator[Callable[[float], None]]:
    """Yield a function that shows the completed share of a computation, 0 to 1, by ``bar``.

    It raises the model's OutOfTime when ``limit_s`` seconds have passed since the start.
    """
    from rigapp_model.errors import OutOfTime

    begin = monotonic()
    with bar(label) as show:

        def report(part: float) -> None:
            if show is not None:
                show(part, 1.0)
            if limit_s is not None and monotonic() - begin >= limit_s:
                raise OutOfTime(f"{limit_s:g} s have passed")

        yield report
