"""How far a long computation of the model is, and when it has taken long enough."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic

from rigapp.config.errors import UnusableInput


def check_time_limit(limit_s: float | None) -> None:
    """Refuse a time limit that is not a finite time above 0."""
    if limit_s is not None and not (math.isfinite(limit_s) and limit_s > 0.0):
        raise UnusableInput(f"--time-limit-s {limit_s:g}: give a finite time above 0.")


@contextmanager
def watched(label: str, limit_s: float | None) -> Iterator[Callable[[float], None]]:
    """Yield what a computation calls with the part done, 0 to 1.

    It shows a progress bar on a terminal and nothing on a pipe, and raises the model's OutOfTime
    when ``limit_s`` seconds have passed since the beginning.
    """
    from model.errors import OutOfTime

    begin = monotonic()

    def in_time() -> None:
        if limit_s is not None and monotonic() - begin >= limit_s:
            raise OutOfTime(f"{limit_s:g} s have passed")

    if not sys.stderr.isatty():
        yield lambda part: in_time()
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(label, total=1.0)

        def tell(part: float) -> None:
            bar.update(task, completed=part)
            in_time()

        yield tell
