"""A load-cell calibration with live readings, without a face: signals in, journal and record out.

The wizard and the terminal are thin faces of ``LiveSession``: they show its instruction and its
judgement of the newest window, and pass on what the operator decides.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from calibration.load_cell.calibrate import LoadCellCalibration, calibrate_load_cell
from calibration.load_cell.daily import DailyCheck, daily_check
from calibration.load_cell.level import LevelError, LevelReading, reversed_level, single
from calibration.load_cell.live import Readiness, Verdict, Window, assess
from calibration.load_cell.pieces import PiecesError
from calibration.load_cell.plans import PlanKind, StepKind
from calibration.load_cell.plausible import check_settings
from calibration.load_cell.procedure import Procedure, ProcedureError, begin, take_up
from calibration.load_cell.readings import LOAD_CELL_COLUMNS, LoadCellReadings, parse_load_cell
from calibration.load_cell.settings import LoadCellSettings
from calibration.load_cell.two_axis import Terms, TwoAxisFit, fit
from calibration.load_cell.weights import pin_force, weight_force
from rigapp.calibrating.daily_history import History, append_check, entry_of, read_history
from rigapp.calibrating.journal import Journal
from rigapp.calibrating.load_cell_result import load_cell_result
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.records_in_use import with_records
from rigapp.config.calibration_settings import LoadCellFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.schema.channels import BASE, LOAD_CELL

PLANS = {"daily": PlanKind.DAILY, "routine": PlanKind.ROUTINE, "full": PlanKind.FULL}
Array = NDArray[np.float64]
SHARE_OF_FULL_SCALE = 0.99
LARGEST_OFFSET = math.radians(20.0)


@dataclass(frozen=True, slots=True)
class Rig:
    """Where the readings come from: name of the rig, whether it is simulated, who calibrates.

    file: the rig file, where it is known.
    """

    name: str
    simulated: bool
    operator: str = ""
    file: Path | None = None


@dataclass(frozen=True, slots=True)
class Wish:
    """What is wanted: plan, pieces (kg), heaviest load (kg); without it, as the cell can bear."""

    plan: PlanKind
    pieces: tuple[float, ...]
    heaviest: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """The end: result as the record keeps it, or the daily check. saved: the record, if any."""

    accepted: bool
    result: Mapping[str, Any]
    calibration: LoadCellCalibration | None
    check: DailyCheck | None
    settings: LoadCellSettings
    saved: Path | None


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
            many, value = int(count.strip() or "1"), float(mass)
        except ValueError as error:
            raise UnusableInput(
                f"weights: {part.strip()!r} is not a mass; write for example 5x8, 2, 2, 1, 0.5"
                " (eight pieces of 5 kg and four others)."
            ) from error
        if not (1 <= many <= 64 and 0.0 < value <= 50.0):
            raise UnusableInput(f"weights: {part.strip()!r}: give 1 to 64 pieces of up to 50 kg.")
        pieces += [value] * many
    if not pieces:
        raise UnusableInput("weights: none are named; write for example 5x8, 2, 2, 1, 0.5.")
    return tuple(sorted(pieces, reverse=True))


def heaviest_load(pieces: Sequence[float], settings: LoadCellSettings) -> float:
    """Return the heaviest load (kg) that the pieces make and the cell may bear."""
    limit = SHARE_OF_FULL_SCALE * settings.cell.full_scale / settings.place.gravity
    return min(sum(pieces), limit - settings.weights.hanger_mass)


def window_of(view: Mapping[str, Any]) -> Window:
    """Return the window that the engine's answer to ``signals`` tells; SI, angle in rad."""
    signals = [view["signals"][name] for name in BASE.names_of(LOAD_CELL)]
    angle, quadratic = view["angle_deg"], view.get("quadratic")
    return Window(
        time=np.array(view["end"], dtype=np.float64) / view["sample_rate_Hz"],
        signal=np.array(signals, dtype=np.float64).T,
        angle=None if angle is None else math.radians(angle),
        stands=bool(view["stands"]),
        noise_share=1.0 / math.sqrt(view["samples_per_mean"]),
        matrix=np.array(view["matrix"], dtype=np.float64),
        zero=np.array(view["zero"], dtype=np.float64),
        quadratic=None if quadratic is None else np.array(quadratic, dtype=np.float64),
    )


def _uncertainty(rig: Path | None) -> tuple[float, float] | None:
    """Return U(F) = first + second F of the rig's calibration, None where it is not stated."""
    if rig is None:
        return None
    return with_records(read_rig(rig)).rig.record.load_cell.uncertainty_N


class LiveSession:
    """One calibration under way. Every event is in the journal before the state changes."""

    def __init__(
        self,
        given: LoadCellFile,
        settings: LoadCellSettings,
        rig: Rig,
        journal: Path,
        wish: Wish | None,
        *,
        keep_waiting_times: bool = True,
    ) -> None:
        """Begin, or take up what the journal tells; raise UnusableInput.

        wish: what to begin; None to take up only. A journal with events is taken up, and must have
        come from the same rig.
        """
        for problem in check_settings(settings):
            if problem.blocks:
                raise UnusableInput(f"settings: {problem.sentence}")
        self.given, self.settings, self.rig = given, settings, rig
        self._patient = keep_waiting_times
        self._since = math.nan
        self._newest = -math.inf
        self._in_use: tuple[Array, Array, Array | None] | None = None
        self.journal = Journal(journal)
        try:
            self.procedure = self._open(wish)
        except (UnusableInput, PiecesError, ProcedureError) as error:
            self.journal.close()
            raise UnusableInput(f"{journal}: {error}") from error

    def _open(self, wish: Wish | None) -> Procedure:
        events = self.journal.read()
        if events:
            first = events[0]
            if (first.get("rig"), first.get("simulated")) != (self.rig.name, self.rig.simulated):
                raise UnusableInput(
                    f"these readings come from the rig {first.get('rig')!r}, this is"
                    f" {self.rig.name!r}; name another journal."
                )
            return take_up(events)
        if wish is None:
            raise UnusableInput("there are no readings to take up; begin a calibration.")
        heaviest = wish.heaviest or heaviest_load(wish.pieces, self.settings)
        procedure = begin(wish.plan, heaviest, wish.pieces)
        self._write(
            {
                **procedure.events[0],
                "rig": self.rig.name,
                "simulated": self.rig.simulated,
                "operator": self.rig.operator,
            }
        )
        return procedure

    # --- what there is to see --------------------------------------------------------------------

    def look(self, window: Window) -> Readiness:
        """Judge the newest window for the step under way."""
        if not self.procedure.done and not math.isnan(window.newest):
            if math.isnan(self._since) or window.newest < self._newest:
                self._since = window.newest
            self._newest = window.newest
        self._in_use = (window.matrix, window.zero, window.quadratic)
        if self.procedure.done:
            readiness = assess(window, self.procedure.steps[-1], 1.0, math.nan, 0.0)
            return replace(readiness, verdict=Verdict.WAITING, words="all readings are taken")
        step = self.procedure.step
        wait = step.wait if self._patient else 0.0
        resolution = self.settings.cell.resolution
        return assess(window, step, resolution, self._since, wait)

    def changed_at(self, time_s: float) -> None:
        """Take note of the device time at which the load was changed (a simulated hand knows)."""
        self._since = time_s

    def expected_force(self) -> float:
        """Return the force (N) of what should hang at the present step."""
        mass = 0.0 if self.procedure.done else self.procedure.step.mass
        if mass > 0.0:
            mass = self.procedure.change.mass
        return float(weight_force(mass, self.settings.weights, self.settings.place))

    def preliminary(self) -> tuple[TwoAxisFit, LoadCellReadings] | None:
        """Fit the readings so far, for the plot; None while they do not tell the axes apart."""
        readings = self.procedure.readings()
        if len(readings) < 4:
            return None
        force = self._applied(readings)
        try:
            return fit(force, readings.signal, Terms()), readings
        except np.linalg.LinAlgError:
            return None

    # --- what the operator does ------------------------------------------------------------------

    def reference(self, shown: float, uncertainty: float) -> None:
        """Take the angle reference: the encoder's angle (rad) while the crank is level.

        Raises ProcedureError when it is so far from 0 that the crank was not level.
        """
        self._refer(single(shown, uncertainty), (shown,))

    def reference_reversed(self, first: float, second: float) -> LevelReading:
        """Take the angle reference with the level turned end for end between two angles (rad).

        The level's own error cancels; what is left is the setting of the bubble. Raises
        ProcedureError.
        """
        setting = math.radians(self.given.angle.setting_standard_uncertainty_deg)
        try:
            found = reversed_level(first, second, setting)
        except LevelError as error:
            raise ProcedureError(str(error)) from error
        self._refer(found, (first, second))
        return found

    def _refer(self, found: LevelReading, shown: Sequence[float]) -> None:
        if abs(found.angle) > LARGEST_OFFSET:
            raise ProcedureError(
                f"the encoder shows {math.degrees(found.angle):.1f} degrees with the crank level;"
                " it should show about 0. Is it the right flat? Else correct"
                " encoder.index_angle_deg in the rig file"
            )
        self._adopt(self.procedure.reference(-found.angle, found.uncertainty, shown))

    def take(self, window: Window) -> None:
        """Take the step under way with a window that is ready; raise ProcedureError when not."""
        readiness = self.look(window)
        if not readiness.ready or window.angle is None:
            raise ProcedureError(f"it cannot be recorded now: {readiness.words}")
        procedure, step = self.procedure, self.procedure.step
        if step.kind is StepKind.TURN:
            self._adopt(procedure.turned(window.angle))
        elif step.kind is StepKind.PRELOAD:
            self._adopt(procedure.exercised())
        elif step.kind is StepKind.READING:
            found = readiness.steadiness
            mean = (float(found.mean[0]), float(found.mean[1]))
            now = round(time.time(), 3)
            self._adopt(procedure.record(window.angle, mean, found.spread, now))
        else:
            raise ProcedureError("the angle reference is entered, not recorded")
        self._since = window.newest

    def reject(self, index: int, reason: str) -> None:
        """Reject a reading (from 0) with a reason; its series is taken again."""
        self._adopt(self.procedure.reject(index, reason))

    def close(self) -> None:
        """Let the journal go; it can be taken up again. One in which nothing was done goes."""
        if len(self.procedure.events) == 1:
            self.journal.path.unlink(missing_ok=True)
        self.journal.close()

    # --- the end ---------------------------------------------------------------------------------

    def judge(self) -> Outcome:
        """Fit and check all readings; nothing is saved. Raises ProcedureError before the end."""
        if not self.procedure.done:
            raise ProcedureError(f"readings are missing: {self.procedure.progress}")
        _, settings = self._final_settings()
        readings = parse_load_cell(self.readings_csv())
        if self.procedure.kind is PlanKind.DAILY:
            return self._judge_daily(readings, settings)
        found = calibrate_load_cell(readings, settings)
        result = load_cell_result(found, settings)
        return Outcome(found.accepted, result, found, None, settings, None)

    def save(self, outcome: Outcome, to: Path) -> Outcome:
        """Seal an accepted outcome in a record; raise UnusableInput."""
        if not outcome.accepted or outcome.calibration is None:
            raise UnusableInput("a calibration that is refused is not saved.")
        refuse_existing(to)
        given, _ = self._final_settings()
        taken = {
            "rig": self.rig.name,
            "simulated": self.rig.simulated,
            "operator": self.rig.operator,
            "plan": self.procedure.kind.value,
            "pieces_kg": list(self.procedure.pieces),
            "events": [dict(event) for event in self.procedure.events],
        }
        keep_record(to, "load cell", self.readings_csv(), given, outcome.result, taken)
        return replace(outcome, saved=to)

    def keep_check(self, outcome: Outcome, store: Path) -> History:
        """Append a daily check to the store and return the history; raise UnusableInput.

        Judged again without new readings it counts once.
        """
        if outcome.check is None or self._in_use is None:
            raise UnusableInput("there is no daily check to keep.")
        matrix, zero, quadratic = self._in_use
        in_use = {
            "matrix": matrix.tolist(),
            "zero": zero.tolist(),
            "quadratic": None if quadratic is None else quadratic.tolist(),
        }
        entry = entry_of(
            outcome.check,
            rig=self.rig.name,
            simulated=self.rig.simulated,
            operator=self.rig.operator,
            calibration=in_use,
            uncertainty_N=_uncertainty(self.rig.file),
            source=f"{self.journal.path.name}:{len(self.procedure.events)}",
        )
        append_check(store, entry)
        return read_history(store, self.rig.name)

    def readings_csv(self) -> str:
        """Return all readings as the CSV of ``calibrate load-cell``, rejected ones as comments."""
        lines = [",".join(LOAD_CELL_COLUMNS)]
        for one in self.procedure.taken:
            step = self.procedure.steps[one.step]
            row = (
                f"{step.series},{step.number},{one.mass!r},{math.degrees(one.angle)!r},"
                f"{one.signal[0]!r},{one.signal[1]!r}"
            )
            reason = " ".join(one.rejected.split())
            lines.append(f"# rejected ({reason}): {row}" if one.rejected else row)
        return "\n".join(lines) + "\n"

    def _judge_daily(self, readings: LoadCellReadings, settings: LoadCellSettings) -> Outcome:
        if self._in_use is None:
            raise ProcedureError("the calibration in use is not known; is the engine running?")
        check = daily_check(readings, settings, *self._in_use)
        result = {
            "accepted": check.passed,
            "problems": [],
            "sentence": check.sentence,
            "deviation_N": check.deviation.tolist(),
            "sensitivity_ratio": check.sensitivity,
            "cross_talk_ratio": check.cross_talk,
            "zero_N": check.zero.tolist(),
        }
        return Outcome(check.passed, result, None, check, settings, None)

    def _final_settings(self) -> tuple[LoadCellFile, LoadCellSettings]:
        offset = self.procedure.angle_offset or 0.0
        uncertainty = self.procedure.angle_uncertainty or 0.0
        angle = msgspec.structs.replace(
            self.given.angle,
            offset_deg=math.degrees(offset),
            standard_uncertainty_deg=math.degrees(uncertainty),
            level_readings_deg=tuple(math.degrees(one) for one in self.procedure.shown),
        )
        given = msgspec.structs.replace(self.given, angle=angle)
        return given, replace(self.settings, angle_offset=offset, angle_uncertainty=uncertainty)

    def _applied(self, readings: LoadCellReadings) -> Array:
        weight = weight_force(readings.mass, self.settings.weights, self.settings.place)
        return pin_force(weight, readings.angle, self.procedure.angle_offset or 0.0)

    def _adopt(self, after: Procedure) -> None:
        self._write(after.events[-1])
        self.procedure = after

    def _write(self, event: Mapping[str, Any]) -> None:
        self.journal.append({**event, "written": round(time.time(), 3)})
