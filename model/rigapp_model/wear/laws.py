"""Table of the wear laws: each is Archard's with a variable wear coefficient.

A new law is one row here, its parameters in ``rigapp_model.parameters.WearLaw``, and its effect in
``rigapp_model.wear.coefficient``. Imports no numerical library: the command line's help uses it.
"""

from __future__ import annotations

from dataclasses import dataclass

from rigapp.texts import say


@dataclass(frozen=True, slots=True)
class Law:
    """Wear law. sentence: for help, form and docs; needs: its keys of ``[wear]``.

    bound: text on the error of a life with it.
    """

    name: str
    sentence: str
    needs: tuple[str, ...]
    bound: str


_AS_ARCHARD = say("the stated error is a bound, as for Archard's law")

LAWS = {
    law.name: law
    for law in (
        Law(
            "archard",
            say("the depth grows with pressure and slip, dh/ds = K p"),
            (),
            say("the stated error is a bound"),
        ),
        Law(
            "running-in",
            say("K falls from its first to its steady value as exp(-revolutions / running-in)"),
            ("initial_wear_coefficient_mm3_per_Nm", "running_in_revolutions"),
            _AS_ARCHARD,
        ),
        Law(
            "pressure-exponent",
            say("dh/ds = K p (p / reference pressure)^(exponent - 1), p the pressure at the spot"),
            ("pressure_exponent", "reference_pressure_MPa"),
            _AS_ARCHARD,
        ),
        Law(
            "two-regimes",
            say(
                "K is another one where nominal pressure times sliding speed is above the"
                " transition"
            ),
            ("severe_wear_coefficient_mm3_per_Nm", "transition_MPa_m_per_s"),
            _AS_ARCHARD,
        ),
    )
}
"""Name in test and parameter files -> wear law."""


def sentence_of(name: str) -> str:
    """Return a text with a law and the bound of its error."""
    law = LAWS[name]
    return say("Wear law {}: {}; {}.", name, law.sentence, law.bound)
