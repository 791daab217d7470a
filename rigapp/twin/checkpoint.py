"""State from which a new twin continues another one: stored with the test, and in its file."""

from __future__ import annotations

import logging
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp.twin.agreement import BandRecord
from rigapp.twin.ahead import BushingAhead
from rigapp.twin.deviation import DeviationRecord
from rigapp.twin.identifying import IdentifiedRecord
from rigapp.twin.pinpath import Reference
from rigapp.twin.twin import TrackedBushing, Twin
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Parameters
from rigapp_model.recurrent_motion import RecurrentMotion
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.state import restored_state

log = logging.getLogger(__name__)

VERSION = 1


class BushingRecord(msgspec.Struct, frozen=True):
    """A bushing's worn surface: float64 (nodes, 2) as bytes, m; why it failed, if it did."""

    surface: bytes
    cycles: float
    step_error: float
    failed: str


class ReferenceRecord(msgspec.Struct, frozen=True):
    """The probes' reference in the new bushing, see ``pinpath.Reference``; m."""

    centre: tuple[float, float]
    run_out: tuple[float, float]
    centred: bool
    radial: float
    across: float
    approach: float
    elastic: bool = False
    beyond: float = float("nan")
    lean: float = float("nan")


class RecurrentRecord(msgspec.Struct, frozen=True):
    """The recurrent motion of the crank: mean (complex128) and scatter (float64) as bytes."""

    speed: float
    seen: int
    mean: bytes
    scatter: bytes
    chance: float


class Checkpoint(msgspec.Struct, frozen=True):
    """Everything of a twin after revolution ``newest``.

    loads: of the bushing ahead, float64 (positions, 3) as bytes: force (N) and slip (m); empty
    where there is none. identified: the wear coefficient so far, None in older ones. before:
    revolutions that the bushing had made when the test began. band: within which a healthy rig
    agrees; deviation: from the model; recurrent: motion of the crank; None in older ones.
    """

    version: int
    newest: int
    profiled: int
    kept_profile: int
    predicted: BushingRecord | None
    driven: BushingRecord | None
    reference: ReferenceRecord | None
    loads: bytes = b""
    identified: IdentifiedRecord | None = None
    before: int = 0
    band: BandRecord | None = None
    deviation: DeviationRecord | None = None
    recurrent: RecurrentRecord | None = None


def packed(twin: Twin) -> bytes:
    """Return a twin's checkpoint."""
    new = twin.reference
    reference = None
    if new is not None:
        reference = ReferenceRecord(
            _pair(new.centre), _pair(new.run_out), new.centred,
            new.radial, new.across, new.approach, new.elastic,
            new.beyond, new.lean,
        )  # fmt: skip
    return msgspec.msgpack.encode(
        Checkpoint(
            VERSION, twin.newest, twin.profiled, twin.kept_profile,
            _record(twin.predicted), _record(twin.driven), reference, _loads(twin.ahead),
            None if twin.identifier is None else twin.identifier.packed(),
            twin.before,
            twin.agreement.packed(),
            twin.deviation.packed(),
            _recurrent_record(twin.recurrent),
        )
    )  # fmt: skip


def restore(twin: Twin, checkpoint: bytes) -> bool:
    """Restore a checkpoint into a new twin; return False, nothing changed, if it does not fit."""
    record = _decoded(checkpoint)
    if record is None:
        return False
    try:
        predicted = _bushing(record.predicted, twin.parameters)
        driven = _bushing(record.driven, twin.parameters)
        ahead = _ahead(record.loads, twin.parameters)
    except (ModelError, ValueError):
        return False
    twin.predicted, twin.driven, twin.ahead = predicted, driven, ahead
    twin.newest, twin.profiled = record.newest, record.profiled
    twin.kept_profile, twin.before = record.kept_profile, record.before
    if twin.identifier is not None and record.identified is not None:
        twin.identifier.restore(record.identified, None if ahead is None else ahead.loads)
    twin.reference = _reference(record.reference)
    if record.band is not None:
        twin.agreement.restore(record.band)
    if record.deviation is not None:
        twin.deviation.restore(record.deviation)
    if record.recurrent is not None:
        twin.recurrent = _recurrent(record.recurrent)
    return True


def _recurrent_record(motion: RecurrentMotion) -> RecurrentRecord:
    mean, scatter = motion.mean.astype("<c16").tobytes(), motion.scatter.astype("<f8").tobytes()
    return RecurrentRecord(
        float(motion.speed), int(motion.seen), mean, scatter, float(motion.chance)
    )


def _recurrent(record: RecurrentRecord) -> RecurrentMotion:
    mean = np.frombuffer(record.mean, dtype="<c16").copy()
    scatter = np.frombuffer(record.scatter, dtype="<f8").copy()
    return RecurrentMotion(record.speed, record.seen, mean, scatter, record.chance)


def take_over(twin: Twin, checkpoint: bytes, same_model: bool) -> None:
    """Continue a new twin with the bushing of another test.

    same_model: of both tests, and its readings are valid; else only the probes' reading of the
    new bushing is taken over, the model's bushings begin unworn, and no coefficient is identified
    from a wear that they lack.
    """
    if same_model and restore(twin, checkpoint):
        twin.before, twin.newest = twin.before + twin.newest, 0
        twin.profiled = twin.kept_profile = 0
        if twin.identifier is not None:
            sought = twin.identifier.sought
            planned = sought.planned + twin.before
            twin.identifier.sought = msgspec.structs.replace(sought, planned=planned)
        return
    record = _decoded(checkpoint)
    if record is not None and record.reference is not None:
        log.warning(
            say(
                "The specimen's last test had another model, or its wear depth is not to be"
                " trusted: the model's bushings begin unworn, and the wear coefficient is not"
                " stated."
            )
        )
        twin.reference, twin.identifier = _reference(record.reference), None


def _reference(kept: ReferenceRecord | None) -> Reference | None:
    if kept is None:
        return None
    return Reference(
        np.array(kept.centre), np.array(kept.run_out), kept.centred,
        kept.radial, kept.across, kept.approach, kept.elastic,
        kept.beyond, kept.lean,
    )  # fmt: skip


def _decoded(checkpoint: bytes) -> Checkpoint | None:
    try:
        record = msgspec.msgpack.decode(checkpoint, type=Checkpoint)
    except msgspec.DecodeError:
        return None
    return record if record.version == VERSION else None


def _record(bushing: TrackedBushing) -> BushingRecord | None:
    state = bushing.state
    if state is None:
        return BushingRecord(b"", 0.0, 0.0, bushing.failed) if bushing.failed else None
    surface = state.front.surface.astype("<f8").tobytes()
    return BushingRecord(surface, state.cycles, state.step_error, bushing.failed)


def _bushing(record: BushingRecord | None, parameters: Parameters) -> TrackedBushing:
    if record is None:
        return TrackedBushing()
    if not record.surface:
        return TrackedBushing(failed=record.failed)
    surface = np.frombuffer(record.surface, dtype="<f8").reshape(-1, 2)
    state = restored_state(parameters, surface, record.cycles, record.step_error)
    return TrackedBushing(state, record.failed)


def _loads(ahead: BushingAhead | None) -> bytes:
    if ahead is None:
        return b""
    return np.column_stack([ahead.loads.force, ahead.loads.slip]).astype("<f8").tobytes()


def _ahead(record: bytes, parameters: Parameters) -> BushingAhead | None:
    if not record:
        return None
    table = np.frombuffer(record, dtype="<f8").reshape(-1, 3)
    return BushingAhead(parameters, CycleLoads(table[:, :2].copy(), table[:, 2].copy()))


def _pair(vector: NDArray[Any]) -> tuple[float, float]:
    return float(vector[0]), float(vector[1])
