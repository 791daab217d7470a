"""A probe calibration with live readings, without a face: voltages in, journal and record out.

The wizard and the terminal are thin faces of ``LiveProbeSession``.
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

from calibration.load_cell.live import Readiness, Verdict
from calibration.load_cell.procedure import ProcedureError
from calibration.probes.alignment import PairCalibration, calibrate_pair, split_pair
from calibration.probes.calibrate import ProbeCalibration, calibrate_probe
from calibration.probes.live import ProbeWindow, assess_probe
from calibration.probes.positions import robust_line
from calibration.probes.procedure import (
    ProbePlan,
    ProbeProcedure,
    ProbeStepKind,
    begin_probes,
    make_probe_plan,
    take_up_probes,
)
from calibration.probes.readings import OTHER_COLUMN, PROBE_COLUMNS, parse_probe
from calibration.probes.settings import ProbeSettings
from rigapp.calibrating.journal import Journal
from rigapp.calibrating.live_calibration import Rig
from rigapp.calibrating.probe_results import pair_lines, pair_result, probe_lines, probe_result
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.config.calibration_settings import ProbeFile, probe_meaning
from rigapp.config.errors import UnusableInput
from rigapp.schema import channels

Array = NDArray[np.float64]

PROBES = {"1": (1,), "2": (2,), "both": (1, 2)}
PROBE_PLANS = {"routine": 1, "full": 3}
"""Plan -> runs up and down."""

SHARE_OF_RANGE = 0.8
ROUND_TO_UM = 5.0


@dataclass(frozen=True, slots=True, eq=False)
class ProbeOutcome:
    """The end: result as the record keeps it. saved: the record, if any."""

    accepted: bool
    result: Mapping[str, Any]
    single: ProbeCalibration | None
    pair: PairCalibration | None
    saved: Path | None


def probe_window_of(view: Mapping[str, Any], range_volts: float) -> ProbeWindow:
    """Return the window that the engine's answer to ``signals`` tells; SI."""
    signals = [view["signals"][name] for name in channels.BASE.names_of(channels.PROBES)]
    return ProbeWindow(
        time=np.array(view["end"], dtype=np.float64) / view["sample_rate_Hz"],
        signal=np.array(signals, dtype=np.float64).T,
        stands=bool(view["stands"]),
        noise_share=1.0 / math.sqrt(view["samples_per_mean"]),
        sensitivity=1e-6 * np.array(view["sensitivity_um_per_V"], dtype=np.float64),
        offset=np.array(view["probe_offset_V"], dtype=np.float64),
        range_volts=range_volts,
    )


def usual_reach_um(sensitivity_um_per_V: Sequence[float], range_V: float, positions: int) -> float:
    """Return the largest position (um): 80 % of the range, in steps of whole 5 um."""
    reach = SHARE_OF_RANGE * range_V * min(abs(one) for one in sensitivity_um_per_V)
    step = 2.0 * reach / (positions - 1)
    if step > 2.0 * ROUND_TO_UM:
        step = math.floor(step / ROUND_TO_UM) * ROUND_TO_UM
    return 0.5 * step * (positions - 1)


class LiveProbeSession:
    """One probe calibration under way. Every event is in the journal before the state changes."""

    def __init__(
        self,
        given: ProbeFile,
        rig: Rig,
        journal: Path,
        plan: ProbePlan | None,
        *,
        keep_waiting_times: bool = True,
    ) -> None:
        """Begin, or take up what the journal tells; raise UnusableInput.

        plan: what to begin; None to take up only. A journal with events is taken up, and must have
        come from the same rig.
        """
        self.given, self.rig = given, rig
        self._patient = keep_waiting_times
        self._since = math.nan
        self._newest = -math.inf
        self._expected: Array | None = None
        self.journal = Journal(journal)
        try:
            self.procedure = self._open(plan)
        except (UnusableInput, ProcedureError) as error:
            self.journal.close()
            raise UnusableInput(f"{journal}: {error}") from error

    def _open(self, plan: ProbePlan | None) -> ProbeProcedure:
        events = self.journal.read()
        if events:
            first = events[0]
            if (first.get("rig"), first.get("simulated")) != (self.rig.name, self.rig.simulated):
                raise UnusableInput(
                    f"these readings come from the rig {first.get('rig')!r}, this is"
                    f" {self.rig.name!r}; name another journal."
                )
            return take_up_probes(events)
        if plan is None:
            raise UnusableInput("there are no readings to take up; begin a calibration.")
        procedure = begin_probes(plan)
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

    def look(self, window: ProbeWindow) -> Readiness:
        """Judge the newest window for the step under way."""
        self._expected = window.sensitivity
        if not self.procedure.done and not math.isnan(window.newest):
            if math.isnan(self._since) or window.newest < self._newest:
                self._since = window.newest
            self._newest = window.newest
        if self.procedure.done:
            found = assess_probe(window, self.procedure.steps[-1], math.nan, 0.0)
            return replace(found, verdict=Verdict.WAITING, words="all readings are taken")
        step = self.procedure.step
        return assess_probe(window, step, self._since, step.wait if self._patient else 0.0)

    def window_of(self, view: Mapping[str, Any]) -> ProbeWindow:
        """Return the window that the engine's answer tells."""
        return probe_window_of(view, self.given.probe.range_V)

    def changed_at(self, time_s: float) -> None:
        """Take note of the device time at which a micrometer was turned (a simulated hand)."""
        self._since = time_s

    def preliminary(self) -> tuple[Array, Array, NDArray[np.int64]] | None:
        """Return position (m), residual (m) and probe of the readings that stand, as taken.

        Each probe's line is its own; None while no probe has three readings.
        """
        parts = []
        for probe in self.procedure.plan.probes:
            taken = self.procedure.readings(probe)
            if len(np.unique(taken.position)) < 3:
                continue
            line = robust_line(taken.position, taken.signal)
            if line.slope == 0.0:
                continue
            which = np.full(len(taken.position), probe, dtype=np.int64)
            parts.append((taken.position, line.residual / line.slope, which))
        if not parts:
            return None
        position, residual, which = (np.concatenate(column) for column in zip(*parts, strict=True))
        return position, residual, which

    # --- what the operator does ------------------------------------------------------------------

    def take(self, window: ProbeWindow, position: float | None = None) -> None:
        """Take the step under way with a window that is ready; raise ProcedureError when not.

        position: what the micrometer shows, m; without it, the step's.
        """
        readiness = self.look(window)
        if not readiness.ready:
            raise ProcedureError(f"it cannot be recorded now: {readiness.words}")
        procedure, step = self.procedure, self.procedure.step
        if step.kind is ProbeStepKind.MOUNT:
            self._adopt(procedure.mounted())
        else:
            found = readiness.steadiness
            mean = (float(found.mean[0]), float(found.mean[1]))
            at = step.position if position is None else position
            self._adopt(procedure.record(at, mean, found.spread, round(time.time(), 3)))
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

    def settings_of(self, probe: int) -> ProbeSettings:
        """Return the settings of a probe; its expected sensitivity is that of the one in use."""
        settings = probe_meaning(self.given)
        if settings.nominal is None and self._expected is not None:
            settings = replace(settings, nominal=float(self._expected[probe - 1]))
        return settings

    def judge(self) -> ProbeOutcome:
        """Fit and check all readings; nothing is saved. Raises ProcedureError before the end."""
        if not self.procedure.done:
            raise ProcedureError(f"readings are missing: {self.procedure.progress}")
        readings = parse_probe(self.readings_csv())
        probes = self.procedure.plan.probes
        if len(probes) == 1:
            single = calibrate_probe(readings, self.settings_of(probes[0]))
            return ProbeOutcome(single.accepted, probe_result(single), single, None, None)
        pair = calibrate_pair(split_pair(readings), (self.settings_of(1), self.settings_of(2)))
        return ProbeOutcome(pair.accepted, pair_result(pair), None, pair, None)

    def save(self, outcome: ProbeOutcome, to: Path) -> ProbeOutcome:
        """Seal an accepted outcome in a record; raise UnusableInput."""
        if not outcome.accepted:
            raise UnusableInput("a calibration that is refused is not saved.")
        refuse_existing(to)
        plan = self.procedure.plan
        taken = {
            "rig": self.rig.name,
            "simulated": self.rig.simulated,
            "operator": self.rig.operator,
            "probes": list(plan.probes),
            "positions": plan.positions,
            "runs": plan.runs,
            "events": [dict(event) for event in self.procedure.events],
        }
        kind = "probe" if outcome.pair is None else "probe pair"
        keep_record(to, kind, self.readings_csv(), self._given_used(), outcome.result, taken)
        return replace(outcome, saved=to)

    def _given_used(self) -> ProbeFile:
        """Return the settings with what was taken from the rig, so that the record is complete."""
        probes = self.procedure.plan.probes
        nominal = self.settings_of(probes[0]).nominal
        if len(probes) > 1 or nominal is None:
            return self.given
        probe = msgspec.structs.replace(
            self.given.probe, nominal_sensitivity_um_per_V=1e6 * nominal
        )
        return msgspec.structs.replace(self.given, probe=probe)

    def readings_csv(self) -> str:
        """Return all readings as the CSV of ``calibrate probes``, rejected ones as comments."""
        lines = [",".join((*PROBE_COLUMNS, OTHER_COLUMN))]
        for one in self.procedure.taken:
            step = self.procedure.steps[one.step]
            own, other = one.signal[step.probe - 1], one.signal[2 - step.probe]
            row = f"{step.series},{step.number},{1e6 * one.position!r},{own!r},{other!r}"
            lines.append(f"# rejected ({one.rejected}): {row}" if one.rejected else row)
        return "\n".join(lines) + "\n"

    def _adopt(self, after: ProbeProcedure) -> None:
        self._write(after.events[-1])
        self.procedure = after

    def _write(self, event: Mapping[str, Any]) -> None:
        self.journal.append({**event, "written": round(time.time(), 3)})


def plan_of(
    probe: str, plan: str, reach_um: float | None, positions: int, usual_um: float
) -> ProbePlan:
    """Return the plan that words ask for; raise UnusableInput naming the one that is wrong."""
    if probe not in PROBES:
        raise UnusableInput(f"--probe {probe}: choose {', '.join(PROBES)}.")
    if plan not in PROBE_PLANS:
        raise UnusableInput(f"--plan {plan}: choose {', '.join(PROBE_PLANS)}.")
    reach = 1e-6 * (usual_um if reach_um is None else reach_um)
    wanted = ProbePlan(PROBES[probe], reach, positions, PROBE_PLANS[plan])
    try:
        make_probe_plan(wanted)
    except ProcedureError as error:
        raise UnusableInput(f"the plan is not possible: {error}.") from error
    return wanted


def outcome_lines(outcome: ProbeOutcome) -> list[str]:
    """Return an outcome in words and numbers, a line each."""
    if outcome.pair is not None:
        return pair_lines(outcome.pair)
    assert outcome.single is not None
    return probe_lines(outcome.single)
