"""What a test came to, in a few numbers: a row of the results, and the card at its end."""

from __future__ import annotations

import enum
import math

import msgspec

from rigapp.schema.messages import FinishReason

NOT_READABLE = "not readable"
RESUMABLE = frozenset({"interrupted", "stopped"})
"""Statuses of a file that can be resumed."""


class HowEnded(enum.StrEnum):
    """Tell how a test ended, as it is said to people."""

    COMPLETE = "complete"
    OPERATOR = "stopped by operator"
    TRIPPED = "tripped"
    INTERRUPTED = "interrupted"
    RUNNING = "running"
    NOT_READABLE = "not readable"


class TestResult(msgspec.Struct, frozen=True):
    """Say what a test file holds and what the test came to; NaN and 0 where it is not known.

    status: as in ``rigapp info``, or ``not readable``, with why in ``reason``. modified: of the
    file, seconds since 1970. flagged: revolutions with a fault in the data. Uncertainties
    are expanded (k = 2), that of the force only where it was asked for; the coefficient's limits
    hold 95 %. force_lower_bound: the force went beyond the measuring range. depths_um: the wear
    depth in equal parts of the test, its line in a list.
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
    depth_um: float = math.nan
    depth_uncertainty_um: float = math.nan
    coefficient: float = math.nan
    coefficient_low: float = math.nan
    coefficient_high: float = math.nan
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
        if self.status == "stopped":
            stopped = self.reason_code == FinishReason.OPERATOR
            return HowEnded.OPERATOR if stopped else HowEnded.TRIPPED
        return HowEnded(self.status)
