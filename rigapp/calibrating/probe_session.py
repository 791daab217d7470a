"""Probe calibration with live readings: micrometer steps up and down, for one probe or both."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np

from rigapp.calibrating.probe_result import fit_probes
from rigapp.calibrating.records_in_use import PROBES as PROBE_RECORDS
from rigapp.calibrating.records_in_use import former_record
from rigapp.calibrating.session import (
    NO_CURVES,
    OTHER_KEYS,
    LiveSession,
    Outcome,
    ResidualsSoFar,
    two_signals,
    window_times,
)
from rigapp.calibrating.training import PROBE_PRACTICE
from rigapp.config.calibration_settings import ProbeFile, probe_meaning
from rigapp.config.errors import UnusableInput
from rigapp.schema import channels
from rigapp.texts import joined, say
from rigapp_calibration.probes.checks import robust_line
from rigapp_calibration.probes.plans import (
    MEASURING,
    ProbePlan,
    ProbeWindow,
    assess_probe,
    probe_readings,
)
from rigapp_calibration.probes.readings import OTHER_COLUMN, PROBE_COLUMNS, ProbeSettings
from rigapp_calibration.records import Record
from rigapp_calibration.taking.procedure import ProcedureError, Step, StepKind, TakenReading
from rigapp_calibration.taking.signals import Readiness

PROBES = {"1": (1,), "2": (2,), "both": (1, 2)}
PROBE_PLANS = {"routine": 1, "full": 3}
"""Plan -> runs up and down."""

SHARE_OF_RANGE = 0.8
"""Share of the probe's range that is calibrated: the rest allows for the set-up of position 0."""
ROUND_TO_UM = 5.0
"""Steps of whole 5 um are easily set on a micrometer's scale."""
FEWEST_FOR_RESIDUALS = 3
LEAST_REACH_UM = 1.0
"""Minimum range of the residual plot: about a micrometer screw's own error."""


def usual_reach_um(sensitivity_um_per_V: Sequence[float], range_V: float, positions: int) -> float:
    """Return the largest position (um): 80 % of the range, in steps of whole 5 um."""
    reach = SHARE_OF_RANGE * range_V * min(abs(sensitivity) for sensitivity in sensitivity_um_per_V)
    step = 2.0 * reach / (positions - 1)
    if step > 2.0 * ROUND_TO_UM:
        step = math.floor(step / ROUND_TO_UM) * ROUND_TO_UM
    return 0.5 * step * (positions - 1)


def probe_plan(choices: Mapping[str, Any], file: ProbeFile) -> ProbePlan:
    """Return the plan of the operator's choices; raise UnusableInput naming the wrong one.

    Without a largest position the usual one is taken, by the sensitivity of the probes.
    """
    probe, plan, positions = choices["which"], choices["plan"], choices["positions"]
    if probe not in PROBES:
        raise UnusableInput("--probe {}: choose {}.", probe, joined(", ", PROBES))
    if plan not in PROBE_PLANS:
        raise UnusableInput("--plan {}: choose {}.", plan, joined(", ", PROBE_PLANS))
    reach = choices["reach"]
    if reach is None:
        reach = usual_reach_um(choices["sensitivity"], file.probe.range_V, max(positions, 2))
    wanted = ProbePlan(PROBES[probe], 1e-6 * reach, positions, PROBE_PLANS[plan])
    try:
        wanted.steps()
    except ProcedureError as error:
        raise UnusableInput("the plan is not possible: {}.", error) from error
    return wanted


class ProbeSession(LiveSession[ProbePlan, ProbeWindow, ProbeFile]):
    """A calibration of one or both probes under way."""

    method = MEASURING
    columns = (*PROBE_COLUMNS, OTHER_COLUMN)
    practice = PROBE_PRACTICE
    prompt = say("Enter records at this position (or type the micrometer's own um), {}", OTHER_KEYS)

    def former(self) -> Record | None:
        """Return the record of this probe, or of the pair, that the rig file names."""
        return former_record(self.rig.file, PROBE_RECORDS, self.procedure.plan.probes[0] - 1)

    def window_of(self, view: Mapping[str, Any]) -> ProbeWindow:
        """Return the window of the engine's answer to ``signals``; SI."""
        return ProbeWindow(
            **window_times(view),
            signal=two_signals(view, channels.PROBES),
            sensitivity=1e-6 * np.array(view["sensitivity_um_per_V"], dtype=np.float64),
            offset=np.array(view["probe_offset_V"], dtype=np.float64),
            range_volts=self.settings_file.probe.range_V,
        )

    def assess(self, window: ProbeWindow, step: Step, since: float, wait: float) -> Readiness:
        """Evaluate a window for a step."""
        return assess_probe(window, step, since, wait)

    # --- display ---------------------------------------------------------------------------------

    def typed(self, answer: str) -> float | None:
        """Return the position (m) that the operator has read from the micrometer."""
        if not answer or self.procedure.step.kind is StepKind.SET_UP:
            return None
        try:
            return 1e-6 * float(answer.removesuffix("um").replace(",", "."))
        except ValueError as error:
            raise ProcedureError("Enter, a position in um, b, r, n or q.") from error

    def expected(self) -> float:
        """Return the target position (m) of the present step."""
        return 0.0 if self.procedure.done else self.procedure.step.value

    def describe(self, reading: TakenReading) -> str:
        """Return series and position of a reading in words."""
        series = self.procedure.steps[reading.step].series
        return say("series {}, {:g} um", series, 1e6 * reading.value)

    def cells(self, reading: TakenReading) -> tuple[str, ...]:
        """Return the position of a reading."""
        return (f"{1e6 * reading.value:.1f}",)

    def live_words(self, readiness: Readiness) -> str:
        """Return the voltages and the position of the probe."""
        if self.procedure.done:
            return ""
        first, second = readiness.steadiness.mean
        return say(
            (
                "Probe 1 {:+.4f} V, probe 2 {:+.4f} V. By the calibration in use probe {:g}"
                " reads {:+.1f} µm."
            ),
            first,
            second,
            self.procedure.step.set_up,
            1e6 * readiness.felt,
        )

    def recorded(self, readiness: Readiness) -> str:
        """Return the voltage of the probe in words."""
        reading = self.procedure.taken[-1]
        own = reading.signal[int(reading.place) - 1]
        return say(
            "{:+.5f} V (the calibration in use makes {:+.1f} um of it)", own, 1e6 * readiness.felt
        )

    def residuals(self) -> ResidualsSoFar:
        """Return the distance of each reading from the line of its probe so far, um."""
        reach = 1.1e6 * self.procedure.plan.reach
        curves, last, worst = list(NO_CURVES), 0.0, (0.0, 0.0, 0)
        for probe in self.procedure.plan.probes:
            taken = probe_readings(self.procedure, probe)
            if len(np.unique(taken.position)) < FEWEST_FOR_RESIDUALS:
                continue
            line = robust_line(taken.position, taken.signal)
            if line.slope == 0.0:
                continue
            position, um = 1e6 * taken.position, 1e6 * line.residual / line.slope
            curves[probe - 1] = (position, um)
            at, last = int(np.abs(um).argmax()), float(um[-1])
            worst = max(
                worst, (float(um[at]), float(position[at]), probe), key=lambda row: abs(row[0])
            )
        if not worst[2]:
            words = say("Residuals are shown from the third position on.")
            return ResidualsSoFar(NO_CURVES, (-reach, reach), LEAST_REACH_UM, words)
        return ResidualsSoFar(
            curves=(curves[0], curves[1]),
            span=(-reach, reach),
            reach=max(LEAST_REACH_UM, 1.2 * abs(worst[0])),
            words=say(
                "Circle: probe 1, triangle: probe 2. Last {:+.2f} µm; largest {:+.2f} µm at"
                " {:g} µm of probe {}.",
                last,
                worst[0],
                worst[1],
                worst[2],
            ),
        )

    # --- the end ---------------------------------------------------------------------------------

    def settings_of(self, probe: int) -> ProbeSettings:
        """Return the settings of a probe; its expected sensitivity is that of the one in use."""
        settings = probe_meaning(self.settings_file)
        if settings.nominal is None and self.newest is not None:
            settings = replace(settings, nominal=float(self.newest.sensitivity[probe - 1]))
        return settings

    def fitted(self) -> Outcome:
        """Fit and check all readings."""
        settings = [self.settings_of(probe) for probe in self.procedure.plan.probes]
        return fit_probes(self.rows(), settings)

    def row(self, reading: TakenReading) -> tuple[str | float, ...]:
        """Return a reading by the columns, in their units."""
        step = self.procedure.steps[reading.step]
        probe = int(reading.place) - 1
        own, other = reading.signal[probe], reading.signal[1 - probe]
        return step.series, step.number, 1e6 * reading.value, own, other

    def facts(self) -> dict[str, Any]:
        """Return the keys of the plan in the record."""
        plan = self.procedure.plan
        return {"probes": list(plan.probes), "positions": plan.positions, "runs": plan.runs}

    def used_settings(self) -> ProbeFile:
        """Return the settings with the values of the rig, so that the record is complete."""
        probes = self.procedure.plan.probes
        nominal = self.settings_of(probes[0]).nominal
        if len(probes) > 1 or nominal is None:
            return self.settings_file
        probe = msgspec.structs.replace(
            self.settings_file.probe, nominal_sensitivity_um_per_V=1e6 * nominal
        )
        return msgspec.structs.replace(self.settings_file, probe=probe)
