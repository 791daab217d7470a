"""Packages that not every installation has, and which extra brings what is missing."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

from rigapp.config.errors import UnusableInput

Extra = Literal["analysis", "page", "publish", "studies"]


@contextmanager
def from_extra(extra: Extra, what: str) -> Iterator[None]:
    """Import inside it what an extra brings; raise UnusableInput with the way to get it.

    what: who needs it, the beginning of the sentence.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        raise UnusableInput(
            f"{what} needs packages that are missing ‹{error}›; install them: "
            f"pip install 'rigapp[{extra}]'."
        ) from error
