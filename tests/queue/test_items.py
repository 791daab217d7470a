"""A queue as a value: what it holds, which test is next, what a fault and a restart leave."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.config.errors import UnusableInput
from rigapp.queue.items import (
    MOST_DONE,
    MOST_LEFT,
    Queue,
    added,
    after_finish,
    at_work,
    begun,
    cut_off,
    ended,
    halted,
    line,
    removed,
)
from rigapp.schema.messages import FinishReason
from rigapp.schema.notices import Finished
from rigapp.schema.queue import ItemState


def five() -> Queue:
    return added(Queue(rig="rig.toml"), [f"{name}.toml" for name in "abcde"], "results")


def finish(file: str, status: str = "complete") -> Finished:
    reason = FinishReason.COMPLETE if status == "complete" else FinishReason.DEVICE
    return Finished(reason, f"it was {status}.", status, 3, file)


def stages(queue: Queue) -> list[str]:
    return [one.state.value for one in queue.items]


def test_tests_are_done_in_their_order() -> None:
    queue = at_work(five())
    for number in range(1, 6):
        assert queue.next is not None
        assert queue.next.number == number
        queue = after_finish(begun(queue, number, f"{number}.h5"), finish(f"{number}.h5"))
    assert stages(queue) == ["done"] * 5
    assert not queue.working
    assert queue.next is None


def test_a_fault_stops_the_queue_and_its_test_is_the_next_one() -> None:
    queue = begun(at_work(five()), 1, "1.h5")
    queue = after_finish(queue, finish("1.h5", "fault"))
    assert stages(queue) == ["stopped", "waiting", "waiting", "waiting", "waiting"]
    assert not queue.working
    assert queue.next is not None
    assert (queue.next.number, queue.next.file, queue.next.sentence) == (1, "1.h5", "it was fault.")
    # somebody goes on with it by hand, to its end: the queue stands, and the next one is next
    queue = after_finish(queue, finish("1.h5"))
    assert stages(queue)[0] == "done"
    assert not queue.working
    assert queue.next is not None
    assert queue.next.number == 2


def test_a_queue_that_is_halted_begins_nothing_and_lets_the_test_end() -> None:
    queue = halted(begun(at_work(five()), 1, "1.h5"))
    assert queue.running is not None
    queue = after_finish(queue, finish("1.h5"))
    assert stages(queue)[:2] == ["done", "waiting"]
    assert not queue.working
    assert begun(queue, 2, "2.h5") == queue


def test_a_restart_leaves_what_ran_as_stopped() -> None:
    queue = cut_off(begun(at_work(five()), 1, "1.h5"))
    assert stages(queue)[:2] == ["stopped", "waiting"]
    assert "computer" in queue.items[0].sentence
    assert not queue.working
    assert cut_off(queue) == queue


def test_another_file_is_nothing_to_the_queue() -> None:
    queue = begun(at_work(five()), 1, "1.h5")
    assert after_finish(queue, finish("other.h5")) == queue


def test_numbers_are_never_given_twice_and_what_runs_stays() -> None:
    queue = removed(five(), [2, 5])
    assert [one.number for one in added(queue, ["f.toml"], "r").items] == [1, 3, 4, 6]
    with pytest.raises(UnusableInput, match="no test 2"):
        removed(queue, [1, 2])
    with pytest.raises(UnusableInput, match="Test 1 runs"):
        removed(begun(at_work(queue), 1, "1.h5"), [1])


def test_a_queue_is_bounded() -> None:
    full = added(Queue(), ["a.toml"] * MOST_LEFT, "r")
    with pytest.raises(UnusableInput, match=f"{MOST_LEFT} tests at most"):
        added(full, ["a.toml"], "r")
    queue = Queue()
    for _ in range(MOST_DONE + 3):
        queue = added(queue, ["a.toml"], "r")
        number = queue.given
        queue = ended(begun(at_work(queue), number, f"{number}.h5"), number, "", done=True)
    assert len(queue.items) == MOST_DONE
    assert queue.items[-1].number == MOST_DONE + 3


def test_a_line_names_number_stage_file_and_end() -> None:
    queue = ended(begun(at_work(five()), 1, "/r/a-1.h5"), 1, "Overload.", done=False)
    assert line(queue.items[0]) == "   1  stopped  a-1.h5  Overload."
    assert line(queue.items[1]) == "   2  waiting  b.toml"


@given(
    st.lists(
        st.sampled_from(["add", "start", "done", "fault", "stop", "restart", "remove"]), max_size=30
    )
)
def test_at_most_one_runs_and_nothing_is_done_out_of_order(deeds: list[str]) -> None:
    queue = Queue()
    for deed in deeds:
        running, following = queue.running, queue.next
        if deed == "add":
            queue = added(queue, ["a.toml"], "r")
        elif deed == "start" and running is None and following is not None:
            number = following.number
            queue = begun(at_work(queue), number, following.file or f"{number}.h5")
        elif deed in ("done", "fault") and running is not None:
            queue = after_finish(
                queue, finish(running.file, "complete" if deed == "done" else "fault")
            )
        elif deed == "stop":
            queue = halted(queue)
        elif deed == "restart":
            queue = cut_off(queue)
        elif deed == "remove" and running is None and following is not None:
            queue = removed(queue, [following.number])
        left = [one.state for one in queue.items if one.state is not ItemState.DONE]
        assert all(state is ItemState.WAITING for state in left[1:])
        numbers = [one.number for one in queue.items]
        assert numbers == sorted(set(numbers))
        assert not queue.working or queue.next is not None
