"""What operators read is a plain sentence: registers and errors of others are details."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from rigapp.gui.language.collect import ROOT, module_sentences, texts_of
from rigapp.presentation.catalogue import LANGUAGES, contexts
from rigapp.presentation.translation import translate
from rigapp.schema.alarms import KINDS
from rigapp.schema.details import details_of, error_text, indented, sentence_of
from rigapp_drivers.api import DeviceLost
from rigapp_drivers.registry import available_drivers, load_driver

INSIDE = re.compile(
    r"""
    \b(?:ipc|inproc|socket|tcp|udp|pty)://        # addresses of the inside
    | /run/|\.sock\b
    | \b0x[0-9A-Fa-f]+ | \{:0?\d*[xX]\}           # numbers as a protocol writes them
    | \b[0-9A-F]{4}h\b | \b[0-9A-F]{4}:\d
    | \b(?:GET|SET)[A-Z]+\b
    | \b(?:SDO|PDO|NMT|COB|SYNC|EEPROM|TEDS|QPPS|CRC|OPERATIONAL)\b
    | \b[Rr]egisters?\b | \b[Oo]bjects?\b | \bstatus\ word\b
    | \b[Bb]ytes?\b | \b[Cc]hecksums?\b | \b[Pp]ackets?\b | \b[Bb]uffers?\b | \bbit\ \d
    | \b[A-Z]\w*(?:Error|Exception)\b | \b[Ee]xceptions?\b | \b[Tt]racebacks?\b
    | \b[Ee]rrno\b | \bstrerror\b
    | \b[Tt]hreads?\b | \bprocess\ \{ | \bPID\b | \bpid\b | \bJSON\b | \bMessagePack\b
    | \b1970\b | \bepoch\b
    | \d[eE][-+]\d\d                             # numbers as a file or a program writes them
    """,
    re.VERBOSE,
)
"""What stands among the details only."""

OF_FILES = {
    "drivers/modbus_sensor/registers", "drivers/dataq/plan", "rigapp/config/names",
    "rigapp/config/consistency", "rigapp/service/security",
}  # fmt: skip
"""Texts about keys of files and options, which name them as the file and the manual do."""

OF_KEYS = {
    str(spec.sentence)
    for name in available_drivers()
    for spec in load_driver(name).settings.values()
}
"""What the keys of devices mean, in the words of their manuals."""

FOR_PROGRAMMERS = {"drivers/gsv8/frames", "drivers/gsv8/protocol", "drivers/roboclaw/protocol"}
"""Refusals of calls that no user can cause, and what a driver puts among details."""

WHO_WROTE = {"process {} on {}", "process {}"}
"""Attributes of a file that say which process writes it."""

IDENTITIES = {"vendor {:08X}", "product {:08X}", "GSV, model {:02X}", "mode {:02X}"}
"""Names of a device that nobody knows, as its plate and its maker's tool have them."""

SYSTEM_WORDS = {"The certificate is made from the record alone: the same bytes each time."}
"""Bytes are what is meant: two files are the same."""


def told() -> Iterator[tuple[str, str]]:
    """Yield every collected text of an operator with the module that says it."""
    for place, one in module_sentences():
        name = re.sub(r"^\w+/rigapp_", "", place)
        if name not in OF_FILES | FOR_PROGRAMMERS and "/simulator" not in name:
            yield name, one
    yield from (
        ("alarms", one)
        for kind in KINDS.values()
        for one in (kind.title, sentence_of(kind.sentence))
    )
    yield from (
        ("alarms", one) for kind in KINDS.values() for one in (kind.consequence, kind.action)
    )
    yield from ((name, one) for one, (name, _) in texts_of().texts.items())


def test_no_text_of_an_operator_has_words_of_the_inside() -> None:
    allowed = WHO_WROTE | IDENTITIES | SYSTEM_WORDS
    keys = {one.removesuffix(".") for one in OF_KEYS}
    texts = {(name, one) for name, one in told() if one not in allowed and one not in keys}
    assert len(texts) > 2500
    assert [one for one in sorted(texts) if INSIDE.search(one[1])] == []


@pytest.mark.parametrize(
    "text",
    [
        "The engine at ipc:///run/user/1000/rigapp/engine-7.sock is gone",
        "object 6041h reads 0x0237", "no reply to GETVALUE", "wrong CRC", "3 bytes only",
        "OSError: no such file", "[Errno 2] none", "started on 01 Jan 1970",
        "run.revolutions = 5e+09 is too much", "the reading thread died", "status word",
        "6083:0 was refused",
    ],
)  # fmt: skip
def test_words_of_the_inside_are_seen(text: str) -> None:
    assert INSIDE.search(text)
    assert not INSIDE.search(sentence_of(f"The drive does not answer ‹{text}›; check its cable."))


def test_no_translation_says_more_of_the_inside_than_its_text() -> None:
    german = re.compile(r"\b(?:Bytes?|Register|Objekt\w*|Puffer|Ausnahme|Faden)\b")
    for language in LANGUAGES.keys() - {"en"}:
        for one in contexts(language).values():
            for text, translated in one.items():
                found = INSIDE.search(translated) or german.search(translated)
                assert not found or INSIDE.search(text), (text, translated)


MODULES = sorted(
    path
    for folder in ("calibration", "drivers", "model", "rigapp")
    for path in (ROOT / folder).rglob("*.py")
    if not re.search(r"/simulator|rigapp/testing|rigapp/simulation", path.as_posix())
)
KEPT = {"strerror", "sentence", "errno", "filename", "code", "remedy"}
"""Of an error of others: the system's own words, which the catalogue has, and numbers."""

WORDED = {
    "rigapp/config/errors", "rigapp/config/loading", "rigapp/config/toml",
    "drivers/modbus_sensor/registers", "rigapp/viewer/levels",
}  # fmt: skip
"""What is wrong in a line of the user's file: the words of the readers of files are in the
catalogue."""
TAKEN = {
    "drivers/modbus_sensor/driver", "drivers/transport", "drivers/cia402/network",
    "drivers/roboclaw/protocol", "rigapp/storage/filesystem/folder",
    "rigapp/storage/reading/reader", "rigapp/storage/structure/hdf", "rigapp/commands/check",
    "rigapp/commands/run", "rigapp/commands/engine", "rigapp/twin/worker", "rigapp/service/host",
    "rigapp/service/requests", "rigapp/engine/engine",
    "rigapp/storage/writing/create", "rigapp/storage/filesystem/rescue",
    "rigapp/storage/upkeep/compact",
}  # fmt: skip
"""They look into the text of an error, put it among details elsewhere, know it as their own, or
take the system's own words out of it."""


def own_errors() -> set[str]:
    """Return the errors of this program: their text is a sentence."""
    trees = (ast.parse(path.read_text("utf-8")) for path in MODULES)
    made = (node for tree in trees for node in ast.walk(tree) if isinstance(node, ast.ClassDef))
    return {one.name for one in made if one.bases} | {"ValueError"}


def caught(kind: ast.expr | None) -> Iterator[str]:
    """Yield the names of the errors that a handler catches."""
    for one in ast.walk(kind) if kind is not None else ():
        if isinstance(one, ast.Name):
            yield one.id
        elif isinstance(one, ast.Attribute):
            yield one.attr


def said_values(call: ast.Call) -> list[ast.expr]:
    """Return the values of a call with a template that do not stand among its details."""
    for at, one in enumerate(call.args):
        if isinstance(one, ast.Constant) and isinstance(one.value, str) and "{" in one.value:
            depth, shown = 0, []
            values = iter(call.args[at + 1 :])
            for piece in re.split(r"(\{[^{}]*\}|‹|›)", one.value):
                depth += (piece == "‹") - (piece == "›")
                value = next(values, None) if piece.startswith("{") else None
                if value is not None and depth == 0:
                    shown.append(value)
            return shown
    return []


def pasted(body: list[ast.stmt], name: str) -> Iterator[int]:
    """Yield the lines of a handler in which its error stands in a text, but not in its details."""
    for node in (one for statement in body for one in ast.walk(statement)):
        shown: list[ast.expr] = []
        if isinstance(node, ast.Call):
            shown = said_values(node)
        if isinstance(node, ast.JoinedStr):
            depth = 0
            for part in node.values:
                if isinstance(part, ast.Constant):
                    depth += str(part.value).count("‹") - str(part.value).count("›")
                elif depth == 0:
                    shown.append(part)
        elif isinstance(node, ast.Call) and getattr(node.func, "id", "") == "str":
            shown = node.args
        for one in shown:
            inner = list(ast.walk(one))
            kept = {
                id(part.value)
                for part in inner
                if isinstance(part, ast.Attribute) and part.attr in KEPT
            }
            if any(
                isinstance(part, ast.Name) and part.id == name and id(part) not in kept
                for part in inner
            ):
                yield node.lineno


@pytest.mark.long
def test_errors_of_others_are_pasted_into_details_only() -> None:
    own, found = own_errors(), []
    for path in MODULES:
        name = path.relative_to(ROOT).with_suffix("").as_posix()
        if re.sub(r"^\w+/rigapp_", "", name) in WORDED | TAKEN:
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ExceptHandler) and node.name and set(caught(node.type)) - own:
                found += [f"{name}:{line}" for line in pasted(node.body, node.name)]
    assert found == []


def test_details_are_parted_from_the_sentence_wherever_they_stand() -> None:
    text = "daq on socket://127.0.0.1:4711: the port cannot be opened ‹x ‹y› z›; check the cable."
    assert sentence_of(text) == "daq: the port cannot be opened; check the cable."
    assert details_of(text) == "socket://127.0.0.1:4711\ny\nx z"
    assert indented("It failed ‹OSError(5)›.") == "It failed.\n    OSError(5)"
    cut = "The file cannot be written ‹[Errno 28] No space le"
    assert (sentence_of(cut), details_of(cut)) == (
        "The file cannot be written",
        "[Errno 28] No space le",
    )
    plain = "daq on /dev/ttyUSB0: there is no such port; check the cable."
    assert (sentence_of(plain), details_of(plain)) == (plain, "")
    assert translate(text) == sentence_of(text)


def test_an_error_of_others_has_a_sentence_of_ours() -> None:
    assert error_text(DeviceLost("daq", "COM3", "it is gone."), "no") == "daq on COM3: it is gone."
    with pytest.raises(KeyError) as foreign:
        {}["a"]
    text = error_text(foreign.value, "The devices could not be connected.")
    assert text == "The devices could not be connected. ‹KeyError('a')›"
    with pytest.raises(FileNotFoundError) as missing:
        Path("/nowhere/t.h5").read_bytes()
    assert sentence_of(error_text(missing.value, "no")) == (
        "/nowhere/t.h5: No such file or directory"
    )
