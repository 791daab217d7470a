"""The state of a rig at one moment, as plain values: for the page, its API and the metrics."""

from __future__ import annotations

import math
import time
from contextlib import suppress

import msgspec
import psutil

from rigapp.page.rig import DiskSpace, WatchedRig
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import state_line, state_word
from rigapp.presentation.times import MOMENT, dated, duration
from rigapp.schema.messages import NO_TEST, Alarm, DeviceView, OpenCalibration, RunState, Status
from rigapp.schema.states import ACTIVE
from rigapp.viewer.channels import FreeValue, value_text
from rigapp.viewer.connection import ConnectionState
from rigapp.viewer.knownwear import COEFFICIENT, REMAINING, newest_wear, wear_of
from rigapp.viewer.levels import margin_words
from rigapp.viewer.margins import DEPTH, margins, nearest_margin, newest, newest_force
from rigapp.viewer.news import News
from rigapp.viewer.quantities import LARGEST, UM_PER_MM
from rigapp.viewer.shown import (
    Level,
    Renewed,
    age_of,
    aged,
    free_values,
    level_of,
    quantity_level,
)

NOTES = 5
"""Number of newest notes; all of them are in the log of the test."""
NOTE_SHOWN = 300
"""Characters: a screen of a telephone."""


class LimitView(msgspec.Struct, frozen=True):
    """A quantity with its limit; used: used share of the limit, 0 to 1.

    mark: of the alarms about the quantity, and of its age; see ``RigView.tile_marks``.
    """

    title: str
    value: float
    limit: float
    unit: str
    action: str
    used: float
    passed: bool
    text: str
    mark: str = ""


class NoteView(msgspec.Struct, frozen=True):
    """A note of the log; time: UTC seconds since 1970."""

    time: float
    revolution: int
    source: str
    text: str


class ProcessView(msgspec.Struct, frozen=True):
    """The engine's process."""

    pid: int
    cpu_seconds: float
    resident_memory_bytes: int
    threads: int
    started_at: float


class RigView(msgspec.Struct, frozen=True):
    """The state of a rig at one moment.

    line: attaching, attached, silent or lost, with why in ``sentence``. state_word, state_line: the
    state and the next step, as in the window. values: newest statistics and predictions by the
    names of their columns, of those that are known. wear: those of the wear coefficient
    (mm^3/(N m)) and of the remaining revolutions, with 95 % limits. tile_marks: of each tile,
    "warning" or "critical" by the alarms about it, "old" by its age. null: not known.
    """

    identity: str
    name: str
    line: str
    sentence: str
    restarts: int
    restarted_at: float
    silence_s: float
    problem: str
    state: str = "unknown"
    state_word: str = ""
    state_line: str = ""
    reason: str = ""
    test: str = ""
    file: str = ""
    revolution: int = 0
    planned: int = 0
    committed: int = 0
    rows_dropped: int = 0
    speed_rpm: float | None = None
    target_rpm: float = math.nan
    started_at: float = 0.0
    expected_end_at: float = 0.0
    data_age_s: float | None = None
    twin_age_s: float | None = None
    worst_margin_percent: float | None = None
    worst_margin: str = ""
    simulated: bool = False
    next_step: str = ""
    values: dict[str, float] = {}
    wear: dict[str, float] = {}
    limits: tuple[LimitView, ...] = ()
    calibration: OpenCalibration | None = None
    alarms: tuple[Alarm, ...] = ()
    devices: tuple[DeviceView, ...] = ()
    notes: tuple[NoteView, ...] = ()
    tiles: tuple[tuple[str, str, str], ...] = ()
    tile_marks: tuple[str, ...] = ()
    revolution_age_s: float | None = None
    disk_free_bytes: int | None = None
    disk_total_bytes: int | None = None
    process: ProcessView | None = None

    @property
    def attached(self) -> bool:
        """Return whether the engine answers."""
        return self.line == ConnectionState.ATTACHED


def view_of(rig: WatchedRig, news: News) -> RigView:
    """Return the present state of a rig."""
    line, sentence = rig.line
    shown = RigView(
        rig.identity, rig.name, line, sentence, rig.restarts, rig.restarted_at,
        news.silence_s, rig.problem,
    )  # fmt: skip
    status = news.status
    if status is None:
        return shown
    tiles, test = _tiles(news), status.test or NO_TEST
    taken = {name: value for name, value in status.flat().items() if name in _FROM_STATUS}
    disk = rig.disk or DiskSpace(0, 0)
    return msgspec.structs.replace(
        shown,
        **taken,
        state=status.engine.state.value,
        state_word=state_word(status),
        state_line=state_line(status),
        file=test.file.replace("\\", "/").rpartition("/")[2],
        data_age_s=news.data_age_s,
        next_step=status.recovery.sentence,
        values=_values(news),
        wear=_wear(news),
        limits=tuple(_limits(news)),
        notes=tuple(_notes(news)),
        tiles=tuple((tile.title, tile.value, tile.detail) for tile in tiles),
        tile_marks=tuple(_mark(tile.level, old=tile.old) for tile in tiles),
        revolution_age_s=age_of(news, Renewed.REVOLUTION).seconds,
        disk_free_bytes=disk.free if rig.disk is not None else None,
        disk_total_bytes=disk.total if rig.disk is not None else None,
        process=_process(rig.local_pid),
    )


_FROM_STATUS = (
    "reason", "test", "revolution", "planned", "committed", "rows_dropped", "speed_rpm",
    "target_rpm", "started_at", "expected_end_at", "twin_age_s", "worst_margin_percent",
    "worst_margin", "simulated", "calibration", "alarms", "devices",
)  # fmt: skip


def _values(news: News) -> dict[str, float]:
    tables = (news.data.rows, news.data.predictions)
    result = {name: table.last(name) for table in tables for name in table.names}
    return {name: value for name, value in result.items() if math.isfinite(value)}


def _wear(news: News) -> dict[str, float]:
    known = newest_wear(news.data.predictions)
    names = (f"{name}{suffix}" for name in (COEFFICIENT, REMAINING) for suffix in _SUFFIXES)
    return {name: known[name] for name in names if math.isfinite(known[name])}


_SUFFIXES = ("", "_low", "_high")


def _limits(news: News) -> list[LimitView]:
    old = age_of(news, Renewed.REVOLUTION).old
    return [
        LimitView(
            margin.limit.title, margin.value, margin.limit.limit, margin.limit.unit,
            margin.limit.action, margin.used, margin.passed, margin.text,
            _mark(margin.level, old=old),
        )
        for margin in margins(news)
    ]  # fmt: skip


def _mark(level: int, *, old: bool) -> str:
    """Return the classes of a value on the page."""
    words = (Level(level).name.lower() if level else "", "old" if old else "")
    return " ".join(filter(None, words))


def _notes(news: News) -> list[NoteView]:
    notes = [event for event in news.events if event.kind == "note"][-NOTES:]
    return [
        NoteView(note.time, note.revolution, note.source, note.text[:NOTE_SHOWN])
        for note in reversed(notes)
    ]


def _tiles(news: News) -> list[FreeValue]:
    """Return the tiles, the most important first, each with a word below it."""
    status = news.status
    assert status is not None
    test = status.test or NO_TEST
    share = f"{100.0 * test.revolution / test.planned:.1f} %" if test.planned else ""
    planned = f"of {grouped(test.planned)}, {share}" if test.planned else ""
    renewed, sampled, turned, predicted = (age_of(news, renewal) for renewal in Renewed)
    alarms = status.alarms
    speed = value_text(status.rig.speed_rpm, "rpm", 1)
    rates = quantity_level(alarms, "speed")
    result = [
        aged(FreeValue("revolution", "Revolution", grouped(test.revolution), planned), renewed),
        *(aged(value, renewed) for value in _step(status)),
        aged(FreeValue("speed", "Speed", speed, _wanted(test.target_rpm), rates), sampled),
    ]
    running = status.engine.state is RunState.RUNNING and not renewed.old
    if running and test.expected_end_at > status.engine.host_time:
        ends = dated(MOMENT, time.localtime(test.expected_end_at))
        left = duration(test.expected_end_at - status.engine.host_time)
        result.append(FreeValue("end", "Planned end", left, ends))
    newest_N, sign = newest_force(news)
    if math.isfinite(newest_N):
        force = sign + value_text(newest_N, "N")
        nearest = nearest_margin(news, LARGEST) if status.engine.state in ACTIVE else None
        words = nearest.left if nearest is not None else ""
        level = level_of(alarms, LARGEST)
        result.append(aged(FreeValue("force", "|F| maximum", force, words, level), turned))
    residual = newest(news, "residual_rms")
    if math.isfinite(residual):
        level = level_of(alarms, "residual_rms")
        text = f"{residual:.2f} N"
        value = FreeValue("residual", "Measured − model", text, "RMS", level)
        result.append(aged(value, predicted))
    result += (aged(value, predicted) for value in (*_depth(news), *wear_of(news, time.time())))
    if test.worst_margin and test.worst_margin_percent is not None:
        margin = f"{test.worst_margin_percent:.0f} %"
        words = margin_words(test.worst_margin)
        result.append(aged(FreeValue("margin", "Smallest margin", margin, words), renewed))
    age = value_text(news.data_age_s, "s", 1)
    result.append(FreeValue("age", "Age of the data", age, "", level_of(alarms, "data_age")))
    result += free_values(news)
    return result


def _step(status: Status) -> list[FreeValue]:
    """Return the tile of the step, none for a test without steps."""
    test = status.test or NO_TEST
    if not test.step:
        return []
    return [FreeValue("step", "Step", f"{test.step}", f"of {test.steps}")]


def _wanted(target_rpm: float) -> str:
    return f"wanted: {target_rpm:.1f} rpm" if target_rpm else ""


def _depth(news: News) -> list[FreeValue]:
    """Return the tile of the wear depth, measured with its uncertainty, by the model without."""
    depth, doubt, model = (
        UM_PER_MM * newest(news, name) for name in (DEPTH, f"{DEPTH}_uncertainty", "wear_depth")
    )
    words = f"model: {model:.2f} µm" if math.isfinite(model) else ""
    if not math.isfinite(depth):
        return [FreeValue("depth", "Wear depth by the model", f"{model:.2f} µm", "")] * bool(words)
    sure = f" ± {doubt:.2f}" if math.isfinite(doubt) else ""
    assert news.status is not None
    level = level_of(news.status.alarms, DEPTH)
    return [FreeValue("depth", "Wear depth", f"{depth:.2f}{sure} µm", words, level)]


def _process(pid: int) -> ProcessView | None:
    """Return the engine's process, None for one that ended or runs on another computer."""
    if not pid:
        return None
    with suppress(psutil.Error):
        process = psutil.Process(pid)
        with process.oneshot():
            used = process.cpu_times()
            return ProcessView(
                pid,
                used.user + used.system,
                process.memory_info().rss,
                process.num_threads(),
                process.create_time(),
            )
    return None
