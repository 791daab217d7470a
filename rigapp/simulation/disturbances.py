"""Disturbances of signals between plant and terminals: faults and laboratory effects."""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numba import float64, types

from rigapp.config.rig import PlantSection, RigFile
from rigapp.schema.channels import BASE, LOAD_CELL, PROBES
from rigapp.simulation.constants import plant_section
from rigapp.simulation.kernels import normal_pair, uniform
from rigapp.simulation.layout import Array
from rigapp.simulation.plant import Samples
from rigapp.simulation.surroundings import room_swing_K
from rigapp_model.compiled import njit

BRIDGES = BASE.names_of(LOAD_CELL)
_OTHER = dict(zip(BRIDGES, reversed(BRIDGES), strict=True))
OUT_OF_RANGE = 1e3  # mV/V or V, beyond the range of any input
SWINGS_PER_S = 0.8  # a weight on a hook of 40 cm
_SPIKES = np.uint64(17)


@dataclass(frozen=True, slots=True)
class WiredSignals:
    """Input signals of the data acquisition: shaft in revolutions, mV/V or V by channel."""

    first_sample: int
    shaft_revolutions: Array
    analog: Mapping[str, Array]


def terminals(samples: Samples, free: Mapping[str, Array]) -> WiredSignals:
    """Return the plant's signals by the names of their channels, including the free ones."""
    wired = (samples.bridge_1, samples.bridge_2, samples.probe_1, samples.probe_2)
    names = (channel.name for channel in BASE.sampled)
    analog = {**dict(zip(names, wired, strict=True)), **free}
    return WiredSignals(samples.first_sample, samples.shaft_revolutions, analog)


class SignalFault(enum.StrEnum):
    """The faults of a signal; the comment names the ``value`` of each."""

    STUCK_VALUE = "stuck_value"  # the input keeps its value
    SATURATED_INPUT = "saturated_input"  # sign of the overload, +1 by default
    BROKEN_BRIDGE_WIRE = "broken_bridge_wire"  # the bridge's input floats to one side
    SLIP_RING_SPIKES = "slip_ring_spikes"  # mV/V, about ``rate_per_s`` of them, either sign
    MOVED_PROBE = "moved_probe"  # offset of a probe's signal, V
    SWAPPED_BRIDGES = "swapped_bridges"  # the two bridges' plugs are exchanged
    SWINGING_WEIGHT = "swinging_weight"  # amplitude as a share of the signal
    JAM = "jam"  # dry friction on the shaft, N m
    REVERSED_ENCODER = "reversed_encoder"  # lines A and B of the crank encoder are exchanged
    CLOCK_DRIFT = "clock_drift"  # ppm by which the device samples faster than it states


_SHAFT = "shaft"
_DEFAULTS = {
    SignalFault.SLIP_RING_SPIKES: 1.5,
    SignalFault.SWINGING_WEIGHT: 0.03,
    SignalFault.MOVED_PROBE: 0.5,
    SignalFault.JAM: 1e3,
    SignalFault.CLOCK_DRIFT: 100.0,
}
"""The default ``value`` of a fault; 1 for the others."""


class Disturbances:
    """Apply the active signal faults to the samples, independent of the division into chunks."""

    def __init__(self, seed: int) -> None:
        self._seed = np.uint64(seed % 2**64)
        self._channels: dict[tuple[SignalFault, str], float] = {}
        self._stuck: dict[str, float] = {}
        self._spike_rate = 0.0

    @property
    def jam_Nm(self) -> float:
        """Return the dry friction on the shaft in addition to the bearing's."""
        return self._channels.get((SignalFault.JAM, _SHAFT), 0.0)

    @property
    def clock(self) -> float:
        """Return the ratio of the true to the stated sample rate."""
        return 1.0 + 1e-6 * self._channels.get((SignalFault.CLOCK_DRIFT, _SHAFT), 0.0)

    def start(self, fault: SignalFault, channel: str, value: float | None, rate: float) -> None:
        """Begin a fault; channel: by its name, "" for both forces."""
        if fault is SignalFault.SLIP_RING_SPIKES:
            self._spike_rate = rate
        for name in _terminals(fault, channel):
            self._channels[fault, name] = _DEFAULTS.get(fault, 1.0) if value is None else value

    def stop(self, fault: SignalFault, channel: str) -> None:
        """End a fault."""
        for name in _terminals(fault, channel):
            self._channels.pop((fault, name), None)
            self._stuck.pop(name, None)

    def apply(self, seen: WiredSignals, sample_rate_Hz: float) -> WiredSignals:
        """Return the signals with the faults."""
        if seen.shaft_revolutions.size == 0 or not self._channels:
            return seen
        shaft, analog = seen.shaft_revolutions, dict(seen.analog)
        for (fault, name), value in self._channels.items():
            if fault is SignalFault.REVERSED_ENCODER:
                shaft = -seen.shaft_revolutions
            elif fault is SignalFault.SWAPPED_BRIDGES:
                analog[name] = seen.analog[_OTHER[name]]
            elif name != _SHAFT:
                analog[name] = self._disturbed(
                    fault, name, value, analog[name], seen.first_sample, sample_rate_Hz
                )
        return replace(seen, shaft_revolutions=shaft, analog=analog)

    def _disturbed(
        self,
        fault: SignalFault,
        name: str,
        value: float,
        signal: Array,
        first_sample: int,
        rate: float,
    ) -> Array:
        if fault is SignalFault.STUCK_VALUE:
            return np.full_like(signal, self._stuck.setdefault(name, float(signal[0])))
        if fault is SignalFault.SWINGING_WEIGHT:
            seconds = (first_sample + np.arange(signal.size)) / rate
            return signal * (1.0 + value * np.sin(2.0 * np.pi * SWINGS_PER_S * seconds))
        if fault is SignalFault.SLIP_RING_SPIKES:
            chance = uniform(self._seed, _SPIKES, first_sample, signal.size)
            threshold = self._spike_rate / rate
            spikes = np.where(chance < 0.5 * threshold, value, -value)
            return signal + np.where(chance < threshold, spikes, 0.0)
        if fault is SignalFault.MOVED_PROBE:
            return signal + value
        size = np.inf if fault is SignalFault.BROKEN_BRIDGE_WIRE else OUT_OF_RANGE
        return np.full_like(signal, np.copysign(size, value))


def _terminals(fault: SignalFault, channel: str) -> tuple[str, ...]:
    if fault in (SignalFault.JAM, SignalFault.REVERSED_ENCODER, SignalFault.CLOCK_DRIFT):
        return (_SHAFT,)
    return (channel,) if channel else BRIDGES


# Disturbances of probes and load cell in a laboratory: drift, temperature, a touched probe, creep.
#
# All are off by default. Those that depend on time or revolutions only are the same for every
# division into chunks and every test of one seed; creep of the cell depends on its past load.

_WANDER = np.uint64(33)


class Interference:
    """Add the laboratory disturbances of ``[simulation.plant]`` to the terminals' signals."""

    def __init__(self, rig: RigFile, seed: int) -> None:
        self._plant = plant_section(rig)
        self._seed = np.uint64(seed % 2**64)
        sensitivities = rig.probes.sensitivity_um_per_V
        self._probes = dict(zip(BASE.names_of(PROBES), sensitivities, strict=True))
        bridges = zip(BASE.names_of(LOAD_CELL), rig.load_cell.zero_mV_per_V, strict=True)
        self._creeping = {name: _Creep(self._plant, zero) for name, zero in bridges}

    def apply(self, seen: WiredSignals, samples: Samples, sample_rate_Hz: float) -> WiredSignals:
        """Return the signals with the disturbances."""
        plant, analog = self._plant, dict(seen.analog)
        turns = np.abs(samples.shaft_revolutions)
        for probe, (name, um_per_V) in enumerate(self._probes.items()):
            um = _probe_um(plant, probe, turns, samples.warm_s, self._seed)
            if um is not None:
                analog[name] = analog[name] + um / um_per_V
        if plant.cell_creep_percent:
            for name, creep in self._creeping.items():
                analog[name] = creep.added(analog[name], sample_rate_Hz)
        return replace(seen, analog=analog)


def _probe_um(
    plant: PlantSection, probe: int, turns: Array, warm_s: Array, seed: np.uint64
) -> Array | None:
    """Return the disturbance of a probe, um; None if all are off."""
    parts = []
    if plant.probe_wander_um:
        slow = wander(turns / plant.probe_wander_revolutions, seed, probe)
        parts.append(plant.probe_wander_um * slow)
    if plant.probe_temperature_um_per_K[probe]:
        parts.append(plant.probe_temperature_um_per_K[probe] * room_swing_K(plant, warm_s))
    if plant.touched_probe_um and probe == 0:
        parts.append(np.where(turns >= plant.touched_at_revolution, plant.touched_probe_um, 0.0))
    return np.sum(parts, axis=0) if parts else None


def wander(at: Array, seed: np.uint64, which: int) -> Array:
    """Return coloured standard noise at times (n,) in units of its correlation length.

    Independent numbers at whole times are interpolated with cosine and sine weights of a quarter
    circle, so that the variance is constant.
    """
    if not at.size:
        return at
    floor = np.floor(at)
    first = int(floor.min())
    knots = np.array(
        [
            normal_pair(seed, _WANDER, np.uint64(index))[which]
            for index in range(first, int(floor.max()) + 2)
        ]
    )
    low, part = floor.astype(np.intp) - first, 0.5 * math.pi * (at - floor)
    return np.asarray(np.cos(part) * knots[low] + np.sin(part) * knots[low + 1])


@njit(types.Tuple((float64[::1], float64))(float64[::1], float64, float64), cache=True)
def _lagging(values: Array, keeps: float, rest: float) -> tuple[Array, float]:
    """Return values after a first-order lag, and its final state for the next values.

    Not by ``scipy.signal``, whose import takes a second at each start of a rig.
    """
    lag = np.empty_like(values)
    for i in range(values.shape[0]):
        lag[i] = (1.0 - keeps) * values[i] + rest
        rest = keeps * lag[i]
    return lag, rest


class _Creep:
    """Creep of a bridge: a delayed share of a lasting load."""

    def __init__(self, plant: PlantSection, zero: float) -> None:
        self._share = plant.cell_creep_percent / 100.0
        self._time_s = plant.cell_creep_time_s
        self._zero = zero
        self._rest = 0.0

    def added(self, signal: Array, sample_rate_Hz: float) -> Array:
        """Return a signal (mV/V) with the creep of all previous load."""
        keeps = math.exp(-1.0 / (sample_rate_Hz * self._time_s))
        lag, self._rest = _lagging(signal - self._zero, keeps, self._rest)
        return np.asarray(signal + self._share * lag)
