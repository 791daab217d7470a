"""Slow channels: values that a device measures occasionally, each with its age.

Each slow device is read by its own thread; values of the drive are from its status, which the
engine polls anyway. They never delay a revolution or end a test: without replies of a device, its
age grows and its value becomes NaN, a warning is raised, and the device is reopened until it
replies.
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
"""Reading period of a device: rooms and bushings take minutes to change by the resolution of such a
device, and a usual line takes 0.1 s for a reply."""

SILENT_S = 10.0
"""Time without a reply after which there is no value, and a warning: ten failed requests in a row
are not a transient disturbance of the line."""

REOPEN_S, LONGEST_REOPEN_S = 5.0, 60.0
"""First and longest pause between attempts to open a lost device. It doubles with each failure, so
that a device that is absent for days is not opened 100,000 times, and one that returns is opened
within a minute."""


FIRST_S = 2.0
"""Longest wait of a connection for the first replies, so that the first values shown are valid; a
connected device replies within a fraction of it."""


@dataclass(frozen=True, slots=True)
class Reading:
    """Value and host time (s, monotonic) of its reading."""

    value: float
    host_s: float


NEVER = Reading(math.nan, -math.inf)
MOST_READINGS = 4096
"""Stored readings per quantity: 7 min of a drive that is read ten times per second, the longest
turn."""


def averages(readings: Iterable[Reading], begin_s: float, end_s: float) -> dict[str, float]:
    """Return ``AVERAGES`` of the readings in an interval, NaN without any, and their number."""
    values = [reading.value for reading in readings if begin_s < reading.host_s <= end_s]
    values = [value for value in values if math.isfinite(value)]
    count = len(values)
    if not count:
        return {**dict.fromkeys(AVERAGES, math.nan), "readings": 0}
    mean = math.fsum(values) / count
    rms = math.sqrt(math.fsum(value * value for value in values) / count)
    return {"mean": mean, "rms": rms, "max": max(values), "readings": count}


def reading_of(value: float, host_s: float, before: Reading | None) -> Reading:
    """Return the reading of a reply; for NaN with the host time of the previous one."""
    if math.isfinite(value):
        return Reading(value, host_s)
    return Reading(math.nan, before.host_s if before is not None else host_s)


def keep(recent: dict[str, deque[Reading]], name: str, reading: Reading) -> None:
    """Store a reading among the last ones of its quantity, dropping the oldest."""
    recent.setdefault(name, deque(maxlen=MOST_READINGS)).append(reading)


class SlowDevice:
    """Slow source with the thread that reads it.

    on_death: called if the thread ends by an unexpected error of a driver.
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
        """Return whether the device is open and its last reply is recent."""
        return self._open and time.monotonic() - self.answered_s < SILENT_S

    def reading(self, quantity: str) -> Reading:
        """Return the latest reading of a quantity."""
        return self._readings.get(quantity, NEVER)

    def recent(self, quantity: str) -> list[Reading]:
        """Return the last readings of a quantity, oldest first."""
        return list(self._recent.get(quantity, ()))

    def await_first(self, timeout_s: float) -> bool:
        """Wait for the first reply or error; return False after the time-out."""
        return self._answered.wait(timeout_s)

    def close(self) -> None:
        """Close the device, from its thread or after that has ended."""
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
            self._close_failed(error)
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

    def _close_failed(self, error: DeviceError) -> None:
        """Close the device, to be reopened, as its state after a failure is unknown."""
        self.errors += 1
        self.last_error = error
        self._answered.set()
        self.close()
        self.worker.pause(self._reopen_s)
        self._reopen_s = min(2.0 * self._reopen_s, LONGEST_REOPEN_S)


class SlowChannels:
    """Values of a rig's slow channels; thread-safe.

    drive: name of the drive; status: returns its latest status, None before the first. age_s:
    returns the age of a host time, for time-outs.
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
        self._status_ns = 0

    def take_drive(self) -> None:
        """Store the values of the drive's latest status; called after each reply."""
        status = self._status()
        if status is None or status.host_time_ns == self._status_ns:
            return
        self._status_ns = status.host_time_ns
        host_s = status.host_time_ns * 1e-9
        for channel in self.channels:
            if channel.device == self._drive:
                before = self._drive_readings.get(channel.input)
                value = float(getattr(status, channel.input))
                self._drive_readings[channel.input] = reading = reading_of(value, host_s, before)
                keep(self._drive_recent, channel.name, reading)

    def at(self, channel: Channel, host_s: float) -> tuple[float, float]:
        """Return the value of a channel at a host time, NaN if it is too old, and its age, s."""
        reading = self._reading(channel)
        age_s = max(0.0, host_s - max(reading.host_s, self._since_s))
        return (reading.value if age_s < SILENT_S else math.nan), age_s

    def columns(self, host_time_ns: int, lasted_s: float) -> dict[str, float]:
        """Return the columns of all channels for a revolution, by name.

        host_time_ns: of its end. lasted_s: its duration.
        """
        result: dict[str, float] = {}
        end_s = host_time_ns * 1e-9
        for channel in self.channels:
            result[channel.name], result[f"{channel.name}_age"] = self.at(channel, end_s)
            if channel.averaged:
                statistics = averages(self._recent(channel), end_s - lasted_s, end_s)
                result |= {f"{channel.name}_{name}": value for name, value in statistics.items()}
        return result

    def silent(self) -> Iterator[tuple[SlowDevice, float]]:
        """Yield the devices without recent replies, with the time since the last one, s."""
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
