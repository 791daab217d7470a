"""The test file (recipe): how long, how fast, what to keep, when to stop, what to compare with.

What its numbers may be stands in ``rigapp.config.ranges``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import msgspec

from model.wear.techniques import SOLVABLE
from rigapp.config.parameters import ParameterFile

if TYPE_CHECKING:
    PredictedJoint = str
else:
    PredictedJoint = Literal[SOLVABLE]

Action = Literal["none", "warn", "pause", "stop", "drive_off"]


class RunSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run]: revolutions, speed and ramp; pause_angle_deg is the safe angle."""

    revolutions: int
    speed_rpm: float
    acceleration_rpm_per_s: float = 60.0
    pause_angle_deg: float = 90.0


class MetadataSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[metadata]: what a reader of the file needs to know."""

    operator: str = ""
    specimen: str = ""
    bushing: str = ""
    notes: str = ""


class CyclesSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[cycles]: which whole cycles are kept.

    before_alarm, after_alarm: revolutions before and after one in which an alarm rises, a limit is
    passed or a note is made, whatever the schedule; 0 and 0 keep none of these.
    """

    schedule: Literal["every", "logarithmic", "none"] = "every"
    every_revolutions: int = 100
    per_decade: int = 20
    before_alarm: int = 5
    after_alarm: int = 5


class LimitRule(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[limits.rule]]: two levels on one quantity of the revolution, e.g. ``force_max``."""

    quantity: str
    warning_above: float | None = None
    critical_above: float | None = None
    warning_below: float | None = None
    critical_below: float | None = None
    hysteresis: float = 0.0
    delay_revolutions: int = 1
    action_warning: Action = "warn"
    action_critical: Action = "stop"


class LimitsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[limits]: what is always watched, and rules of one's own."""

    overload_N: float = 380.0
    overspeed_rpm: float = 700.0
    stale_data_s: float = 2.0
    rule: tuple[LimitRule, ...] = ()


class StopSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[stop]: what ends the test before its last revolution; the first that is met, any of them.

    Planned ends (the test is complete): elapsed_time_h, running_time_h, wear_depth_um. Limits (the
    test is stopped): force_N, wear_rate_um_per_1000_revolutions, deviation_N, deviation_percent.
    A level must be passed in so many judged revolutions in a row as the key beside it says.
    """

    elapsed_time_h: float | None = None
    running_time_h: float | None = None
    wear_depth_um: float | None = None
    wear_depth_revolutions: int = 20
    force_N: float | None = None
    force_revolutions: int = 10
    wear_rate_um_per_1000_revolutions: float | None = None
    wear_rate_window_revolutions: int = 1000
    deviation_N: float | None = None
    deviation_percent: float | None = None
    deviation_revolutions: int = 20
    hold_off_revolutions: int = 0


class PredictionSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[prediction]: the model that runs beside the data."""

    joint: PredictedJoint = "continuous"
    enabled: bool = True


class TestFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A test file."""

    __test__ = False

    schema: int
    title: str
    run: RunSection
    model: ParameterFile
    metadata: MetadataSection = MetadataSection()
    cycles: CyclesSection = CyclesSection()
    limits: LimitsSection = LimitsSection()
    stop: StopSection = StopSection()
    prediction: PredictionSection = PredictionSection()
