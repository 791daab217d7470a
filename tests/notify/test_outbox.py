"""An outbox loses nothing that it has room for, and sends no oftener than is wanted."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.notify.message import Level, Message, worded
from rigapp.notify.outbox import (
    HOUR_S,
    LONGEST_WAIT_S,
    MOST_WAITING,
    Outbox,
    due,
    failed,
    put,
    sent,
)


def message(number: int, level: Level = "warning") -> Message:
    return Message(f"alarm:{number}", "raised", level, f"Title {number}", "Text.", float(number))


def filled(number: int) -> Outbox:
    outbox = Outbox()
    for one in range(number):
        outbox = put(outbox, message(one))
    return outbox


def test_messages_go_one_by_one_in_their_order() -> None:
    outbox, order = filled(3), list[str]()
    while batch := due(outbox, 1000.0, 20):
        order += [one.key for one in batch]
        outbox = sent(outbox, batch, 1000.0)
    assert order == ["alarm:0", "alarm:1", "alarm:2"]


def test_what_the_hour_has_no_room_for_goes_in_one() -> None:
    outbox = filled(5)
    batch = due(outbox, 0.0, 2)
    assert len(batch) == 5
    title, text = worded("Rig", batch)
    assert title == "Rig: 5 messages"
    assert all(f"Title {number}" in text for number in range(5))
    assert sent(outbox, batch, 0.0).waiting == ()


def test_after_failures_it_waits_longer_each_time_but_never_long() -> None:
    outbox, waits, now = filled(1), list[float](), 0.0
    for _ in range(12):
        outbox = failed(outbox, now)
        waits.append(outbox.not_before - now)
        assert due(outbox, now, 20) == ()
        now = outbox.not_before
        assert due(outbox, now, 20) == outbox.waiting
    assert waits[:4] == [5.0, 10.0, 20.0, 40.0]
    assert waits[-1] == LONGEST_WAIT_S
    assert outbox.failing_since == 0.0 or outbox.failing_since <= now


def test_a_clock_that_is_set_back_keeps_nothing_waiting_for_days() -> None:
    outbox = failed(filled(1), 1e9)
    assert due(outbox, 1e9 - 86400.0, 20) == outbox.waiting


def test_of_too_many_the_oldest_goes_that_is_not_critical() -> None:
    outbox = put(Outbox(), message(-1, "critical"))
    for number in range(MOST_WAITING + 5):
        outbox = put(outbox, message(number))
    assert len(outbox.waiting) == MOST_WAITING
    assert outbox.lost == 6
    assert outbox.waiting[0].key == "alarm:-1"
    assert outbox.waiting[-1].key == f"alarm:{MOST_WAITING + 4}"


steps = st.lists(st.tuples(st.floats(0.0, 900.0), st.integers(0, 4), st.booleans()), max_size=120)


@given(steps, st.integers(1, 6))
def test_in_no_hour_more_are_sent_than_wanted_and_each_message_arrives_once(
    course: list[tuple[float, int, bool]], most_per_hour: int
) -> None:
    outbox, now, number = Outbox(), 0.0, 0
    times, arrived = list[float](), list[str]()
    for wait, new, works in course:
        now += wait
        for _ in range(new):
            outbox = put(outbox, message(number))
            number += 1
        batch = due(outbox, now, most_per_hour)
        if batch and works:
            times.append(now)
            arrived += [one.key for one in batch]
            outbox = sent(outbox, batch, now)
        elif batch:
            outbox = failed(outbox, now)
    for at in times:
        assert sum(at <= other < at + HOUR_S for other in times) <= most_per_hour
    lost = outbox.lost
    while outbox.waiting:
        now += LONGEST_WAIT_S + HOUR_S
        batch = due(outbox, now, most_per_hour)
        assert batch, "what waits goes in the end"
        arrived += [one.key for one in batch]
        outbox = sent(outbox, batch, now)
    assert len(arrived) == len(set(arrived)), "none arrives twice"
    if not lost:
        assert arrived == [f"alarm:{one}" for one in range(number)]


@pytest.mark.parametrize("number", [1, 20])
def test_the_text_of_any_batch_is_bounded(number: int) -> None:
    long = Message("k", "raised", "critical", "Title", "x" * 10_000, 0.0)
    assert len(worded("Rig", [long] * number)[1]) < 4000
