"""An uncertainty budget: contributions, combined and expanded after the GUM."""

from __future__ import annotations

import math
from dataclasses import dataclass

import GTC
from GTC import reporting


@dataclass(frozen=True, slots=True)
class Contribution:
    """One line of the budget: name, standard uncertainty, degrees of freedom (without: known)."""

    name: str
    uncertainty: float
    degrees: float = math.inf


@dataclass(frozen=True, slots=True)
class Budget:
    """The uncertainty at one value, in its unit: contributions, combined, coverage, expanded."""

    value: float
    contributions: tuple[Contribution, ...]
    combined: float
    degrees: float
    coverage_factor: float
    expanded: float


def combine(value: float, lines: tuple[Contribution, ...]) -> Budget:
    """Combine contributions; the coverage factor gives 95 % by the Welch-Satterthwaite formula."""
    total = GTC.constant(value)
    for line in lines:
        total = total + GTC.ureal(0.0, line.uncertainty, df=line.degrees, label=line.name)
    combined = float(GTC.uncertainty(total))
    degrees = float(GTC.dof(total))
    factor = float(reporting.k_factor(degrees if combined > 0.0 else math.inf))
    return Budget(value, lines, combined, degrees, factor, factor * combined)
