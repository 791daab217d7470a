"""How a program comes to its end: signals that ask for it, work that may hang on the way."""

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
    """Collect the names of the signals that ask for an end: Ctrl-C, kill, a closed terminal.

    Must be entered in the main thread. A hang-up that is ignored (nohup) stays so. Raises
    KeyboardInterrupt when one came before (``ending_as_interrupt``) and got lost on its way.
    """
    _end_if_heard(signal.getsignal(signal.SIGINT))
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
    """Raise KeyboardInterrupt at a signal, and remember it: what is being loaded may swallow it.

    An extension module that looks for an optional part clears whatever came up meanwhile.
    """

    def __init__(self) -> None:
        self.heard = False

    def __call__(self, number: int, frame: FrameType | None) -> NoReturn:
        """Handle a signal."""
        self.heard = True
        raise KeyboardInterrupt


@contextmanager
def ending_as_interrupt() -> Iterator[None]:
    """Let Ctrl-C, kill and a closed terminal raise KeyboardInterrupt, so that all is closed.

    Where it is lost on its way it is raised at the end. Elsewhere than in the main thread it does
    nothing.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    interrupting = Interrupting()
    before = {number: signal.signal(number, interrupting) for number in _signals()}
    try:
        yield
        _end_if_heard(interrupting)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _end_if_heard(handler: object) -> None:
    if isinstance(handler, Interrupting) and handler.heard:
        raise KeyboardInterrupt


class Background(Generic[Result]):
    """Do something that may hang in a thread that keeps no process from ending."""

    def __init__(self, work: Callable[[], Result], name: str) -> None:
        """Begin at once."""
        self._work = work
        self._results: list[Result] = []
        self._ended = threading.Event()
        self.error: BaseException | None = None
        threading.Thread(target=self._run, name=name, daemon=True).start()

    @property
    def done(self) -> bool:
        """Tell whether it has ended, in whatever way."""
        return self._ended.is_set()

    def wait(self, timeout_s: float) -> bool:
        """Wait for the end; False when it did not come in time."""
        return self._ended.wait(timeout_s)

    def result(self) -> Result:
        """Return what came out of work that is done, or raise what it raised."""
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
    """Do the last work of a program; when it hangs, or is asked again, end the process.

    signals: as ``termination_signals`` collects them. While ``turning`` it takes two more, so that
    nobody leaves a spindle alone by impatience. give_up: done before the process is ended.
    """
    heard, deadline = len(signals), time.monotonic() + limit_s
    closing = Background(work, "closing")
    while not closing.wait(0.05):
        more = len(signals) - heard
        if time.monotonic() > deadline or more > (2 if turning() else 0):
            give_up()
            end_at_once(say("what was still open could not be closed in time and was left."))
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
