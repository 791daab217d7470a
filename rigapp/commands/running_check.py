"""`rigapp calibrate running-check`: the pin's known inertia against the cell, without the follower.

Each speed is a short test of the engine, with all its guards and a file of its own.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from calibration.turning.running_check import Known, RunningCheck, SpeedRun, running_check
from rigapp.calibrating.practice import preparation
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.commands.calibrate import say_result
from rigapp.commands.engine_line import Ask, engine_line
from rigapp.config.calibration_settings import CellSection, LoadCellFile, read_load_cell_settings
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test, read_rig
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
from rigapp.process.ending import ending_as_interrupt
from rigapp.schema.messages import Flag, Request, RunState

RAMP_REVOLUTIONS = 3
"""Revolutions beyond those wanted; the first ones carry the ramp."""
STEADY_SHARE = 0.02
LOOK_EVERY_S = 0.1
MASS_UNCERTAINTY = 0.01
ENDED = frozenset({RunState.READY, RunState.STOPPED, RunState.FAULT, RunState.IDLE})

Say = Callable[[str], None]


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
    refuse_existing(to)
    wanted = parse_speeds(speeds, document.record)
    known = known_term(document.record, mass_kg, radius_mm)
    if revolutions < 5:
        raise UnusableInput("--revolutions: take at least 5; 20 are good.")
    if document.record.simulation is None and not follower_off:
        raise UnusableInput(
            "the follower must be off the pin and nothing may hang on it; then add --follower-off."
        )
    given = LoadCellFile(schema=1, cell=CellSection(name="load cell"))
    if settings is not None:
        given, _ = read_load_cell_settings(settings)

    def say(text: str) -> None:
        print(text, file=sys.stderr if as_json else sys.stdout, flush=True)

    operator = given.paperwork.operator or os.environ.get("USER", "")
    runs, files = take_runs(document, to, wanted, revolutions, operator, say)
    found = running_check(runs, known)
    result = running_result(found, known)
    if found.accepted:
        taken = {
            "rig": document.record.name,
            "simulated": document.record.simulation is not None,
            "operator": operator,
            "files": [path.name for path in files],
        }
        keep_record(to, "running check", runs_csv(runs), given, result, taken)
    if not as_json:
        print("\n".join([*running_lines(found), found.sentence]))
    say_result(result, to, as_json=as_json, lines=())
    return 0 if found.accepted else 1


def parse_speeds(text: str, rig: RigFile) -> list[float]:
    """Return at least two rising speeds (rpm); raise UnusableInput."""
    try:
        speeds = sorted({float(word) for word in text.replace(";", ",").split(",") if word.strip()})
    except ValueError as error:
        raise UnusableInput(f"--speeds {text}: write speeds in rpm, such as 30,120,240.") from error
    most = rig.spindle.maximum_speed_rpm
    if len(speeds) < 2 or speeds[0] <= 0.0 or speeds[-1] > most:
        raise UnusableInput(
            f"--speeds {text}: give two or more different speeds above 0, up to {most:g} rpm."
        )
    return speeds


def known_term(rig: RigFile, mass_kg: float | None, radius_mm: float | None) -> Known:
    """Return what is known of the pin and the cell; raise UnusableInput without a mass."""
    cell = rig.load_cell
    mass = cell.outboard_mass_kg if mass_kg is None else mass_kg
    radius = cell.outboard_radius_mm if radius_mm is None else radius_mm
    if not (mass > 0.0 and radius > 0.0):
        raise UnusableInput(
            "the mass of the pin outboard of its gauges is not known; write"
            " load_cell.outboard_mass_kg and outboard_radius_mm, or give --mass-kg and --radius-mm."
        )
    per_force = 0.005 if cell.uncertainty_N is None else cell.uncertainty_N[1] / 2.0
    return Known(mass * radius * 1e-3, MASS_UNCERTAINTY, cell.resolution_N, per_force)


def take_runs(
    rig: Document[RigFile],
    to: Path,
    speeds: Sequence[float],
    revolutions: int,
    operator: str,
    say: Say,
) -> tuple[list[SpeedRun], list[Path]]:
    """Run every speed through the engine; raise UnusableInput when one is not completed."""
    simulated = rig.record.simulation is not None
    recipes = [to.with_name(f"{to.stem}.{speed:g}rpm.toml") for speed in speeds]
    files = [path.with_suffix(".h5") for path in recipes]
    for path in (*recipes, *files):
        if path.exists():
            raise UnusableInput(f"{path}: exists and is not overwritten; name another record.")
    for speed, recipe in zip(speeds, recipes, strict=True):
        recipe.write_text(_recipe(rig.record, speed, revolutions, operator), encoding="utf-8")
    line = _bare_rig(rig, operator) if simulated else engine_line(rig.path, operator)
    with line as ask:
        for speed, recipe, out in zip(speeds, recipes, files, strict=True):
            say(f"{speed:g} rpm for {revolutions} revolutions; {out.name} records it.")
            ask("start", {"test": str(recipe.resolve()), "out": str(out.resolve())})
            _wait(ask, out)
    return [read_run(path, speed) for path, speed in zip(files, speeds, strict=True)], files


@contextmanager
def _bare_rig(rig: Document[RigFile], operator: str) -> Iterator[Ask]:
    """Yield a line to the simulated rig after the simulated hands took its follower off."""
    from rigapp.service.host import EngineHost
    from rigapp.service.simulated import parse_speed

    host = EngineHost(rig, parse_speed(None, rig))

    def ask(verb: str, arguments: dict[str, Any]) -> Any:
        reply = host.handle(Request(verb, arguments, operator))
        if not reply.ok:
            raise UnusableInput(reply.sentence)
        return reply.result

    with ending_as_interrupt():
        try:
            host.connect(parse_test(_recipe(rig.record, 30.0, 5, operator), "running check"))
            for action in preparation():
                ask(action.verb, dict(action.arguments))
            ask("hand", {"what": "release_crank"})
            yield ask
        finally:
            host.close()


def _wait(ask: Ask, out: Path) -> None:
    try:
        while True:
            status = ask("status", {})
            if RunState(status["state"]) in ENDED:
                break
            time.sleep(LOOK_EVERY_S)
    except BaseException:
        ask("stop", {"reason": "the running check was interrupted"})
        raise
    if RunState(status["state"]) is not RunState.STOPPED:
        raise UnusableInput(f"the run was not completed: {status['reason']}; {out} holds it.")


def _recipe(rig: RigFile, rpm: float, revolutions: int, operator: str) -> str:
    """Return the test file of one speed: no prediction, guards kept close."""
    from rigapp.simulation.constants import packaged_parameters

    test = TestFile(
        schema=1,
        title=f"Running check at {rpm:g} rpm, without the follower",
        run=RunSection(
            revolutions=revolutions + RAMP_REVOLUTIONS + math.ceil(rpm / 120.0 * rpm / 60.0),
            speed_rpm=rpm,
            acceleration_rpm_per_s=max(60.0, rpm / 2.0),
        ),
        model=packaged_parameters(),
        metadata=MetadataSection(operator=operator, notes="running check of the load cell"),
        cycles=CyclesSection(schedule="none", before_alarm=0, after_alarm=0),
        limits=LimitsSection(
            overload_N=0.5 * rig.load_cell.full_scale_N, overspeed_rpm=1.3 * rpm + 10.0
        ),
        prediction=PredictionSection(enabled=False),
    )
    tree = {key: value for key, value in msgspec.to_builtins(test).items() if key != "stop"}
    text = toml_text(tree)
    parse_test(text, "running check")
    return text


def read_run(path: Path, rpm: float) -> SpeedRun:
    """Return the revolutions of a test file at its steady speed."""
    from rigapp.storage import open_test

    with open_test(path) as reader:
        summary = reader.summary()
        if summary["status"] != "complete":
            raise UnusableInput(
                f"the run at {rpm:g} rpm was not completed: {summary['reason']} {path} holds it."
            )
        names = ("speed", "quality", "force_1_mean", "force_2_mean", "force_1_rms", "force_2_rms")
        speed, quality, one, two, rms_1, rms_2 = (reader.column(name) for name in names)
    good = (np.abs(speed / rpm - 1.0) < STEADY_SHARE) & (quality & int(Flag.PARTIAL) == 0)
    force = np.column_stack((one, two))[good].astype(np.float64)
    squares = np.column_stack((rms_1, rms_2))[good] ** 2 - force**2
    spread = float(np.sqrt(np.maximum(squares, 0.0).mean(axis=0).min())) if len(force) else 0.0
    return SpeedRun(speed[good].astype(np.float64) * math.pi / 30.0, force, spread)


def runs_csv(runs: Sequence[SpeedRun]) -> str:
    """Return every revolution that was used, as CSV."""
    lines = ["run,speed_rpm,force_1_N,force_2_N"]
    for number, run in enumerate(runs, 1):
        for speed, (one, two) in zip(run.speed, run.force, strict=True):
            lines.append(
                f"{number},{float(speed) * 30.0 / math.pi!r},{float(one)!r},{float(two)!r}"
            )
    return "\n".join(lines) + "\n"


def running_result(found: RunningCheck, known: Known) -> dict[str, Any]:
    """Return what ``--json`` prints and the record keeps, units in the keys."""
    return {
        "accepted": found.accepted,
        "problems": [
            {"code": one.code, "sentence": one.sentence, "blocks": one.blocks}
            for one in found.problems
        ],
        "sentence": found.sentence,
        "known_mass_times_radius_kg_m": known.moment,
        "measured_mass_times_radius_kg_m": found.moment,
        "measured_expanded_uncertainty_kg_m": found.moment_expanded,
        "coverage_factor": 2.0,
        "speeds": [
            {
                "speed_rpm": one.speed * 30.0 / math.pi,
                "known_N": list(one.known),
                "measured_N": list(one.measured),
                "expanded_uncertainty_N": one.expanded,
                "agrees": one.agrees,
            }
            for one in found.comparisons
        ],
    }


def running_lines(found: RunningCheck) -> list[str]:
    """Return the speeds as lines of a table."""
    if not found.comparisons:
        return []
    return [
        "   rpm   known N   force_1 N   force_2 N   U (k = 2) N",
        *(
            f"{one.speed * 30.0 / math.pi:6.1f} {one.known[0]:+9.2f} {one.measured[0]:+11.2f}"
            f" {one.measured[1]:+11.2f} {one.expanded:13.2f}"
            for one in found.comparisons
        ),
    ]
