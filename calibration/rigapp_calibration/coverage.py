"""The coverage probability that every uncertainty is stated for, and the factor of a normal one."""

from __future__ import annotations

COVERAGE = 0.95
NORMAL_FACTOR = 1.959963984540054
"""Of the normal distribution, two-sided (JCGM 100, table G.2)."""
