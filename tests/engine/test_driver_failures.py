"""Whatever class of exception a driver raises, wherever the engine calls it, the rig stays safe.

A trap makes one method of a device in memory raise at a call. The walk goes over methods, classes
of exceptions and states: the test ends with power off and a sentence that names device, port and
what was being done, or goes on where the device is not needed, and Ready is reached again.
"""

from __future__ import annotations

import asyncio
import dataclasses
import itertools
import math
import struct
import threading
from collections.abc import Iterator, Sequence
from typing import Any

import pytest
import serial
from test_channels import ChannelRig, heard

from rigapp.config.errors import UnusableInput
from rigapp.engine.samples import slow
from rigapp.schema.messages import DeviceView, FinishReason, RunState
from rigapp.schema.states import ENDED, Refused
from rigapp_drivers.api import DeviceError, DriverInfo, ReplyTimeout
from rigapp_drivers.registry import DriverBroken, DriverNotFound
from tests.engine.engine_doubles import a_test, back_to_work, eventually

LONG = 1_000_000


class LibraryError(Exception):
    """An error of a library's own whose words cannot even be had."""

    def __str__(self) -> str:
        raise RuntimeError("no words")


class BareDeviceError(DeviceError):
    """A DeviceError of a driver that forgot to say whose it is."""

    def __init__(self) -> None:
        Exception.__init__(self, "out of order")


FOREIGN = (
    ValueError("garbled"),
    KeyError("answer"),
    struct.error("unpack requires a buffer of 4 bytes"),
    RuntimeError("out of order"),
    SystemExit(3),
    OSError(5, "Input/output error"),
    serial.SerialException("device reports readiness to read"),
    asyncio.CancelledError(),
    StopIteration(),
    KeyboardInterrupt(),
    LibraryError(),
    BareDeviceError(),
)
"""One of each kind; KeyboardInterrupt is one only in a thread that is not the main one."""

ANYWHERE = tuple(one for one in FOREIGN if not isinstance(one, KeyboardInterrupt))
FEW = (ValueError, SystemExit, BareDeviceError)
"""Kinds that the default suite tries; the others are tried by the long one."""


def tried(errors: Sequence[BaseException]) -> list[Any]:
    """Return errors as cases, those that are not among the few marked as long."""
    marks = [() if type(one) in FEW else (pytest.mark.long,) for one in errors]
    return [pytest.param(one, marks=mark) for one, mark in zip(errors, marks, strict=True)]


@dataclasses.dataclass
class Trap:
    """Let calls of a device's method raise, from the nth on, so many times."""

    device: Any
    method: str
    error: BaseException
    nth: int = 1
    times: float = 1.0

    def __post_init__(self) -> None:
        """Set it."""
        self.sprung = threading.Event()
        self._call = getattr(self.device, self.method)
        self._numbers = itertools.count(1)
        setattr(self.device, self.method, self)

    def __call__(self, *arguments: Any) -> Any:
        """Raise, or do what the device does."""
        if self.nth <= next(self._numbers) < self.nth + self.times:
            self.sprung.set()
            raise self.error
        return self._call(*arguments)

    def take_away(self) -> None:
        """Let the device work again."""
        setattr(self.device, self.method, self._call)


def named(error: BaseException) -> str:
    return type(error).__name__


@pytest.fixture
def rig(monkeypatch: pytest.MonkeyPatch) -> Iterator[ChannelRig]:
    monkeypatch.setattr(slow, "PERIOD_S", 0.01)
    monkeypatch.setattr(slow, "REOPEN_S", 0.02)
    memory = ChannelRig()
    yield memory
    memory.engine.shutdown(20.0)


def words_name(sentence: str, device: str, doing: str) -> None:
    assert f"{device} on memory" in sentence
    assert doing in sentence
    for code in ("Error", "Exit", "Exception", "Traceback"):
        assert code not in sentence, "exceptions belong into the log"


def shown_of(rig: ChannelRig, device: str) -> DeviceView:
    return next(one for one in rig.engine.status().rig.devices if one.name == device)


# --- while connecting ----------------------------------------------------------------------------

CONNECTING = (
    ("source", "open", "daq", "opened"),
    ("source", "configure", "daq", "set up"),
    ("source", "start", "daq", "started"),
    ("spindle", "open", "drive", "opened"),
    ("spindle", "configure", "drive", "set up"),
    ("spindle", "status", "drive", "read"),
)


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize(("thing", "method", "device", "doing"), CONNECTING)
def test_a_driver_that_fails_while_connecting_is_a_fault_that_connecting_again_mends(
    rig: ChannelRig, thing: str, method: str, device: str, doing: str
) -> None:
    for error in ANYWHERE:
        trap = Trap(getattr(rig, thing), method, error)
        with pytest.raises(DeviceError) as caught:
            rig.engine.connect()
        assert caught.value.__cause__ is error
        assert (caught.value.device, caught.value.port) == (device, "memory")
        words_name(str(caught.value), device, doing)
        assert rig.engine.state is RunState.FAULT
        words_name(rig.engine.status().engine.reason, device, doing)
        shown = {one.name: one for one in rig.engine.status().rig.devices}
        assert shown.keys() == {"daq", "drive", "climate"}
        assert [one.connected for one in shown.values()] == [False] * 3
        assert doing in shown[device].last_error
        assert {name: one.help for name, one in shown.items() if one.help} == {
            device: "a-driver-failed"
        }
        assert not rig.source.opened
        assert rig.is_stationary
        trap.take_away()
    back_to_work(rig)
    assert not shown_of(rig, device).help


def test_a_driver_that_cannot_be_made_is_a_fault_that_names_it(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, device in (("memory source", "daq"), ("memory drive", "drive")):
        trap = Trap(MadeBy(rig, name, monkeypatch), "made", struct.error("4 bytes"))
        with pytest.raises(DeviceError) as caught:
            rig.engine.connect()
        words_name(str(caught.value), device, "made")
        trap.take_away()
    back_to_work(rig)


def test_a_slow_source_that_cannot_be_made_costs_its_values_alone(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    trap = Trap(MadeBy(rig, "memory thermometer", monkeypatch), "made", SystemExit("no licence"))
    runs_without_the_thermometer(rig, "failed while it was made")
    trap.take_away()
    rig.engine.connect()
    eventually(heard(rig.engine, "room_temperature"))


@pytest.mark.parametrize("broken", [True, False], ids=["broken", "not installed"])
def test_a_slow_source_whose_package_cannot_be_loaded_costs_its_values_alone(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch, broken: bool
) -> None:
    load = rig.engine._load

    def loaded(name: str) -> DriverInfo:
        if name == "memory thermometer":
            raise (DriverBroken if broken else DriverNotFound)("reinstall the package acme")
        return load(name)

    monkeypatch.setattr(rig.engine, "_load", loaded)
    if broken:
        runs_without_the_thermometer(rig, "reinstall the package acme")
    else:  # a mistake in the rig file
        with pytest.raises(UnusableInput, match=r"devices\.climate\.driver: reinstall"):
            rig.engine.connect()


def runs_without_the_thermometer(rig: ChannelRig, words: str) -> None:
    rig.engine.connect()
    assert words in shown_of(rig, "climate").last_error
    rig.start(a_test(5))
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"


class MadeBy:
    """The factory of a driver in memory."""

    def __init__(self, rig: ChannelRig, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
        load = rig.engine._load

        def loaded(asked: str) -> DriverInfo:
            info = load(asked)
            if asked != name:
                return info
            return dataclasses.replace(info, factory=lambda *made: self.made(info, *made))

        monkeypatch.setattr(rig.engine, "_load", loaded)

    def made(self, info: DriverInfo, *arguments: Any) -> Any:
        return info.factory(*arguments)


@pytest.mark.parametrize("error", [one for one in ANYWHERE if not isinstance(one, ValueError)],
                         ids=named)  # fmt: skip
def test_a_check_that_fails_is_one_sentence_that_names_the_driver(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    def check(request: object) -> None:
        raise error

    load = rig.engine._load
    monkeypatch.setattr(
        rig.engine, "_load", lambda name: dataclasses.replace(load(name), check=check)
    )
    with pytest.raises(UnusableInput, match="memory source") as caught:
        rig.engine.connect()
    assert caught.value.__cause__ is error
    assert "check" in str(caught.value)
    assert rig.engine.state is RunState.FAULT


# --- in every state of a test --------------------------------------------------------------------

STARTING, RUNNING = RunState.STARTING, RunState.RUNNING
PAUSING, PAUSED, STOPPING = RunState.PAUSING, RunState.PAUSED, RunState.STOPPING
OPEN = (STARTING, RUNNING, PAUSING, PAUSED, STOPPING)


def bring_to(rig: ChannelRig, state: RunState) -> None:
    """Bring a test into a state in which it stays for a while."""
    rig.engine.connect()
    rig.crank.jammed = state is STARTING
    rig.start(a_test(LONG, every=1_000_000))
    if state is not STARTING:
        eventually(lambda: rig.store.rows)
        if state in (PAUSING, PAUSED):
            rig.engine.pause("Ada")
        elif state is STOPPING:
            rig.engine.stop("Ada")
    reached = rig.engine.wait((state, *ENDED), 60.0)
    assert reached is state, rig.engine.outcome
    rig.crank.jammed = False


def in_turn(*walk: Any) -> Iterator[Any]:
    """Yield each case with an exception, so that every class comes up in turn."""
    for case, error in zip(walk, itertools.cycle(FOREIGN), strict=False):
        device, method, state = case
        name = f"{device}.{method} while {state}, {named(error)}"
        marks = () if state in (RUNNING, PAUSED) else (pytest.mark.long,)
        yield pytest.param(*case, error, id=name, marks=marks)


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("thing", "method", "state", "error"),
    [
        *in_turn(
            *itertools.product(("source",), ("read",), OPEN),
            *itertools.product(("spindle",), ("status", "drive_off", "set_speed"), OPEN),
        )
    ],
)
def test_a_driver_that_fails_in_a_test_ends_it_safely_and_ready_is_reached_again(
    rig: ChannelRig, thing: str, method: str, state: RunState, error: BaseException
) -> None:
    bring_to(rig, state)
    # Enough calls in a row that no repetition hides it; the power-off fails for good.
    trap = Trap(getattr(rig, thing), method, error, times=math.inf)
    device, doing = {
        "read": ("daq", "read"),
        "status": ("drive", "read"),
        "drive_off": ("drive", "taken off"),
        "set_speed": ("drive", "given a speed"),
    }[method]
    if method == "drive_off":
        rig.spindle.ignores = math.inf  # and each command but those that it refuses: its watchdog
        rig.engine.drive_off("Ada")
    elif method == "set_speed":
        rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    eventually(lambda: rig.is_stationary)
    assert trap.sprung.is_set() or state is STOPPING
    outcome = rig.engine.outcome
    assert outcome is not None
    assert rig.store.closed
    if method in ("read", "status") and state is not STOPPING:
        assert outcome.reason is FinishReason.DEVICE
        words_name(outcome.sentence, device, doing)
    if method in ("drive_off", "set_speed") and trap.sprung.is_set():
        assert doing in shown_of(rig, device).last_error
    connection = rig.engine._connection
    assert connection is not None
    assert not [one.name for one in connection.workers if one.error is not None]
    trap.take_away()
    rig.spindle.ignores = 0.0
    back_to_work(rig)


@pytest.mark.parametrize("error", tried(FOREIGN), ids=named)
def test_one_failed_answer_of_the_drive_ends_nothing(rig: ChannelRig, error: BaseException) -> None:
    bring_to(rig, RUNNING)
    trap = Trap(rig.spindle, "status", error)
    eventually(trap.sprung.is_set)
    rows = len(rig.store.rows)
    eventually(lambda: len(rig.store.rows) > rows + 3)
    assert rig.engine.state is RUNNING


@pytest.mark.sampled
@pytest.mark.parametrize("error", tried(ANYWHERE), ids=named)
def test_a_start_that_the_driver_fails_turns_nothing(rig: ChannelRig, error: BaseException) -> None:
    rig.engine.connect()
    trap = Trap(rig.spindle, "set_speed", error)
    with pytest.raises(DeviceError) as caught:
        rig.start(a_test(LONG))
    words_name(str(caught.value), "drive", "given a speed")
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    assert rig.is_stationary
    trap.take_away()
    back_to_work(rig)


@pytest.mark.sampled
@pytest.mark.parametrize("error", tried(ANYWHERE), ids=named)
def test_a_resume_that_the_driver_fails_ends_the_test(
    rig: ChannelRig, error: BaseException
) -> None:
    bring_to(rig, PAUSED)
    trap = Trap(rig.spindle, "set_speed", error)
    with pytest.raises(DeviceError) as caught:
        rig.engine.resume("Ada")
    words_name(str(caught.value), "drive", "given a speed")
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    assert rig.is_stationary
    trap.take_away()
    back_to_work(rig)


@pytest.mark.parametrize("error", tried(FOREIGN), ids=named)
def test_a_power_off_goes_past_a_command_that_fails_meanwhile(
    rig: ChannelRig, error: BaseException
) -> None:
    bring_to(rig, RUNNING)
    begun, release = threading.Event(), threading.Event()

    def fails(*speed: float) -> None:
        begun.set()
        release.wait(30.0)
        raise error

    rig.spindle.set_speed = fails  # type: ignore[method-assign]
    commander = threading.Thread(target=lambda: rig.engine.stop("Ada"))
    commander.start()
    eventually(begun.is_set)
    rig.engine.drive_off("Ada")
    assert ("off", 0.0) in rig.spindle.commands, "it does not wait for the command under way"
    offs = rig.spindle.commands.count(("off", 0.0))
    release.set()
    commander.join(30.0)
    eventually(lambda: rig.spindle.commands.count(("off", 0.0)) > offs)
    del rig.spindle.set_speed
    rig.engine.wait(ENDED, 60.0)
    assert rig.is_stationary
    back_to_work(rig)


@pytest.mark.parametrize("error", tried(ANYWHERE), ids=named)
def test_a_reset_that_the_driver_fails_is_refused_in_a_sentence(
    rig: ChannelRig, error: BaseException
) -> None:
    bring_to(rig, RUNNING)
    rig.spindle.faults = ("overcurrent",)
    rig.engine.wait(ENDED, 60.0)
    rig.engine.acknowledge(operator="Ada")
    trap = Trap(rig.spindle, "reset_fault", error)
    with pytest.raises(Refused) as caught:
        rig.engine.reset("Ada")
    assert "fault was reset" in str(caught.value)
    assert trap.sprung.is_set()
    rig.engine.reset("Ada")
    assert rig.engine.state is RunState.READY


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("thing", "method"), [("source", "stop"), ("source", "close"), ("spindle", "close")]
)
def test_a_device_that_cannot_be_released_holds_nothing_up(
    rig: ChannelRig, thing: str, method: str
) -> None:
    bring_to(rig, RUNNING)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    for error in ANYWHERE:
        Trap(getattr(rig, thing), method, error)
        rig.engine.connect()
        assert rig.engine.state is RunState.READY
    back_to_work(rig)


@pytest.mark.parametrize("method", ["counters", "input_faults"])
def test_what_a_driver_says_of_itself_may_fail_and_the_status_is_told(
    rig: ChannelRig, method: str
) -> None:
    rig.source.input_faults = tuple  # type: ignore[attr-defined]
    bring_to(rig, RUNNING)
    for error in ANYWHERE:
        trap = Trap(rig.source, method, error)
        shown = shown_of(rig, "daq")
        if method == "counters":
            assert trap.sprung.is_set()
            assert shown.counters == {}
        eventually(trap.sprung.is_set)
        trap.take_away()
    assert rig.engine.state is RUNNING


@pytest.mark.parametrize("thing", ["source", "spindle"])
def test_an_answer_of_another_kind_is_a_failure_of_the_driver(rig: ChannelRig, thing: str) -> None:
    bring_to(rig, RUNNING)
    method, device = {"source": ("read", "daq"), "spindle": ("status", "drive")}[thing]
    setattr(getattr(rig, thing), method, lambda *_: "nonsense")
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    words_name(rig.engine.outcome.sentence, device, "read")
    assert rig.is_stationary
    delattr(getattr(rig, thing), method)
    back_to_work(rig)


# --- devices that a test does not need -----------------------------------------------------------


@pytest.mark.sampled
@pytest.mark.parametrize("method", ["open", "configure", "read", "close"])
def test_a_slow_source_that_fails_costs_its_values_and_comes_back(
    rig: ChannelRig, method: str
) -> None:
    rig.engine.connect()
    for error in (*FOREIGN, ReplyTimeout("climate", "memory", "no answer"), TypeError("None")):
        eventually(lambda: not shown_of(rig, "climate").last_error)  # answered since
        opened = rig.thermometer.opened
        trap = Trap(rig.thermometer, method, error)  # before what makes it be called
        first = Trap(rig.thermometer, "read", error) if method != "read" else None
        eventually(trap.sprung.is_set)
        eventually(lambda before=opened: rig.thermometer.opened > before)  # type: ignore[misc]
        trap.take_away()
        if first is not None:
            first.take_away()
    rig.start(a_test(5))
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    eventually(heard(rig.engine, "room_temperature"))
    assert not [one for one in rig.engine.status().alarms if one.active]
