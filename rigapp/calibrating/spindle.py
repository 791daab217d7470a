"""Runs of the spindle for a calibration: one short test at each speed, resumed after a break.

Each is a test with a file of its own, beside the record; both stay there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

from rigapp.calibrating.training import Action
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.recipe import TestFile
from rigapp.config.toml import toml_text
from rigapp.schema.messages import AT_REST, RunState
from rigapp.schema.states import ENDED
from rigapp.texts import say

IDLE = frozenset(state.value for state in (*ENDED, *AT_REST, RunState.CALIBRATING))
SLOWEST_RPM = 0.5
"""No spindle turns evenly below this speed."""


@dataclass(frozen=True, slots=True)
class SpindleRun:
    """One run of the spindle: speed (rpm), its test, the name of its files without ending."""

    rpm: float
    test: TestFile
    stem: Path

    @property
    def recipe(self) -> Path:
        """Return the path of the test file."""
        return self.stem.with_name(f"{self.stem.name}.toml")

    @property
    def out(self) -> Path:
        """Return the path of the recorded file."""
        return self.stem.with_name(f"{self.stem.name}.h5")


class SpindleRuns:
    """Carry out one run after the other, with any engine and any way of waiting.

    A complete run is not repeated. The file of an interrupted one is set aside, and the run is
    repeated; one that an engine still records is waited for.
    """

    def __init__(self, runs: Sequence[SpindleRun], what: str) -> None:
        """Take the runs; what: their name in words.

        Raises UnusableInput for an impossible test, or a file of other origin.
        """
        self.runs, self.what = tuple(runs), what
        self.position = 0
        self.words = ""
        self._begun, self._now = False, 0
        for run in self.runs:
            text = toml_text(run.test)
            parse_test(text, what)
            known = run.recipe.exists() and run.recipe.read_text("utf-8") == text
            for path in (run.recipe, run.out):
                if path.exists() and not known:
                    raise UnusableInput(
                        "{}: exists and is not overwritten; name another record.", path
                    )

    @property
    def done(self) -> bool:
        """Return whether every run is recorded."""
        return self.position >= len(self.runs)

    @property
    def planned(self) -> int:
        """Return the revolutions of all runs."""
        return sum(run.test.run.revolutions for run in self.runs)

    @property
    def turned(self) -> int:
        """Return the recorded revolutions, those of the present run included."""
        return sum(run.test.run.revolutions for run in self.runs[: self.position]) + self._now

    def forget(self) -> None:
        """Forget the last request of ``go_on``, which the engine refused."""
        self._begun, self._now = False, 0

    @property
    def turning(self) -> bool:
        """Return whether a run was begun and is not known to have ended."""
        return self._begun

    @property
    def files(self) -> list[Path]:
        """Return the test files, in the order of the runs."""
        return [run.out for run in self.runs]

    def go_on(self, status: Mapping[str, Any]) -> Action | None:
        """Return the next request to the engine with this status; None to wait.

        ``words`` then hold the progress. Raises UnusableInput when a run has failed.
        """
        run = self.runs[self.position]
        planned, done = run.test.run.revolutions, int(status["revolution"])
        idle = status["state"] in IDLE
        if not idle and str(status["file"]) == str(run.out.resolve()):
            self._begun, self._now = True, done
            self.words = say("{:g} rpm: revolution {} of {}", run.rpm, done, planned)
            return None
        if self._begun:
            self.forget()
            if done < planned or status["state"] == RunState.FAULT.value:
                raise UnusableInput(
                    "the {} ended after {} of {} revolutions: {}; {} holds what was recorded.",
                    self.what,
                    done,
                    planned,
                    status["reason"],
                    run.out,
                )
            self.position += 1
            return None
        if _is_whole(run.out):
            self.words = say(
                "{} holds the {} at {:g} rpm already; for a new one name another record.",
                run.out,
                self.what,
                run.rpm,
            )
            self.position += 1
            return None
        for later in self.runs[self.position :]:
            later.recipe.write_text(toml_text(later.test), encoding="utf-8")
        self._begun = True
        self.words = say("{:g} rpm for {} revolutions; {} records it.", run.rpm, planned, run.out)
        return Action("start", {"test": str(run.recipe.resolve()), "out": str(run.out.resolve())})

    def compress(self) -> None:
        """Compress the files, unless the engine is running on and compresses them itself."""
        from rigapp.storage import StorageFailed, compact_test

        for path in self.files:
            with suppress(UnusableInput, StorageFailed):
                compact_test(path)


def _is_whole(out: Path) -> bool:
    """Return whether a run is complete; set the file of an interrupted one aside."""
    from rigapp.storage import open_test

    if not out.exists():
        return False
    status = "damaged"
    with suppress(UnusableInput), open_test(out) as reader:
        status = reader.summary()["status"]
    if status == "complete":
        return True
    if status == "running":
        raise UnusableInput("{}: another program records this run; let it end first.", out)
    names = (out.with_name(f"{out.stem}.cut-off-{number}{out.suffix}") for number in count(1))
    out.rename(next(name for name in names if not name.exists()))
    return False


def speeds_of(option: str, text: str, least: float, most: float, fewest: int) -> list[float]:
    """Return different speeds (rpm) of a text such as ``3,6``; raise UnusableInput."""
    try:
        speeds = [float(word) for word in text.replace(";", ",").split(",") if word.strip()]
    except ValueError as error:
        raise UnusableInput("{} {}: write speeds in rpm, such as 3,6.", option, text) from error
    different = len(set(speeds)) == len(speeds) >= fewest
    if not different or not all(least <= speed <= most for speed in speeds):
        raise UnusableInput(
            "{} {}: give {} or more different speeds from {:g} to {:g} rpm.",
            option,
            text,
            fewest,
            least,
            most,
        )
    return speeds
