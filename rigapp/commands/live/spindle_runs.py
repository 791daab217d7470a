"""`rigapp calibrate run-out` and `running-check`: short tests with all limits of the engine.

Each speed is a test with its own file beside the record; both are kept.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.rolls import roll_plan, rolls_of, save_map
from rigapp.calibrating.running_check import check_of, known_term
from rigapp.calibrating.spindle import SLOWEST_RPM, SpindleRun, SpindleRuns, speeds_of
from rigapp.calibrating.training import BARE_PIN
from rigapp.commands.calibrate import say_outcome
from rigapp.commands.live.engine_line import Ask, engine_line, occupied
from rigapp.commands.live.terminal import Say, operator_of, sayer
from rigapp.config.calibration_settings import CellSection, LoadCellFile, RunOutFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_document, read_rig, read_test
from rigapp.config.recipe import (
    CyclesSection,
    LimitsSection,
    MetadataSection,
    PredictionSection,
    RunSection,
    TestFile,
)
from rigapp.config.rig import RigFile
from rigapp_calibration.turning.running_check import LEAST_REVOLUTIONS

POLL_S = 0.1  # ten updates of the progress line a second
RUN_RAMP = 3
"""Additional revolutions, since the first ones are the ramp."""
SLOWEST_RAMP_RPM_PER_S = 60.0  # of a usual drive; the length of every run allows for it
RAMP_S = 2.0  # longest ramp of faster runs
OVERLOAD_SHARE = 0.5
"""Overload limit, share of full scale: with only the pin's inertia, half indicates a mistake."""
OVERSPEED_FACTOR, OVERSPEED_MORE_RPM = 1.3, 10.0
"""Overspeed limit: 30 % overshoot of the loop, and 10 rpm for the resolution of slow speeds."""


def take_runs(runs: SpindleRuns, line: AbstractContextManager[Ask], say: Say) -> None:
    """Perform all runs through the engine; raises UnusableInput.

    line: connection to the engine. An interrupt first stops the spindle under control.
    """
    fastest = max(run.rpm for run in runs.runs)
    with line as ask, occupied(ask, runs.what, fastest) as key:
        shown = ""
        try:
            while not runs.done:
                action = runs.go_on(ask("status", {}))
                if runs.words != shown:
                    shown = runs.words
                    say(shown)
                if action is not None:
                    ask(action.verb, {**action.arguments, "calibration": key})
                elif not runs.done:
                    time.sleep(POLL_S)
        except BaseException:
            if runs.turning:
                ask("stop", {"reason": f"the {runs.what} was interrupted"})
            raise
    runs.compress()


# --- run-out --------------------------------------------------------------------------------------


def calibrate_run_out(
    rig: Path | None,
    recorded: Sequence[Path],
    to: Path,
    *,
    settings: Path | None,
    test: Path | None,
    rpm: str,
    revolutions: int,
    orders: int,
    as_json: bool,
) -> int:
    """Make the map from live or recorded rolls; save a record when it is accepted.

    test: a test file whose mechanism and limits apply to live rolls.
    """
    if (rig is None) == (not recorded):
        raise UnusableInput(
            "give --rig or --from, one of the two: live rolls need --rig, recorded ones --from"
            " FILE.h5."
        )
    file = RunOutFile(schema=1) if settings is None else read_document(settings, RunOutFile).record
    refuse_existing(to)
    files, source = recorded, dict[str, Any](rig="")
    if rig is not None:
        document, operator = read_rig(rig), operator_of(file)
        base = plain_test() if test is None else read_test(test).record
        plan = roll_plan(rpm, revolutions, orders)
        rolls = rolls_of(document, base, plan, to.with_suffix(""), operator)
        own = document.record.simulated
        take_runs(rolls, engine_line(rig, operator, own=own), sayer(as_json))
        files, source = rolls.files, {"rig": document.record.name, "simulated": own}
    return say_outcome(save_map(files, orders, source, file, to), to, as_json=as_json)


def plain_test() -> TestFile:
    """Return a test with the built-in mechanism, for a roll without a test file."""
    from rigapp.simulation.constants import packaged_parameters

    run = RunSection(revolutions=1, speed_rpm=1.0)
    return TestFile(schema=1, title="Slow roll", run=run, model=packaged_parameters())


# --- running check --------------------------------------------------------------------------------


def check_running(
    rig: Path,
    to: Path,
    *,
    speeds: str,
    revolutions: int,
    mass_kg: float | None,
    radius_mm: float | None,
    follower_off: bool,
    settings: Path | None,
    as_json: bool,
) -> int:
    """Run the check and save its record when it passes; return the exit status."""
    document = read_rig(rig)
    here = document.record
    refuse_existing(to)
    wanted = sorted(speeds_of("--speeds", speeds, SLOWEST_RPM, here.spindle.maximum_speed_rpm, 2))
    known = known_term(here, mass_kg, radius_mm)
    if revolutions < LEAST_REVOLUTIONS:
        raise UnusableInput(f"--revolutions: take at least {LEAST_REVOLUTIONS}; 20 are good.")
    simulated = here.simulated
    if not simulated and not follower_off:
        raise UnusableInput(
            "the follower must be off the pin and nothing may hang on it; then add --follower-off."
        )
    file = LoadCellFile(schema=1, cell=CellSection(name="load cell"))
    if settings is not None:
        file = read_document(settings, LoadCellFile).record
    operator = operator_of(file)
    runs = [
        SpindleRun(
            rpm,
            running_test(here, rpm, revolutions, operator),
            to.with_name(f"{to.stem}.{rpm:g}rpm"),
        )
        for rpm in wanted
    ]
    line = _bare_rig(document, operator) if simulated else engine_line(rig, operator)
    taken_runs = SpindleRuns(runs, "running check")
    take_runs(taken_runs, line, sayer(as_json))
    outcome, readings = check_of(taken_runs.files, wanted, known)
    if outcome.accepted:
        taken = {
            "rig": here.name,
            "simulated": simulated,
            "operator": operator,
            "files": [path.name for path in taken_runs.files],
        }
        keep_record(to, outcome.kind, readings, file, outcome.result, taken)
    return say_outcome(outcome, to, as_json=as_json)


def running_test(rig: RigFile, rpm: float, revolutions: int, operator: str) -> TestFile:
    """Return the test of one speed: no stored cycles, no prediction, tight limits."""
    from rigapp.simulation.constants import packaged_parameters

    slowest_ramp = rpm / 120.0 * rpm / SLOWEST_RAMP_RPM_PER_S
    return TestFile(
        schema=1,
        title=f"Running check at {rpm:g} rpm, without the follower",
        run=RunSection(
            revolutions=revolutions + RUN_RAMP + math.ceil(slowest_ramp),
            speed_rpm=rpm,
            acceleration_rpm_per_s=max(SLOWEST_RAMP_RPM_PER_S, rpm / RAMP_S),
        ),
        model=packaged_parameters(),
        metadata=MetadataSection(operator=operator, notes="running check of the load cell"),
        cycles=CyclesSection(schedule="none", before_alarm=0, after_alarm=0),
        limits=LimitsSection(
            overload_N=OVERLOAD_SHARE * rig.load_cell.full_scale_N,
            overspeed_rpm=OVERSPEED_FACTOR * rpm + OVERSPEED_MORE_RPM,
        ),
        prediction=PredictionSection(enabled=False),
    )


@contextmanager
def _bare_rig(rig: Document[RigFile], operator: str) -> Iterator[Ask]:
    """Yield a connection to the simulated rig after the simulated operator removed its follower."""
    test = running_test(rig.record, 30.0, LEAST_REVOLUTIONS, operator)
    with engine_line(rig.path, operator, own=True, test=test) as ask:
        for action in BARE_PIN:
            ask(action.verb, dict(action.arguments))
        ask("hand", {"what": "release_crank"})
        yield ask
