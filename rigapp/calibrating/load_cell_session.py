"""Load cell calibration with live readings: weights at pin angles, angle reference, daily check."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike

from rigapp.calibrating.daily_history import (
    DailyHistory,
    append_check,
    decision_rule_keys,
    entry_of,
    read_history,
)
from rigapp.calibrating.load_cell_result import fit_load_cell
from rigapp.calibrating.records_in_use import LOAD_CELL as LOAD_CELL_RECORD
from rigapp.calibrating.records_in_use import former_record, with_records
from rigapp.calibrating.session import (
    NO_CURVES,
    LiveSession,
    Outcome,
    ResidualsSoFar,
    two_signals,
    window_times,
)
from rigapp.calibrating.training import LOAD_CELL_PRACTICE
from rigapp.config.calibration_settings import LoadCellFile, load_cell_meaning
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.schema.channels import LOAD_CELL
from rigapp.texts import joined, say, sentence_of_error
from rigapp_calibration.load_cell.daily import daily_check
from rigapp_calibration.load_cell.force_uncertainty import LARGEST_SHARE
from rigapp_calibration.load_cell.plans import (
    SIZES,
    WEIGHING,
    LevelError,
    LevelReading,
    LoadCellPlan,
    LoadCellWindow,
    PlanKind,
    assess_load,
    load_cell_readings,
    reversed_level,
    single,
)
from rigapp_calibration.load_cell.readings import HUNG_COLUMN, LOAD_CELL_COLUMNS, load_cell_table
from rigapp_calibration.load_cell.settings import LoadCellSettings, check_settings
from rigapp_calibration.load_cell.two_axis import Terms, fit
from rigapp_calibration.load_cell.weights import (
    FEWEST_LOADS,
    force_per_mass,
    pin_force,
    weight_force,
)
from rigapp_calibration.records import Record
from rigapp_calibration.taking.procedure import Event, ProcedureError, Step, StepKind, TakenReading
from rigapp_calibration.taking.signals import Readiness, SignalState

PLANS = {"daily": PlanKind.DAILY, "routine": PlanKind.ROUTINE, "full": PlanKind.FULL}
SHARE_OF_FULL_SCALE = 0.99
"""Share of the cell's limit for the heaviest load: leaves a hundredth for the pieces' tolerance."""
HEAVIEST_PIECE_KG = 2000.0
"""A single disc of a deadweight machine for 20 kN."""
LARGEST_OFFSET = math.radians(20.0)
"""Larger than the error of a coupling set by eye: another flat, or a wrong index."""
FEWEST_FOR_RESIDUALS = 4
ALIKE = 0.01
"""Relative difference of the loads of a series: the hysteresis that is refused as too much."""
LEAST_REACH_N = 2.0
"""Minimum range of the residual plot: the resolution of the rig's own cell."""


def parse_pieces(text: str) -> tuple[float, ...]:
    """Return the pieces (kg) of a text such as ``5x8, 2x2, 1, 0.5``; raise UnusableInput.

    ``MxN``: N pieces of M kg.
    """
    pieces: list[float] = []
    for part in text.replace(";", ",").split(","):
        word = part.strip().removesuffix("kg").strip()
        if not word:
            continue
        mass, _, count = word.lower().replace("×", "x").replace("kg", "").partition("x")
        try:
            count_of, value = int(count.strip() or "1"), float(mass)
        except ValueError as error:
            raise UnusableInput(
                "weights: {} is not a mass; write for example 5x8, 2, 2, 1, 0.5 (eight"
                " pieces of 5 kg and four others).",
                repr(part.strip()),
            ) from error
        if not (1 <= count_of <= 64 and 0.0 < value <= HEAVIEST_PIECE_KG):
            raise UnusableInput(
                "weights: {}: give 1 to 64 pieces of up to {:g} kg.",
                repr(part.strip()),
                HEAVIEST_PIECE_KG,
            )
        pieces += [value] * count_of
    if not pieces:
        raise UnusableInput("weights: none are named; write for example 5x8, 2, 2, 1, 0.5.")
    return tuple(sorted(pieces, reverse=True))


def load_cell_plan(choices: Mapping[str, Any], file: LoadCellFile) -> LoadCellPlan:
    """Return the plan of the operator's choices, up to the sum of the pieces and the cell's limit.

    Raises UnusableInput naming the wrong choice.
    """
    plan, settings = choices["plan"], load_cell_meaning(file, "settings")
    if plan not in PLANS:
        raise UnusableInput("--plan {}: choose {}.", plan, joined(", ", PLANS))
    pieces = parse_pieces(choices["weights"])
    limit = SHARE_OF_FULL_SCALE * settings.cell.full_scale / settings.place.gravity
    on_pin = settings.weights.hanger_mass + settings.weights.at_zero
    heaviest = min(sum(pieces), limit - on_pin)
    wanted = LoadCellPlan(PLANS[plan], heaviest, pieces)
    loads = [sum(pieces_hung) for pieces_hung in wanted.loads()]
    if len(loads) < (1 if wanted.kind is PlanKind.DAILY else FEWEST_LOADS):
        raise UnusableInput(
            "weights: by adding one piece after the other these make {} load(s) up to {:.3g} kg"
            " ({} kg), and {} are needed. Add pieces, for example of {:.2g} kg.",
            len(loads),
            heaviest,
            joined(", ", (f"{pieces_hung:g}" for pieces_hung in loads)) or "0",
            FEWEST_LOADS,
            heaviest / SIZES[wanted.kind].loads,
        )
    return wanted


class LoadCellSession(LiveSession[LoadCellPlan, LoadCellWindow, LoadCellFile]):
    """A dead-weight calibration, or a daily check, under way."""

    method = WEIGHING
    columns = (*LOAD_CELL_COLUMNS, HUNG_COLUMN)
    practice = LOAD_CELL_PRACTICE
    _kept = 0
    """Number of events of the stored daily check."""

    @property
    def settings(self) -> LoadCellSettings:
        """Return the settings as the operator gave them, SI."""
        return load_cell_meaning(self.settings_file, "settings")

    def check_settings(self) -> None:
        """Raise UnusableInput for impossible weights, gravity or air."""
        for problem in check_settings(self.settings):
            if problem.blocks:
                raise UnusableInput("settings: {}", problem.sentence)

    def window_of(self, view: Mapping[str, Any]) -> LoadCellWindow:
        """Return the window of the engine's answer to ``signals``; SI, angle in rad."""
        angle, quadratic = view["angle_deg"], view.get("quadratic")
        return LoadCellWindow(
            **window_times(view),
            signal=two_signals(view, LOAD_CELL),
            angle=None if angle is None else math.radians(angle),
            matrix=np.array(view["matrix"], dtype=np.float64),
            zero=np.array(view["zero"], dtype=np.float64),
            quadratic=None if quadratic is None else np.array(quadratic, dtype=np.float64),
        )

    def assess(self, window: LoadCellWindow, step: Step, since: float, wait: float) -> Readiness:
        """Evaluate a window for a step."""
        return assess_load(window, step, self.settings.cell.resolution, since, wait)

    def place_of(self, window: LoadCellWindow) -> float | None:
        """Return the angle of the pin, rad."""
        return window.angle

    # --- display ---------------------------------------------------------------------------------

    def expected(self) -> float:
        """Return the force (N) of the load at the present step."""
        mass = 0.0 if self.procedure.done else self.procedure.step.value
        return float(weight_force(mass, self.settings.weights, self.settings.place))

    def describe(self, reading: TakenReading) -> str:
        """Return mass and angle of a reading in words."""
        text = say("{:g} kg at {:.1f} degrees", reading.value, math.degrees(reading.place))
        return say("{}, {:.0f} s after loading", text, reading.hung) if reading.hung else text

    def cells(self, reading: TakenReading) -> tuple[str, ...]:
        """Return mass and angle of a reading."""
        return f"{reading.value:g}", f"{math.degrees(reading.place):.1f}"

    def live_words(self, readiness: Readiness) -> str:
        """Return signals, the measured force and the expected one."""
        first, second = readiness.steadiness.mean
        unit, procedure = self.settings_file.cell.signal_unit, self.procedure
        text = say(
            "Signals {:+.5f}, {:+.5f} {}: the cell reads {:.1f} N",
            first,
            second,
            unit,
            readiness.felt,
        )
        if not procedure.done and procedure.step.kind is not StepKind.SET_UP:
            text += say("; the planned load weighs {:.1f} N", self.expected())
        return say("{}.", text)

    def compared(self, readiness: Readiness) -> Readiness:
        """Return it, or a hint instead if the measured load is not the expected one."""
        procedure = self.procedure
        if procedure.done or procedure.step.kind is not StepKind.READING or not readiness.ready:
            return readiness
        taken, signal = procedure.taken, readiness.steadiness.mean
        doubt = self._doubt(procedure.step.value, procedure.step.series, taken, signal)
        if not doubt:
            return readiness
        before = [reading.value for reading in taken if not reading.rejected][-1]
        if not self._doubt(before, procedure.step.series, taken, signal):
            return replace(
                readiness, state=SignalState.WAITING, words=say("the load has not changed yet")
            )
        return replace(readiness, state=SignalState.WRONG, words=doubt)

    def _doubt(
        self, mass: float, series: str, before: Sequence[TakenReading], signal: ArrayLike
    ) -> str:
        """Return a warning if the measured load is not the expected mass, else empty.

        Measured against the zero of the same series, since the pin's weight is in both; by the gain
        of earlier loads in the series, since the calibration in use may belong to another cell or
        be missing.
        """
        window, steps, settings = self.newest, self.procedure.steps, self.settings
        same_series = [
            reading
            for reading in before
            if not reading.rejected and steps[reading.step].series == series
        ]
        zeros = [np.array(reading.signal) for reading in same_series if reading.value == 0.0]
        if window is None or not zeros:
            return ""

        def weight(mass: float) -> float:
            return float(weight_force(mass, settings.weights, settings.place))

        expected, aside = weight(mass), window.zero - zeros[-1]
        gains = [
            window.force(np.asarray(reading.signal) + aside) / weight(reading.value)
            for reading in same_series
            if reading.value > 0.0
        ]
        gain, allowed = (float(np.median(gains)), ALIKE) if gains else (1.0, LARGEST_SHARE)
        off = window.force(np.asarray(signal) + aside) / gain - expected
        # A loaded cell returns to its zero only as well as it measured the load.
        heaviest = max(expected, *(weight(reading.value) for reading in same_series))
        if abs(off) <= allowed * heaviest + settings.cell.resolution:
            return ""
        force, kg = abs(off), abs(off) / force_per_mass(settings.weights, settings.place)
        if off > 0.0:
            return say("Check the pieces: {:.1f} N ({:.2f} kg) more than should hang.", force, kg)
        return say("Check the pieces: {:.1f} N ({:.2f} kg) less than should hang.", force, kg)

    def recorded(self, readiness: Readiness) -> str:
        """Return the signals in words."""
        first, second = readiness.steadiness.mean
        text = say(
            "{:.5f}, {:.5f} {} (the calibration in use makes {:.1f} N of it)",
            first,
            second,
            self.settings_file.cell.signal_unit,
            readiness.felt,
        )
        *before, last = self.procedure.taken
        series = self.procedure.steps[last.step].series
        doubt = self._doubt(last.value, series, before, last.signal)
        return say("{}. {}", text, doubt) if doubt else text

    def residuals(self) -> ResidualsSoFar:
        """Return the difference of each reading from a fit of all so far, N, in the order taken."""
        readings = load_cell_readings(self.procedure)
        weight = weight_force(readings.mass, self.settings.weights, self.settings.place)
        force = pin_force(weight, readings.angle, self.angle_reference["offset"])
        try:
            if len(readings) < FEWEST_FOR_RESIDUALS:
                raise np.linalg.LinAlgError(say("too few"))
            residual = fit(force, readings.signal, Terms()).residual
        except np.linalg.LinAlgError:
            words = say("Residuals are shown when two pin angles are known.")
            return ResidualsSoFar(NO_CURVES, (0.0, 12.0), LEAST_REACH_N, words)
        count = np.arange(1.0, len(residual) + 1.0)
        largest = np.abs(residual).max(axis=1)
        worst = int(largest.argmax())
        last = joined(", ", (f"{value:+.2f}" for value in residual[-1]))
        return ResidualsSoFar(
            curves=((count, residual[:, 0]), (count, residual[:, 1])),
            span=(0.0, max(12.0, len(count) + 1.0)),
            reach=max(LEAST_REACH_N, 1.2 * float(largest[worst])),
            words=say(
                (
                    "Circle: axis 1, triangle: axis 2. Last {} N; largest {:.2f} N at reading {}"
                    " of those that count."
                ),
                last,
                largest[worst],
                worst + 1,
            ),
        )

    # --- the angle reference ---------------------------------------------------------------------

    def reference(self, shown: float, uncertainty: float) -> None:
        """Take the angle reference: the encoder's angle (rad) while the crank is level.

        Raises ProcedureError if it is too far from 0 for a level crank.
        """
        self._refer(single(shown, uncertainty), (shown,))

    def reference_reversed(self, first: float, second: float) -> LevelReading:
        """Take the angle reference with the level turned end for end between two angles (rad).

        The level's own error cancels; the setting of the bubble remains. Raises
        ProcedureError.
        """
        setting = math.radians(self.settings_file.angle.setting_standard_uncertainty_deg)
        try:
            level = reversed_level(first, second, setting)
        except LevelError as error:
            raise ProcedureError(sentence_of_error(error)) from error
        self._refer(level, (first, second))
        return level

    @property
    def angle_reference(self) -> Event:
        """Return the angle reference that was taken, rad; 0 before it is."""
        return self.procedure.told("reference") or {"offset": 0.0, "uncertainty": 0.0}

    def _refer(self, level: LevelReading, shown: Sequence[float]) -> None:
        if abs(level.angle) > LARGEST_OFFSET:
            raise ProcedureError(
                "the encoder shows {:.1f} degrees with the crank level; it should show"
                " about 0. Is it the right flat? Else correct encoder.index_angle_deg"
                " in the rig file",
                math.degrees(level.angle),
            )
        self.adopt(self.procedure.reference(-level.angle, level.uncertainty, shown))

    # --- the end ---------------------------------------------------------------------------------

    def fitted(self) -> Outcome:
        """Fit and check all readings, or compare those of a daily check with the loads."""
        rows, file = self.rows(), self.used_settings()
        if self.procedure.plan.kind is not PlanKind.DAILY:
            return fit_load_cell(rows, file, "settings")
        readings, settings = load_cell_table(rows), load_cell_meaning(file, "settings")
        used = self.newest
        if used is None:
            raise ProcedureError("the calibration in use is not known; is the engine running?")
        check = daily_check(readings, settings, used.matrix, used.zero, used.quadratic)
        result = {
            "accepted": check.passed,
            "problems": [],
            "sentence": check.sentence,
            "deviation_N": check.deviation.tolist(),
            "sensitivity_ratio": check.sensitivity,
            "cross_talk_ratio": check.cross_talk,
            "zero_N": check.zero.tolist(),
            **decision_rule_keys(check),
        }
        return Outcome(say("daily check"), result, (check.sentence, check.rule), check=check)

    def former(self) -> Record | None:
        """Return the record of the load cell that the rig file names, None without one."""
        return former_record(self.rig.file, LOAD_CELL_RECORD)

    def keep_check(self, outcome: Outcome, store: Path) -> DailyHistory:
        """Append a daily check to the store and return the history; raise UnusableInput.

        The same readings count once.
        """
        used, file = self.newest, self.rig.file
        if outcome.check is None or used is None:
            raise UnusableInput("there is no daily check to keep.")
        in_use = {
            "matrix": used.matrix.tolist(),
            "zero": used.zero.tolist(),
            "quadratic": None if used.quadratic is None else used.quadratic.tolist(),
        }
        stated = None
        if file is not None:
            stated = with_records(read_rig(file)).rig.record.load_cell.uncertainty_N
        entry = entry_of(
            outcome.check,
            self.rig,
            calibration=in_use,
            uncertainty_N=stated,
            source=f"{self.journal.path.name}:{len(self.procedure.events)}",
        )
        append_check(store, entry)
        self._kept = len(self.procedure.events)
        return read_history(store, self.rig.name)

    def close(self) -> None:
        """Close the journal; that of a stored daily check is set aside, not to be resumed."""
        super().close()
        if self._kept == len(self.procedure.events):
            self._kept, path = 0, self.journal.path
            path.rename(path.with_name(f"{path.name}.{time.strftime('%Y%m%d-%H%M%S')}.kept"))

    def row(self, reading: TakenReading) -> tuple[str | float, ...]:
        """Return a reading by the columns, in their units."""
        step = self.procedure.steps[reading.step]
        angle = math.degrees(reading.place)
        return step.series, step.number, reading.value, angle, *reading.signal, reading.hung or ""

    def facts(self) -> dict[str, Any]:
        """Return the keys of the plan in the record."""
        plan = self.procedure.plan
        return {"plan": plan.kind.value, "pieces_kg": list(plan.pieces)}

    def used_settings(self) -> LoadCellFile:
        """Return the settings with the angle reference that was taken."""
        reference = self.angle_reference
        angle = msgspec.structs.replace(
            self.settings_file.angle,
            offset_deg=math.degrees(reference["offset"]),
            standard_uncertainty_deg=math.degrees(reference["uncertainty"]),
            level_readings_deg=tuple(math.degrees(shown) for shown in reference.get("shown", ())),
        )
        return msgspec.structs.replace(self.settings_file, angle=angle)
