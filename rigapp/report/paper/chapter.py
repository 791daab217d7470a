"""One comparison with the paper: numbers, a picture, and what they say in plain sentences."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(frozen=True, slots=True)
class Chapter:
    """Hold a comparison. ``name`` names its files; ``columns`` are the CSV table's.

    ``draw`` draws on matplotlib axes, as many as ``panels``; ``words`` say what the picture shows
    to who cannot see it; ``table`` is a small one for the page, with its header first.
    """

    name: str
    title: str
    columns: Mapping[str, np.ndarray]
    sentences: Sequence[str]
    draw: Callable[[Sequence[Any]], None]
    words: str
    panels: int = 1
    table: Sequence[tuple[str, ...]] = field(default_factory=tuple)
    warning: str = ""


def largest_difference(a: np.ndarray, b: np.ndarray) -> float:
    """Return the largest difference of two curves as a part of the first one's size."""
    return float(np.abs(a - b).max() / max(np.abs(a).max(), 1e-300))
