"""What a laboratory adds to the signals of probes and load cell: wandering, warmth, a touch, creep.

All of it is off by default. What depends on time or revolutions alone is the same for every cut
into chunks and for every test of one seed; creep of the cell remembers its load.
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numba import float64, types

from rigapp.config.rig import PlantSection, RigFile
from rigapp.schema.channels import BASE, LOAD_CELL, PROBES
from rigapp.simulation.constants import plant_section
from rigapp.simulation.disturbances import WiredSignals
from rigapp.simulation.layout import Array
from rigapp.simulation.plant import Samples
from rigapp.simulation.sensing import normal_pair
from rigapp.simulation.surroundings import room_swing_K
from rigapp_model.compiled import njit

_WANDER = np.uint64(33)


class Interference:
    """Add to the terminals' signals what ``[simulation.plant]`` says of the laboratory."""

    def __init__(self, rig: RigFile, seed: int) -> None:
        self._plant = plant_section(rig)
        self._seed = np.uint64(seed % 2**64)
        sensitivities = rig.probes.sensitivity_um_per_V
        self._probes = dict(zip(BASE.names_of(PROBES), sensitivities, strict=True))
        bridges = zip(BASE.names_of(LOAD_CELL), rig.load_cell.zero_mV_per_V, strict=True)
        self._creeping = {name: _Creep(self._plant, zero) for name, zero in bridges}

    def apply(self, seen: WiredSignals, samples: Samples, sample_rate_Hz: float) -> WiredSignals:
        """Return the signals with it in them."""
        plant, analog = self._plant, dict(seen.analog)
        turns = np.abs(samples.shaft_revolutions)
        for place, (name, um_per_V) in enumerate(self._probes.items()):
            um = _probe_um(plant, place, turns, samples.warm_s, self._seed)
            if um is not None:
                analog[name] = analog[name] + um / um_per_V
        if plant.cell_creep_percent:
            for name, creep in self._creeping.items():
                analog[name] = creep.added(analog[name], sample_rate_Hz)
        return replace(seen, analog=analog)


def _probe_um(
    plant: PlantSection, place: int, turns: Array, warm_s: Array, seed: np.uint64
) -> Array | None:
    """Return what a probe sees beside the pin, um; None where nothing is switched on."""
    parts = []
    if plant.probe_wander_um:
        slow = wander(turns / plant.probe_wander_revolutions, seed, place)
        parts.append(plant.probe_wander_um * slow)
    if plant.probe_temperature_um_per_K[place]:
        parts.append(plant.probe_temperature_um_per_K[place] * room_swing_K(plant, warm_s))
    if plant.touched_probe_um and place == 0:
        parts.append(np.where(turns >= plant.touched_at_revolution, plant.touched_probe_um, 0.0))
    return np.sum(parts, axis=0) if parts else None


def wander(at: Array, seed: np.uint64, place: int) -> Array:
    """Return coloured standard noise at places (n,) counted in lengths of its memory.

    Between independent numbers at whole places it turns from one to the next by a quarter of a
    circle, so that it has the same variance everywhere.
    """
    if not at.size:
        return at
    whole = np.floor(at)
    first = int(whole.min())
    knots = np.array(
        [
            normal_pair(seed, _WANDER, np.uint64(index))[place]
            for index in range(first, int(whole.max()) + 2)
        ]
    )
    low, part = whole.astype(np.intp) - first, 0.5 * math.pi * (at - whole)
    return np.asarray(np.cos(part) * knots[low] + np.sin(part) * knots[low + 1])


@njit(types.Tuple((float64[::1], float64))(float64[::1], float64, float64), cache=True)
def _lagging(values: Array, keeps: float, rest: float) -> tuple[Array, float]:
    """Return values after a lag of first order, and what remains of it for those that follow.

    A filter of ``scipy.signal`` does the same, and loads for a second at each start of a rig.
    """
    lag = np.empty_like(values)
    for i in range(values.shape[0]):
        lag[i] = (1.0 - keeps) * values[i] + rest
        rest = keeps * lag[i]
    return lag, rest


class _Creep:
    """Let a bridge go on by a part of a lasting load."""

    def __init__(self, plant: PlantSection, zero: float) -> None:
        self._share = plant.cell_creep_percent / 100.0
        self._time_s = plant.cell_creep_time_s
        self._zero = zero
        self._rest = 0.0

    def added(self, signal: Array, sample_rate_Hz: float) -> Array:
        """Return a signal (mV/V) with the creep of all that came before."""
        keeps = math.exp(-1.0 / (sample_rate_Hz * self._time_s))
        lag, self._rest = _lagging(signal - self._zero, keeps, self._rest)
        return np.asarray(signal + self._share * lag)
