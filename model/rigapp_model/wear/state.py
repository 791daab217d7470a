"""Wear during a running test: a small state, advanced by measured or predicted revolutions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.bushing.compliance import surface_angles
from rigapp_model.bushing.ring import ring_of, sectors_at_least
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Parameters
from rigapp_model.wear.coefficient import steady_cycles, switched
from rigapp_model.wear.front import (
    Front,
    WearProblem,
    contact_pressure,
    implicit_step,
    touched,
    wear_problem,
    worn_area,
)
from rigapp_model.wear.loads import CycleLoads, gathered, loads_of_cycle
from rigapp_model.wear.plan import mesh_error
from rigapp_model.wear.profile import profile

Array = NDArray[np.float64]

POSITIONS = 12  # of the crank: with 96 the depth changes by 1e-6, in seven times the time
LARGEST_SECTORS = 360  # with twice as many the depth of the reference joint does not change


@dataclass(frozen=True, slots=True)
class WearState:
    """Wear of a bushing after ``cycles``, in SI; ``advance`` returns a new state.

    ``max_depth`` (m); ``depth_at_contact`` (m) at the contact point: increase of the clearance;
    ``worn_area`` (m^2); ``worn_mass`` (kg); ``peak_pressure`` (Pa) and ``mean_force`` (N) of the
    last advance; ``estimated_error`` (m) of the depth.
    """

    parameters: Parameters
    problem: WearProblem
    front: Front
    cycles: float = 0.0
    peak_pressure: float = 0.0
    mean_force: float = 0.0
    step_error: float = 0.0

    @property
    def max_depth(self) -> float:
        """Return the largest depth, m."""
        return max(float(self.front.depth(self.problem.ring.inner).max()), 0.0)

    @property
    def depth_at_contact(self) -> float:
        """Return the depth at the contact point of a follower in tension or compression, m."""
        return self.front.depth_at_contact_point(self.problem.ring.inner)

    @property
    def clearance(self) -> float:
        """Return the radial clearance including the wear at the contact point, m."""
        return self.problem.ring.clearance + self.depth_at_contact

    @property
    def worn_area(self) -> float:
        """Return the worn cross-section, m^2."""
        return worn_area(self.problem, self.front.surface)

    @property
    def worn_mass(self) -> float:
        """Return the worn mass, kg."""
        return self.worn_area * self.problem.width * self.parameters.bushing.density

    @property
    def estimated_error(self) -> float:
        """Return a bound of the depth's error due to steps and mesh, m."""
        if self.front.touching is None:
            return 0.0
        nodes_in_half = 0.5 * float(self.front.touching.sum(axis=1).max())
        return self.step_error + float(mesh_error(np.array(nodes_in_half))) * self.max_depth

    def profile(self) -> tuple[Array, Array]:
        """Return angles (rad, from -pi, 0 at the initial contact point) and depths (m)."""
        sectors = self.problem.sectors
        return surface_angles(sectors), profile(self.front.surface, self.problem.ring)

    def advance(
        self,
        force_follower: ArrayLike,
        slip: ArrayLike,
        cycles: float,
        sliding: ArrayLike = 1.0,
    ) -> WearState:
        """Advance by a number of cycles equal to this revolution.

        force_follower: (2, n), N, on the follower by the pin in the follower frame, measured or
        predicted, at equal steps of the crank; slip: (n,), m, from each sample to the next;
        sliding: sliding speed, m/s; its sign is used for friction, its magnitude for the regime.
        Samples are merged into 12 positions. Two implicit steps; their difference from a single
        step is added to the error. Raises ContactError or ModelError.
        """
        return self.advance_by(worn_by(self.parameters, force_follower, slip, sliding), cycles)

    def advance_by(self, revolution: CycleLoads, cycles: float) -> WearState:
        """Advance by a number of cycles of loads in the wear frame (see ``advance``)."""
        loads = gathered(revolution.pressing(), POSITIONS).pressing()
        if not loads.slip.size:
            return replace(self, cycles=self.cycles + cycles, mean_force=0.0, peak_pressure=0.0)
        law, done = self.problem.law, self.cycles
        effort = float(steady_cycles(law, done + cycles) - steady_cycles(law, done))
        front = self.front
        if front.pins is None:
            front = touched(self.problem, front, loads)
        coarse = implicit_step(self.problem, front, loads, effort)
        fine = front
        for _ in range(2):
            fine = implicit_step(self.problem, fine, loads, 0.5 * effort)
        inner = self.problem.ring.inner
        depth = fine.depth(inner)
        deep = depth >= 0.5 * depth.max()
        error = float(np.abs(depth - coarse.depth(inner))[deep].max(initial=0.0))
        return replace(
            self,
            front=fine,
            cycles=self.cycles + cycles,
            peak_pressure=float(contact_pressure(self.problem, fine).max()),
            mean_force=loads.mean_force,
            step_error=self.step_error + error,
        )


def worn_by(
    parameters: Parameters, force_follower: ArrayLike, slip: ArrayLike, sliding: ArrayLike = 1.0
) -> CycleLoads:
    """Return a revolution's loads with the factors of their regimes; arguments as ``advance``."""
    joint = parameters.joint
    loads = loads_of_cycle(force_follower, slip, joint.friction_coefficient, sliding)
    return switched(loads, np.asarray(sliding), joint, parameters.bushing.law)


def unworn_state(parameters: Parameters, typical_force: float) -> WearState:
    """Return the state before the first cycle.

    typical_force: largest expected force, N, which sets the mesh, of 120 to 360 sectors, so that a
    narrow contact is resolved. Raises ModelError unless it is above 0.
    """
    if not (np.isfinite(typical_force) and typical_force > 0.0):
        raise ModelError("typical_force", typical_force, say("give a finite force above 0"), "N")
    joint = parameters.joint
    ring = ring_of(joint, parameters.bushing.material)
    first = ring.half_angle(typical_force / joint.bushing_width)
    sectors = int(np.clip(sectors_at_least(6.0 * np.pi / first), 120, LARGEST_SECTORS))
    problem = _problem(parameters, sectors)
    return WearState(parameters, problem, problem.unworn())


def restored_state(
    parameters: Parameters, surface: ArrayLike, cycles: float, step_error: float = 0.0
) -> WearState:
    """Restore a state from its ``front.surface``, (nodes, 2), m.

    cycles, step_error: of the state. It advances like the original. Raises ModelError for a surface
    of another bushing.
    """
    nodes = np.ascontiguousarray(surface, dtype=np.float64)
    shape = nodes.shape
    if nodes.ndim != 2 or shape[1] != 2 or shape[0] % 2 or shape[0] < 16:
        raise ModelError("surface", shape, say("give (2 x sectors, 2) positions of surface nodes"))
    problem = _problem(parameters, shape[0] // 2)
    ring = problem.ring
    radius = np.hypot(nodes[:, 0], nodes[:, 1])
    if not (np.isfinite(nodes).all() and radius.min() > 0.99 * ring.inner):
        raise ModelError(
            "surface", float(radius.min()), say("it is inside the unworn bushing"), "m"
        )
    if radius.max() >= ring.outer:
        raise ModelError("surface", float(radius.max()), say("it is outside the bushing"), "m")
    return WearState(parameters, problem, Front(nodes), cycles, step_error=step_error)


def _problem(parameters: Parameters, sectors: int) -> WearProblem:
    """Return the problem with all surface nodes, for forces in any direction."""
    joint = parameters.joint
    ring = ring_of(joint, parameters.bushing.material)
    any_load = CycleLoads(np.array([[1.0, 0.0]]), np.array([1.0]))
    return wear_problem(
        ring,
        sectors,
        joint.bushing_width,
        parameters.bushing.wear_coefficient,
        any_load,
        np.pi,
        parameters.bushing.law,
    )
