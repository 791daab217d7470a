"""A slow roll of the spindle: a short test of the engine, with all its guards and its own file."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rigapp.commands.engine_line import Ask, engine_line
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test, read_rig, read_test
from rigapp.config.recipe import (
    CyclesSection,
    LimitsSection,
    MetadataSection,
    PredictionSection,
    RunSection,
    StopSection,
    TestFile,
)
from rigapp.config.rig import RigFile
from rigapp.config.toml import toml_text
from rigapp.schema.states import ENDED

LOOK_EVERY_S = 0.2
IDLE = frozenset(state.value for state in ENDED)
RAMP_REVOLUTIONS = 2
"""Revolutions beyond those wanted: the first ones carry the ramp."""


def take_roll(
    rig: Path,
    test: Path | None,
    rpm: float,
    revolutions: int,
    to: Path,
    operator: str,
    say: Callable[[str], None],
) -> Path:
    """Turn the spindle slowly and return the test file of it; raise UnusableInput.

    test: a test file whose mechanism and limits are kept. The test and its file stand beside the
    record ``to`` and stay there. An interrupt stops the spindle under control first.
    """
    if revolutions < 1:
        raise UnusableInput("--revolutions: take at least 1; 12 are good.")
    from rigapp.calibrating.records_in_use import with_records
    from rigapp.storage import StorageFailed, compact_test

    document = read_rig(rig)
    if "run_out" in with_records(document).blocking:
        raise UnusableInput(
            f"{rig}: the map in use has expired, and an expired record forbids a start: take"
            " run_out out of [probes] for the roll."
        )
    name = f"{to.stem}.roll-{rpm:g}rpm"
    recipe, out = to.with_name(f"{name}.toml"), to.with_name(f"{name}.h5")
    for path in (recipe, out):
        if path.exists():
            raise UnusableInput(f"{path}: exists and is not overwritten; name another record.")
    text = roll_text(document.record, test, rpm, revolutions, operator)
    recipe.write_text(text, encoding="utf-8")
    simulated = document.record.simulation is not None
    with engine_line(rig, operator, own=simulated) as ask:
        say(f"Rolling at {rpm:g} rpm for {revolutions} revolutions; {out} records it.")
        ask("start", {"test": str(recipe.resolve()), "out": str(out.resolve())})
        _wait_for_the_end(ask, out, revolutions + RAMP_REVOLUTIONS, say)
    # An engine that goes on running compresses its files itself.
    with suppress(UnusableInput, StorageFailed):
        compact_test(out)
    return out


def _wait_for_the_end(ask: Ask, out: Path, planned: int, say: Callable[[str], None]) -> None:
    """Wait while the test is active; an interrupt stops the spindle and is passed on."""
    shown = -1
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
        ask("stop", {"reason": "the slow roll was interrupted"})
        raise
    if done < planned:
        raise UnusableInput(
            f"the slow roll ended after {done} of {planned} revolutions: {status['reason']};"
            f" {out} holds what was recorded."
        )


def roll_text(rig: RigFile, test: Path | None, rpm: float, revolutions: int, operator: str) -> str:
    """Return the test file of a slow roll: every cycle kept, no prediction, guards kept close."""
    if test is not None:
        base = read_test(test).record
        model, limits = base.model, base.limits
    else:
        from rigapp.simulation.constants import packaged_parameters

        model, limits = packaged_parameters(), LimitsSection()
    overload = min(limits.overload_N, 0.95 * rig.load_cell.full_scale_N)
    roll = TestFile(
        schema=1,
        title=f"Slow roll at {rpm:g} rpm for the run-out map",
        run=RunSection(
            revolutions=revolutions + RAMP_REVOLUTIONS,
            speed_rpm=rpm,
            acceleration_rpm_per_s=max(1.0, rpm),
        ),
        model=model,
        metadata=MetadataSection(operator=operator, notes="slow roll of the pin"),
        cycles=CyclesSection(schedule="every", every_revolutions=1),
        limits=LimitsSection(
            overload_N=overload, overspeed_rpm=3.0 * rpm + 10.0, stale_data_s=limits.stale_data_s
        ),
        stop=StopSection(),
        prediction=PredictionSection(enabled=False),
    )
    text = toml_text(roll)
    parse_test(text, "slow roll")
    return text
