"""The end of a program: termination signals, and last work that may hang."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Generic, NoReturn, TypeVar

from rigapp.texts import say

Result = TypeVar("Result")


@contextmanager
def termination_signals() -> Iterator[list[str]]:
    """Collect the names of the termination signals: Ctrl-C, kill, a closed terminal.

    Must be entered in the main thread. A hang-up that is ignored (nohup) remains ignored. Raises
    KeyboardInterrupt if a signal was received before (``ending_as_interrupt``) and lost.
    """
    _raise_if_signalled(signal.getsignal(signal.SIGINT))
    names: list[str] = []

    def note(number: int, frame: FrameType | None) -> None:
        names.append(signal.Signals(number).name)

    before = {number: signal.signal(number, note) for number in _signals()}
    try:
        yield names
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class Interrupting:
    """Raise KeyboardInterrupt at a signal, and store it, as an import may suppress it.

    An extension module that tries an optional import clears any pending exception.
    """

    def __init__(self) -> None:
        self.signalled = False

    def __call__(self, number: int, frame: FrameType | None) -> NoReturn:
        """Handle a signal."""
        self.signalled = True
        raise KeyboardInterrupt


@contextmanager
def ending_as_interrupt() -> Iterator[None]:
    """Make Ctrl-C, kill and a closed terminal raise KeyboardInterrupt, for an orderly end.

    A lost one is raised at the end. Outside the main thread this has no effect.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    interrupting = Interrupting()
    before = {number: signal.signal(number, interrupting) for number in _signals()}
    try:
        yield
        _raise_if_signalled(interrupting)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _raise_if_signalled(handler: object) -> None:
    if isinstance(handler, Interrupting) and handler.signalled:
        raise KeyboardInterrupt


class Background(Generic[Result]):
    """Run work that may hang in a daemon thread."""

    def __init__(self, work: Callable[[], Result], name: str) -> None:
        """Start at once."""
        self._work = work
        self._results: list[Result] = []
        self._ended = threading.Event()
        self.error: BaseException | None = None
        threading.Thread(target=self._run, name=name, daemon=True).start()

    @property
    def done(self) -> bool:
        """Return whether the work has ended, with or without an error."""
        return self._ended.is_set()

    def wait(self, timeout_s: float) -> bool:
        """Wait for the end; return False on time-out."""
        return self._ended.wait(timeout_s)

    def result(self) -> Result:
        """Return the result of ended work, or raise its error."""
        if self.error is not None:
            raise self.error
        return self._results[0]

    def _run(self) -> None:
        try:
            self._results.append(self._work())
        except BaseException as error:
            self.error = error
        finally:
            self._ended.set()


def shutdown_with_timeout(
    work: Callable[[], None],
    signals: list[str],
    turning: Callable[[], bool],
    give_up: Callable[[], None],
    limit_s: float,
) -> None:
    """Do the final work of a program; if it hangs, or on a further signal, end the process.

    signals: from ``termination_signals``. While ``turning`` two more are required, so that an
    impatient user does not abandon a turning spindle. give_up: called before the process is ended.
    """
    received, deadline = len(signals), time.monotonic() + limit_s
    closing = Background(work, "closing")
    while not closing.wait(0.05):
        more = len(signals) - received
        if time.monotonic() > deadline or more > (2 if turning() else 0):
            give_up()
            end_at_once(say("what was still open was not closed in time."))
    closing.result()


def end_at_once(sentence: str) -> NoReturn:
    """End this process without waiting for anything; exit status 1."""
    with suppress(OSError, ValueError):
        sys.stderr.write(f"rigapp: {sentence}\n")
        sys.stderr.flush()
    os._exit(1)


def _signals() -> list[signal.Signals]:
    numbers = [signal.SIGINT, signal.SIGTERM]
    hang_up = getattr(signal, "SIGHUP", None)
    if hang_up is not None and signal.getsignal(hang_up) is not signal.SIG_IGN:
        numbers.append(hang_up)
    return numbers
