"""What the identification says, in a sentence for the operator."""

from __future__ import annotations

import numpy as np

from rigapp_model.identification.consistency import Departure
from rigapp_model.identification.inference import Credible, Identification
from rigapp_model.identification.statements import CHANGE, CONSTANT, RUNNING_IN

TOLD = 20.0
"""Odds above which a statement counts as told: one error in twenty, as for limits of 95 %."""
TOO_WIDE = 2.0
"""Limits further apart than this factor tell no coefficient."""
MM3_PER_M2 = 1e9
"""mm^3/(N m) in a m^2/N."""


def sentence(known: Identification, departure: Departure | None = None) -> str:
    """Return in plain words how the joint wears, or why that cannot be told."""
    if departure is not None and not _explained(known, departure):
        return (
            f"The joint wears {'faster' if departure.faster else 'slower'} than before: it was told"
            f" at revolution {departure.revolution:.0f}, and began about revolution"
            f" {departure.since:.0f}."
        )
    constant = next(one for one in known.verdicts if one.name == CONSTANT)
    others = [one for one in known.verdicts if one.name != CONSTANT]
    best = max(others, key=lambda one: one.weight)
    second = min(others, key=lambda one: one.weight)
    if best.weight <= TOLD * constant.weight:
        if constant.coefficient.high > TOO_WIDE * constant.coefficient.low:
            return (
                "The wear coefficient cannot be told yet, because its limits are a factor of"
                f" {constant.coefficient.high / constant.coefficient.low:.2g} apart: the depth so"
                f" far, {1e6 * known.readings.depth[-1]:.2g} um, is too small against its"
                " uncertainty."
            )
        return (
            f"One wear coefficient, {in_words(constant.coefficient)}, explains all readings so far:"
            " neither running-in nor a change is told from it at odds of 20 to 1."
        )
    if best.weight <= TOLD * second.weight:
        return (
            "The wear coefficient is not constant. Whether the joint runs in or changed at one"
            f" time cannot be told, because the odds are {best.weight / second.weight:.2g} to 1"
            f" only; {in_words(best.coefficient)} now."
        )
    return {RUNNING_IN: _running_in, CHANGE: _changed}[best.name](known)


def _explained(known: Identification, departure: Departure) -> bool:
    """Tell whether a change is told since, and no earlier than the departure by half a bin."""
    best, place = known.best, known.best.place
    if best.name != CHANGE or place is None or best.weight <= TOLD * (1.0 - best.weight):
        return False
    return revolution_of(known, place.high) > 0.9 * departure.since


def _running_in(known: Identification) -> str:
    best = known.best
    assert best.before is not None
    assert best.place is not None
    done = known.progress > 3.0 * best.place.median  # to a twentieth of the way
    return (
        f"Running-in: the wear coefficient {'fell' if done else 'is falling'} from"
        f" {in_words(best.before)} to {in_words(best.coefficient)},"
        f" by two thirds within {revolution_of(known, best.place.median):.0f} revolutions."
    )


def _changed(known: Identification) -> str:
    best = known.best
    assert best.before is not None
    assert best.place is not None
    low, median, high = (
        revolution_of(known, one) for one in (best.place.low, best.place.median, best.place.high)
    )
    return (
        f"Changed at revolution {median:.0f} ({low:.0f} to {high:.0f}): the wear coefficient was"
        f" {in_words(best.before)} before and is {in_words(best.coefficient)} since."
    )


def revolution_of(known: Identification, progress: float) -> float:
    """Return the revolution at which a progress (nominal cycles) was or will be made."""
    by = known.readings
    if progress > known.progress:
        return known.revolution + (progress - known.progress) / known.rate
    made = np.concatenate([[0.0], by.progress, [known.progress]])
    return float(np.interp(progress, made, np.concatenate([[0.0], by.middle, [known.revolution]])))


def in_words(coefficient: Credible) -> str:
    """Return a coefficient (m^2/N) with its limits, in 10⁻⁶ mm³/(N m)."""
    median, low, high = (
        np.format_float_positional(1e6 * MM3_PER_M2 * one, 3, fractional=False, trim="-")
        for one in (coefficient.median, coefficient.low, coefficient.high)
    )
    return f"{median} ({low} to {high}) · 10⁻⁶ mm³/(N m)"
