"""Read a RoboClaw's state in as few packets as the drive allows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from rigapp_drivers.api import ProtocolError, ReplyTimeout
from rigapp_drivers.roboclaw.link import Link
from rigapp_drivers.roboclaw.protocol import Command, combined_status_of, count_of, speed_of
from rigapp_drivers.spindles import WATCHDOG_PERIOD

SLOW_PERIOD: Final = 8  # supply and temperature change slowly; read in every eighth status
_TICK_LIMIT: Final = 1 << 32
_TICK_NEAR_WRAP: Final = 1_000_000  # ms before the clock wraps, far longer than between two calls


@dataclass(frozen=True, slots=True)
class Readings:
    """One status in the drive's units and direction; None if not reported by the drive."""

    state: int
    count: int
    speed: int
    current: int
    main_voltage: int
    temperature: int
    setpoint: int | None = None
    pwm: int | None = None
    tick: int | None = None


def can_combine(link: Link) -> bool:
    """Return whether the drive has command 73, by one read."""
    try:
        link.read(Command.COMBINED_STATUS, tries=2)
    except (ReplyTimeout, ProtocolError):
        return False
    return True


class StatusReader:
    """Read one motor: by command 73 alone, or by four packets and periodically two slow ones."""

    def __init__(self, link: Link, motor: int, combined: bool) -> None:
        self._link = link
        self._motor = motor - 1
        self._combined = combined
        self._polls = 0
        self._slow = (0, 0)
        self._tick: int | None = None

    def read(self) -> Readings:
        """Return the present readings; errors as ``Link.read``."""
        readings = self._in_one() if self._combined else self._in_parts()
        self._polls += 1
        return readings

    @property
    def watchdog_is_due(self) -> bool:
        """Return whether the readback of the serial time-out is due."""
        return self._polls % WATCHDOG_PERIOD == 0

    def has_restarted(self, readings: Readings) -> bool:
        """Return whether the drive's clock decreased since the last call, except by wrapping."""
        before, self._tick = self._tick, readings.tick
        if before is None or readings.tick is None:
            return False
        return readings.tick < before < _TICK_LIMIT - _TICK_NEAR_WRAP

    def _in_one(self) -> Readings:
        status = combined_status_of(self._link.read(Command.COMBINED_STATUS))
        return Readings(
            state=status.state,
            count=status.counts[self._motor],
            speed=status.speeds[self._motor],
            current=status.currents[self._motor],
            main_voltage=status.main_voltage,
            temperature=max(status.temperatures),
            setpoint=status.setpoints[self._motor],
            pwm=status.pwm[self._motor],
            tick=status.tick,
        )

    def _in_parts(self) -> Readings:
        (state,) = self._link.read(Command.STATUS)
        count = count_of(self._link.read(Command.COUNT_M1 + self._motor))
        speed = speed_of(self._link.read(Command.SPEED_M1 + self._motor))
        currents = self._link.read(Command.CURRENTS)
        if self._polls % SLOW_PERIOD == 0:
            (main,) = self._link.read(Command.MAIN_VOLTAGE)
            (temperature,) = self._link.read(Command.TEMPERATURE_1)
            self._slow = (main, temperature)
        return Readings(state, count, speed, currents[self._motor], *self._slow)
