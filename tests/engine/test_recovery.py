"""From whatever happened, the steps that the engine names lead back to a test that runs."""

from __future__ import annotations

import contextlib
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import LimitRule
from rigapp.engine.recording.store import Opened, OpenRequest
from rigapp.engine.views import AT_REST, WAITING, Situation, recovery
from rigapp.schema.messages import Alarm, Ends, FinishReason, Remedy, RunState, Severity
from rigapp.schema.states import ACTIVE, ENDED, InFault, Refused
from rigapp_drivers.api import DeviceError, DeviceFault, ProtocolError
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

LONG = 1_000_000
QUIET = (Refused, UnusableInput, DeviceError, TimeoutError)
STEPS_AT_MOST = 12
NO_SHRINKING = (Phase.explicit, Phase.reuse, Phase.generate)
"""A way is walked in real time by real threads: there is no time to make it shorter."""


@dataclass(eq=False)
class Bench:
    """A rig in memory with an operator before it: faults, mending, and the buttons."""

    rig: MemoryRig

    def start(self, revolutions: int = LONG) -> None:
        rules = (LimitRule("force_max", critical_above=300.0, action_critical="pause"),)
        self.rig.start(a_test(revolutions, rules=rules))
        with contextlib.suppress(TimeoutError):
            self.rig.engine.wait({*ENDED, RunState.RUNNING}, 0.2)

    def mend(self) -> None:
        """Plug every cable back, release every button."""
        source, spindle, crank = self.rig.source, self.rig.spindle, self.rig.crank
        source.lost = source.silent = source.encoder_dead = source.index_dead = False
        source.open_fails = False
        source.broken = source.saturated = None
        source.force_N = 50.0
        spindle.lost = spindle.emergency_stop = spindle.latches_stop = False
        spindle.cause_remains = False
        crank.deaf = crank.jammed = False
        spindle.ignores = 0.0
        for store in self.rig.stores:
            store.broken = None

    def shelve(self) -> None:
        """Hide every alarm."""
        for alarm in self.rig.engine.status().alarms:
            self.rig.engine.shelve(alarm.key, "known", 10.0, "Ada")

    def let_it_look(self) -> None:
        """Wait until the engine has seen the rig as it is now, where it sees it at all."""
        engine, source, spindle = self.rig.engine, self.rig.source, self.rig.spindle
        reads, polls = source.reads, spindle.polls

        def looked() -> bool:
            connection = engine._connection
            if connection is None or not connection.sound:
                return True
            return source.reads > reads + 3 and spindle.polls > polls + 2

        eventually(looked, 20.0)

    def do(self, name: str) -> None:
        """Let something happen; what the engine refuses is refused."""
        with contextlib.suppress(*QUIET):
            DEEDS[name](self)


def _fault(what: Callable[[MemoryRig], object]) -> Callable[[Bench], None]:
    def cause(bench: Bench) -> None:
        what(bench.rig)
        with contextlib.suppress(TimeoutError):  # time for the engine to see it
            bench.rig.engine.wait(ENDED, 0.15)

    return cause


def _break_file(rig: MemoryRig) -> None:
    for store in rig.stores:
        store.broken = OSError("no space left on device")


DEEDS: dict[str, Callable[[Bench], None]] = {
    "cable pulled": _fault(lambda rig: setattr(rig.source, "lost", True)),
    "stream stops": _fault(lambda rig: setattr(rig.source, "silent", True)),
    "nonsense": _fault(
        lambda rig: setattr(rig.source, "broken", ProtocolError("daq", "memory", "nonsense"))
    ),
    "driver fails": _fault(lambda rig: setattr(rig.source, "broken", ValueError("a defect"))),
    "device gone": _fault(lambda rig: setattr(rig.source, "open_fails", True)),
    "encoder dead": _fault(lambda rig: setattr(rig.source, "encoder_dead", True)),
    "index missing": _fault(lambda rig: setattr(rig.source, "index_dead", True)),
    "overload": _fault(lambda rig: setattr(rig.source, "force_N", 390.0)),
    "critical rule": _fault(lambda rig: setattr(rig.source, "force_N", 320.0)),
    "no number": _fault(lambda rig: setattr(rig.source, "force_N", float("nan"))),
    "force saturated": _fault(lambda rig: setattr(rig.source, "saturated", 0)),
    "probe saturated": _fault(lambda rig: setattr(rig.source, "saturated", 3)),
    "samples lost": _fault(lambda rig: setattr(rig.source, "lose_samples", 2000)),
    "drive silent": _fault(lambda rig: setattr(rig.spindle, "lost", True)),
    "drive fault": _fault(lambda rig: setattr(rig.spindle, "faults", ("overcurrent",))),
    "drive fault stays": _fault(lambda rig: setattr(rig.spindle, "cause_remains", True)),
    "emergency stop": _fault(lambda rig: setattr(rig.spindle, "emergency_stop", True)),
    "drive latches stops": _fault(lambda rig: setattr(rig.spindle, "latches_stop", True)),
    "drive deaf": _fault(lambda rig: setattr(rig.crank, "deaf", True)),
    "one command ignored": _fault(lambda rig: setattr(rig.spindle, "ignores", 1.0)),
    "commands ignored": _fault(lambda rig: setattr(rig.spindle, "ignores", math.inf)),
    "turns by itself": _fault(lambda rig: rig.spindle.turn_by_itself()),
    "crank jammed": _fault(lambda rig: setattr(rig.crank, "jammed", True)),
    "file fails": _fault(_break_file),
    "mend": Bench.mend,
    "connect": lambda bench: bench.rig.engine.connect(),
    "disconnect": lambda bench: bench.rig.engine.shutdown(20.0),
    "start": Bench.start,
    "short test": lambda bench: bench.start(2),
    "pause": lambda bench: bench.rig.engine.pause("Ada"),
    "resume": lambda bench: bench.rig.engine.resume("Ada"),
    "stop": lambda bench: bench.rig.engine.stop("Ada"),
    "drive off": lambda bench: bench.rig.engine.drive_off("Ada"),
    "acknowledge": lambda bench: bench.rig.engine.acknowledge(operator="Ada"),
    "shelve": lambda bench: bench.shelve(),
    "reset": lambda bench: bench.rig.engine.reset("Ada"),
    "wait for the end": lambda bench: bench.rig.engine.wait(ENDED, 0.5) and None,
}


def test_a_step_is_named_in_every_situation() -> None:
    causes = [
        Alarm("a", Severity.CRITICAL, "A", "c", "q", f"end it by {ends}", 1.0, 1,
              active=active, acknowledged=acknowledged, ends=ends)
        for ends, active, acknowledged in itertools.product(Ends, (True, False), (True, False))
    ]  # fmt: skip
    lists = [(), *((one,) for one in causes), *itertools.product(causes, causes)]
    for state, connected, alarms in itertools.product(RunState, (True, False), lists):
        told = recovery(Situation(state, "why", connected, alarms, "a.h5"))
        if state in WAITING:
            assert told.sentence.startswith("Wait")
        elif state in AT_REST:
            assert told.step in told.left
            assert told.sentence
            assert told.left[-1] is Remedy.RESUME
            assert (told.verb == "") == (told.step is Remedy.CAUSE)
            if not alarms and connected:
                assert told.step is (Remedy.RESET if state is RunState.FAULT else Remedy.RESUME)
            if alarms and connected:
                assert told.step is not Remedy.RESUME
        else:
            assert told.verb == ("resume" if state is RunState.PAUSED else "")


def follow(bench: Bench) -> list[str]:
    """Do what the engine names as next until it names going on; return the steps."""
    engine = bench.rig.engine
    verbs: dict[str, Callable[[], object]] = {
        "connect": engine.connect,
        "acknowledge": lambda: engine.acknowledge(operator="Ada"),
        "reset": lambda: engine.reset("Ada"),
    }
    made: list[str] = []
    while True:
        eventually(lambda: engine.status().recovery.step is not Remedy.NONE, 20.0)
        told = engine.status().recovery
        if told.step is Remedy.RESUME:
            return made
        made.append(told.step.value)
        assert len(made) <= STEPS_AT_MOST, f"no way out: {made}, {engine.status()}"
        if told.step is Remedy.CAUSE:
            eventually(lambda: engine.status().recovery.step is not Remedy.CAUSE, 20.0)
        else:
            with contextlib.suppress(Refused, DeviceFault):  # the drive waits for its reset
                verbs[told.verb]()


def leads_out(deeds: list[str]) -> list[str]:
    """Let all that happen, mend it, follow the steps, and run a test to its end."""
    bench = Bench(MemoryRig())
    engine = bench.rig.engine
    try:
        for name in deeds:
            bench.do(name)
        bench.mend()
        if engine.state in ACTIVE:
            engine.stop("Ada")
            engine.wait(ENDED, 60.0)
        bench.let_it_look()
        steps = follow(bench)
        if engine.state is RunState.STOPPED:
            engine.reset("Ada")
        assert engine.state is RunState.READY
        assert engine.status().recovery.step is Remedy.RESUME
        bench.rig.start(a_test(2))
        engine.wait(ENDED, 60.0)
        assert engine.outcome is not None
        assert engine.outcome.reason is FinishReason.COMPLETE, engine.outcome
        return steps
    finally:
        engine.shutdown(20.0)


@given(st.lists(st.sampled_from(sorted(DEEDS)), max_size=12))
@example(["connect", "start", "cable pulled", "mend", "connect"])
@example(["connect", "start", "index missing", "wait for the end", "mend", "connect"])
@example(["connect", "start", "index missing", "wait for the end", "mend"])
@example(["connect", "start", "emergency stop", "wait for the end", "mend", "connect"])
@example(["connect", "start", "overload", "wait for the end", "connect", "mend"])
@example(["connect", "start", "force saturated", "wait for the end", "connect"])
@example(["connect", "start", "cable pulled", "wait for the end", "shelve"])
@example(["connect", "drive latches stops", "emergency stop", "connect"])
@example(["connect", "drive fault", "drive fault stays", "acknowledge", "reset"])
@example(["connect", "start", "drive deaf", "stop", "cable pulled", "wait for the end"])
@example(["connect", "start", "file fails", "wait for the end"])
@example(["connect", "start", "commands ignored", "drive off", "wait for the end"])
@example(["connect", "turns by itself", "wait for the end"])
@settings(max_examples=2, phases=NO_SHRINKING)
def test_ready_is_reached_from_every_state_by_the_steps_that_are_named(deeds: list[str]) -> None:
    leads_out(deeds)


@pytest.mark.parametrize(
    ("attribute", "value", "words"),
    [
        ("emergency_stop", True, "the emergency stop is pressed.*release the button"),
        ("faults", ("overcurrent",), "overcurrent.*then reset"),
    ],
)
def test_what_forbids_to_turn_is_said_by_connect_and_start(
    attribute: str, value: object, words: str
) -> None:
    rig = MemoryRig()
    setattr(rig.spindle, attribute, value)
    try:
        with pytest.raises(DeviceFault, match=words):
            rig.engine.connect()
        assert rig.engine.state is RunState.FAULT
        with pytest.raises(DeviceFault, match=words):
            rig.start(a_test(2))
        assert not rig.stores
    finally:
        rig.engine.shutdown(20.0)


@pytest.mark.parametrize(
    ("happens", "words", "code"),
    [
        ("lost", "daq on memory: .*reconnect", FinishReason.DEVICE),
        ("silent", "daq on memory has sent no samples.*reconnect", FinishReason.DEVICE),
        ("broken", "daq on memory: its driver .* failed.*reconnect", FinishReason.DEVICE),
    ],
)
def test_a_fault_that_comes_during_the_start_is_its_refusal(
    happens: str, words: str, code: FinishReason
) -> None:
    def fault_meanwhile(request: OpenRequest) -> Opened:
        setattr(rig.source, happens, ValueError("a defect") if happens == "broken" else True)
        rig.engine.wait([RunState.FAULT], 30.0)
        return rig._open(request)

    rig = MemoryRig(open_store=fault_meanwhile)
    try:
        rig.engine.connect()
        eventually(lambda: rig.source.reads > 3)
        with pytest.raises(InFault, match=words) as refused:
            rig.start(a_test(2))
        assert refused.value.code is code
        assert rig.store.discarded, "nothing was measured: the same command can be given again"
        assert rig.is_stationary
        with pytest.raises(InFault, match=words):
            rig.start(a_test(2))
    finally:
        rig.engine.shutdown(20.0)


@pytest.mark.soak
@pytest.mark.timeout(3600)
@given(st.lists(st.sampled_from(sorted(DEEDS)), max_size=25))
@settings(max_examples=1500, phases=NO_SHRINKING)
def test_ready_is_reached_from_every_state_however_long_the_way(deeds: list[str]) -> None:
    leads_out(deeds)
