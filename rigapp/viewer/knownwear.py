"""The wear shown in the window: the tiles from the newest columns, the bands from the file.

Bands and posteriors are computed by ``rigapp identify`` in a process of its own, so that the
window does not freeze and shows the numbers of the command and the report.
"""

from __future__ import annotations

import json
import math
import subprocess
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.presentation.numbers import coefficient_text, grouped
from rigapp.presentation.times import MOMENT, dated, duration
from rigapp.presentation.translation import tr, translate
from rigapp.process.children import module_command
from rigapp.schema.columns import WEAR_MODELS
from rigapp.schema.messages import RunState, last_set_speed
from rigapp.schema.wire import sentence_of_parts
from rigapp.viewer.channels import FreeValue
from rigapp.viewer.lines import QUALITY
from rigapp.viewer.news import News
from rigapp.viewer.series import SeriesTable
from rigapp.viewer.tasks import TaskWorker

Floats = NDArray[np.float64]

ODDS = 20.0
"""Odds from which a statement is made, as in the sentences of ``rigapp_model.identification``."""
TIMEOUT_S = 120.0
"""Time limit of one computation: it takes seconds, on a busy computer a minute."""
COEFFICIENT, REMAINING = "wear_coefficient", "remaining_revolutions"


@dataclass(frozen=True, slots=True)
class NewestWear:
    """The newest statement of the prediction's columns; NaN where nothing is known."""

    revolution: float = math.nan
    values: Mapping[str, float] = field(default_factory=dict)

    def __getitem__(self, name: str) -> float:
        return self.values.get(name, math.nan)

    @property
    def known(self) -> bool:
        """Return whether a coefficient is stated."""
        return math.isfinite(self[COEFFICIENT])

    @property
    def statement(self) -> str:
        """Return the most probable statement, in a word, with its probability."""
        model, share = self["wear_model"], self["wear_model_weight"]
        if not math.isfinite(model):
            return ""
        if model not in range(len(WEAR_MODELS)):  # of a newer version or another program
            return tr("the file's wear model {:g} is unknown here", model)
        word = tr(WEAR_MODELS[int(model)])
        if share >= ODDS * (1.0 - share):
            return word
        return tr("not identified, most likely {} ({:.0f} %)", word, 100.0 * share)


_NAMES = (
    *(f"{name}{end}" for name in (COEFFICIENT, REMAINING) for end in ("", "_low", "_high")),
    "wear_model",
    "wear_model_weight",
)

SEARCHED = 256
"""Buckets searched for the newest statement, which is needed at every update."""
RECENT = 256
"""Revolutions searched for the last one at the set speed: a ramp has fewer."""


def newest_wear(predictions: SeriesTable) -> NewestWear:
    """Return the newest statement in the columns."""
    series = predictions.series(COEFFICIENT)
    buckets = series.envelope(0, len(series), SEARCHED)
    holding = np.flatnonzero(buckets.high > 0.0)
    if not holding.size:
        return NewestWear()
    start = int(buckets.first[holding[-1]])
    stop = int(buckets.first[holding[-1] + 1]) if holding[-1] + 1 < len(buckets.first) else None
    known = np.flatnonzero(series.rows(start, len(series) if stop is None else stop) > 0.0)
    if not known.size:  # older rows are held in buckets alone
        return NewestWear()
    row = start + int(known[-1])
    values = {name: predictions.at(name, row) for name in _NAMES}
    return NewestWear(float(predictions.revolutions[row]), values)


def wear_of(news: News, now: float) -> list[FreeValue]:
    """Return the tiles of the wear of the shown test; with the date while it runs."""
    status, rows = news.status, news.data.rows
    live = status is not None and status.engine.state is RunState.RUNNING and not news.is_replay
    rpm = _rpm(rows, live) if len(rows) else 0.0
    if live and status is not None and 0.0 < status.rig.simulated_speed < math.inf:
        rpm *= status.rig.simulated_speed
    revolution = rows.revolutions[-1] if len(rows) else math.nan
    return wear_values(news.data.predictions, rpm, now if live else None, revolution)


def _rpm(rows: SeriesTable, live: bool) -> float:
    """Return the present speed; for a test that does not run the last one outside of ramps."""
    if live or QUALITY not in rows.names:
        return abs(rows.last("speed"))
    speed, quality = (rows.newest(name, RECENT) for name in ("speed", QUALITY))
    return last_set_speed(speed, quality)


def wear_values(
    predictions: SeriesTable, rpm: float, now: float | None, revolution: float
) -> list[FreeValue]:
    """Return the tiles of the wear coefficient and of the time that remains; none without it.

    rpm: the present speed, by the wall clock; now: the host's time, None if the test does
    not run; revolution: the present one, from which the remaining ones count down.
    """
    newest = newest_wear(predictions)
    if not newest.known:
        return []
    value, limits = coefficient_text(
        *(newest[f"{COEFFICIENT}{suffix}"] for suffix in ("", "_low", "_high"))
    )
    limits = f"{limits}; {newest.statement}"
    tiles = [FreeValue(COEFFICIENT, tr("Wear coefficient"), value, limits)]
    since = max(revolution - newest.revolution, 0.0) if math.isfinite(revolution) else 0.0
    left, soon, late = (
        max(newest[f"{REMAINING}{suffix}"] - since, 0.0) for suffix in ("", "_low", "_high")
    )
    if math.isfinite(left):
        tiles.append(_remaining(left, soon, late, rpm, now))
    return tiles


def _remaining(left: float, soon: float, late: float, rpm: float, now: float | None) -> FreeValue:
    """Return the tile of the remaining time, in revolutions while the crank is stationary."""
    title = tr("Until the final wear depth")
    latest = grouped(round(late)) if math.isfinite(late) else tr("beyond the model")
    turns = tr("{} to {} revolutions (95 %)", grouped(round(soon)), latest)
    if rpm <= 0.0:
        return FreeValue(REMAINING, title, tr("{} revolutions", grouped(round(left))), turns)
    seconds = 60.0 * left / rpm
    date = ""
    if now is not None:
        date = dated(f"{MOMENT}; ", time.localtime(now + seconds))
    return FreeValue(REMAINING, title, duration(seconds), date + turns)


@dataclass(frozen=True, slots=True, eq=False)
class WearBand:
    """The band predicted after a revolution, (n,) each: revolutions and um."""

    after: int
    revolution: Floats
    low: Floats
    median: Floats
    high: Floats


@dataclass(frozen=True, slots=True, eq=False)
class KnownWear:
    """The result of ``rigapp identify`` for a test.

    after: the revolution from which it was known, 0 if unknown; planned: the last one;
    bands: the early one first, the last one last; readings: revolution and depth (um) of the bins;
    course: columns over the revolutions after which something was known; depth_um: of the end.
    """

    sentence: str
    after: int = 0
    planned: int = 0
    bands: tuple[WearBand, ...] = ()
    readings: tuple[Floats, Floats] = (np.empty(0), np.empty(0))
    course: Mapping[str, Floats] = field(default_factory=dict)
    depth_um: float = math.nan


Run = Callable[[list[str]], str]


def run_identify(arguments: list[str]) -> str:
    """Return the output of ``rigapp identify``; raise OSError with its sentence when it fails."""
    done = subprocess.run(
        module_command("rigapp", "identify", *arguments),
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )
    if not done.stdout.strip():
        raise OSError(done.stderr.strip() or f"rigapp identify ended with {done.returncode}")
    return done.stdout


def known_wear(path: Path, after: int, run: Run = run_identify) -> KnownWear:
    """Return the result for a test after a revolution; runs on a worker thread."""
    return of_tree(json.loads(run([str(path), "--json", "--after", str(after)]))["tests"][0])


def of_tree(tree: Mapping[str, Any]) -> KnownWear:
    """Return the result in the JSON of one test."""
    parts = tree.get("sentence_parts")  # the sentence for other languages
    sentence = sentence_of_parts(parts) if parts else tree["sentence"]
    if tree["refused"]:
        return KnownWear(sentence)
    left = tree["remaining_revolutions"]
    return KnownWear(
        sentence,
        tree["revolution"],
        tree["planned_revolutions"],
        tuple(
            WearBand(
                band["after_revolution"],
                *(_floats(band[key]) for key in ("revolution", "low_um", "median_um", "high_um")),
            )
            for band in tree["bands"]
        ),
        (_floats(tree["readings"]["revolution"]), _floats(tree["readings"]["depth_um"])),
        {name: _floats(values) for name, values in tree["course"].items()},
        left["depth_um"] if left is not None else math.nan,
    )


def _floats(values: list[float | None]) -> Floats:
    return np.array([math.nan if value is None else value for value in values], dtype=np.float64)


NOTHING = KnownWear("")
REST_S = 3.0
"""Pause between two computations: at the highest speed of a simulated rig bins come faster."""
Read = Callable[[Path, int], KnownWear]
"""Computes the result for a test after a revolution, on a worker thread."""


class WearReader:
    """Compute the known wear of a test, one computation at a time for all panels."""

    def __init__(self, worker: TaskWorker, read: Read = known_wear) -> None:
        self._worker, self._reader = worker, read
        self.known, self.sentence = NOTHING, ""
        self._read: tuple[Path | None, float] = (None, math.nan)
        self._busy = False
        self._done_at = -math.inf

    def look(self, news: News, rest_s: float = REST_S) -> None:
        """Compute again where the columns have a new statement, rest_s after the last time."""
        path, rows = news.path, news.data.predictions.revolutions
        if self._read[0] != path:
            self.known, self.sentence, self._read = NOTHING, "", (path, math.nan)
            self._done_at = -math.inf
        if path is None or not len(rows) or self._busy:
            return
        if time.monotonic() < self._done_at + rest_s:
            return
        revolution = newest_wear(news.data.predictions).revolution
        # The reason for an unknown wear changes with the revolutions: compute at each doubling.
        wanted = (path, revolution if math.isfinite(revolution) else -math.log2(len(rows)) // 1.0)
        if wanted == self._read:
            return
        after = int(rows[-1])
        self._busy = self._worker.submit(
            lambda: self._reader(path, after),
            lambda known: self._computed(wanted, known),
            lambda error: self._computed(wanted, KnownWear(tr("Not computed: {}", error))),
        )

    def _computed(self, wanted: tuple[Path, float], known: KnownWear) -> None:
        self._busy = False
        self._done_at = time.monotonic()
        if self._read[0] == wanted[0]:
            self._read, self.known = wanted, known
            self.sentence = translate(known.sentence)
