"""Result of a test in a few numbers: a row of the results, and the card at its end."""

from __future__ import annotations

import math

import msgspec

from rigapp.schema.messages import FinishReason, HowEnded
from rigapp.schema.states import FAULTS
from rigapp.texts import say

NOT_READABLE = say("not readable")
RESUMABLE = frozenset({"interrupted", "stopped"})
"""Statuses of a file that can be resumed."""


def how_ended(status: str, reason_code: str) -> HowEnded:
    """Return how a test ended; status: of its file, reason_code: a ``FinishReason``."""
    if status not in ("stopped", "fault"):
        return HowEnded(status)
    if reason_code == FinishReason.OPERATOR:
        return HowEnded.OPERATOR
    return HowEnded.FAULT if reason_code in FAULTS else HowEnded.TRIPPED


class TestResult(msgspec.Struct, frozen=True):
    """Content of a test file and result of the test; NaN and 0 where unknown.

    status: as in ``rigapp info``, or ``not readable``, with why in ``reason``. modified: of the
    file, seconds since 1970. flagged: revolutions with a fault in the data. Uncertainties are
    expanded (k = 2), that of the force only on request; the coefficient's limits
    hold 95 %. force_lower_bound: the force exceeded the measuring range. coefficient_reason:
    why there is none, and alarms: titles of all that were raised in the test, only on
    request. size_bytes: of the content of the file, without space reserved for unrecorded
    data. model_depth_um: at depth_um. depths_um: the wear depth in equal parts of
    the test, its line in a list.
    """

    __test__ = False

    path: str
    modified: float = 0.0
    size_bytes: int = 0
    status: str = NOT_READABLE
    reason_code: str = ""
    reason: str = ""
    title: str = ""
    specimen: str = ""
    operator: str = ""
    simulated: bool = False
    started: str = ""
    ended: str = ""
    planned: int = 0
    revolutions: int = 0
    flagged: int = 0
    gaps: int = 0
    cycles_saved: int = 0
    alarms: tuple[str, ...] = ()
    depth_um: float = math.nan
    depth_uncertainty_um: float = math.nan
    model_depth_um: float = math.nan
    coefficient: float = math.nan
    coefficient_low: float = math.nan
    coefficient_high: float = math.nan
    coefficient_reason: str = ""
    force_max_N: float = math.nan
    force_uncertainty_N: float = math.nan
    force_max_revolution: int = 0
    force_max_angle_deg: float = math.nan
    force_lower_bound: bool = False
    residual_rms_N: float = math.nan
    residual_worst_N: float = math.nan
    depths_um: tuple[float, ...] = ()

    @property
    def outcome(self) -> HowEnded:
        """Return how the test ended."""
        return how_ended(self.status, self.reason_code)
