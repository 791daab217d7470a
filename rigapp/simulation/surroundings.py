"""The laboratory environment of the simulated rig: values of free inputs and slow devices.

The bushing is heated by the friction power in the joint: force along the wall times sliding speed,
through a first-order lag (see ``kernels``). The room's temperature and humidity vary about their
means, once a day by default, in opposite phase: warmer air of the same water content has a lower
relative humidity. Their day begins at the crank's first departure from rest, so that a test of the
same seed does not depend on the time at rest before.

A free input of the rig file has the quantity after which its channel is named,
``[channels.bushing_temperature]``, ``room_temperature`` or ``humidity``; any other is not
connected and floats near 0 V. A slow device measures the same, by its quantities' names.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from rigapp.config.rig import ChannelSection, PlantSection, RigFile
from rigapp.simulation.constants import plant_section
from rigapp.simulation.layout import Array
from rigapp.simulation.plant import Samples

HOUR_S = 3600.0
DRIVE_WARMER_K = 10.5
"""Temperature of a drive's electronics above the room [assumed]."""
CONNECTED_NOISE_V = 2e-4
FLOATING_NOISE_V = 2e-3
"""Standard deviations: of a transmitter's output, of an open input of a few megohms [assumed]."""

Values = Callable[[PlantSection, Array, Array], Array]


def room_swing_K(plant: PlantSection, warm_s: Array) -> Array:
    """Return the deviation of the room from its mean temperature."""
    return np.asarray(plant.room_swing_K * _swing(plant, warm_s))


def _swing(plant: PlantSection, warm_s: Array) -> Array:
    return np.asarray(np.sin(2.0 * math.pi / (HOUR_S * plant.room_swing_hours) * warm_s))


def _room(plant: PlantSection, rise_K: Array, warm_s: Array) -> Array:
    return plant.room_temperature_degC + room_swing_K(plant, warm_s)


def _bushing(plant: PlantSection, rise_K: Array, warm_s: Array) -> Array:
    return _room(plant, rise_K, warm_s) + rise_K


def _humidity(plant: PlantSection, rise_K: Array, warm_s: Array) -> Array:
    swing = plant.humidity_swing_percent * _swing(plant, warm_s)
    return np.asarray(np.clip(plant.humidity_percent - swing, 0.0, 100.0))


QUANTITIES: Mapping[str, Values] = {
    "bushing_temperature": _bushing,
    "room_temperature": _room,
    "temperature": _room,
    "humidity": _humidity,
}
"""Name of a channel, or of a slow device's quantity without its unit -> its values (degC, %)."""


class FreeInputs:
    """The analog inputs of ``[channels.NAME]`` and their terminal voltages."""

    def __init__(self, rig: RigFile) -> None:
        self._plant = plant_section(rig)
        self._channels = {name: free for name, free in rig.channels.items() if not free.source}

    def __len__(self) -> int:
        """Return the number of inputs."""
        return len(self._channels)

    def voltages(self, samples: Samples) -> dict[str, Array]:
        """Return (samples,) in V for each, by the name of its channel."""
        volts = {}
        for row, (name, section) in enumerate(self._channels.items()):
            noise = samples.free_noise[row]
            values = QUANTITIES.get(name)
            if values is None:
                volts[name] = FLOATING_NOISE_V * noise
                continue
            value = values(self._plant, samples.bushing_rise_K, samples.warm_s)
            volts[name] = _volts(section, value) + CONNECTED_NOISE_V * noise
        return volts


def _volts(section: ChannelSection, value: Array) -> Array:
    """Return the voltage of a value by inverting the channel's scale or table."""
    if section.table:
        pairs = np.array(sorted(section.table, key=lambda pair: pair[1]))
        return np.asarray(np.interp(value, pairs[:, 1], pairs[:, 0]))
    return np.asarray(value / section.scale + section.offset_V)


def slow_values(
    quantities: tuple[str, ...], plant: PlantSection, rise_K: float, warm_s: float
) -> dict[str, float]:
    """Return the values of a slow device by its quantities; unknown ones are omitted."""
    result = {}
    for quantity in quantities:
        values = QUANTITIES.get(quantity.rpartition("_")[0])
        if values is not None:
            result[quantity] = float(values(plant, np.array(rise_K), np.array(warm_s)))
    return result
