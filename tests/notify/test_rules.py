"""Which fact becomes which message: pairs that close, what is told once, what is kept back."""

from __future__ import annotations

import datetime
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.config.notify import NotifySection
from rigapp.notify.facts import DiskSeen, Fact, Heartbeat, Observation, Silence
from rigapp.notify.message import Message
from rigapp.notify.rules import NotificationState, pass_time, update
from rigapp.schema.alarms import make_alarm
from rigapp.schema.messages import Alarm, FinishReason, RunState, Severity, Status
from rigapp.schema.notices import AlarmChanged, Finished, StateChanged

ALL = NotifySection(
    url="json://127.0.0.1",
    when=("critical", "warning", "end", "pause", "criterion", "silence", "disk", "daily"),
    recovered_after_s=10.0,
)
NIGHT = datetime.datetime(2026, 11, 23, 3, 0)


def alarm(key: str = "disk_slow", *, active: bool = True, state: str = "") -> Alarm:
    kind = make_alarm(key, seconds=3.0, force_N=400.0, limit_N=380.0)
    return Alarm(
        key, kind.kind.severity, kind.title, kind.sentence, kind.kind.consequence,
        kind.kind.action, 0.0, 7, active=active, state=state or "unacknowledged",
    )  # fmt: skip


def told(
    way: NotifySection,
    *seen: tuple[float, Observation],
    until: float = 1000.0,
    book: NotificationState | None = None,
) -> list[Message]:
    """Return what is told of facts at their times, a second at a time."""
    book, found = book or NotificationState(), list[Message]()
    facts = list(seen)
    for second in range(round(until) + 1):
        while facts and facts[0][0] <= second:
            at, what = facts.pop(0)
            book, messages = update(way, book, Fact(at, what))
            found += messages
        book, messages = pass_time(way, book, float(second), NIGHT)
        found += messages
    return found


def turns(messages: list[Message]) -> list[tuple[str, str]]:
    return [(one.key, one.turn) for one in messages]


def test_an_alarm_is_told_once_and_its_end_once() -> None:
    found = told(
        ALL,
        (1.0, AlarmChanged(alarm())),
        (2.0, AlarmChanged(alarm())),  # acknowledged, perhaps
        (50.0, AlarmChanged(alarm(active=False))),
    )
    assert turns(found) == [("alarm:disk_slow", "raised"), ("alarm:disk_slow", "recovered")]
    assert found[0].level == "warning"
    assert "What to do: Stop other programs" in found[0].text
    assert 60.0 <= found[1].at <= 61.0


def test_what_flutters_is_one_trouble() -> None:
    flutter = [(float(t), AlarmChanged(alarm(active=t % 6 < 3))) for t in range(300)]
    assert turns(told(ALL, *flutter)) == [
        ("alarm:disk_slow", "raised"), ("alarm:disk_slow", "recovered"),
    ]  # fmt: skip


@pytest.mark.parametrize(("when", "number"), [("warning", 2), ("critical", 0)])
def test_only_the_severities_that_are_wanted_are_told(when: str, number: int) -> None:
    way = msgspec.structs.replace(ALL, when=(when,))
    changes = (1.0, AlarmChanged(alarm())), (9.0, AlarmChanged(alarm(active=False)))
    assert len(told(way, *changes)) == number


def test_a_shelved_alarm_is_not_told_but_the_end_of_one_that_was_told_is() -> None:
    assert told(ALL, (1.0, AlarmChanged(alarm(state="shelved")))) == []
    found = told(
        ALL,
        (1.0, AlarmChanged(alarm())),
        (5.0, AlarmChanged(alarm(state="shelved"))),
        (9.0, AlarmChanged(alarm(active=False, state="shelved"))),
    )
    assert [one.turn for one in found] == ["raised", "recovered"]


def test_a_latched_alarm_whose_condition_is_over_says_that_it_waits() -> None:
    over = alarm("overload", active=False, state="latched")
    found = told(ALL, (1.0, AlarmChanged(alarm("overload"))), (2.0, AlarmChanged(over)))
    assert "until it is reset" in found[-1].text


def test_the_list_of_a_sign_of_life_tells_what_no_notice_told() -> None:
    listed = running(alarms=(alarm(),))
    empty = running()
    still = Heartbeat(Status.of_flat({"state": RunState.CONNECTING, "rig": "rig"}))
    assert turns(told(ALL, (1.0, listed), (3.0, still), until=900.0)) == [
        ("alarm:disk_slow", "raised")
    ]
    found = told(ALL, (1.0, listed), (2.0, listed), (3.0, empty))
    assert [one.turn for one in found] == ["raised", "recovered"]
    assert "sees it no more" in found[1].text


@pytest.mark.parametrize("status", ["complete", "stopped", "fault"])
def test_the_end_of_a_test_is_told_with_its_reason(status: str) -> None:
    end = Finished(FinishReason.LIMIT, "The force was too large.", status, 12345, "/data/t.h5")
    (found,) = told(ALL, (1.0, end))
    assert (found.key, found.turn) == ("end", "told")
    assert found.level == ("information" if status == "complete" else "critical")
    assert found.text.startswith("The force was too large.\n12,345 revolutions")


def test_a_pause_is_told_with_its_reason_and_its_end_only_where_the_test_goes_on() -> None:
    pause = (1.0, StateChanged(RunState.PAUSED, "pausing for Ada"))
    found = told(ALL, pause, (60.0, StateChanged(RunState.RUNNING, "")))
    assert turns(found) == [("pause", "raised"), ("pause", "recovered")]
    assert "pausing for Ada" in found[0].text
    assert len(told(ALL, pause, (60.0, StateChanged(RunState.STOPPED, "")))) == 1
    rest = (1.0, StateChanged(RunState.PAUSED, "step 1 is done", resting=True))
    assert told(ALL, rest, (60.0, StateChanged(RunState.RUNNING, ""))) == []


def running(**known: Any) -> Heartbeat:
    return Heartbeat(Status.of_flat(dict(state=RunState.RUNNING, rig="rig", **known)))


def near(percent: float) -> Heartbeat:
    return Heartbeat(
        Status.of_flat(
            {
                "state": RunState.RUNNING,
                "rig": "rig",
                "test": "Long test",
                "criterion_percent": percent,
                "criterion": "wear depth",
            }
        )
    )


def test_a_criterion_that_comes_near_is_told_once_though_it_flickers() -> None:
    signs = [(float(t), near(5.2 if t % 2 else 4.8)) for t in range(100)]
    assert turns(told(ALL, (0.0, near(50.0)), *signs)) == [("criterion", "raised")]
    assert [one.turn for one in told(ALL, (1.0, near(4.0)), (9.0, near(20.0)))] == [
        "raised", "recovered",
    ]  # fmt: skip


def test_a_full_disk_is_told_and_that_there_is_room_again() -> None:
    small, large = DiskSeen("/data", 10**9), DiskSeen("/data", 10**10)
    found = told(ALL, (1.0, large), (2.0, small), (3.0, small), (50.0, large))
    assert turns(found) == [("disk", "raised"), ("disk", "recovered")]
    assert "1 GB are free in /data" in found[0].text


def test_silence_is_told_by_its_length_or_at_once_when_the_process_is_gone() -> None:
    sign = running(test="Long test", revolution=420)
    assert told(ALL, (1.0, sign), (2.0, Silence(59.0, gone=False))) == []
    for silence in (Silence(61.0, gone=False), Silence(0.5, gone=True)):
        found = told(ALL, (1.0, sign), (2.0, silence), (3.0, silence), (9.0, sign))
        assert turns(found) == [("silence", "raised"), ("silence", "recovered")]
        assert "Long test at revolution 420" in found[0].text


def test_a_summary_comes_once_a_day_at_its_time_and_not_long_after_it() -> None:
    book, _ = update(
        ALL,
        NotificationState(),
        Fact(0.0, running(test="T", revolution=70)),
    )
    found: dict[str, int] = {}
    at = datetime.datetime(2026, 11, 23, 0, 0)
    while at < datetime.datetime(2026, 11, 25, 12, 0):
        book, messages = pass_time(ALL, book, at.timestamp(), at)
        found |= {f"{at:%d %H:%M}": len(messages)} if messages else {}
        at += datetime.timedelta(minutes=1)
    assert found == {"23 07:00": 1, "24 07:00": 1, "25 07:00": 1}
    late = datetime.datetime(2026, 11, 26, 8, 1)
    assert pass_time(ALL, book, late.timestamp(), late)[1] == ()


def test_a_summary_says_how_the_test_stands() -> None:
    sign = Heartbeat(
        Status.of_flat(
            {
                "state": RunState.RUNNING,
                "rig": "rig",
                "test": "Long test",
                "file": "/data/t.h5",
                "revolution": 5000,
                "planned": 21377,
                "worst_margin_percent": 12.0,
                "worst_margin": "overload",
                "alarms": (alarm(),),
            }
        )
    )
    book = msgspec.structs.replace(NotificationState(), status=sign.status, summary_revolution=3000)
    _, (found,) = pass_time(ALL, book, 0.0, datetime.datetime(2026, 11, 23, 7, 0))
    for words in ("5,000 of 21,377; 2,000 since", "12 % to overload", "Disk slow"):
        assert words in found.text


KEYS = ("disk_slow", "file_moved", "overload", "storage")
changes = st.tuples(
    st.floats(0.0, 30.0), st.sampled_from(KEYS), st.booleans(), st.sampled_from(["notice", "sign"])
)


@given(st.lists(changes, max_size=60), st.floats(0.0, 60.0))
def test_whatever_happens_raised_and_recovered_alternate_and_all_is_closed_in_the_end(
    steps: list[tuple[float, str, bool, str]], recovered_after_s: float
) -> None:
    way = msgspec.structs.replace(ALL, recovered_after_s=recovered_after_s)
    book, found, now = NotificationState(), list[Message](), 0.0
    active: dict[str, Alarm] = {}
    for wait, key, rises, how in steps:
        now += wait
        one = Alarm(key, Severity.WARNING, key, "c", "q", "a", now, 1, active=rises)
        active = {name: it for name, it in active.items() if name != key}
        active |= {key: one} if rises else {}
        seen: Observation = AlarmChanged(one)
        if how == "sign":
            seen = running(alarms=tuple(active.values()))
        book, messages = update(way, book, Fact(now, seen))
        found += messages
        book, messages = pass_time(way, book, now, NIGHT)
        found += messages
    open_now = {name.removeprefix("alarm:") for name in book.open}
    assert active.keys() <= open_now, "what holds was told and is not told to be over"
    book, messages = update(way, book, Fact(now, running()))
    found += messages
    book, messages = pass_time(way, book, now + 61.0, NIGHT)
    found += messages
    for key in KEYS:
        own = [one.turn for one in found if one.key == f"alarm:{key}"]
        assert own == ["raised", "recovered"] * (len(own) // 2)
    assert book.open == {}
