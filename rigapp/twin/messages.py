"""What the engine and the twin's process tell each other; light to load for the engine."""

from __future__ import annotations

import msgspec

from rigapp.config.parameters import ParameterFile
from rigapp.config.recipe import PriorSection
from rigapp.schema.messages import Prediction


class IdentificationTarget(msgspec.Struct, frozen=True):
    """Say what a test asks of its wear, and what the record of its probes states.

    sensitivity: relative standard uncertainty; drift_um: what a position may wander by in a decade
    of revolutions, standard; None where no record states it. depth_um: of the stop criterion, None
    without one. planned: the last revolution. record: which one it is. prior: of the wear
    coefficient, None where the test file has none. load: relative standard uncertainty of the
    force, 0 where nothing states it.
    """

    sensitivity: float | None = None
    drift_um: float | None = None
    depth_um: float | None = None
    planned: float = 0.0
    record: str = ""
    prior: PriorSection | None = None
    load: float = 0.0

    @property
    def depth(self) -> float | None:
        """Return the depth of the stop criterion, m."""
        return None if self.depth_um is None else 1e-6 * self.depth_um


class TwinSetup(msgspec.Struct, frozen=True):
    """Tell the twin which model to run.

    new_position_um: mean pin position (probe_1, probe_2) of the new bushing, where the file of a
    resumed test knows it; else the first revolutions tell. checkpoint: what an earlier twin of the
    same test left, to go on from there. new_test: that was another test of the same specimen,
    whose revolutions begin anew; same_model: of both tests, else only where the probes saw the new
    bushing counts. sought: what is to be identified. force_uncertainty_N: expanded (k = 2) of the
    measured force, constant and per N, None where nothing states it.
    """

    parameters: ParameterFile
    joint: str
    new_position_um: tuple[float, float] | None = None
    checkpoint: bytes = b""
    new_test: bool = False
    same_model: bool = True
    sought: IdentificationTarget = IdentificationTarget()
    force_uncertainty_N: tuple[float, float] | None = None


class TwinAnswer(msgspec.Struct, frozen=True):
    """Say what became of the setup or of a revolution.

    refused: why there is no prediction of this revolution; the next one may have one. failed: why
    this process ends and another must take over. hopeless: no other would do better. said: what
    the operator should read besides.
    """

    prediction: Prediction | None = None
    refused: str = ""
    failed: str = ""
    hopeless: bool = False
    said: tuple[str, ...] = ()
