"""Random commands and faults in any order: the spindle comes to rest, with a reason."""

from __future__ import annotations

import time
from typing import Any

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    rule,
)

from rigapp.config.errors import UnusableInput
from rigapp.engine.drive.timing import Timing
from rigapp.engine.recording.store import Opened
from rigapp.schema.channels import BASE
from rigapp.schema.messages import RunState
from rigapp.schema.states import ACTIVE, ENDED, TURNING, Refused
from rigapp_drivers.api import DeviceError
from tests.engine.engine_doubles import RATE, Crank, FakeStore, MemoryRig, a_test, eventually

LAST = ("revolution", "time")

QUICK = Timing(
    read=0.02,
    poll=0.01,
    commit=0.02,
    supervise=0.005,
    silence=2.0,
    silence_commit=2.0,
    stop_margin=0.3,
    coast=0.5,
    start_margin=2.0,
)

FAULTS = ("cable", "silence", "drive fault", "emergency stop", "drive lost", "disk", "overload")


class Operating(RuleBasedStateMachine):
    """An operator and a rig that fails."""

    def __init__(self) -> None:
        super().__init__()
        self.rig = MemoryRig(timing=QUICK)
        self.broken: set[str] = set()
        self.bad_disks: list[FakeStore] = []
        self.left: FakeStore | None = None
        self.rig.engine.connect()

    @initialize(long=st.booleans())
    def begin(self, long: bool) -> None:
        self.start(1000 if long else 2)

    # --- commands, accepted or refused -----------------------------------------------------------

    def command(self, verb: Any, *arguments: Any, **options: Any) -> None:
        try:
            verb(*arguments, **options)
        except (Refused, DeviceError):
            return

    @rule(revolutions=st.sampled_from([2, 1000]))
    def start(self, revolutions: int) -> None:
        self.command(self.rig.start, a_test(revolutions))

    @rule()
    def pause(self) -> None:
        self.command(self.rig.engine.pause, "Ada")

    @rule()
    def resume(self) -> None:
        self.command(self.rig.engine.resume, "Ada")

    @rule()
    def stop(self) -> None:
        self.command(self.rig.engine.stop, "Ada")

    @rule()
    def drive_off(self) -> None:
        self.command(self.rig.engine.drive_off, "Ada")

    @rule()
    def reset(self) -> None:
        self.command(self.rig.engine.acknowledge, operator="Ada")
        self.command(self.rig.engine.reset, "Ada")

    @rule()
    def disconnect(self) -> None:
        """Let the program end as it should: it stops a test under way, and says so."""
        self.rig.engine.shutdown(10.0)
        assert self.rig.engine.state is RunState.IDLE
        if self.rig.stores:
            assert self.rig.engine.outcome is not None
            assert self.rig.engine.outcome.sentence
            assert self.rig.store.closed

    @rule()
    def kill(self) -> None:
        """Let the program die; the drive's watchdog stops the crank, another program begins."""
        dead = self.rig
        if dead.stores:
            self.left = self.as_committed(dead.store)
        crank = dead.crank
        dead.source.crank = dead.spindle.crank = Crank()  # nothing of it reaches the rig any more
        with crank.lock:
            crank.powered, crank.target, crank.acceleration = False, 0.0, 20.0
        dead.engine.shutdown(10.0)
        crank.turn(round(0.5 * RATE))
        assert abs(crank.speed) < 1e-6
        self.rig = MemoryRig(crank=crank, timing=QUICK)
        self.apply()
        self.command(self.rig.engine.connect)

    def as_committed(self, store: FakeStore) -> FakeStore:
        """Return what is found after a kill: the rows that were safe."""
        safe = list(store.rows[: store.safe])
        return FakeStore(rows=safe, safe=len(safe), ending=store.ending)

    @rule(revolutions=st.sampled_from([4, 1000]))
    def go_on(self, revolutions: int) -> None:
        """Resume the last file, as a kill or an end has left it."""
        left = self.as_committed(self.rig.store) if self.rig.stores else self.left
        if left is None or (left.ending is not None and left.ending[0] == "complete"):
            return
        if self.rig.engine.state in ACTIVE:
            return
        last = (
            [float(left.rows[-1][BASE.place[name]]) for name in LAST] if left.rows else [0.0, 0.0]
        )
        left.ending = None
        self.rig.opened = Opened(left, len(left.rows), int(last[0]), last[1], time.time())
        before = len(left.rows)
        try:
            self.rig.start(a_test(revolutions), resume=True)
        except (Refused, DeviceError, UnusableInput):
            self.rig.opened = None
            return
        assert self.rig.store is left
        eventually(lambda: len(left.rows) > before or self.rig.engine.state not in TURNING, 30.0)
        numbers = left.column("revolution")
        assert list(numbers) == sorted(set(numbers))

    # --- the rig ---------------------------------------------------------------------------------

    @rule(fault=st.sampled_from(FAULTS))
    def breaks(self, fault: str) -> None:
        self.broken.add(fault)
        self.apply()

    @rule()
    def repair(self) -> None:
        self.broken.clear()
        self.apply()

    def apply(self) -> None:
        rig, broken = self.rig, self.broken
        rig.source.lost = "cable" in broken
        rig.source.silent = "silence" in broken
        rig.spindle.faults = ("overcurrent",) if "drive fault" in broken else ()
        rig.spindle.emergency_stop = "emergency stop" in broken
        rig.spindle.lost = "drive lost" in broken
        rig.source.force_N = 390.0 if "overload" in broken else 50.0
        if rig.stores:
            rig.store.broken = OSError("no space left") if "disk" in broken else None
            if "disk" in broken:
                self.bad_disks.append(rig.store)

    # --- time ------------------------------------------------------------------------------------

    @rule(rows=st.integers(1, 3))
    def some_revolutions_pass(self, rows: int) -> None:
        # No precondition: the state is the engine's threads' affair, not Hypothesis'.
        if self.rig.engine.state is not RunState.RUNNING:
            return
        wanted = len(self.rig.store.rows) + rows
        eventually(
            lambda: len(self.rig.store.rows) >= wanted or self.rig.engine.state not in TURNING
        )

    @rule()
    def it_comes_to_rest(self) -> None:
        if self.rig.engine.state not in (RunState.PAUSING, RunState.STOPPING):
            return
        self.rig.engine.wait((*ENDED, RunState.PAUSED), 60.0)

    # --- what always holds -----------------------------------------------------------------------

    @invariant()
    def every_state_but_a_turning_one_means_no_motion(self) -> None:
        engine, rig = self.rig.engine, self.rig
        before = engine.state
        turning = abs(rig.crank.speed) > 1e-6
        if before in ENDED and engine.state is before:
            assert not turning or "drive lost" in self.broken
            assert engine.status().engine.reason

    def teardown(self) -> None:
        rig, engine = self.rig, self.rig.engine
        try:
            if engine.state in ACTIVE:
                self.command(engine.stop, "Ada")
                engine.wait(ENDED, 60.0)
            if rig.stores:
                outcome = engine.outcome
                assert outcome is not None
                assert outcome.sentence
                assert rig.store.closed
                if not any(rig.store is bad for bad in self.bad_disks):
                    # A start that fails before its first whole revolution leaves no file.
                    gone = rig.store.discarded and outcome.revolutions == 0
                    assert gone or rig.store.ending is not None
                    assert len(rig.store.rows) == rig.store.safe
        finally:
            engine.shutdown(10.0)
        assert engine.state is RunState.IDLE
        # With cable and drive lost nobody let the time of the rig in memory go on: do it now.
        rig.crank.turn(round(5 * RATE))
        assert rig.is_stationary


TestOperating = Operating.TestCase
TestOperating.settings = settings(
    max_examples=25,
    stateful_step_count=14,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
