"""A bushing of the model that wears ahead of the real one, for the elastic approach by depth.

Approach depends on depth, whatever the wear coefficient is: it sets only how fast both
grow. So the approach at the *measured* depth is removed, however wrong the model's wear is.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.details import error_text
from rigapp.texts import say
from rigapp.twin.approach import Approach
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Parameters
from rigapp_model.wear.front import Front, contact_pressure, implicit_step, touched
from rigapp_model.wear.loads import CycleLoads, gathered, loads_of_cycle
from rigapp_model.wear.state import POSITIONS, unworn_state

Array = NDArray[np.float64]

GROWTH = 0.15
"""A step wears by this share of depth and approach together."""
AHEAD = 1.3
"""The table reaches further than the requested depth by this factor."""
FIRST_REACH = 10e-6
"""The table begins with depths up to this value, m."""
ANY_COEFFICIENT = 1e-12
"""Wear coefficient of a bushing whose model does not wear, m^2/N; the table is the same for any."""

log = logging.getLogger(__name__)


@dataclass(slots=True)
class BushingAhead:
    """Wear a new bushing under the loads of a revolution, up to the requested depth."""

    parameters: Parameters
    loads: CycleLoads
    _front: Front | None = None
    _depths: list[float] = field(default_factory=list)
    _rows: list[Array] = field(default_factory=list)
    _failed: bool = False
    _approach: Approach | None = None

    def upto(self, depth: float) -> Approach | None:
        """Return the approach at depths up to one at least, m; None where the model fails."""
        try:
            while not self._failed and self._reach < AHEAD * max(depth, FIRST_REACH):
                self._step()
        except (ModelError, ValueError, ArithmeticError) as error:
            self._failed = True
            why = error_text(error, say("the wear cannot be computed"))
            log.warning(
                say("The elastic approach is not known beyond {:g} m: {}", self._reach, why)
            )
        if self._rows and (self._approach is None or self._approach.depths.size < len(self._rows)):
            order = np.argsort(self.loads.magnitude)
            table = np.array(self._rows)[:, order]
            self._approach = Approach(np.array(self._depths), self.loads.magnitude[order], table)
        return self._approach

    @property
    def _reach(self) -> float:
        return self._depths[-1] if self._depths else -1.0

    def _step(self) -> None:
        coefficient = self.parameters.bushing.wear_coefficient or ANY_COEFFICIENT
        state = unworn_state(self.parameters, float(self.loads.magnitude.max()))
        problem = replace(state.problem, wear_coefficient=coefficient)
        if self._front is None:
            front = touched(problem, problem.unworn(), self.loads)
        else:
            peak = float(contact_pressure(problem, self._front).max())
            wanted = GROWTH * (self._depths[-1] + float(self._rows[-1].max()))
            cycles = wanted / (coefficient * peak * float(self.loads.slip.sum()))
            front = implicit_step(problem, self._front, self.loads, cycles)
        assert front.pins is not None
        ring = problem.ring
        row = np.array([ring.indentation(front.surface, pin) for pin in front.pins])
        depth = front.depth_at_contact_point(ring.inner)
        if depth <= self._reach:
            raise ArithmeticError(say("the bushing ahead does not wear where the pin bears"))
        self._front = front
        self._depths.append(depth)
        self._rows.append(row)


def bushing_ahead(parameters: Parameters, force: Array, slip: Array) -> BushingAhead | None:
    """Return the bushing ahead under a revolution's forces, None where nothing presses.

    force (2, n): N, on the follower by the pin in the follower frame; slip (n,): m.
    """
    mu = parameters.joint.friction_coefficient
    try:
        loads = gathered(loads_of_cycle(force, slip, mu).pressing(), POSITIONS).pressing()
    except ModelError:
        return None
    return BushingAhead(parameters, loads) if loads.slip.size else None
