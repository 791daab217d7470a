"""Threads with a name, a heartbeat and a reported failure; commands one after the other."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from rigapp.schema.states import Refused

OVERSLEPT_S = 1.0
"""Excess duration of a pause which shows that the whole process did not run."""


class Worker:
    """Run a step repeatedly in a separate thread.

    step: does a piece of work and returns within a fraction of a second; returning False ends the
    thread normally. on_death: called once, in the failing thread, if step raised. age_s: returns
    the age of a host time, to measure the duration of a silence.
    """

    def __init__(
        self,
        name: str,
        step: Callable[[], bool | None],
        on_death: Callable[[Worker, BaseException], None],
        silence_s: float,
        age_s: Callable[[float], float] = lambda since_s: time.monotonic() - since_s,
    ) -> None:
        self.name = name
        self._age_s = age_s
        self.silence_s = silence_s
        self.error: BaseException | None = None
        self.ended = False
        self._step = step
        self._on_death = on_death
        self._halt = threading.Event()
        self._beat = time.monotonic()
        self._overslept = (float("-inf"), 0.0)
        self._thread = threading.Thread(target=self._run, name=f"rigapp {name}", daemon=True)

    def start(self) -> None:
        """Start the thread."""
        self._beat = time.monotonic()
        self._thread.start()

    def halt(self) -> None:
        """Request the thread to end after its present step."""
        self._halt.set()

    @property
    def halting(self) -> bool:
        """Return whether the end was requested."""
        return self._halt.is_set()

    def pause(self, seconds: float) -> None:
        """Wait inside a step, but no longer than until the end is requested."""
        before_s = time.monotonic()
        self._halt.wait(seconds)
        woken_s = time.monotonic()
        over_s = woken_s - before_s - seconds
        if over_s > OVERSLEPT_S:
            self._overslept = (woken_s, over_s)

    def overslept(self, since_s: float) -> float:
        """Return the excess duration in s of a pause that ended since then, 0 for none."""
        woken_s, over_s = self._overslept
        return over_s if woken_s >= since_s else 0.0

    def join(self, timeout_s: float) -> bool:
        """Wait for the end of the thread; return False on time-out."""
        if self._thread.ident is None or self._thread is threading.current_thread():
            return True
        self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def beat(self) -> None:
        """Send a heartbeat during a long step."""
        self._beat = time.monotonic()

    def silent_for(self) -> float:
        """Return the seconds since the last heartbeat."""
        return self._age_s(self._beat)

    @property
    def well(self) -> bool:
        """Return whether the thread is running with a heartbeat, or ended normally."""
        if self.ended and self.error is None:
            return True
        return self._thread.is_alive() and self.silent_for() < self.silence_s

    def _run(self) -> None:
        try:
            while not self._halt.is_set():
                self._beat = time.monotonic()
                if self._step() is False:
                    break
        except BaseException as error:
            self.error = error
            self._on_death(self, error)
        finally:
            self.ended = True


class CommandLock:
    """A lock for one command at a time, with a time-out."""

    def __init__(self, wait_s: float) -> None:
        self._wait_s = wait_s
        self._lock = threading.Lock()
        self._since = 0.0

    def __enter__(self) -> None:
        """Wait for the previous command; raise Refused on time-out."""
        if not self._lock.acquire(timeout=self._wait_s):
            since = time.monotonic() - self._since
            raise Refused(
                "the engine has been busy with another command for {:.0f} s (connecting"
                " or starting, perhaps); wait for it, or stop",
                since,
            )
        self._since = time.monotonic()

    def __exit__(self, *_: object) -> None:
        self._lock.release()
