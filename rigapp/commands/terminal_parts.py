"""What live calibrations on the terminal share: take all steps, wait until steady, reject."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from typing import Protocol, TypeVar

from calibration.load_cell.live import WINDOW_S, Readiness
from calibration.load_cell.procedure import ProcedureError
from rigapp.calibrating.practice import Action
from rigapp.commands.engine_line import Ask

LISTEN_S = WINDOW_S + 1.0
PATIENCE_S = 60.0
LOOK_EVERY_S = 0.03

W = TypeVar("W")
Say = Callable[[str], None]
Read = Callable[[str], str]


class Stepwise(Protocol):
    """What is asked of a calibration in progress."""

    @property
    def done(self) -> bool:
        """Tell whether every step has been taken."""
        ...

    @property
    def progress(self) -> str:
        """Return where the calibration stands."""
        ...

    @property
    def instruction(self) -> str:
        """Return what the operator does now."""
        ...


def take_all(procedure: Callable[[], Stepwise], step: Callable[[], bool], say: Say) -> bool:
    """Take every step; return False when the operator closes it to take it up again."""
    while not (now := procedure()).done:
        say(f"\n[{now.progress}] {now.instruction}")
        try:
            if not step():
                return False
        except ProcedureError as error:
            say(f"  {error}")
    return True


def wait_ready(listen: Callable[[], tuple[W, Readiness]], say: Say) -> W:
    """Return a window that is ready; raise ProcedureError when none comes in time."""
    deadline = time.monotonic() + PATIENCE_S
    said = ""
    while True:
        window, found = listen()
        if found.ready:
            return window
        words = found.words.partition(";")[0]
        if words != said:
            say(f"  {found.words} …")
            said = words
        if time.monotonic() > deadline + found.left:
            raise ProcedureError(f"it did not become steady in {PATIENCE_S:g} s: {found.words}")
        time.sleep(LOOK_EVERY_S)


def ask_rejection(
    standing: Iterable[str], reject: Callable[[int, str], object], read: Read, say: Say
) -> None:
    """List the readings that stand, ask which does not count and why, reject it."""
    for line in standing:
        say(f"  {line}")
    word = read("  number of the reading: ").strip()
    if not word.isdigit():
        say("  That is not a number; nothing was rejected.")
        return
    reject(int(word) - 1, read("  reason: "))


def act(ask: Ask, action: Action) -> float:
    """Let the simulated hands do something; return the first device sample after it."""
    result = ask(action.verb, dict(action.arguments))
    return float(result["after_sample"]) if isinstance(result, dict) else 0.0
