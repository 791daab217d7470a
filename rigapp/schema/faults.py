"""A fault of the simulated rig, as in fault files, requests and the control channel."""

from __future__ import annotations

from typing import Annotated

import msgspec

NotNegative = Annotated[float, msgspec.Meta(ge=0)]


class FaultRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """One fault: kind, place, begin, duration, size; see ``simulation.faults``.

    channel: of a signal fault, by its name in the rig's channel table.
    """

    kind: str
    device: str = ""
    channel: str = ""
    at_s: NotNegative | None = None
    at_revolution: NotNegative | None = None
    duration_s: NotNegative | None = None
    value: float | None = None
    count: Annotated[int, msgspec.Meta(ge=1)] | None = None
    target: int | None = None
    rate_per_s: NotNegative = 1.0
