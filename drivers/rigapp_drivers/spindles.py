"""Common parts of the spindle drivers: checks of requests, and messages on watchdog stops."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from typing import Any, Final

from rigapp.texts import say, sentence_of_error
from rigapp_drivers.api import DriveRequest, Line, Named, SettingRefused, SettingsLost, SettingSpec

_log = logging.getLogger(__name__)

QUANTITIES: Final = ("current_A", "supply_V", "temperature_C", "torque_Nm")
"""Condition of a drive in addition to its motion: fields of ``DriveStatus``."""
NEEDED: Final = {"torque_Nm": "torque_constant_Nm_per_A"}
TORQUE_CONSTANT: Final = SettingSpec(
    float,
    0.0,
    say(
        "Torque of the motor for 1 A, from its data sheet, for the channel torque_Nm; 0: not known."
    ),
    0.0,
    1e3,
)
WATCHDOG_PERIOD: Final = 8
"""Calls of ``status`` between two readings of the watchdog's setting: 0.8 s at 0.1 s."""
_ROUNDING: Final = 1e-9  # relative; a speed may exceed the maximum by a conversion's rounding


def silence_message(silence_s: float) -> str:
    """Return the message of a watchdog stop; silence_s: duration of the host's silence."""
    return say(
        "watchdog: the host was silent for {:.2f} s and the drive has stopped the motor", silence_s
    )


def settings_lost(who: Named, watchdog_s: float, set_s: float) -> SettingsLost:
    """Return the error of a drive that lost its settings; watchdog_s: 0 if it has none."""
    what = say("speed unit, limits or heartbeat")
    if watchdog_s != set_s:
        what = say("watchdog {:g} s instead of {:g} s", watchdog_s, set_s)
    return SettingsLost.at(
        who,
        "the drive has lost its settings ({}), as after a restart; check its supply,"
        " then connect again.",
        what,
    )


def torque_Nm(current_A: float, settings: Mapping[str, Any]) -> float:
    """Return the motor's torque from its current, NaN if the torque constant is unknown."""
    constant = float(settings["torque_constant_Nm_per_A"])
    return constant * current_A if constant else math.nan


def refuse_request(
    who: Named | Line,
    request: DriveRequest,
    settings: Mapping[str, Any],
    check: Callable[[DriveRequest], None],
) -> None:
    """Raise SettingRefused for a request that is invalid for any drive, or by ``check``.

    settings: used to open the port; those of the request must be the same.
    """
    refusal = ""
    if request.counts_per_revolution < 1:
        refusal = say("{} counts per revolution are too few.", request.counts_per_revolution)
    if request.direction not in (1, -1):
        refusal = say("direction {} is neither 1 nor -1.", request.direction)
    for key, value in request.settings.items():
        if key in settings and settings[key] != value:
            refusal = say(
                "{} = {} differs from {}, with which the port was opened; open it again.",
                key,
                value,
                settings[key],
            )
    if not refusal:
        try:
            check(request)
            return
        except ValueError as error:
            refusal = sentence_of_error(error)
    raise SettingRefused.at(who, refusal)


def refuse_speed(who: Named | Line, speed_rev_per_s: float, request: DriveRequest) -> None:
    """Raise SettingRefused for a speed that is not finite or exceeds the rig's maximum."""
    limit = request.maximum_speed_rev_per_s
    if not math.isfinite(speed_rev_per_s):
        raise SettingRefused.at(who, "a speed of {} is not a number.", speed_rev_per_s)
    if abs(speed_rev_per_s) > limit * (1 + _ROUNDING):
        raise SettingRefused.at(
            who,
            "{:.1f} rpm is above the rig's maximum of {:.1f} rpm.",
            speed_rev_per_s * 60,
            limit * 60,
        )


def ramp_steps(
    who: Named | Line, acceleration_rev_per_s2: float, step_rev_per_s2: float, most: int
) -> int:
    """Return an acceleration in the drive's steps, 1 to ``most``; raise SettingRefused."""
    ramp = acceleration_rev_per_s2 / step_rev_per_s2
    if not (math.isfinite(ramp) and ramp > 0):
        raise SettingRefused.at(
            who, "an acceleration of {:g} rev/s2 is not possible.", acceleration_rev_per_s2
        )
    return min(max(1, round(ramp)), most)


def note_survived_silence(who: Named, silence_s: float, watchdog_s: float) -> None:
    """Log that this computer was late although the drive reports no stop."""
    _log.warning(
        "%s on %s: nothing was sent to it for %.2f s, and its watchdog of %.2f s has not fired; "
        "test the watchdog if this computer was not busy",
        who.name,
        who.port,
        silence_s,
        watchdog_s,
    )
