"""The identification as text for the operator."""

from __future__ import annotations

import numpy as np

from rigapp.texts import joined, say
from rigapp_model.identification.consistency import Departure
from rigapp_model.identification.findings import (
    CREEP_NAME,
    HEAT_NAME,
    STEP_NAME,
    SWING_NAME,
    Disturbance,
)
from rigapp_model.identification.inference import Credible, Identification
from rigapp_model.identification.statements import CHANGE, CONSTANT, RUNNING_IN

ODDS = 20.0
"""Odds above which a statement is reported: one error in twenty, as for limits of 95 %."""
MAY_SWING = 0.2
"""Probability of an undetected swing above which it is mentioned."""
TOO_WIDE = 2.0
"""Ratio of the limits above which no coefficient is reported."""
MM3_PER_M2 = 1e9
"""mm^3/(N m) per m^2/N."""


def sentence(known: Identification, departure: Departure | None = None) -> str:
    """Return a text with the wear of the joint, or why it is unknown, and the disturbances."""
    disturbed = joined("; ", [_disturbance(cause) for cause in known.disturbances])
    text = _wear(known, departure)
    if known.disturbances:
        text = say("{} The probes are disturbed, which the limits allow for: {}.", text, disturbed)
    if _may_swing(known):
        text = say(
            (
                "{} A slow drift of the probes, as by the room's temperature, cannot be excluded"
                " yet. The limits include it; a channel room_temperature would separate it."
            ),
            text,
        )
    return text


def _may_swing(known: Identification) -> bool:
    """Return whether a swing that has not completed a period may widen the limits."""
    if known.readings.warm_zero is not None:
        return False
    probability = sum(
        v.weight * float(v.nodes.weight @ (v.nodes.kinds.period > known.revolution))
        for v in known.verdicts
    )
    return probability > MAY_SWING


def _disturbance(cause: Disturbance) -> str:
    size, doubt = (f"{1e6 * value:.2g}" for value in (abs(cause.size), 2.0 * cause.doubt))
    span = grouped_by(cause.revolutions)
    if cause.name == HEAT_NAME:
        return say("{} ± {} um for a degree of temperature", f"{1e6 * cause.size:.2g}", doubt)
    if cause.name == CREEP_NAME:
        return say("creep of {} ± {} um a decade of revolutions", f"{1e6 * cause.size:.2g}", doubt)
    if cause.name == SWING_NAME:
        return say("a slow swing of {} ± {} um, period about {} revolutions", size, doubt, span)
    if cause.name == STEP_NAME:
        return say(
            "a step of {} ± {} um about revolution {}",
            f"{1e6 * cause.size:.2g}",
            doubt,
            f"{cause.revolutions:.0f}",
        )
    return say("noise of {} um that is correlated over {} revolutions", size, span)


def grouped_by(revolutions: float) -> str:
    """Format a number of revolutions with two significant digits."""
    return f"{float(f'{revolutions:.2g}'):.0f}"


def _wear(known: Identification, departure: Departure | None) -> str:
    """Return a text with the wear of the joint, or why it is unknown."""
    if departure is not None and not _explained(known, departure):
        return say(
            (
                "The joint wears {} than before: detected at revolution {:.0f}, began about"
                " revolution {:.0f}."
            ),
            say("faster") if departure.faster else say("slower"),
            departure.revolution,
            departure.since,
        )
    constant = next(verdict for verdict in known.verdicts if verdict.name == CONSTANT)
    others = [verdict for verdict in known.verdicts if verdict.name != CONSTANT]
    best = max(others, key=lambda verdict: verdict.weight)
    second = min(others, key=lambda verdict: verdict.weight)
    if best.weight <= ODDS * constant.weight:
        if known.coefficient.high > TOO_WIDE * known.coefficient.low:
            return say(
                (
                    "The wear coefficient cannot be determined yet. Its limits are a factor of"
                    " {:.2g} apart: the depth so far, {:.2g} um, is too small against its"
                    " uncertainty."
                ),
                known.coefficient.high / known.coefficient.low,
                1e6 * known.readings.depth[-1],
            )
        return say(
            (
                "One wear coefficient, {}, explains all readings so far. Neither running-in nor"
                " a change is shown at odds of 20 to 1."
            ),
            in_words(known.coefficient),
        )
    if best.weight <= ODDS * second.weight:
        return say(
            (
                "The wear coefficient is not constant. Running-in and a sudden change cannot be"
                " distinguished, because the odds are {:.2g} to 1 only; {} now."
            ),
            best.weight / second.weight,
            in_words(known.coefficient),
        )
    return {RUNNING_IN: _running_in, CHANGE: _changed}[best.name](known)


def _explained(known: Identification, departure: Departure) -> bool:
    """Return whether a reported change explains the departure."""
    best, transition = known.best, known.best.transition
    if best.name != CHANGE or transition is None or best.weight <= ODDS * (1.0 - best.weight):
        return False
    return revolution_of(known, transition.high) > 0.9 * departure.since


def _running_in(known: Identification) -> str:
    best = known.best
    assert best.before is not None
    assert best.after is not None
    assert best.transition is not None
    done = known.progress > 3.0 * best.transition.median  # exp(-3): a twentieth remains
    return say(
        "Running-in: the wear coefficient {} from {} to {}, by two thirds within {:.0f}"
        " revolutions.",
        say("fell") if done else say("is falling"),
        in_words(best.before),
        in_words(best.after),
        revolution_of(known, best.transition.median),
    )


def _changed(known: Identification) -> str:
    best = known.best
    assert best.before is not None
    assert best.transition is not None
    at = best.transition
    low, median, high = (revolution_of(known, p) for p in (at.low, at.median, at.high))
    return say(
        "Changed at revolution {:.0f} ({:.0f} to {:.0f}): the wear coefficient was {}"
        " before and is {} since.",
        median,
        low,
        high,
        in_words(best.before),
        in_words(best.coefficient),
    )


def revolution_of(known: Identification, progress: float) -> float:
    """Return the revolution at which a progress (nominal cycles) was or will be reached."""
    by = known.readings
    if progress > known.progress:
        return known.revolution + (progress - known.progress) / known.rate
    made = np.concatenate([[0.0], by.progress, [known.progress]])
    return float(np.interp(progress, made, np.concatenate([[0.0], by.middle, [known.revolution]])))


def in_words(coefficient: Credible) -> str:
    """Format a coefficient (m^2/N) and its limits, in 10⁻⁶ mm³/(N m)."""
    median, low, high = (
        np.format_float_positional(1e6 * MM3_PER_M2 * limit, 3, fractional=False, trim="-")
        for limit in (coefficient.median, coefficient.low, coefficient.high)
    )
    return say("{} ({} to {}) · 10⁻⁶ mm³/(N m)", median, low, high)
