"""Errors of the model about unusable numbers, and checks that raise them."""

from __future__ import annotations

import math
from typing import Any

from rigapp.texts import say


class ModelError(ValueError):
    """Unusable number; the message names the quantity, its value and the remedy.

    ``quantity`` is the name of the field or argument at fault, ``value`` its value.
    """

    def __init__(self, quantity: str, value: Any, remedy: str, unit: str = "") -> None:
        shown = f"{value:g}" if isinstance(value, (int, float)) else str(value)
        self.quantity = quantity
        self.value = value
        self.remedy = remedy
        super().__init__(
            say("{} is {}{}: {}", quantity.replace("_", " "), shown, unit and " " + unit, remedy)
        )


def require_finite(quantity: str, value: Any, unit: str = "") -> None:
    """Raise ModelError unless the value is one finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ModelError(quantity, value, say("give a finite number"), unit)


def require_positive(quantity: str, value: Any, unit: str = "") -> None:
    """Raise ModelError unless the value is a finite number above zero."""
    require_finite(quantity, value, unit)
    if value <= 0.0:
        raise ModelError(quantity, value, say("it must be greater than 0"), unit)


def require_not_negative(quantity: str, value: Any, unit: str = "") -> None:
    """Raise ModelError unless the value is a finite number of at least zero."""
    require_finite(quantity, value, unit)
    if value < 0.0:
        raise ModelError(quantity, value, say("it must not be negative"), unit)


class OutOfTime(Exception):
    """Raised by a caller's ``progress`` between steps, to stop a computation."""
