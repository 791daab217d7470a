"""What others say is said in the window's language, with no English left."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from string import Formatter
from typing import Any

import numpy as np
import pytest

from rigapp.checks.start import preflight
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig, parse_test, read_parameters
from rigapp.config.ranges import keys_of, refusal
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.engine.commands import ended_by
from rigapp.gui.language import speak_language
from rigapp.presentation.catalogue import LANGUAGES, contexts
from rigapp.presentation.translation import ENGLISH, translate
from rigapp.queue.items import Queue, removed
from rigapp.report.results import _recorded_reason
from rigapp.schema.alarms import KINDS, make_alarm
from rigapp.schema.loglines import AlarmChange, alarm_change
from rigapp.schema.messages import Event, FinishReason, RunState, Status
from rigapp.schema.states import Ending
from rigapp.schema.wire import decode, encode, tree_of
from rigapp.storage.reading.reader import open_test
from rigapp.texts import Sentence, joined, sentence_of_error
from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_drivers.api import DeviceError
from rigapp_drivers.cia402.protocol import describe_code
from rigapp_drivers.gsv8.words import STATUS_WORDS, status_words, value_fault_words
from rigapp_drivers.registry import SettingsError, available_drivers, check_settings, load_driver
from rigapp_drivers.roboclaw.status import describe_status
from rigapp_drivers.transport import SerialPort
from tests.calibration.simulated_cell import SETTINGS
from tests.calibration.virtual_mistakes import MISTAKES, Kind, take

TRANSLATED = sorted(LANGUAGES.keys() - {ENGLISH})
WORD = re.compile(r"[^\W\d_]{2,}")
NOT_WORDS = re.compile(
    r"\{[^{}]*\}|[\w-]*(?:[._/=][\w/-]+)+|\"[^\"]*\"|'[^']*'|`[^`]*`|--\w+|\b[0-9A-F]{4}\b"
)
"""Values, keys of files, paths, quotations and commands: the same in every language."""


@pytest.fixture(autouse=True, params=TRANSLATED)
def _spoken(qapp: Any, request: pytest.FixtureRequest) -> Iterator[None]:
    speak_language(qapp, request.param)
    yield
    speak_language(qapp, ENGLISH)


def words_of(text: str) -> set[str]:
    """Return the words of a text in small letters, without what is the same in every language."""
    return {word.lower() for word in WORD.findall(NOT_WORDS.sub(" ", text))}


def english_words(language: str) -> set[str]:
    """Return the words that the catalogue has in English and never in its own language."""
    found = [(text, said) for one in contexts(language).values() for text, said in one.items()]
    said = {word for _, one in found for word in words_of(one)}
    return {word for text, _ in found for word in words_of(text)} - said


def of_alarms(folder: Path) -> Iterator[str]:
    for kind in KINDS.values():
        named = [
            (name, spec)
            for text in (kind.title, kind.sentence)
            for _, name, spec, _ in Formatter().parse(text)
            if name
        ]
        values: dict[str, object] = {name: 1.5 if spec else "x.y" for name, spec in named}
        for text in (kind.title, kind.sentence):
            yield Sentence(text, "x.y", **values)
        yield from map(Sentence, (kind.consequence, kind.action))


def of_amplifier(folder: Path) -> Iterator[str]:
    yield from map(status_words, (*STATUS_WORDS, 0xB0, 0xEE))
    yield from (value_fault_words(kind, 1 << bit) for kind in range(1, 7) for bit in range(16))
    yield from (value_fault_words(kind, flags) for kind in range(1, 6) for flags in (0, 0xFFFF))


def of_drives(folder: Path) -> Iterator[str]:
    for bits in (16, 32):
        for bit in range(bits):
            status = describe_status(1 << bit, bits)
            yield from (*status.faults, *status.warnings)
    status = describe_status(0xFFFF, 16)
    yield joined(", ", status.faults)
    yield from map(describe_code, range(0x1000, 0x10000, 0x10))


def of_settings(folder: Path) -> Iterator[str]:
    for driver in available_drivers():
        info = load_driver(driver)
        for key, wrong in ((one, bad) for one in (*info.settings, "zzz") for bad in WRONG):
            try:
                check_settings(info, {key: wrong}, "rig.toml")
            except SettingsError as error:
                yield sentence_of_error(error)


WRONG: tuple[object, ...] = ("fast", -1e9, 1e30, 1.5, True, [], float("nan"))


def of_ports(folder: Path) -> Iterator[str]:
    for port in (str(folder / "missing"), "socket://127.0.0.1:1"):
        try:
            SerialPort("amplifier.one", port, 9600).open()
        except DeviceError as error:
            yield sentence_of_error(error)


def of_files(folder: Path) -> Iterator[str]:
    for reader, name in ((parse_test, "quick.toml"), (parse_rig, "simulated.toml")):
        lines = (Path("examples") / name).read_text("utf-8").splitlines()
        for at, line in enumerate(lines):
            key, _, value = line.partition("=")
            for spoilt in spoilt_lines(line, key, value):
                try:
                    reader("\n".join([*lines[:at], spoilt, *lines[at + 1 :]]), name)
                except UnusableInput as error:
                    yield sentence_of_error(error)
    for number in keys_of(TestFile):
        yield refusal(number.path, -1e9)
        yield refusal(number.path, 1e30)
        yield refusal(number.path, float("nan"))


def spoilt_lines(line: str, key: str, value: str) -> Iterator[str]:
    """Yield a line of a file with mistakes in it."""
    if value and not line.startswith("#"):
        yield from (f"{key}= {one}" for one in ("[]", "-1e9", "1e30", "true", '"§"', "nan", "{}"))
        yield f"{key}x = {value}"
        yield key
    yield f"{line} ]"
    yield ""


def of_calibrations(folder: Path) -> Iterator[str]:
    rng = np.random.default_rng(3)
    for angles in (4, 12):
        for mistake in MISTAKES.values():
            taken = take(Kind(angles, noise=0.07, display=0.02), rng)
            for problem in calibrate_load_cell(
                mistake.plant(taken, rng), mistake.settings
            ).problems:
                yield problem.sentence
    readings = take(Kind(4), rng).readings
    for spoilt in (
        replace(readings, angle=readings.angle * np.nan),
        replace(readings, mass=readings.mass * 1000.0),
        replace(readings, mass=-readings.mass),
        replace(readings, angle=readings.angle * 0.0),
        replace(readings, signal=-readings.signal),
        replace(readings, signal=readings.signal * 1000.0),
        replace(readings, signal=readings.signal[:, ::-1]),
        replace(readings, signal=readings.signal * 0.0),
    ):
        with suppress(ValueError):
            for problem in calibrate_load_cell(spoilt, SETTINGS).problems:
                yield problem.sentence


def of_the_disk(folder: Path) -> Iterator[str]:
    (folder / "empty.h5").touch()
    (folder / "text.h5").write_text("no test", "utf-8")
    for path in (folder / "missing.h5", folder, folder / "empty.h5", folder / "text.h5"):
        with pytest.raises(UnusableInput) as refused:
            open_test(path)
        yield sentence_of_error(refused.value)
        with pytest.raises(UnusableInput) as refused:
            read_parameters(path)
        yield sentence_of_error(refused.value)


def of_the_start(folder: Path) -> Iterator[str]:
    for check in preflight(None, None, None, None):
        yield from (check.name, check.sentence, check.advice)
    with pytest.raises(Exception, match="no test") as refused:
        removed(Queue(), [7])
    yield sentence_of_error(refused.value)


def words_of_files() -> set[str]:
    """Return what files have as keys and choices; some of it would be words elsewhere."""
    keys = [*keys_of(TestFile), *keys_of(RigFile)]
    named = {part for one in keys for part in (*one.path.split("."), *one.choices)}
    for driver in available_drivers():
        for key, spec in load_driver(driver).settings.items():
            named |= {key, *map(str, spec.choices)}
    return {word for one in named for word in words_of(one)} | {"daq", "drive"}


SOURCES: tuple[Callable[[Path], Iterator[str]], ...] = (
    of_alarms, of_amplifier, of_drives, of_settings, of_ports, of_files, of_calibrations,
    of_the_disk, of_the_start,
)  # fmt: skip


@pytest.mark.sampled
@pytest.mark.parametrize("source", SOURCES, ids=[one.__name__ for one in SOURCES])
def test_no_english_word_is_left_of_what_is_told(
    source: Callable[[Path], Iterator[str]], tmp_path: Path
) -> None:
    english = english_words("de") - words_of_files()
    told_all = {sentence for sentence in source(tmp_path) if sentence}
    assert told_all
    left = {one: (translate(one), words_of(translate(one)) & english) for one in told_all}
    assert [(one, *found) for one, found in left.items() if found[1]] == []


def test_an_operators_note_is_never_translated() -> None:
    """Also where it reads like a sentence of the engine, or like a part of one."""
    ended = ended_by("Ada", "All revolutions are done. The drive was switched off.", off=False)
    assert ended == "Ada stopped the test: All revolutions are done. The drive was switched off."
    assert translate(ended) == (
        "Ada hat den Versuch gestoppt: All revolutions are done. The drive was switched off."
    )
    assert translate(ended_by("", "", off=True)) == "Der Bediener hat den Antrieb ausgeschaltet."
    for words in ("cable", "Start a test.", "vom Bediener", "the drive does not answer"):
        assert translate(words) == words
        ending = Ending(FinishReason.OPERATOR, ended_by("Ada", words, off=True))
        status = decode(
            encode(Status.of_flat({"state": RunState.STOPPED, "reason": ending.sentence})), Status
        )
        assert translate(status.engine.reason) == f"Ada hat den Antrieb ausgeschaltet: {words}"


def test_an_end_in_a_file_is_said_as_it_was_on_the_rig() -> None:
    for reason, said in (
        ("The planned 30 revolutions are made and recorded.", "Die geplanten 30 Umdrehungen"),
        ("Ada stopped the test: Start a test.", "Ada hat den Versuch gestoppt: Start a test."),
        ("Start a test.", "Start a test."),
    ):
        assert translate(_recorded_reason(reason, 30, "ada")).startswith(said)


def test_an_alarm_in_a_file_is_said_as_it_was_on_the_rig() -> None:
    cause = make_alarm("input_saturated", "probe_1", wired="in 5", device="daq", span="10 V")
    change = AlarmChange("raised", str(cause.title), action=cause.kind.action)
    event = Event(0.0, 1, "alarm", "engine", "", key=cause.key, data=tree_of(change))
    read = alarm_change(event)
    assert read is not None
    assert read == change
    assert translate(read.title) == "Eingang übersteuert: probe_1"
    assert translate(read.action).startswith("Stecker, Kabel und Sensor")
