"""`rigapp calibrate run-out` and `running-check`: short tests of the engine, with all its guards.

Each speed is a test with a file of its own, beside the record; both stay there.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from calibration.turning.run_out import FASTEST
from calibration.turning.running_check import LEAST_REVOLUTIONS
from rigapp.calibrating.practice import BARE_PIN
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.run_out import map_of
from rigapp.calibrating.running_check import check_of, known_term
from rigapp.commands.calibrate import say_outcome
from rigapp.commands.engine_line import Ask, engine_line
from rigapp.commands.live_terminal import Say, sayer
from rigapp.config.calibration_settings import CellSection, LoadCellFile, RunOutFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test, read_document, read_rig, read_test
from rigapp.config.recipe import (
    CyclesSection,
    LimitsSection,
    MetadataSection,
    PredictionSection,
    RunSection,
    TestFile,
)
from rigapp.config.rig import RigFile
from rigapp.config.toml import toml_text
from rigapp.schema.messages import RunState
from rigapp.schema.states import ENDED

LOOK_EVERY_S = 0.1
IDLE = frozenset(state.value for state in (*ENDED, RunState.READY, RunState.IDLE))
ROLL_RAMP = 2
RUN_RAMP = 3
"""Revolutions beyond those wanted: the first ones carry the ramp."""
SLOWEST_RPM = 0.5
"""Slower no spindle turns evenly."""


@dataclass(frozen=True, slots=True)
class SpindleRun:
    """One run of the spindle: speed (rpm), its test, the name of its files without ending."""

    rpm: float
    test: TestFile
    stem: Path

    @property
    def recipe(self) -> Path:
        """Return the test file."""
        return self.stem.with_name(f"{self.stem.name}.toml")

    @property
    def out(self) -> Path:
        """Return the file of what is recorded."""
        return self.stem.with_name(f"{self.stem.name}.h5")


def take_runs(
    runs: Sequence[SpindleRun], line: AbstractContextManager[Ask], what: str, say: Say
) -> list[Path]:
    """Run every speed through the engine and return the test files; raise UnusableInput.

    line: to the engine; what: the runs are, in words. An interrupt stops the spindle under control
    first.
    """
    from rigapp.storage import StorageFailed, compact_test

    for path in (path for run in runs for path in (run.recipe, run.out)):
        if path.exists():
            raise UnusableInput(f"{path}: exists and is not overwritten; name another record.")
    for run in runs:
        text = toml_text(run.test)
        parse_test(text, what)
        run.recipe.write_text(text, encoding="utf-8")
    with line as ask:
        for run in runs:
            planned = run.test.run.revolutions
            say(f"{run.rpm:g} rpm for {planned} revolutions; {run.out} records it.")
            ask("start", {"test": str(run.recipe.resolve()), "out": str(run.out.resolve())})
            _wait_for_the_end(ask, run, what, say)
    for run in runs:
        # An engine that goes on running compresses its files itself.
        with suppress(UnusableInput, StorageFailed):
            compact_test(run.out)
    return [run.out for run in runs]


def _wait_for_the_end(ask: Ask, run: SpindleRun, what: str, say: Say) -> None:
    """Wait while the test is active; an interrupt stops the spindle and is passed on."""
    planned, shown = run.test.run.revolutions, -1
    try:
        while True:
            status = ask("status", {})
            done = int(status["revolution"])
            if done != shown:
                shown = done
                say(f"  revolution {done} of {planned}")
            if status["state"] in IDLE:
                break
            time.sleep(LOOK_EVERY_S)
    except BaseException:
        ask("stop", {"reason": f"the {what} was interrupted"})
        raise
    if done < planned or status["state"] == RunState.FAULT.value:
        raise UnusableInput(
            f"the {what} ended after {done} of {planned} revolutions: {status['reason']};"
            f" {run.out} holds what was recorded."
        )


def speeds_of(option: str, text: str, least: float, most: float, fewest: int) -> list[float]:
    """Return different speeds (rpm) of a text such as ``3,6``; raise UnusableInput."""
    try:
        speeds = [float(word) for word in text.replace(";", ",").split(",") if word.strip()]
    except ValueError as error:
        raise UnusableInput(f"{option} {text}: write speeds in rpm, such as 3,6.") from error
    different = len(set(speeds)) == len(speeds) >= fewest
    if not different or not all(least <= one <= most for one in speeds):
        raise UnusableInput(
            f"{option} {text}: give {fewest} or more different speeds from {least:g} to {most:g}"
            " rpm."
        )
    return speeds


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
    """Make the map from live rolls or from recorded ones; keep a record when it is good.

    test: a test file whose mechanism and limits are kept in live rolls.
    """
    if (rig is None) == (not recorded):
        raise UnusableInput(
            "give --rig or --from, one of the two: live rolls need --rig, recorded ones --from"
            " FILE.h5."
        )
    given = RunOutFile(schema=1) if settings is None else read_document(settings, RunOutFile).record
    refuse_existing(to)
    files, name = list(recorded), ""
    if rig is not None:
        operator = given.paperwork.operator or os.environ.get("USER", "")
        speeds = speeds_of("--rpm", rpm, SLOWEST_RPM, FASTEST * 30.0 / math.pi, 1)
        name = read_rig(rig).record.name
        files = take_rolls(rig, test, speeds, revolutions, to, operator, sayer(as_json))
    outcome, readings, facts = map_of(files, orders)
    if outcome.accepted:
        taken = {"rig": name, "files": facts, "orders": orders}
        keep_record(to, outcome.kind, readings, given, outcome.result, taken)
    return say_outcome(outcome, to, as_json=as_json)


def take_rolls(
    rig: Path,
    test: Path | None,
    speeds: Sequence[float],
    revolutions: int,
    to: Path,
    operator: str,
    say: Callable[[str], None],
) -> list[Path]:
    """Turn the spindle slowly, once at each speed, and return the test files."""
    if revolutions < 1:
        raise UnusableInput("--revolutions: take at least 1; 12 are good.")
    document = read_rig(rig)
    if "run_out" in with_records(document).blocking:
        raise UnusableInput(
            f"{rig}: the map in use has expired, and an expired record forbids a start: take"
            " run_out out of [probes] for the roll."
        )
    runs = [
        SpindleRun(
            rpm,
            roll_test(document.record, test, rpm, revolutions, operator),
            to.with_name(f"{to.stem}.roll-{rpm:g}rpm"),
        )
        for rpm in speeds
    ]
    own = document.record.simulation is not None
    return take_runs(runs, engine_line(rig, operator, own=own), "slow roll", say)


def roll_test(
    rig: RigFile, test: Path | None, rpm: float, revolutions: int, operator: str
) -> TestFile:
    """Return the test of a slow roll: every cycle kept, no prediction, guards kept close."""
    from rigapp.simulation.constants import packaged_parameters

    base = None if test is None else read_test(test).record
    limits = LimitsSection() if base is None else base.limits
    return TestFile(
        schema=1,
        title=f"Slow roll at {rpm:g} rpm for the run-out map",
        run=RunSection(
            revolutions=revolutions + ROLL_RAMP,
            speed_rpm=rpm,
            acceleration_rpm_per_s=max(1.0, rpm),
        ),
        model=packaged_parameters() if base is None else base.model,
        metadata=MetadataSection(operator=operator, notes="slow roll of the pin"),
        cycles=CyclesSection(schedule="every", every_revolutions=1),
        limits=LimitsSection(
            overload_N=min(limits.overload_N, 0.95 * rig.load_cell.full_scale_N),
            overspeed_rpm=3.0 * rpm + 10.0,
            stale_data_s=limits.stale_data_s,
        ),
        prediction=PredictionSection(enabled=False),
    )


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
    """Run the check and keep its record when it is passed; return the exit status."""
    document = read_rig(rig)
    here = document.record
    refuse_existing(to)
    wanted = sorted(speeds_of("--speeds", speeds, SLOWEST_RPM, here.spindle.maximum_speed_rpm, 2))
    known = known_term(here, mass_kg, radius_mm)
    if revolutions < LEAST_REVOLUTIONS:
        raise UnusableInput(f"--revolutions: take at least {LEAST_REVOLUTIONS}; 20 are good.")
    simulated = here.simulation is not None
    if not simulated and not follower_off:
        raise UnusableInput(
            "the follower must be off the pin and nothing may hang on it; then add --follower-off."
        )
    given = LoadCellFile(schema=1, cell=CellSection(name="load cell"))
    if settings is not None:
        given = read_document(settings, LoadCellFile).record
    operator = given.paperwork.operator or os.environ.get("USER", "")
    runs = [
        SpindleRun(
            rpm,
            running_test(here, rpm, revolutions, operator),
            to.with_name(f"{to.stem}.{rpm:g}rpm"),
        )
        for rpm in wanted
    ]
    line = _bare_rig(document, operator) if simulated else engine_line(rig, operator)
    files = take_runs(runs, line, "running check", sayer(as_json))
    outcome, readings = check_of(files, wanted, known)
    if outcome.accepted:
        taken = {
            "rig": here.name,
            "simulated": simulated,
            "operator": operator,
            "files": [path.name for path in files],
        }
        keep_record(to, outcome.kind, readings, given, outcome.result, taken)
    return say_outcome(outcome, to, as_json=as_json)


def running_test(rig: RigFile, rpm: float, revolutions: int, operator: str) -> TestFile:
    """Return the test of one speed: no cycles kept, no prediction, guards kept close."""
    from rigapp.simulation.constants import packaged_parameters

    acceleration = max(60.0, rpm / 2.0)
    return TestFile(
        schema=1,
        title=f"Running check at {rpm:g} rpm, without the follower",
        run=RunSection(
            revolutions=revolutions + RUN_RAMP + math.ceil(rpm / 120.0 * rpm / 60.0),
            speed_rpm=rpm,
            acceleration_rpm_per_s=acceleration,
        ),
        model=packaged_parameters(),
        metadata=MetadataSection(operator=operator, notes="running check of the load cell"),
        cycles=CyclesSection(schedule="none", before_alarm=0, after_alarm=0),
        limits=LimitsSection(
            overload_N=0.5 * rig.load_cell.full_scale_N, overspeed_rpm=1.3 * rpm + 10.0
        ),
        prediction=PredictionSection(enabled=False),
    )


@contextmanager
def _bare_rig(rig: Document[RigFile], operator: str) -> Iterator[Ask]:
    """Yield a line to the simulated rig after the simulated hands took its follower off."""
    test = running_test(rig.record, 30.0, LEAST_REVOLUTIONS, operator)
    with engine_line(rig.path, operator, own=True, test=test) as ask:
        for action in BARE_PIN:
            ask(action.verb, dict(action.arguments))
        ask("hand", {"what": "release_crank"})
        yield ask
