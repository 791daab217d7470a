"""The test file (recipe): length, speed, kept cycles, limits, stop criteria, prediction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

import msgspec

from rigapp.config.numbers import FORCE_N, IN_A_ROW, LEVEL, MOST, within
from rigapp.config.parameters import ParameterFile
from rigapp.texts import say
from rigapp_model.wear.techniques import SOLVABLE, TECHNIQUES

if TYPE_CHECKING:
    PredictedJoint = str
else:
    PredictedJoint = Literal[SOLVABLE]

JOINT_WORDS = msgspec.Meta(
    description="; ".join(f"{name}: {TECHNIQUES[name].sentence}" for name in SOLVABLE)
)

Action = Literal["none", "warn", "pause", "stop", "drive_off"]


MOST_STEPS = 1000
"""Maximum number of steps; more are not written by hand and would slow each use."""


class RunStep(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[run.step]]: a number of revolutions, or a duration, at a speed of their own, then a rest.

    rest_s: not after the last revolution of the test.
    """

    name: str = ""
    revolutions: Annotated[int | None, within(1, MOST, unit="revolutions")] = None
    duration_s: Annotated[float | None, within(0.1, 1e8)] = None
    speed_rpm: Annotated[float | None, within(0.1, 3000.0)] = None
    acceleration_rpm_per_s: Annotated[float | None, within(0.1, 10_000.0)] = None
    rest_s: Annotated[float, within(0.0, 1e7)] = 0.0


class RunSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run]: revolutions, speed and ramp; pause_angle_deg is the safe angle."""

    revolutions: Annotated[int, within(1, MOST, unit="revolutions")]
    speed_rpm: Annotated[float, within(0.1, 3000.0)]
    acceleration_rpm_per_s: Annotated[float, within(0.1, 10_000.0)] = 60.0
    pause_angle_deg: Annotated[float, within(0.0, 359.999)] = 90.0
    repeat_from_step: Annotated[int, within(1, MOST_STEPS)] = 1
    step: tuple[RunStep, ...] = ()


class MetadataSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[metadata]: information for readers of the file."""

    operator: str = ""
    specimen: str = ""
    bushing: str = ""
    notes: str = ""


class CyclesSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[cycles]: which whole cycles are kept.

    before_alarm, after_alarm: whatever the schedule.
    """

    schedule: Literal["every", "logarithmic", "none"] = "every"
    every_revolutions: Annotated[int, IN_A_ROW] = 100
    per_decade: Annotated[int, within(1, 1000)] = 20
    before_alarm: Annotated[int, within(0, 1000, unit="revolutions")] = 5
    after_alarm: Annotated[int, within(0, 1000, unit="revolutions")] = 5


class LimitRule(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[limits.rule]]: two levels on one quantity of the revolution, e.g. ``force_max``."""

    quantity: str
    warning_above: Annotated[float | None, LEVEL] = None
    critical_above: Annotated[float | None, LEVEL] = None
    warning_below: Annotated[float | None, LEVEL] = None
    critical_below: Annotated[float | None, LEVEL] = None
    hysteresis: Annotated[float, within(0.0, 1e9)] = 0.0
    delay_revolutions: Annotated[int, IN_A_ROW] = 1
    steps: tuple[Annotated[int, within(1, MOST_STEPS)], ...] = ()
    action_warning: Action = "warn"
    action_critical: Action = "stop"


class LimitsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[limits]: the limits of every test, and the user's rules."""

    overload_N: Annotated[float, FORCE_N] = 380.0
    overspeed_rpm: Annotated[float, within(0.1, 5000.0)] = 700.0
    stale_data_s: Annotated[float, within(0.05, 60.0)] = 2.0
    rule: tuple[LimitRule, ...] = ()


class StopSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[stop]: criteria that end the test before its last revolution; the first one that is met.

    A level must be passed in the number of consecutive evaluated revolutions of the key beside it.
    """

    elapsed_time_h: Annotated[float | None, within(0.001, 100_000.0)] = None
    running_time_h: Annotated[float | None, within(0.001, 100_000.0)] = None
    wear_depth_um: Annotated[float | None, within(0.1, 20_000.0)] = None
    wear_depth_revolutions: Annotated[int, IN_A_ROW] = 20
    force_N: Annotated[float | None, FORCE_N] = None
    force_revolutions: Annotated[int, IN_A_ROW] = 10
    wear_rate_um_per_1000_revolutions: Annotated[float | None, within(0.001, 10_000.0)] = None
    wear_rate_window_revolutions: Annotated[int, within(20, 1_000_000)] = 1000
    deviation_N: Annotated[float | None, within(0.1, 10_000.0)] = None
    deviation_percent: Annotated[float | None, within(0.1, 1000.0)] = None
    deviation_revolutions: Annotated[int, IN_A_ROW] = 20
    wear_coefficient_mm3_per_Nm: Annotated[float | None, within(1e-12, 1.0)] = None
    remaining_revolutions: Annotated[float | None, within(0.0, MOST, unit="revolutions")] = None
    wear_consistency: Annotated[float | None, within(0.1, 1000.0, unit="standard deviations")] = (
        None
    )
    identified_revolutions: Annotated[int, IN_A_ROW] = 20
    hold_off_revolutions: Annotated[int, within(0, MOST)] = 0


class PriorSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[prediction.prior]: the wear coefficient by earlier tests of the same pairing.

    ln K is normal about that of the key. ``rigapp identify`` prints all three.
    """

    wear_coefficient_mm3_per_Nm: Annotated[float, within(1e-12, 1.0)]
    spread_ln: Annotated[float, within(0.001, 10.0)]
    source: str = say("the test file")


class PredictionSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[prediction]: the model that runs beside the data.

    prior: of the wear coefficient; without one its uncertainty is a decade to either side.
    """

    joint: Annotated[PredictedJoint, JOINT_WORDS] = "continuous"
    enabled: bool = True
    prior: PriorSection | None = None


MOST_TILES, MOST_PLOTS = 12, 6
"""Maximum numbers on the operator's own page; more cannot be read at a glance."""


class ViewSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[view]: the operator's own page of the window.

    The page itself writes both.
    """

    tiles: Annotated[tuple[str, ...], msgspec.Meta(max_length=MOST_TILES)] = ()
    plots: Annotated[tuple[str, ...], msgspec.Meta(max_length=MOST_PLOTS)] = ()


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
    view: ViewSection = ViewSection()
