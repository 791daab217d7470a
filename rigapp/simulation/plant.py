"""The plant of the simulated rig: time in, terminal signals and true values out.

Crank angle and speed are states, driven by the drive's command. One compiled call advances a chunk.
Signals are electrical, in mV/V and V.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rigapp.simulation import impacts, kernels, layout, mechanics
from rigapp.simulation.layout import Array, Constants, Drive
from rigapp.simulation.wall import APPROACH, Wall, looked_up, unworn_wall, worn_wall
from rigapp.texts import say

LONGEST_STEP_S = 1.0 / 900.0  # 95 steps per turn at the highest usual speed, 570 rpm
DEEPEST_SHARE = 0.5
"""Deepest wear that can be set, as a fraction of the pin's radius."""
LEAST_FORCE_N = 10.0
"""Smallest force whose contact is resolved by the bushing's nodes."""
START_BEFORE_REST_RAD = math.radians(3.0)


@dataclass(frozen=True, slots=True)
class Truth:
    """The true values at each sample: arrays of one length, SI units.

    Force on the follower by the pin, in the crank frame, at the sample's instant (the terminal
    signals are delayed); wear depth at the contact.
    """

    time_s: Array
    angle_rad: Array
    speed_rad_per_s: Array
    force_e1_N: Array
    force_n1_N: Array
    wear_depth_m: Array


@dataclass(frozen=True, slots=True)
class Samples:
    """The samples at the terminals: shaft in revolutions as the encoder turns, mV/V, V.

    bushing_rise_K: of the bushing above room temperature. warm_s: time since the first departure
    from rest.
    free_noise: (free inputs, samples), standard normal.
    """

    first_sample: int
    shaft_revolutions: Array
    bridge_1: Array
    bridge_2: Array
    probe_1: Array
    probe_2: Array
    bushing_rise_K: Array
    warm_s: Array
    free_noise: Array
    truth: Truth


@dataclass(frozen=True, slots=True)
class PlantState:
    """The plant's state at one moment, SI units."""

    time_s: float
    angle_rad: float
    speed_rad_per_s: float
    acceleration_rad_per_s2: float
    motor_torque_Nm: float
    motor_current_A: float
    joint_force_N: float
    wear_depth_m: float
    worn_area_m2: float
    motor_work_J: float
    friction_loss_J: float
    bushing_rise_K: float
    samples: int
    kinetic_energy_J: float
    potential_energy_J: float


_STATES = {
    "time_s": layout.TIME,
    "angle_rad": layout.ANGLE,
    "speed_rad_per_s": layout.SPEED,
    "acceleration_rad_per_s2": layout.ACCELERATION,
    "motor_torque_Nm": layout.TORQUE,
    "motor_current_A": layout.CURRENT,
    "joint_force_N": layout.FORCE,
    "wear_depth_m": layout.DEPTH,
    "worn_area_m2": layout.AREA,
    "motor_work_J": layout.WORK,
    "friction_loss_J": layout.LOSS,
    "bushing_rise_K": layout.RISE,
}


class Plant:
    """Run the plant; one thread at a time."""

    def __init__(
        self,
        constants: Constants,
        *,
        seed: int = 1,
        filter_delay_s: float = 0.0,
        sample_rate_Hz: float = 960.0,
        angle_rad: float | None = None,
        longest_step_s: float = LONGEST_STEP_S,
        free_inputs: int = 0,
    ) -> None:
        """Start at rest: at angle_rad, or just before the crank's equilibrium position.

        free_inputs: number of further inputs that need noise.
        """
        self._rows = layout.ROWS + free_inputs
        self.constants = Constants(*map(float, constants))
        self._assembled = self.constants
        self._seed = np.uint64(seed % 2**64)
        self._delay = filter_delay_s
        self._longest = longest_step_s
        self._usual_force = max(_mean_force(self.constants), LEAST_FORCE_N)
        self._wall = self._new_wall()
        self._state = np.zeros(layout.STATES)
        self._counters = np.zeros(layout.COUNTERS, dtype=np.int64)
        start = rest_angle(constants) - START_BEFORE_REST_RAD if angle_rad is None else angle_rad
        self._state[layout.ANGLE] = start
        self._settle()
        self._rate = 0.0
        self._ring = np.empty((4, 0))
        self.set_sample_rate(sample_rate_Hz)

    def set_sample_rate(self, sample_rate_Hz: float) -> None:
        """Change the sample rate; raise ValueError if it is not positive."""
        if not sample_rate_Hz > 0.0:
            raise ValueError(say("sample rate {} Hz is not positive", sample_rate_Hz))
        if sample_rate_Hz == self._rate:
            return
        self._rate = sample_rate_Hz
        self._steps_per_sample = max(1, math.ceil(1.0 / (sample_rate_Hz * self._longest) - 1e-9))
        self.step_s = 1.0 / (sample_rate_Hz * self._steps_per_sample)
        self._delay_steps = self._delay / self.step_s
        size = math.ceil(self._delay_steps) + 4
        self._ring = np.repeat(self._present()[:, np.newaxis], size, axis=1)
        self._counters[layout.PHASE] = 0
        self._counters[layout.HEAD] = 0

    @property
    def sample_rate_Hz(self) -> float:
        """Return the sample rate."""
        return self._rate

    @property
    def time_s(self) -> float:
        """Return the plant's time."""
        return float(self._state[layout.TIME])

    @property
    def angle_rad(self) -> float:
        """Return the crank angle, unwrapped."""
        return float(self._state[layout.ANGLE])

    @property
    def speed_rad_per_s(self) -> float:
        """Return the crank speed."""
        return float(self._state[layout.SPEED])

    @property
    def motor_current_A(self) -> float:
        """Return the motor current."""
        return float(self._state[layout.CURRENT])

    @property
    def wear_coefficient(self) -> float:
        """Return the wear coefficient at the present depth, m^2/N."""
        k, depth = self.constants, float(self._state[layout.DEPTH])
        early = 1.0 + (k.running_in_factor - 1.0) * math.exp(-depth / k.running_in_depth)
        late = k.wear_change_factor if depth >= k.wear_change_depth else 1.0
        return k.wear_coefficient * early * late

    @property
    def warm_s(self) -> float:
        """Return the time since the crank's first departure from rest, 0 before."""
        if not self._counters[layout.DEPARTURES]:
            return 0.0
        return float(self._state[layout.TIME] - self._state[layout.WARM])

    def advance(self, steps: int, drive: Drive) -> Samples:
        """Advance by ``steps`` steps of ``step_s`` with a command; return the samples due."""
        room = steps // self._steps_per_sample + 1
        out = np.empty((self._rows, room))
        first = int(self._counters[layout.SAMPLE])
        if drive.mode != layout.VELOCITY:
            self._state[layout.INTEGRAL] = 0.0
        count = kernels.advance(
            self.constants._replace(wear_coefficient=self.wear_coefficient),
            Drive(*map(float, drive)),
            self._wall,
            self._state,
            self._counters,
            self._ring,
            out,
            steps,
            self._steps_per_sample,
            self.step_s,
            self._delay_steps,
            self._seed,
        )
        return _samples(first, out[:, :count])

    def bench(self, weight_N: float, micrometers_m: tuple[float, float]) -> None:
        """Remove the follower: a weight hangs on the pin, micrometers face the probes."""
        self.constants = self.constants._replace(
            bench=1.0,
            follower_mass=0.0,
            follower_inertia=0.0,
            slider_mass=0.0,
            stiffness=0.0,
            weight=weight_N,
            micrometer_1=micrometers_m[0],
            micrometer_2=micrometers_m[1],
        )

    def assemble(self) -> None:
        """Refit the follower."""
        together = self._assembled
        self.constants = self.constants._replace(
            bench=0.0,
            follower_mass=together.follower_mass,
            follower_inertia=together.follower_inertia,
            slider_mass=together.slider_mass,
            stiffness=together.stiffness,
        )
        self._settle()

    def wear_to(self, depth_m: float, area_m2: float | None = None) -> None:
        """Wear the bushing to a depth; without an area it is derived from the depth.

        Time, crank and noise do not change. Raises ValueError for a depth or area below 0, and for
        a depth at which the crank could not turn.
        """
        if not 0.0 <= depth_m < DEEPEST_SHARE * self.constants.pin_radius:
            raise ValueError(
                say(
                    "a depth of {:g} um is not possible; give 0 to less than {:g} um",
                    depth_m * 1000000.0,
                    DEEPEST_SHARE * self.constants.pin_radius * 1000000.0,
                )
            )
        if area_m2 is not None and not 0.0 <= area_m2 < math.inf:
            raise ValueError(say("a worn area of {:g} mm2 is not possible", area_m2 * 1000000.0))
        self._wall, area = worn_wall(
            self._new_wall(), mechanics.bore(self.constants), self._usual_force, depth_m
        )
        self._state[layout.DEPTH] = depth_m
        self._state[layout.AREA] = area if area_m2 is None else area_m2
        angle = self._state[layout.ANGLE]
        self._state[layout.FORCE] = mechanics.resting(self.constants, angle, depth_m)[2]
        self._settle()

    def approach_m(self, force_N: float) -> float:
        """Return the elastic approach of pin and present bushing under a force."""
        return float(looked_up(self._wall.table, self._wall.state, force_N, APPROACH))

    def _new_wall(self) -> Wall:
        k = self.constants
        material = (k.outer_radius, k.youngs_modulus, k.poissons_ratio)
        return unworn_wall(mechanics.bore(k), *material, self._usual_force)

    def turn_by_hand(self, angle_rad: float) -> None:
        """Turn the crank to an angle of its present revolution, at rest."""
        turns = math.floor(self._state[layout.ANGLE] / (2.0 * math.pi))
        self._state[layout.ANGLE] = 2.0 * math.pi * turns + angle_rad % (2.0 * math.pi)
        self._state[layout.SPEED] = 0.0
        self._settle()

    def _settle(self) -> None:
        """Set slider and follower of a joint that may lose contact to rest at the crank's angle."""
        wall = self._wall
        impacts.settle(self.constants, wall.table, wall.state, self._state)

    def state(self) -> PlantState:
        """Return the present state."""
        s = self._state
        k, wall = self.constants, self._wall
        if k.loose == 1.0 and k.bench == 0.0:
            kinetic, potential = impacts.loose_energy(k, wall.table, wall.state, s)
        else:
            pose = (s[layout.ANGLE], s[layout.SPEED], s[layout.DEPTH])
            kinetic, potential = mechanics.energy(k, *pose)
        return PlantState(
            **{name: float(s[row]) for name, row in _STATES.items()},
            samples=int(self._counters[layout.SAMPLE]),
            kinetic_energy_J=kinetic,
            potential_energy_J=potential,
        )

    def _present(self) -> Array:
        """Return the present sensor inputs, to fill the filters' history at a change of rate."""
        if self._ring.shape[1] > 0:
            return self._ring[:, int(self._counters[layout.HEAD])].copy()
        angle, depth = self._state[layout.ANGLE], self._state[layout.DEPTH]
        fx, fy, _ = mechanics.resting(self.constants, angle, depth)
        position = mechanics.geometry(self.constants, angle, depth)
        wall = self._wall
        return np.array(
            kernels.views(self.constants, wall.table, wall.state, position, depth, fx, fy, 0.0)
        )


def _mean_force(constants: Constants) -> float:
    """Return the mean joint force of a slow turn, N."""
    angles = np.linspace(0.0, 2.0 * math.pi, 25)[:-1]
    return float(np.mean([mechanics.resting(constants, angle, 0.0)[2] for angle in angles]))


def rest_angle(constants: Constants) -> float:
    """Return the crank angle (rad, 0 ... 2 pi) of least potential energy: spring and weight."""
    angles = np.linspace(0.0, 2.0 * math.pi, 721)[:-1]
    potential = [mechanics.energy(constants, angle, 0.0, 0.0)[1] for angle in angles]
    return float(angles[int(np.argmin(potential))])


def _samples(first: int, out: Array) -> Samples:
    """Return rows of the output as records, whose fields have the rows' order."""
    truth = Truth(*out[layout.OUT_TIME : layout.OUT_DEPTH + 1])
    shaft, bridge_1, bridge_2, probe_1, probe_2 = out[layout.OUT_SHAFT : layout.OUT_PROBE_2 + 1]
    rise_K, warm_s, noise = out[layout.OUT_RISE], out[layout.OUT_WARM], out[layout.ROWS :]
    return Samples(first, shaft, bridge_1, bridge_2, probe_1, probe_2, rise_K, warm_s, noise, truth)
