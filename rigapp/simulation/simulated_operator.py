"""Actions of an operator at the rig: hang weights, turn the pin, set micrometers, change bushings.

An action is a table from the control channel::

    {"hand": "take_off_follower"}      the pin is free for the dead-weight calibration
    {"hand": "hang_weight", "mass_kg": 5.0, "gravity_m_s2": 9.8123}     0 takes it off
    {"hand": "hang_weight", "mass_kg": 5.0, "hung_s": 300.0}     it hangs for so long already
    {"hand": "turn_pin", "angle_deg": 90.0}
    {"hand": "set_micrometer", "probe": 1, "position_um": -200.0}
    {"hand": "release_crank"}          the crank may turn without the follower
    {"hand": "put_on_follower"}
    {"hand": "new_specimen"}           an unworn bushing in place of the present one

The crank is locked while the follower is off, until it is released. A weight is given by its
conventional mass: steel of 8000 kg/m3 in air of 1.2 kg/m3, so its force is m g (1 - 1.2 / 8000).
The cell creeps with the logarithm of the given loading time.
"""

from __future__ import annotations

import math
import re
from typing import Annotated, Literal

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.simulation.plant import Plant

BUOYANCY = 1.0 - 1.2 / 8000.0  # conventional mass: air over steel
LOCK_Nm = 1e6
CREEP_PER_DECADE = 3e-4
"""Growth of the cell's signal from 30 s to 300 s as a share of the load: that of a good cell."""
CREEP_FROM_S = 30.0
HEAVIEST_KG = 100.0  # more than a person can hang on a pin


def _tag(name: str) -> str:
    """Return the name of an action's class in a message."""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()


class _Hand(msgspec.Struct, frozen=True, forbid_unknown_fields=True, tag_field="hand", tag=_tag):
    """Base of all actions: a table with the name in the key ``hand``."""


class TakeOffFollower(_Hand, frozen=True):
    """Take the follower off the pin."""


class PutOnFollower(_Hand, frozen=True):
    """Put the follower on the pin."""


class ReleaseCrank(_Hand, frozen=True):
    """Unlock the crank while the follower is off."""


class HangWeight(_Hand, frozen=True):
    """Hang a weight on the pin in place of the present one, for some time if given."""

    mass_kg: Annotated[float, msgspec.Meta(ge=0, le=HEAVIEST_KG)]
    gravity_m_s2: Annotated[float, msgspec.Meta(gt=9.7, lt=9.9)] = 9.80665
    hung_s: Annotated[float, msgspec.Meta(ge=0, le=1e6)] = 0.0


class TurnPin(_Hand, frozen=True):
    """Turn the crank to an angle from +x."""

    angle_deg: Annotated[float, msgspec.Meta(ge=-360, le=360)]


class SetMicrometer(_Hand, frozen=True):
    """Set a probe's micrometer to a position."""

    probe: Literal[1, 2]
    position_um: Annotated[float, msgspec.Meta(ge=-5000, le=5000)]


class NewSpecimen(_Hand, frozen=True):
    """Put an unworn bushing in place of the present one."""


Hand = (
    TakeOffFollower
    | PutOnFollower
    | ReleaseCrank
    | HangWeight
    | TurnPin
    | SetMicrometer
    | NewSpecimen
)


class SimulatedOperator:
    """Perform an operator's actions on a stationary plant."""

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._off = False
        self._locked = True
        self._weight_N = 0.0
        self._micrometers_um = [0.0, 0.0]

    @property
    def lock_Nm(self) -> float:
        """Return the friction that locks the crank while the follower is off."""
        return LOCK_Nm if self._off and self._locked else 0.0

    def do(self, hand: Hand) -> None:
        """Perform an action; raise UnusableInput if it is not possible on a real rig."""
        if self._plant.state().speed_rad_per_s != 0.0:
            raise UnusableInput("hand: the spindle turns; stop it first.")
        if isinstance(hand, HangWeight | SetMicrometer | ReleaseCrank) and not self._off:
            raise UnusableInput("hand: the follower is on the pin; take_off_follower first.")
        match hand:
            case TakeOffFollower():
                self._off = self._locked = True
            case ReleaseCrank():
                if self._weight_N > 0.0:
                    raise UnusableInput("hand: a weight hangs on the pin; take it off first.")
                self._locked = False
            case PutOnFollower():
                self._off = False
                self._weight_N = 0.0
                self._micrometers_um = [0.0, 0.0]
            case HangWeight(mass_kg=mass, gravity_m_s2=gravity, hung_s=hung):
                self._locked = True
                creep = CREEP_PER_DECADE * math.log10(max(hung, CREEP_FROM_S) / CREEP_FROM_S)
                self._weight_N = mass * gravity * BUOYANCY * (1.0 + creep)
            case TurnPin(angle_deg=angle):
                self._plant.turn_by_hand(math.radians(angle))
            case SetMicrometer(probe=probe, position_um=position):
                self._micrometers_um[probe - 1] = position
            case NewSpecimen():
                self._plant.wear_to(0.0)
        if self._off:
            first, second = self._micrometers_um
            self._plant.bench(self._weight_N, (first * 1e-6, second * 1e-6))
        else:
            self._plant.assemble()


def hand_of(tree: dict[str, object]) -> Hand:
    """Return the action in a control message's table; raise UnusableInput."""
    try:
        hand: Hand = msgspec.convert(tree, Hand)
    except msgspec.ValidationError as error:
        raise UnusableInput("hand: {}.", error) from error
    return hand
