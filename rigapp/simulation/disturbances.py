"""Faults of the signals between the plant and the terminals, and of the shaft itself."""

from __future__ import annotations

import enum
from dataclasses import replace

import numpy as np

from rigapp.simulation.layout import Array
from rigapp.simulation.plant import Samples
from rigapp.simulation.sensing import uniform

CHANNELS = {
    "force_1": "bridge_1",
    "force_2": "bridge_2",
    "probe_1": "probe_1",
    "probe_2": "probe_2",
}
FAR_OUT = 1e3  # mV/V or V, beyond the range of any input
_OTHER = {"bridge_1": "bridge_2", "bridge_2": "bridge_1"}
SWINGS_PER_S = 0.8  # a weight on a hook of 40 cm
_SPIKES = np.uint64(17)


class SignalFault(enum.StrEnum):
    """Name what can happen to a signal; ``value`` of the fault is what stands behind it."""

    STUCK_VALUE = "stuck_value"  # the input keeps the value it had
    SATURATED_INPUT = "saturated_input"  # sign of the overload, +1 by default
    BROKEN_BRIDGE_WIRE = "broken_bridge_wire"  # the bridge's input floats to one side
    SLIP_RING_SPIKES = "slip_ring_spikes"  # mV/V, about ``rate_per_s`` of them, either sign
    SWAPPED_BRIDGES = "swapped_bridges"  # the two bridges' plugs are exchanged
    SWINGING_WEIGHT = "swinging_weight"  # share of the signal by which it goes to and fro
    JAM = "jam"  # N m of dry friction on the shaft
    REVERSED_ENCODER = "reversed_encoder"  # lines A and B of the crank encoder are exchanged


_SHAFT = "shaft"
_DEFAULTS = {
    SignalFault.SLIP_RING_SPIKES: 1.5,
    SignalFault.SWINGING_WEIGHT: 0.03,
    SignalFault.JAM: 1e3,
}
"""What stands behind a fault when nothing is said; 1 for the others."""


class Disturbances:
    """Apply the signal faults that are on to the samples; the same for every cut into chunks."""

    def __init__(self, seed: int) -> None:
        self._seed = np.uint64(seed % 2**64)
        self._channels: dict[tuple[SignalFault, str], float] = {}
        self._stuck: dict[str, float] = {}
        self._spike_rate = 0.0

    @property
    def jam_Nm(self) -> float:
        """Return the dry friction on the shaft beyond the bearing's."""
        return self._channels.get((SignalFault.JAM, _SHAFT), 0.0)

    def start(self, fault: SignalFault, channel: str, value: float | None, rate: float) -> None:
        """Let a fault begin; channel: force_1, force_2, probe_1 or probe_2, "" for both forces."""
        if fault is SignalFault.SLIP_RING_SPIKES:
            self._spike_rate = rate
        for name in _terminals(fault, channel):
            self._channels[fault, name] = _DEFAULTS.get(fault, 1.0) if value is None else value

    def stop(self, fault: SignalFault, channel: str) -> None:
        """Let a fault end."""
        for name in _terminals(fault, channel):
            self._channels.pop((fault, name), None)
            self._stuck.pop(name, None)

    def apply(self, samples: Samples, sample_rate_Hz: float) -> Samples:
        """Return the samples with the faults in them."""
        changed: dict[str, Array] = {}
        if samples.shaft_revolutions.size == 0:
            return samples
        for (fault, name), value in self._channels.items():
            if fault is SignalFault.REVERSED_ENCODER:
                changed["shaft_revolutions"] = -samples.shaft_revolutions
            if name == _SHAFT:
                continue
            if fault is SignalFault.SWAPPED_BRIDGES:
                changed[name] = getattr(samples, _OTHER.get(name, name))
                continue
            signal = changed.get(name, getattr(samples, name))
            changed[name] = self._disturbed(fault, name, value, signal, samples, sample_rate_Hz)
        return replace(samples, **changed) if changed else samples  # type: ignore[arg-type]

    def _disturbed(
        self,
        fault: SignalFault,
        name: str,
        value: float,
        signal: Array,
        samples: Samples,
        rate: float,
    ) -> Array:
        if fault is SignalFault.STUCK_VALUE:
            return np.full_like(signal, self._stuck.setdefault(name, float(signal[0])))
        if fault is SignalFault.SWINGING_WEIGHT:
            seconds = (samples.first_sample + np.arange(signal.size)) / rate
            return signal * (1.0 + value * np.sin(2.0 * np.pi * SWINGS_PER_S * seconds))
        if fault is SignalFault.SLIP_RING_SPIKES:
            chance = uniform(self._seed, _SPIKES, samples.first_sample, signal.size)
            threshold = self._spike_rate / rate
            spikes = np.where(chance < 0.5 * threshold, value, -value)
            return signal + np.where(chance < threshold, spikes, 0.0)
        size = np.inf if fault is SignalFault.BROKEN_BRIDGE_WIRE else FAR_OUT
        return np.full_like(signal, np.copysign(size, value))


def _terminals(fault: SignalFault, channel: str) -> tuple[str, ...]:
    if fault in (SignalFault.JAM, SignalFault.REVERSED_ENCODER):
        return (_SHAFT,)
    return (CHANNELS[channel],) if channel else ("bridge_1", "bridge_2")
