"""Slow channels: values that a device measures now and then, each with its age.

Each slow device has a thread of its own that reads it; those of the drive come from the answers
that the engine polls anyway. Nothing here delays a revolution or ends a test: a device that is
silent gives no value and a growing age, raises a warning, and is opened again until it answers.
"""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from rigapp.process.threads import Worker
from rigapp.schema.channels import AVERAGES, Channel
from rigapp_drivers.api import DeviceError, DriveStatus, Identity, SlowRequest
from rigapp_drivers.edge import GuardedSlow

PERIOD_S = 1.0
"""A device is read once in so long: rooms and bushings take minutes to change by what such a
device resolves, and a usual line takes 0.1 s for an answer."""

SILENT_S = 10.0
"""Without an answer for so long there is no value any more, and a warning: ten questions in a row
are no passing disturbance of the line."""

REOPEN_S, LONGEST_REOPEN_S = 5.0, 60.0
"""Between two attempts to open a lost device: a port that hangs takes some of it. The
pause doubles with each failure: a device that is gone for days is not tried 100,000 times, and one
that returns is found within a minute."""


FIRST_S = 2.0
"""A connection waits so long for the first answers, so that the first values shown are true; a
device that is there answers within a fraction of it."""


@dataclass(frozen=True, slots=True)
class Reading:
    """One value and the host time (s, monotonic) at which it was read."""

    value: float
    host_s: float


NEVER = Reading(math.nan, -math.inf)
MOST_READINGS = 4096
"""Kept of each quantity: a drive that is read ten times a second fills 7 min, the longest turn."""


def averages(readings: Iterable[Reading], begin_s: float, end_s: float) -> dict[str, float]:
    """Return ``AVERAGES`` of the readings in a time, NaN without one, and how many there are."""
    values = [reading.value for reading in readings if begin_s < reading.host_s <= end_s]
    values = [value for value in values if math.isfinite(value)]
    count = len(values)
    if not count:
        return {**dict.fromkeys(AVERAGES, math.nan), "readings": 0}
    mean = math.fsum(values) / count
    rms = math.sqrt(math.fsum(value * value for value in values) / count)
    return {"mean": mean, "rms": rms, "max": max(values), "readings": count}


def reading_of(value: float, host_s: float, before: Reading | None) -> Reading:
    """Return the reading of an answer; without a number it is None, and the age keeps growing."""
    if math.isfinite(value):
        return Reading(value, host_s)
    return Reading(math.nan, before.host_s if before is not None else host_s)


def keep(recent: dict[str, deque[Reading]], name: str, reading: Reading) -> None:
    """Add a reading to the last ones of its quantity; the oldest are dropped."""
    recent.setdefault(name, deque(maxlen=MOST_READINGS)).append(reading)


class SlowDevice:
    """A slow source with the thread that reads it.

    on_death: called when the thread ends by an error that no driver should raise.
    """

    def __init__(
        self,
        source: GuardedSlow,
        request: SlowRequest,
        on_open: Callable[[Identity, Mapping[str, str | float | int]], None],
        on_death: Callable[[Worker, BaseException], None],
        silence_s: float,
    ) -> None:
        self.source = source
        self.errors = 0
        self.last_error: DeviceError | None = None
        self.answered_s = time.monotonic()
        self.worker = Worker(f"ask {source.name}", self._step, on_death, silence_s)
        self._request = request
        self._on_open = on_open
        self._open = False
        self._reopen_s = REOPEN_S
        self._answered = threading.Event()
        self._readings: dict[str, Reading] = {}
        self._recent: dict[str, deque[Reading]] = {}

    @property
    def answering(self) -> bool:
        """Return whether the device is open and has answered lately."""
        return self._open and time.monotonic() - self.answered_s < SILENT_S

    def reading(self, quantity: str) -> Reading:
        """Return the newest reading of a quantity."""
        return self._readings.get(quantity, NEVER)

    def recent(self, quantity: str) -> list[Reading]:
        """Return the last readings of a quantity, oldest first."""
        return list(self._recent.get(quantity, ()))

    def await_first(self, timeout_s: float) -> bool:
        """Wait until it has answered or failed to; False when neither came in time."""
        return self._answered.wait(timeout_s)

    def close(self) -> None:
        """Release the device, in its thread or after that has ended."""
        self._open = False
        self.source.close()

    def _step(self) -> None:
        try:
            if not self._open:
                identity = self.source.open()
                self._on_open(identity, self.source.configure(self._request))
                self._open = True
            values = self.source.read()
        except DeviceError as error:
            self._failed(error)
            return
        now = time.monotonic()
        self._readings = {
            name: reading_of(value, now, self._readings.get(name)) for name, value in values.items()
        }
        for name, reading in self._readings.items():
            keep(self._recent, name, reading)
        self.answered_s, self.last_error, self._reopen_s = now, None, REOPEN_S
        self._answered.set()
        self.worker.pause(PERIOD_S)

    def _failed(self, error: DeviceError) -> None:
        """Close the device, to be opened again: its state after a failure is unknown."""
        self.errors += 1
        self.last_error = error
        self._answered.set()
        self.close()
        self.worker.pause(self._reopen_s)
        self._reopen_s = min(2.0 * self._reopen_s, LONGEST_REOPEN_S)


class SlowChannels:
    """Return the values of a rig's slow channels; any thread may call it.

    drive: name of the drive; status: its newest status, None before the first. age_s: how long ago
    a host time was, to judge a silence by.
    """

    def __init__(
        self,
        channels: Iterable[Channel],
        devices: Iterable[SlowDevice],
        drive: str,
        status: Callable[[], DriveStatus | None],
        age_s: Callable[[float], float],
    ) -> None:
        self.channels = tuple(channels)
        self.devices = {device.source.name: device for device in devices}
        self._drive = drive
        self._status = status
        self._age_s = age_s
        self._since_s = time.monotonic()
        self._drive_readings: dict[str, Reading] = {}
        self._drive_recent: dict[str, deque[Reading]] = {}
        self._taken_ns = 0

    def take_drive(self) -> None:
        """Take the drive's newest status; called after every answer."""
        status = self._status()
        if status is None or status.host_time_ns == self._taken_ns:
            return
        self._taken_ns = status.host_time_ns
        host_s = status.host_time_ns * 1e-9
        for channel in self.channels:
            if channel.device == self._drive:
                before = self._drive_readings.get(channel.input)
                value = float(getattr(status, channel.input))
                self._drive_readings[channel.input] = reading = reading_of(value, host_s, before)
                keep(self._drive_recent, channel.name, reading)

    def at(self, channel: Channel, host_s: float) -> tuple[float, float]:
        """Return the value of a channel at a host time, NaN when it is too old, and its age, s."""
        reading = self._reading(channel)
        age_s = max(0.0, host_s - max(reading.host_s, self._since_s))
        return (reading.value if age_s < SILENT_S else math.nan), age_s

    def columns(self, host_time_ns: int, lasted_s: float) -> dict[str, float]:
        """Return the columns of all of them for a revolution, by name.

        host_time_ns: its end. lasted_s: how long it took.
        """
        result: dict[str, float] = {}
        end_s = host_time_ns * 1e-9
        for channel in self.channels:
            result[channel.name], result[f"{channel.name}_age"] = self.at(channel, end_s)
            if channel.averaged:
                kept = averages(self._recent(channel), end_s - lasted_s, end_s)
                result |= {f"{channel.name}_{name}": value for name, value in kept.items()}
        return result

    def silent(self) -> Iterator[tuple[SlowDevice, float]]:
        """Yield the devices that have not answered for too long, with the seconds."""
        for device in self.devices.values():
            age_s = self._age_s(device.answered_s)
            if age_s >= SILENT_S:
                yield device, age_s

    def _recent(self, channel: Channel) -> list[Reading]:
        if channel.device != self._drive:
            return self.devices[channel.device].recent(channel.input)
        return list(self._drive_recent.get(channel.name, ()))

    def _reading(self, channel: Channel) -> Reading:
        if channel.device != self._drive:
            return self.devices[channel.device].reading(channel.input)
        return self._drive_readings.get(channel.input, NEVER)
