"""Coverage probability of all stated uncertainties, and its factor of a normal distribution."""

from __future__ import annotations

import math

COVERAGE = 0.95
NORMAL_FACTOR = 1.959963984540054
"""Of the normal distribution, two-sided (JCGM 100, table G.2)."""


def by_uncertainty(value: float, expanded: float, more: int = 0) -> str:
    """Return a value with the decimals of U, which has two significant figures (JCGM 100, 7.2.6).

    more: additional decimals, for values known better. A U of 100 or more is rounded to tens.
    """
    if not (math.isfinite(expanded) and expanded > 0.0):
        return f"{value:.6g}"
    # A rounded U may gain a digit: 0.0996 becomes 0.10, one decimal fewer.
    places = 1 - int(f"{expanded:.1e}".partition("e")[2]) + more
    return f"{round(value, places) + 0.0:.{max(0, places)}f}"
