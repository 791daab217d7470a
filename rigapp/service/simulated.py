"""The simulated rig of an engine: started on demand, restarted for another mechanism."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from rigapp.calibrating.training import MISTAKES
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import refusal
from rigapp.config.rig import RigFile
from rigapp.simulation.process import SimulatedRig, start_simulated_rig

Speed = float | Literal["max"]


def parse_speed(text: str | None, rig: Document[RigFile]) -> Speed | None:
    """Return the speed of ``--speed``, by default that of the rig file; raises UnusableInput.

    None when the samples are not simulated, since the crank then turns in real time.
    """
    simulation, simulated = rig.record.simulation, rig.record.simulated_samples
    if text is None:
        return simulation.speed if simulation is not None and simulated else None
    if not simulated:
        raise UnusableInput(
            f"--speed {text}: {rig.path} is not a simulated rig; leave --speed out."
        )
    if text == "max":
        return "max"
    try:
        speed = float(text)
    except ValueError as error:
        raise UnusableInput(f"--speed {text}: give a number of times real time, or max.") from error
    wrong = refusal("simulation.speed", speed).removeprefix("simulation.speed = ")
    if wrong:
        raise UnusableInput(f"--speed {wrong}; or give max.")
    return speed


class SimulatedDevices:
    """The simulated rig of one rig file, with the mechanism of the present test."""

    def __init__(self, rig: Document[RigFile], speed: Speed | None) -> None:
        """Set the rig and its speed without starting it."""
        self._rig = rig
        self.speed = speed
        self._process: SimulatedRig | None = None
        self._parameters: ParameterFile | None = None
        self._specimen: str | None = None
        self._handled = False

    @property
    def needed(self) -> bool:
        """Return whether any device of the rig is simulated here."""
        return bool(self._rig.record.simulated_devices)

    def suits(self, parameters: ParameterFile | None) -> bool:
        """Return whether the running rig has these parameters."""
        if not self.needed:
            return True
        return (
            self._process is not None
            and self._process.alive()
            and not any(self._process.state().get("failed", {}).values())
            and (parameters in (None, self._parameters) or not self._rig.record.simulated_samples)
        )

    def ports(self, parameters: ParameterFile | None) -> Mapping[str, str]:
        """Return the port of each simulated device, starting or restarting the rig if necessary."""
        if not self.needed:
            return {}
        if not self.suits(parameters) or self._process is None:
            self.close()
            self._process = start_simulated_rig(
                self._rig.path, speed=self.speed or 1.0, parameters=parameters
            )
            self._parameters = parameters
            self._specimen = None
        return self._process.urls

    @property
    def process(self) -> SimulatedRig:
        """Return the running simulated rig; raises UnusableInput without one."""
        if self._process is None or not self._process.alive():
            raise UnusableInput("There is no simulated rig running; connect it first.")
        return self._process

    def fit(self, specimen: str, worn_um: float = 0.0) -> bool:
        """Insert the bushing of a test with its wear, unless it is the present one.

        Return True when it was changed. Raises UnusableInput while the spindle turns.
        """
        before, self._specimen = self._specimen, specimen
        new = before is None and worn_um <= 0.0
        if not self.needed or new or before == specimen:
            return False
        self.process.hand("new_specimen")
        self.process.wear_to(max(worn_um, 0.0))
        return True

    def hand(self, what: str, details: Mapping[str, Any]) -> None:
        """Execute an action of the simulated operator; raises UnusableInput, SimulationFailed."""
        self._handled = True
        self.process.hand(what, **details)

    def put_together(self) -> None:
        """Undo the simulated operator's actions: no weight, no mistake, follower on the pin.

        Raises UnusableInput while the spindle turns, SimulationFailed.
        """
        if self._handled and self._process is not None:
            for kind in MISTAKES:
                self.process.clear(kind)
            self.process.hand("put_on_follower")
            self._handled = False

    def close(self) -> None:
        """End the simulated rig."""
        self._handled = False
        if self._process is not None:
            self._process.close()
            self._process = None


class SampleNumbers:
    """Relate the sample numbers of the simulated rig to the engine's, which lag in transit.

    The engine's count minus the rig's is at most the constant offset of the two numberings; the
    largest observed difference is its best estimate.
    """

    def __init__(self) -> None:
        """Start without an estimate."""
        self._difference: int | None = None
        self._processed = 0

    def note(self, processed: int, made: int) -> None:
        """Add a reading of both; ``processed`` is read before ``made``."""
        if self._difference is None or processed < self._processed:
            self._difference = processed - made
        self._processed = processed
        self._difference = max(self._difference, processed - made)

    def processed_at(self, made: int) -> int:
        """Return the engine's number of the rig's sample ``made``."""
        return made + (self._difference or 0)
