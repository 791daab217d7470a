"""A process that did not run says so, wherever in its look the supervisor was put to sleep."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable

import pytest

from rigapp.engine.connection import Connection
from rigapp.process.threads import OVERSLEPT_S
from rigapp.schema.messages import RunState
from rigapp.schema.states import ENDED
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

ASLEEP_S = 1.5 * OVERSLEPT_S

pytestmark = pytest.mark.skipif(not hasattr(ctypes.PyDLL(None), "usleep"), reason="needs usleep")


def stop_every_thread() -> None:
    """Sleep without giving the interpreter away: no thread of this process runs meanwhile."""
    ctypes.PyDLL(None).usleep(round(ASLEEP_S * 1e6))


def once(
    do: Callable[[], object], then: Callable[[], None]
) -> tuple[Callable[[], None], list[float]]:
    """Return a function that does ``do`` at its first call, and when that was over."""
    done: list[float] = []

    def call() -> None:
        if not done:
            do()
            done.append(time.monotonic())
        then()

    return call, done


def told(rig: MemoryRig) -> list[str]:
    return [event.text for event in rig.store.events if event.kind == "suspended"]


def running() -> tuple[MemoryRig, Connection]:
    rig = MemoryRig()
    rig.engine.connect()
    rig.start(a_test(1_000_000))
    eventually(lambda: rig.engine.state is RunState.RUNNING, 60.0)
    connection = rig.engine._connection
    assert connection is not None
    return rig, connection


def ended(rig: MemoryRig) -> None:
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()


def test_a_sleep_in_the_midst_of_a_look_is_told_and_no_thread_is_blamed() -> None:
    rig, connection = running()
    connection.watches.look, _ = once(stop_every_thread, connection.watches.look)  # type: ignore[method-assign]
    eventually(lambda: told(rig), 60.0)
    ended(rig)
    (text,) = told(rig)
    assert "did not run for" in text
    assert not any("sign of life" in event.text for event in rig.store.events)


def test_a_look_that_waits_while_the_others_run_is_no_sleep() -> None:
    rig, connection = running()
    connection.watches.look, done = once(  # type: ignore[method-assign]
        lambda: time.sleep(ASLEEP_S), connection.watches.look
    )
    eventually(lambda: done, 60.0)
    ended(rig)
    assert told(rig) == []
