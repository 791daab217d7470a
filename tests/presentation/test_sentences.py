"""A sentence is its English text, and keeps its template from where it arises to the screen."""

from __future__ import annotations

import json
import pickle
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.presentation.translation import speak, translate
from rigapp.schema.details import details_of, sentence_of
from rigapp.schema.messages import Reply, Severity
from rigapp.schema.wire import decode, encode, json_bytes, tree_of
from rigapp.texts import Sentence, Value, as_written, capitalised, joined, say, sentence_of_error

ROOT = Path(__file__).parents[2]

GERMAN = {
    "{} on {}: {}": "{} an {}: {}",
    "the port {} cannot be opened; check the {}": "{1} prüfen: {0} lässt sich nicht öffnen",
    "cable": "Kabel",
    "asked by the operator": "vom Bediener verlangt",
    "{} stopped the test: {}": "{} hat den Versuch gestoppt: {}",
    "{:.1f} N for {} revolution{}": "{1} Umdrehungen, {0} N",
    "warning": "Warnung",
}


@pytest.fixture
def german() -> Iterator[None]:
    speak(GERMAN)
    yield
    speak(None)


TEMPLATES = st.lists(
    st.sampled_from(["{}", "{:.1f}", " is ", "no ", "{{x}}", "‹", "›", ". "]), max_size=8
)
NUMBERS = st.floats(allow_nan=False, allow_infinity=False, width=32) | st.integers(-9, 9)


@st.composite
def sentences(draw: st.DrawFn, deep: bool = True) -> tuple[Sentence, str]:
    """Return a sentence, and what an f-string would have said."""
    template, text, values = "", "", list[Any]()
    for piece in draw(TEMPLATES):
        template += piece
        if piece == "{:.1f}":
            values.append(draw(NUMBERS))
            text += f"{values[-1]:.1f}"
        elif piece == "{}":
            value: Any = draw(st.text(max_size=5) | NUMBERS)
            inner = deep and draw(st.booleans())
            value, said = draw(sentences(deep=False)) if inner else (value, str(value))
            values.append(value)
            text += said
        else:
            text += piece.replace("{{", "{").replace("}}", "}")
    return (say(template, *values), text) if values else (say(text), text)


@given(sentences())
def test_a_sentence_is_its_english_text_everywhere(drawn: tuple[Sentence, str]) -> None:
    sentence, text = drawn
    assert sentence == text
    assert type(str(sentence)) is str
    assert json.loads(json_bytes({"said": [sentence]})) == {"said": [text]}
    assert json.loads(json.dumps(sentence)) == text
    for same in (
        pickle.loads(pickle.dumps(sentence)),  # noqa: S301 - our own
        decode(encode(Reply(ok=False, sentence=sentence)), Reply).sentence,
        decode(encode({"deep": [sentence]}), dict)["deep"][0],
        tree_of(Reply(ok=False, sentence=sentence))["sentence"],
    ):
        assert same == text
        assert (same.template, same.values) == (sentence.template, sentence.values)
    assert translate(sentence) == sentence_of(sentence)


def test_a_sentence_is_said_in_the_language_of_the_window(german: None) -> None:
    port = say("the port {} cannot be opened ‹{}›; check the {}.", "COM3", "errno 5", say("cable"))
    error = say("{} on {}: {}", "daq", "COM3", port)
    assert error == "daq on COM3: the port COM3 cannot be opened ‹errno 5›; check the cable."
    assert translate(error) == ("daq an COM3: Kabel prüfen: COM3 lässt sich nicht öffnen.")
    assert details_of(error) == "errno 5"
    force = say("{:.1f} N for {} revolution{}", np.float64(2), 3, "s")
    assert translate(force) == "3 Umdrehungen, 2.0 N"
    assert translate(say("{}", Severity.WARNING)) == "Warnung"
    assert translate(joined("; ", [say("cable"), "cable"])) == "Kabel; cable"


def test_what_somebody_wrote_is_never_translated(german: None) -> None:
    note = "asked by the operator"
    stopped = say("{} stopped the test: {}", "cable", note)
    assert translate(stopped) == "cable hat den Versuch gestoppt: asked by the operator"
    assert translate(note) == note
    assert translate(as_written(note)) == note
    by_itself = say("{} stopped the test: {}", "Eva", say("asked by the operator"))
    assert translate(by_itself) == "Eva hat den Versuch gestoppt: vom Bediener verlangt"


def test_an_address_of_the_inside_is_no_part_of_the_sentence(german: None) -> None:
    error = say("{} on {}: {}", "daq", "socket://127.0.0.1:1", say("cable"))
    assert translate(error) == "daq: Kabel"
    assert details_of(error) == "socket://127.0.0.1:1"


def test_an_error_says_its_sentence() -> None:
    error = ValueError(say("{} is too much", 3))
    assert isinstance(sentence_of_error(error), Sentence)
    assert say("no: {}", error).values == {"0": say("{} is too much", 3)}
    assert say("no: {}", KeyError("a")) == "no: 'a'"


def test_endings_are_cut_with_the_structure_kept() -> None:
    assert say("{} is short.", "it").rstrip(".").template == "{} is short"
    assert say("it is {}", "short.").rstrip(".") == "it is short"
    assert say("{} s", 3).removesuffix(" s").values == {"0": 3}


def test_a_string_of_an_older_program_is_taken_as_it_is() -> None:
    body = msgspec.msgpack.encode({"ok": False, "sentence": "asked by the operator"})
    assert decode(body, Reply).sentence == "asked by the operator"
    values: dict[str, Value] = say("{}", "a").values
    assert values == {"0": "a"}


def test_a_sentence_begins_with_a_capital_letter_and_keeps_its_structure(german: None) -> None:
    assert translate(capitalised(say("asked by the operator"))) == "Vom Bediener verlangt"
    assert capitalised(say("{}: {}", say("cable"), 3)) == "Cable: 3"
    assert translate(capitalised(say("{}: {}", say("cable"), 3))) == "Kabel: 3"
    assert capitalised("eva") == "Eva"


def test_records_leave_the_process_by_one_door() -> None:
    """Msgspec refuses a sentence; only ``rigapp.schema.wire`` tells it what to write instead."""
    found = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "rigapp").rglob("*.py")
        if re.search(r"msgspec\.(?:json\.encode|msgpack\.encode|to_builtins)\(", path.read_text())
    }
    numbers_only = {"rigapp/twin/checkpoint.py", "rigapp/storage/reading/export.py"}
    assert found - {"rigapp/schema/wire.py"} == numbers_only
