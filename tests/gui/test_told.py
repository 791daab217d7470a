"""What others tell is said in the window's language: known again, quickly, with no English left."""

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

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig, parse_test, read_parameters
from rigapp.config.ranges import keys_of, refusal
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.gui.language.catalogue import ENGLISH, LANGUAGES, TOLD, contexts, speak_language
from rigapp.presentation import told
from rigapp.presentation.told import retold
from rigapp.presentation.translation import language_changes, tr
from rigapp.queue.items import Queue, removed
from rigapp.schema.alarms import KINDS
from rigapp.service.preflight import preflight
from rigapp.storage.reading.reader import open_test
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


def filled(template: str, values: dict[str, str]) -> str:
    return told._filled(template, values)


def some_values(template: str) -> dict[str, str]:
    """Return a value for each brace of a template: a number where it is one, else a name."""
    found = {}
    before = ""
    for at, (before, name, spec) in enumerate(told._parts(template)):
        if name and spec and spec[-1] in "gfde,%":
            found[name] = f"{at + 3}.5"
        elif name:
            found[name] = f"x{at}.toml" if before or not at else ""
    return found


def test_each_template_is_known_again_with_its_values() -> None:
    wrong = []
    for template in contexts("de")[TOLD]:
        core = template.strip(told.EDGES)
        values = some_values(core)
        wanted = filled(tr(template).strip(told.EDGES), values)
        if retold(filled(core, values)).lower() != wanted.lower():
            wrong.append(template)
    assert wrong == []


def test_few_templates_are_tried_for_a_sentence() -> None:
    known = told._known_by(language_changes())
    tried = [
        len(known.like(filled(core, some_values(core))))
        for core in (one.strip(told.EDGES) for one in contexts("de")[TOLD])
    ]
    assert len(tried) > 900
    assert sum(tried) / len(tried) < 10
    assert max(tried) < 40


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
            yield text.format("x.y", **values)
        yield from (kind.consequence, kind.action)


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
    yield ", ".join(status.faults)
    yield from map(describe_code, range(0x1000, 0x10000, 0x10))
    yield "watchdog: the host was silent for 1.01 s and the drive has stopped the motor; " + (
        "reset the fault before the next start."
    )


def of_settings(folder: Path) -> Iterator[str]:
    for driver in available_drivers():
        info = load_driver(driver)
        for key, wrong in ((one, bad) for one in (*info.settings, "zzz") for bad in WRONG):
            try:
                check_settings(info, {key: wrong}, "rig.toml")
            except SettingsError as error:
                yield str(error)


WRONG: tuple[object, ...] = ("fast", -1e9, 1e30, 1.5, True, [], float("nan"))


def of_ports(folder: Path) -> Iterator[str]:
    for port in (str(folder / "missing"), "socket://127.0.0.1:1"):
        try:
            SerialPort("amplifier.one", port, 9600).open()
        except DeviceError as error:
            yield str(error)


def of_files(folder: Path) -> Iterator[str]:
    for reader, name in ((parse_test, "quick.toml"), (parse_rig, "simulated.toml")):
        lines = (Path("examples") / name).read_text("utf-8").splitlines()
        for at, line in enumerate(lines):
            key, _, value = line.partition("=")
            for spoilt in spoilt_lines(line, key, value):
                try:
                    reader("\n".join([*lines[:at], spoilt, *lines[at + 1 :]]), name)
                except UnusableInput as error:
                    yield str(error)
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
        for _, plant in MISTAKES.values():
            taken = take(Kind(angles, noise=0.07, display=0.02), rng)
            for problem in calibrate_load_cell(plant(taken, rng), SETTINGS).problems:
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
        yield str(refused.value)
        with pytest.raises(UnusableInput) as refused:
            read_parameters(path)
        yield str(refused.value)


def of_the_start(folder: Path) -> Iterator[str]:
    for check in preflight(None, None, None, None):
        yield from (check.what, check.finding, check.action)
    with pytest.raises(Exception, match="no test") as refused:
        removed(Queue(), [7])
    yield str(refused.value)


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


@pytest.mark.parametrize("source", SOURCES, ids=[one.__name__ for one in SOURCES])
def test_no_english_word_is_left_of_what_is_told(
    source: Callable[[Path], Iterator[str]], tmp_path: Path
) -> None:
    english = english_words("de") - words_of_files()
    told_all = {sentence for sentence in source(tmp_path) if sentence}
    assert told_all
    left = {one: (retold(one), words_of(retold(one)) & english) for one in told_all}
    assert [(one, *found) for one, found in left.items() if found[1]] == []
