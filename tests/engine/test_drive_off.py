"""What takes the power off does so in every state of a run, at once, and before anything else."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal

import pytest
from patience import PATIENCE_S

from rigapp.schema.messages import FinishReason, RunState, Severity
from rigapp.schema.states import ACTIVE, ENDED
from rigapp_drivers.api import Block, DriveStatus
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

LONG = 1_000_000
STARTING, RUNNING = RunState.STARTING, RunState.RUNNING
PAUSING, PAUSED, STOPPING = RunState.PAUSING, RunState.PAUSED, RunState.STOPPING
OPEN = (STARTING, RUNNING, PAUSING, PAUSED, STOPPING)


@dataclass(frozen=True)
class Command:
    """One command to the drive: what, with how many samples processed and drive polls before it."""

    what: str
    rpm: float
    samples: int
    polls: int


class Watched(MemoryRig):
    """A rig in memory that notes what the drive is told and when, counted and not timed.

    shown_sample, shown_poll: first sample of the block, and number of the drive's answer, that
    were the first to show the danger. What came before the strike may still be on its way.
    """

    struck = False
    shown_sample: int | None = None
    shown_poll: int | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        self.told: list[Command] = []
        read, status = self.source.read, self.spindle.status
        set_speed, drive_off = self.spindle.set_speed, self.spindle.drive_off

        def seen_read(timeout_s: float) -> Block | None:
            struck, block = self.struck, read(timeout_s)
            if struck and block is not None and self.shown_sample is None:
                self.shown_sample = block.first_sample
            return block

        def seen_status() -> DriveStatus:
            struck, told = self.struck, status()
            if struck and self.shown_poll is None:
                self.shown_poll = self.spindle.polls
            return told

        def noted_speed(rev_per_s: float, rev_per_s2: float) -> None:
            self._note("speed", 60.0 * rev_per_s)
            set_speed(rev_per_s, rev_per_s2)

        def noted_off() -> None:
            self._note("off", 0.0)
            drive_off()

        self.source.read = seen_read  # type: ignore[method-assign]
        self.spindle.status = seen_status  # type: ignore[method-assign]
        self.spindle.set_speed = noted_speed  # type: ignore[method-assign]
        self.spindle.drive_off = noted_off  # type: ignore[method-assign]

    def _note(self, what: str, rpm: float) -> None:
        self.told.append(Command(what, rpm, self.engine.samples_processed, self.spindle.polls))


@dataclass(frozen=True)
class Danger:
    """Something that ends a test.

    off: without power, else by a ramp. by: who shows it; the drive is told before the next sample
    is processed, or before the drive is asked again.
    """

    name: str
    strike: Callable[[Watched], object]
    code: FinishReason
    off: bool = True
    states: tuple[RunState, ...] = OPEN
    key: str = ""
    by: Literal["samples", "drive", "others"] = "others"


def _set(thing: str, **values: Any) -> Callable[[Watched], object]:
    def strike(rig: Watched) -> None:
        for name, value in values.items():
            setattr(getattr(rig, thing), name, value)

    return strike


def _turn(rpm: float, told: float = 1.0) -> Callable[[Watched], object]:
    def strike(rig: Watched) -> None:
        rig.spindle.tells_ratio = told
        with rig.crank.lock:
            rig.crank.powered, rig.crank.jammed = True, False
            rig.crank.speed = rig.crank.target = rpm / 60.0

    return strike


def _be_silent(rig: Watched) -> None:
    rig.source.silent = True
    if rig.engine.state in ACTIVE:  # nothing else is late any more: a short limit proves the same
        rig.engine.set_limit("stale_data_s", 0.5)


def _drive_off(rig: Watched) -> None:
    rig.engine.drive_off("Ada", "smoke")


LIMIT, DEVICE = FinishReason.LIMIT, FinishReason.DEVICE
DANGERS = (
    Danger("overload", _set("source", force_N=390.0), LIMIT, by="samples"),
    Danger("not a number", _set("source", force_N=math.nan), DEVICE, key="invalid_signal",
           by="samples"),
    Danger("cell cut off", _set("source", saturated=0), DEVICE, key="saturated:force_1",
           by="samples"),
    Danger("overspeed", _turn(300.0), LIMIT, states=(STARTING, RUNNING, PAUSING, STOPPING)),
    Danger("overspeed of the encoder", _turn(300.0, told=0.1), LIMIT, key="overspeed",
           states=(STARTING, RUNNING, PAUSING, STOPPING)),
    Danger("overspeed of the drive", _set("spindle", tells_ratio=3.0), LIMIT, key="overspeed",
           states=(RUNNING, PAUSING, STOPPING), by="drive"),
    Danger("moves in a pause", _turn(30.0), DEVICE, states=(PAUSED,), key="moved_in_pause"),
    Danger("drive fault", _set("spindle", faults=("overcurrent",)), DEVICE, key="drive_fault",
           by="drive"),
    Danger("emergency stop", _set("spindle", emergency_stop=True), DEVICE, key="emergency_stop",
           by="drive"),
    # Not while stopping: without an angle the way to the rest ends by a ramp, before the limit.
    Danger("stale data", _be_silent, DEVICE, key="stale_data",
           states=(STARTING, RUNNING, PAUSING, PAUSED)),
    Danger("encoder lost", _set("source", encoder_dead=True), DEVICE, states=(RUNNING,),
           key="encoder_lost"),
    Danger("operator", _drive_off, FinishReason.OPERATOR, key="-"),
    Danger("storage", lambda rig: setattr(rig.store, "broken", OSError("input/output error")),
           FinishReason.STORAGE, off=False),
    Danger("cable pulled", _set("source", lost=True), DEVICE, off=False, key="device_lost:daq"),
)  # fmt: skip


@pytest.fixture
def rig() -> Iterator[Watched]:
    quick = replace(MemoryRig().timing, standing=0.05, start_margin=60.0, stop_margin=60.0)
    memory = Watched(timing=quick)
    memory.engine.connect()
    yield memory
    memory.source.silent = memory.source.lost = False
    memory.engine.shutdown(20.0)


def bring_to(rig: Watched, state: RunState) -> None:
    """Bring a test into a state in which it stays until something happens."""
    rig.crank.jammed = state is STARTING
    rig.start(a_test(LONG, every=1_000_000))
    if state is not STARTING:
        eventually(lambda: rig.store.rows)
        rig.crank.deaf = state in (PAUSING, STOPPING)
        if state in (PAUSING, PAUSED):
            rig.engine.pause("Ada")
        elif state is STOPPING:
            rig.engine.stop("Ada")
    reached = rig.engine.wait((state, *ENDED), 60.0)
    assert reached is state, rig.engine.outcome
    if state is PAUSING:  # the creep has been commanded; only the angle is awaited
        eventually(lambda: rig.told[-1].rpm == 10.0)
    rig.crank.deaf = False


@pytest.mark.sampled(every=2)
@pytest.mark.parametrize(
    ("danger", "state"),
    [
        pytest.param(one, state, id=f"{one.name} while {state}")
        for one in DANGERS
        for state in one.states
    ],
)
def test_every_danger_reaches_the_drive_in_every_state(
    rig: Watched, danger: Danger, state: RunState
) -> None:
    bring_to(rig, state)
    before = len(rig.told)
    rig.struck = True
    danger.strike(rig)
    if state is STOPPING and not danger.off:  # it is being stopped: nothing more to tell at once
        rig.crank.target = 0.0
        rig.engine.wait(ENDED, 60.0)
        return

    def told() -> list[Command]:
        """Return what followed, but for the ramp with which a stop gives up its way to the rest."""
        ramp_down = ("speed", 0.0) if state is STOPPING else None
        return [one for one in rig.told[before:] if (one.what, one.rpm) != ramp_down]

    eventually(told)
    first = told()[0]
    assert first.what == ("off" if danger.off else "speed")
    assert first.rpm == 0.0
    if danger.by == "samples":
        assert rig.shown_sample is None or first.samples <= rig.shown_sample
    elif danger.by == "drive":
        assert rig.shown_poll is None or first.polls <= rig.shown_poll
    assert rig.engine.wait(ENDED, 60.0) in ENDED
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is (FinishReason.OPERATOR if state is STOPPING else danger.code)
    assert all(one.rpm == 0.0 for one in rig.told[before:]), "nothing turns it again"
    assert rig.told[-1].what == "off"
    assert rig.is_stationary
    keys = [one.key for one in rig.engine.status().alarms if one.severity is Severity.CRITICAL]
    assert (danger.key or danger.name) in keys or danger.key == "-"


class Hanging:
    """A call to the drive that does not return before it is released."""

    def __init__(self, rig: Watched, name: str) -> None:
        self.begun, self.release = threading.Event(), threading.Event()
        self._call = getattr(rig.spindle, name)
        setattr(rig.spindle, name, self)

    def __call__(self, *arguments: float) -> None:
        """Hang, and only then reach the drive."""
        self.begun.set()
        self.release.wait(PATIENCE_S)
        self._call(*arguments)


def test_a_power_off_waits_for_no_speed_command_and_is_repeated_after_it(rig: Watched) -> None:
    hanging = Hanging(rig, "set_speed")
    starter = threading.Thread(target=lambda: rig.start(a_test(LONG)), daemon=True)
    starter.start()
    try:
        assert hanging.begun.wait(PATIENCE_S)
        rig.engine.drive_off("Ada", "smoke")
        assert [one.what for one in rig.told] == ["off"], "the start still hangs"
    finally:
        hanging.release.set()
        starter.join(PATIENCE_S)
    assert not starter.is_alive()
    eventually(lambda: [one.what for one in rig.told][-2:] == ["speed", "off"])
    rig.engine.wait(ENDED, 60.0)
    assert rig.is_stationary


def test_a_power_off_waits_for_no_reset(rig: Watched) -> None:
    rig.spindle.faults = ("overcurrent",)
    rig.engine.wait((RunState.FAULT,), 60.0)
    eventually(lambda: rig.engine.status().alarms)  # it is listed after the state
    rig.engine.acknowledge()
    hanging = Hanging(rig, "reset_fault")
    resetter = threading.Thread(target=rig.engine.reset, daemon=True)
    resetter.start()
    try:
        assert hanging.begun.wait(PATIENCE_S)
        before = len(rig.told)
        rig.engine.drive_off("Ada", "smoke")
        assert len(rig.told) == before + 1, "the reset still hangs"
    finally:
        hanging.release.set()
        resetter.join(PATIENCE_S)


@pytest.mark.long
def test_a_ramp_down_that_hangs_becomes_a_power_off(rig: Watched) -> None:
    bring_to(rig, RUNNING)
    hanging = Hanging(rig, "set_speed")
    stopper = threading.Thread(target=lambda: rig.engine.stop("Ada"), daemon=True)
    stopper.start()
    try:
        eventually(lambda: rig.told[-1].what == "off")
        assert hanging.begun.is_set()
        assert stopper.is_alive(), "the ramp down still hangs"
    finally:
        hanging.release.set()
        stopper.join(PATIENCE_S)
    assert rig.engine.wait(ENDED, 60.0) in ENDED
    assert rig.is_stationary
    assert rig.told[-1].what == "off"


@pytest.mark.parametrize("name", ["drive fault", "emergency stop", "stale data", "cable pulled"])
def test_a_danger_without_a_test_takes_the_power_off_too(rig: Watched, name: str) -> None:
    danger = next(one for one in DANGERS if one.name == name)
    danger.strike(rig)
    rig.engine.wait((RunState.FAULT,), 60.0)
    eventually(lambda: rig.told)
    assert [one.what for one in rig.told if one.what == "speed"] == []
