"""Every alarm that is raised is in the table, with all that its words name, and every entry is."""

from __future__ import annotations

import ast
import string
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from rigapp.schema.alarms import KINDS, exceeded, key_of, kind_of, make_alarm
from rigapp.schema.messages import Ends, Severity

ABOUT = ("make_alarm", "warn", "partial", "clear", "is_active")
SOURCES = sorted((Path(__file__).parents[2] / "rigapp").rglob("*.py"))


def calls(*names: str) -> Iterator[tuple[str, ast.Call]]:
    """Yield every call of the program of a function or method with one of these names."""
    for where, name, node in _calls():
        if name in names:
            yield where, node


@cache
def _calls() -> list[tuple[str, str, ast.Call]]:
    found = []
    for path in SOURCES:
        text = path.read_text(encoding="utf-8")
        if not any(f"{name}(" in text for name in ABOUT):
            continue  # to parse the whole source takes seconds
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call):
                name = getattr(node.func, "id", getattr(node.func, "attr", ""))
                if name in ABOUT:
                    found.append((f"{path.name}:{node.lineno}", name, node))
    return found


def keys_of(argument: ast.expr) -> set[str]:
    """Return the literal keys that an argument can have."""
    return {
        one.value
        for one in ast.walk(argument)
        if isinstance(one, ast.Constant) and isinstance(one.value, str)
    }


def named(key: str) -> set[str]:
    """Return what the words of a kind name beside WHAT."""
    words = KINDS[key].title + KINDS[key].sentence
    return {name for _, name, _, _ in string.Formatter().parse(words) if name}


def test_what_is_raised_is_in_the_table_with_all_that_its_words_name() -> None:
    raised: set[str] = set()
    for where, call in calls("make_alarm"):
        given = {one.arg for one in call.keywords}
        for key in keys_of(call.args[0]):
            raised.add(key)
            assert key in KINDS, where
            assert named(key) <= given, f"{where}: {key} needs {named(key)}"
    # ``Engine.warn`` makes the alarm of a key and a sentence, also as a callback.
    for where, call in calls("warn", "partial"):
        key_node = call.args[1] if getattr(call.args[0], "attr", "") == "warn" else call.args[0]
        key = getattr(key_node, "value", None)
        if isinstance(key, str):
            raised.add(key)
            assert named(key) <= {"sentence"}, where
    later = {"input:broken", "input:suspect", "input:before", "input", "input:saturated"}
    assert raised | later == set(KINDS), "raised nowhere, or by a key that is no literal"


def test_what_is_cleared_or_asked_for_is_in_the_table() -> None:
    for where, call in calls("clear", "is_active"):
        of_alarms = getattr(getattr(call.func, "value", None), "attr", "") == "alarms"
        if of_alarms and isinstance(call.args[0], ast.Constant):
            assert kind_of(str(call.args[0].value)) is not None, where


@pytest.mark.parametrize("key", sorted(KINDS))
def test_every_kind_can_be_raised_told_and_found_again_by_its_key(key: str) -> None:
    values = dict.fromkeys(named(key), 1.0)
    cause = make_alarm(key, "it", **values)
    assert cause.key == key_of(key, "it")
    assert kind_of(cause.key) is KINDS[key]
    for words in (cause.title, cause.sentence, cause.kind.consequence, cause.kind.action):
        assert words
        assert "{" not in words
    kind = cause.kind
    assert (kind.stop is not None) <= kind.latched, "what ends a test is critical"
    assert kind.off <= (kind.stop is not None)
    assert "switched off" not in kind.consequence or kind.off


def test_a_rule_has_a_kind_of_its_own() -> None:
    cause = exceeded("force_max", Severity.CRITICAL, 160.0, 150.0, True, "drive_off")
    assert kind_of(cause.key) is None
    assert (cause.key, cause.kind.ends) == ("rule:force_max:critical:above", Ends.TEST)
    assert cause.kind.off
    assert cause.sentence == "force_max is 160, above the critical limit 150."
