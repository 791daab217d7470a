"""What can be wrong with a calibration, as a code and one sentence for the operator."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Problem:
    """Name a problem. blocks: the calibration is refused because of it."""

    code: str
    sentence: str
    blocks: bool = True
