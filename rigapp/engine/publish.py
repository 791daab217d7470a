"""Hand results to viewers: bounded, drop-oldest, never waiting for anyone.

A ``Subscription`` carries data for a screen, a ``NoticeStream`` the milestones of a run for a
program that follows it. Both may be taken from any thread.
"""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.messages import (
    Cycle,
    Event,
    Prediction,
    WornProfile,
)
from rigapp.schema.notices import Committed, Notice

Array = NDArray[np.float64]


class NoticeStream:
    """Queue the milestones of a run; when full, the oldest ``Committed`` goes first."""

    def __init__(self, bound: int = 4096) -> None:
        self._bound = bound
        self._items: deque[Notice] = deque()
        self._condition = threading.Condition()
        self.dropped = 0

    def put(self, notice: Notice) -> None:
        """Add a milestone; never waits."""
        with self._condition:
            if len(self._items) >= self._bound:
                self._drop()
            self._items.append(notice)
            self._condition.notify_all()

    def get(self, timeout_s: float) -> Notice | None:
        """Return the oldest milestone, or None when none came in time."""
        with self._condition:
            self._condition.wait_for(lambda: bool(self._items), timeout_s)
            return self._items.popleft() if self._items else None

    def _drop(self) -> None:
        self.dropped += 1
        for place, item in enumerate(self._items):
            if isinstance(item, Committed):
                del self._items[place]
                return
        self._items.popleft()


@dataclass(frozen=True, slots=True, eq=False)
class Update:
    """Carry what is new since the last take.

    rows: (n, columns) of ``revolution_columns``; first_row: place of the first in the file;
    predictions: (m, columns) of ``prediction_columns``; cycle, prediction, profile: the newest,
    None when there is none since the last take.
    """

    rows: Array
    first_row: int
    predictions: Array
    events: tuple[Event, ...]
    cycle: Cycle | None
    prediction: Prediction | None
    profile: WornProfile | None = None


class Subscription:
    """Collect for one viewer; what it does not take in time is dropped, oldest first."""

    def __init__(self, columns: int, prediction_columns: int, rows: int, events: int) -> None:
        self._columns = columns
        self._prediction_columns = prediction_columns
        self._rows: deque[Array] = deque(maxlen=rows)
        self._predictions: deque[Array] = deque(maxlen=rows)
        self._events: deque[Event] = deque(maxlen=events)
        self._next_row = 0
        self._prediction: Prediction | None = None
        self._profile: WornProfile | None = None
        self._cycle: Any = None
        self._lock = threading.Lock()
        self.rows_dropped = 0
        self.events_dropped = 0

    def _full(self, queue: deque[Any]) -> bool:
        return queue.maxlen is not None and len(queue) >= queue.maxlen

    def restart(self, first_row: int) -> None:
        """Begin with another file: rows of the last one are forgotten."""
        with self._lock:
            self._rows.clear()
            self._predictions.clear()
            self._prediction = None
            self._profile = None
            self._cycle = None
            self._next_row = first_row

    def add_row(self, row: Array, place: int, cycle: Any) -> None:
        """Add a row, its place in the file and a maker of its whole cycle."""
        with self._lock:
            if self._full(self._rows):
                self.rows_dropped += 1
            self._rows.append(row)
            self._next_row = place + 1
            self._cycle = cycle

    def add_event(self, event: Event) -> None:
        """Add an event."""
        with self._lock:
            if self._full(self._events):
                self.events_dropped += 1
            self._events.append(event)

    def add_prediction(
        self, values: Array, prediction: Prediction, profile: WornProfile | None = None
    ) -> None:
        """Add a prediction, and a worn profile where there is a new one."""
        with self._lock:
            self._predictions.append(values)
            self._prediction = prediction
            self._profile = profile or self._profile

    def take(self) -> Update:
        """Return what is new, and forget it. The cycle is calibrated here, in the caller's time."""
        with self._lock:
            rows, predictions = list(self._rows), list(self._predictions)
            events = tuple(self._events)
            first = self._next_row - len(rows)
            cycle, prediction, profile = self._cycle, self._prediction, self._profile
            self._rows.clear()
            self._predictions.clear()
            self._events.clear()
            self._cycle = self._prediction = self._profile = None
        return Update(
            rows=np.array(rows).reshape(-1, self._columns),
            first_row=first,
            predictions=np.array(predictions).reshape(-1, self._prediction_columns),
            events=events,
            cycle=cycle() if cycle is not None else None,
            prediction=prediction,
            profile=profile,
        )


class Publisher:
    """Reach every viewer; a viewer can neither delay nor fail the engine."""

    def __init__(self, columns: int, prediction_columns: int) -> None:
        self._columns = columns
        self._prediction_columns = prediction_columns
        self._subscriptions: tuple[Subscription, ...] = ()
        self._streams: tuple[NoticeStream, ...] = ()
        self._lock = threading.Lock()
        self.next_row = 0

    def subscribe(self, rows: int = 100_000, events: int = 10_000) -> Subscription:
        """Return a bounded collection of rows, events, predictions and the newest cycle."""
        one = Subscription(self._columns, self._prediction_columns, rows, events)
        one.restart(self.next_row)
        with self._lock:
            self._subscriptions = (*self._subscriptions, one)
        return one

    def unsubscribe(self, one: Subscription) -> None:
        """Forget a viewer."""
        with self._lock:
            self._subscriptions = tuple(s for s in self._subscriptions if s is not one)

    def watch(self, bound: int = 4096) -> NoticeStream:
        """Return a bounded stream of Committed, StateChanged, AlarmChanged and Finished."""
        stream = NoticeStream(bound)
        with self._lock:
            self._streams = (*self._streams, stream)
        return stream

    def unwatch(self, stream: NoticeStream) -> None:
        """Forget a follower."""
        with self._lock:
            self._streams = tuple(s for s in self._streams if s is not stream)

    def restart(self, first_row: int) -> None:
        """Tell every viewer that another file begins."""
        self.next_row = first_row
        for one in self._subscriptions:
            one.restart(first_row)

    def row(self, row: Array, cycle: Any) -> None:
        """Publish a row that is in the file."""
        for one in self._subscriptions:
            one.add_row(row, self.next_row, cycle)
        self.next_row += 1

    def event(self, event: Event) -> None:
        """Publish an event."""
        for one in self._subscriptions:
            one.add_event(event)

    def prediction(self, values: Array, prediction: Prediction) -> None:
        """Publish a prediction; its checkpoint is for the file alone."""
        shown = msgspec.structs.replace(prediction, profile=None, checkpoint=b"")
        for one in self._subscriptions:
            one.add_prediction(values, shown, prediction.profile)

    def notice(self, notice: Notice) -> None:
        """Publish a milestone."""
        for stream in self._streams:
            stream.put(notice)
