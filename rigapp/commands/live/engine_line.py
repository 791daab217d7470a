"""A line to an engine for a command: the one that runs for the rig, or one hosted here."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.recipe import TestFile
from rigapp.process.ending import ending_as_interrupt
from rigapp.schema.messages import Reply, Request

log = logging.getLogger(__name__)

Ask = Callable[[str, dict[str, Any]], Any]


@contextmanager
def engine_line(
    rig: Path, operator: str = "", *, own: bool = False, test: TestFile | None = None
) -> Iterator[Ask]:
    """Yield a function that asks the rig's engine; what is refused raises UnusableInput.

    own: host an engine here even if another one runs (simulated rigs). test: whose mechanism a rig
    that is simulated here has; the packaged one without.
    """
    from rigapp.service.client import Client
    from rigapp.service.host import EngineHost
    from rigapp.service.launch import find_engine
    from rigapp.service.simulated import parse_speed

    entry = None if own else find_engine(rig)
    if entry is not None:
        client = Client(entry, operator)
        try:
            yield lambda verb, arguments: result_of(client.request(verb, arguments))
        finally:
            client.close()
        return
    document = read_rig(rig)
    with ending_as_interrupt():
        host = EngineHost(document, parse_speed(None, document), own=own)
        try:
            host.connect(test)
            yield lambda verb, arguments: result_of(host.handle(Request(verb, arguments, operator)))
        finally:
            host.close()


@contextmanager
def occupied(ask: Ask, what: str, fastest_rpm: float = 0.0) -> Iterator[str]:
    """Let a calibration occupy the rig, and yield its key; it ends in order, however this ends.

    fastest_rpm: at which its tests turn the spindle. Raises UnusableInput where the rig is not
    free.
    """
    key = ask("calibration_begin", {"what": what, "fastest_rpm": fastest_rpm})["key"]
    try:
        yield key
    finally:
        try:
            ask("calibration_end", {"key": key})
        except UnusableInput as error:
            log.warning("the end of the calibration: %s", error)


def result_of(reply: Reply) -> Any:
    """Return the result of an answer; raise UnusableInput for a refusal."""
    if not reply.ok:
        raise UnusableInput(reply.sentence)
    return reply.result
