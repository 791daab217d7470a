"""Events keep key, level and data beside their sentence; logs without them read the same."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import h5py
import pytest
from storage_samples import PLAN, new_test, write

from rigapp.engine.judging.alarms import AlarmBook
from rigapp.schema.alarms import exceeded, make_alarm
from rigapp.schema.loglines import (
    AlarmChange,
    LimitChange,
    RestSignals,
    alarm_change,
    alarm_line,
    limit_change,
    rest_signals,
)
from rigapp.schema.messages import Alarm, Event, Severity
from rigapp.storage import logged_sentence, open_test, reopen_test
from rigapp.texts import Sentence, say

DETAILED = replace(PLAN, event_details=True)


def test_sentences_of_a_log_keep_their_templates_for_other_languages(tmp_path: Path) -> None:
    cause = say("{} N at {:.0f} deg", 391, 223.4)
    stopped = say("Overload: {}. The drive is off.", cause)
    typed = Event(2.0, 2, "note", "Ada", "Overload: seen. The drive is off.")
    with new_test(tmp_path, DETAILED) as writer:
        writer.append_event(Event(1.0, 1, "state", "engine", stopped, data={"cause": cause}))
        writer.append_event(typed)
    with open_test(tmp_path / "test.h5") as test:
        first, second = test.events()
    assert isinstance(first.text, Sentence)
    assert (first.text, first.text.template) == (stopped, stopped.template)
    assert isinstance(first.data["cause"], Sentence)
    assert first.data["cause"].values == {"0": 391, "1": 223.4}
    assert second == typed
    assert type(second.text) is str
    assert logged_sentence(str(stopped), [first, second]) is first.text
    assert logged_sentence("never logged", [first, second]) == "never logged"


def lines() -> list[Event]:
    """Return what an engine logs of many alarms, changed limits and signals at rest."""
    found: list[Event] = []

    def changed(alarm: Alarm, change: AlarmChange, who: str) -> None:
        found.append(alarm_line(float(len(found)), len(found), who, alarm, change))

    book = AlarmBook(lambda: 0.0, changed)
    rule = exceeded("force_max", Severity.CRITICAL, 160.0, 150.0, True, "stop")
    lost = make_alarm(
        "device_lost", "daq", port="/dev/ttyACM0", sentence="no answer: the cable. Look at it: now."
    )
    blind = make_alarm("blind", "wear_depth_um", name="wear depth")
    met = make_alarm("stop", "force_N", name="force", sentence="met.")
    broken = make_alarm(
        "input:saturated", "analog_1", device="daq", port="COM1", words="input 1 (analog_1)"
    )
    speed = make_alarm("speed_lost", speed_rpm=3.0, target_rpm=30.0)
    for one in (
        make_alarm("lost_samples", sentence="3 samples of daq were lost in all."),
        speed,
        lost,
        rule,
        blind,
        met,
        broken,
    ):
        book.raise_alarm(one, 7)
        book.acknowledge(one.key, "Ann")
        book.clear(one.key)
        book.raise_alarm(one, 9)
        book.clear(one.key)
    book.shelve(rule.key, "known: a cable", 600.0, "Bj\u00f8rn")
    book.acknowledge(rule.key, "Ann")
    for alarm in book.alarms():
        book.acknowledge(alarm.key, "Ann")
    book.reset("Ann")
    limit = LimitChange(None, 121.0)
    rest = RestSignals(0.125, -1.5)
    name = "force_max.warning_below"
    text = f"limit {name} changed: wear-in"
    return [
        *found,
        Event(1.0, 1, "limit_changed", "Ann", text, "none", "121", name, data=asdict(limit)),
        Event(2.0, 1, "rest", "engine", "at rest", after="0.125, -1.5", data=asdict(rest)),
        Event(3.0, 1, "note", "Ann", "limit overload_N changed"),
        Event(4.0, 1, "alarm", "engine", "words of another version"),
    ]


def asdict(record: LimitChange | RestSignals) -> dict[str, float | None]:
    """Return a record as the log's data."""
    return {name: getattr(record, name) for name in record.__struct_fields__}


def test_the_log_keeps_key_level_and_data(quick_folder: Path) -> None:
    with new_test(quick_folder, DETAILED) as writer:
        for one in lines():
            assert writer.append_event(one)
    path = quick_folder / "test.h5"
    with open_test(path) as reader:
        assert reader.events() == lines()
        assert reader.first_altered_event() is None
        assert "continued" in reader.column_units("events")
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        assert sum(file["/entry/events/continued"][:]) > 3
        file["/entry/events/level"][2] = b"information"
    with open_test(path) as reader:
        assert reader.first_altered_event() == 2


@pytest.mark.parametrize("details", [True, False])
def test_a_log_of_either_form_says_the_same(quick_folder: Path, details: bool) -> None:
    plan = replace(PLAN, event_details=details)
    wanted = lines()
    with new_test(quick_folder, plan) as writer:
        write(writer, 1, 10)
        for one in wanted[:20]:
            writer.append_event(one)
    with reopen_test(quick_folder / "test.h5") as writer:
        for one in wanted[20:]:
            writer.append_event(one)
    with open_test(quick_folder / "test.h5") as reader:
        found = [one for one in reader.events() if one.kind != "gap"]
        assert [one.level for one in reader.events() if one.kind == "gap"] == ["warning"]
        assert reader.first_altered_event() is None
        assert ("key" in reader.column_units("events")) is details
    assert len(found) == len(wanted)
    for ours, theirs in zip(found, wanted, strict=True):
        assert ours.level == theirs.level, theirs.text
        # The name of an input is in no sentence of its alarm's title.
        assert ours.key == theirs.key if details else theirs.key.startswith(ours.key), ours
        assert limit_change(ours) == limit_change(theirs)
        assert rest_signals(ours) == rest_signals(theirs)
        mine, engines = alarm_change(ours), alarm_change(theirs)
        if not details and mine is not None and mine.what == "raised" and "rule" in ours.key:
            mine = replace_words(mine, engines)
        assert mine == engines, theirs.text


def replace_words(change: AlarmChange, by: AlarmChange | None) -> AlarmChange:
    """Return a change with the words that the older form did not keep of a rule."""
    assert by is not None
    values = {name: getattr(change, name) for name in change.__struct_fields__}
    return AlarmChange(**{**values, "consequence": by.consequence, "action": by.action})
