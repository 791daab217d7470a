"""Publish results to viewers: bounded, oldest dropped first, non-blocking.

A ``Subscription`` has the data for a display, a ``NoticeStream`` the milestones of a run for a
program. Both are thread-safe.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.messages import Prediction, Snapshot, Status, WornProfile
from rigapp.schema.notices import Committed, Notice

Array = NDArray[np.float64]


class NoticeStream:
    """Queue of the milestones of a run; when full, the oldest ``Committed`` is dropped first."""

    def __init__(self, bound: int = 4096) -> None:
        self._bound = bound
        self._items: deque[Notice] = deque()
        self._condition = threading.Condition()
        self.dropped = 0

    def put(self, notice: Notice) -> None:
        """Add a milestone, without blocking."""
        with self._condition:
            if len(self._items) >= self._bound:
                self._drop()
            self._items.append(notice)
            self._condition.notify_all()

    def get(self, timeout_s: float) -> Notice | None:
        """Return the oldest milestone, or None after the time-out."""
        with self._condition:
            self._condition.wait_for(lambda: bool(self._items), timeout_s)
            return self._items.popleft() if self._items else None

    def _drop(self) -> None:
        self.dropped += 1
        for index, item in enumerate(self._items):
            if isinstance(item, Committed):
                del self._items[index]
                return
        self._items.popleft()


class Subscription:
    """Data for one viewer; when full, the oldest are dropped."""

    def __init__(self, units: Mapping[str, str], rows: int) -> None:
        self._units = dict(units)
        self._rows: deque[Array] = deque(maxlen=rows)
        self._predictions: deque[Array] = deque(maxlen=rows)
        self._next_row = 0
        self._prediction: Prediction | None = None
        self._profile: WornProfile | None = None
        self._cycle: Any = None
        self._lock = threading.Lock()
        self.rows_dropped = 0
        self.on_news: Callable[[], object] = lambda: None
        """Called in the engine's thread when ``waits`` becomes true; must not wait."""

    def restart(self, first_row: int) -> None:
        """Start with another file and drop the rows of the previous one."""
        with self._lock:
            self._rows.clear()
            self._predictions.clear()
            self._prediction = None
            self._profile = None
            self._cycle = None
            self._next_row = first_row

    def add_row(self, row: Array, index: int, cycle: Any) -> None:
        """Add a row, its index in the file and a function that returns its complete cycle."""
        with self._lock:
            waited = self.waits
            self.rows_dropped += len(self._rows) == self._rows.maxlen
            self._rows.append(row)
            self._next_row = index + 1
            self._cycle = cycle
        if not waited:
            self.on_news()

    def add_prediction(
        self, values: Array, prediction: Prediction, profile: WornProfile | None = None
    ) -> None:
        """Add a prediction, and a new worn profile, if any."""
        with self._lock:
            waited = self.waits
            self._predictions.append(values)
            self._prediction = prediction
            self._profile = profile or self._profile
        if not waited:
            self.on_news()

    @property
    def waits(self) -> bool:
        """Return whether there is a new revolution or prediction."""
        return self._cycle is not None or self._prediction is not None

    def take(self, status: Callable[[], Status]) -> Snapshot:
        """Remove and return the data since the last call.

        status: of the engine, read after the rows. The cycle is calibrated here, in the caller's
        thread.
        """
        with self._lock:
            rows, predictions = list(self._rows), list(self._predictions)
            first = self._next_row - len(rows)
            cycle, prediction, profile = self._cycle, self._prediction, self._profile
            self._rows.clear()
            self._predictions.clear()
            self._cycle = self._prediction = self._profile = None
        now = status()
        engine = msgspec.structs.replace(now.engine, rows_dropped=self.rows_dropped)
        return Snapshot(
            status=msgspec.structs.replace(now, engine=engine),
            first_row=first,
            rows=np.array(rows, "<f8").tobytes(),
            predictions=np.array(predictions, "<f8").tobytes(),
            cycle=cycle() if cycle is not None else None,
            prediction=prediction,
            profile=profile,
            columns=self._units,
        )


class Publisher:
    """Publisher to all viewers; a viewer cannot delay the engine or make it fail.

    units: of the columns of a row, by name, in order.
    """

    def __init__(self, units: Mapping[str, str]) -> None:
        self._units = units
        self._subscriptions: tuple[Subscription, ...] = ()
        self._streams: tuple[NoticeStream, ...] = ()
        self._lock = threading.Lock()
        self.next_row = 0

    def subscribe(self, rows: int = 100_000) -> Subscription:
        """Return a new bounded subscription to rows, predictions and the latest cycle."""
        subscription = Subscription(self._units, rows)
        subscription.restart(self.next_row)
        with self._lock:
            self._subscriptions = (*self._subscriptions, subscription)
        return subscription

    def unsubscribe(self, subscription: Subscription) -> None:
        """Remove a viewer."""
        with self._lock:
            self._subscriptions = tuple(s for s in self._subscriptions if s is not subscription)

    def watch(self) -> NoticeStream:
        """Return a bounded stream of Committed, StateChanged, AlarmChanged and Finished."""
        stream = NoticeStream()
        with self._lock:
            self._streams = (*self._streams, stream)
        return stream

    def unwatch(self, stream: NoticeStream) -> None:
        """Remove a stream."""
        with self._lock:
            self._streams = tuple(s for s in self._streams if s is not stream)

    def restart(self, first_row: int) -> None:
        """Start another file in all subscriptions."""
        self.next_row = first_row
        for subscription in self._subscriptions:
            subscription.restart(first_row)

    def row(self, row: Array, cycle: Any) -> None:
        """Publish a stored row."""
        for subscription in self._subscriptions:
            subscription.add_row(row, self.next_row, cycle)
        self.next_row += 1

    def prediction(self, values: Array, prediction: Prediction) -> None:
        """Publish a prediction, without its checkpoint, which is for the file only."""
        published = msgspec.structs.replace(prediction, profile=None, checkpoint=b"")
        for subscription in self._subscriptions:
            subscription.add_prediction(values, published, prediction.profile)

    def notice(self, notice: Notice) -> None:
        """Publish a milestone."""
        for stream in self._streams:
            stream.put(notice)
