"""Random commands and faults in any order: in the end the spindle stands and a reason is given."""

from __future__ import annotations

from typing import Any

from engine_doubles import RATE, FakeStore, MemoryRig, a_test, eventually
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    rule,
)

from drivers.api import DeviceError
from rigapp.engine.messages import RunState
from rigapp.engine.run import ACTIVE, ENDED, TURNING, Refused
from rigapp.engine.timing import Timing

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
    def reconnect(self) -> None:
        self.command(self.rig.engine.reconnect)

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
        self.rig.engine.wait((*ENDED, RunState.PAUSED), 10.0)

    # --- what always holds -----------------------------------------------------------------------

    @invariant()
    def every_state_but_a_turning_one_means_no_motion(self) -> None:
        engine, rig = self.rig.engine, self.rig
        before = engine.state
        turning = abs(rig.crank.speed) > 1e-6
        if before in ENDED and engine.state is before:
            assert not turning or "drive lost" in self.broken
            assert engine.status().reason

    def teardown(self) -> None:
        rig, engine = self.rig, self.rig.engine
        try:
            if engine.state in ACTIVE:
                self.command(engine.stop, "Ada")
                engine.wait(ENDED, 10.0)
            if rig.stores:
                outcome = engine.outcome
                assert outcome is not None
                assert outcome.sentence
                assert rig.store.closed
                if not any(rig.store is bad for bad in self.bad_disks):
                    assert rig.store.ending is not None
                    assert len(rig.store.rows) == rig.store.safe
        finally:
            engine.shutdown(10.0)
        assert engine.state is RunState.IDLE
        # With cable and drive lost nobody let the time of the rig in memory go on: do it now.
        rig.crank.turn(round(5 * RATE))
        assert rig.stands


TestOperating = Operating.TestCase
TestOperating.settings = settings(
    max_examples=25,
    stateful_step_count=14,
    deadline=None,
    suppress_health_check=list(HealthCheck),
    derandomize=True,
    print_blob=False,
)
