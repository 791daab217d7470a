"""The coverage probability that every uncertainty is stated for, and the factor of a normal one."""

from __future__ import annotations

import math

COVERAGE = 0.95
NORMAL_FACTOR = 1.959963984540054
"""Of the normal distribution, two-sided (JCGM 100, table G.2)."""


def by_uncertainty(value: float, expanded: float, more: int = 0) -> str:
    """Return a value with the decimals of U, which has two significant figures (JCGM 100, 7.2.6).

    more: decimals beyond these, for what is known better. A U of 100 and more is one of tens.
    """
    if not (math.isfinite(expanded) and expanded > 0.0):
        return f"{value:.6g}"
    # The exponent of the rounded U: 0.0996 is 0.10, one place less.
    places = 1 - int(f"{expanded:.1e}".partition("e")[2]) + more
    return f"{round(value, places) + 0.0:.{max(0, places)}f}"
