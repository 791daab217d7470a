"""The test file (recipe): how long, how fast, what to keep, when to stop, what to compare with."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from rigapp.config.parameters import ParameterFile

Positive = Annotated[float, msgspec.Meta(gt=0)]
PositiveCount = Annotated[int, msgspec.Meta(ge=1)]

Action = Literal["none", "warn", "pause", "stop", "drive_off"]


class RunSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run]: revolutions, speed and ramp; pause_angle_deg is the safe angle."""

    revolutions: PositiveCount
    speed_rpm: Positive
    acceleration_rpm_per_s: Positive = 60.0
    pause_angle_deg: Annotated[float, msgspec.Meta(ge=0, lt=360)] = 90.0


class MetadataSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[metadata]: what a reader of the file needs to know."""

    operator: str = ""
    specimen: str = ""
    bushing: str = ""
    notes: str = ""


class CyclesSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[cycles]: which whole cycles are kept."""

    schedule: Literal["every", "logarithmic", "none"] = "every"
    every_revolutions: PositiveCount = 100
    per_decade: PositiveCount = 20


class LimitRule(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[limits.rule]]: two levels on one quantity of the revolution, e.g. ``force_max``."""

    quantity: str
    warning_above: float | None = None
    critical_above: float | None = None
    warning_below: float | None = None
    critical_below: float | None = None
    hysteresis: float = 0.0
    delay_revolutions: PositiveCount = 1
    action_warning: Action = "warn"
    action_critical: Action = "stop"


class LimitsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[limits]: what is always watched, and rules of one's own."""

    overload_N: Positive = 380.0
    overspeed_rpm: Positive = 700.0
    stale_data_s: Positive = 2.0
    rule: tuple[LimitRule, ...] = ()


class PredictionSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[prediction]: the model that runs beside the data."""

    joint: Literal["perfect", "continuous"] = "continuous"
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
    prediction: PredictionSection = PredictionSection()
