"""A line to an engine for a command: the one that runs for the rig, or one hosted here."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.recipe import TestFile
from rigapp.process.ending import ending_as_interrupt
from rigapp.schema.messages import Reply, Request

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
            yield lambda verb, arguments: _result(client.request(verb, arguments))
        finally:
            client.close()
        return
    document = read_rig(rig)
    with ending_as_interrupt():
        host = EngineHost(document, parse_speed(None, document))
        try:
            host.connect(test)
            yield lambda verb, arguments: _result(host.handle(Request(verb, arguments, operator)))
        finally:
            host.close()


def _result(reply: Reply) -> Any:
    if not reply.ok:
        raise UnusableInput(reply.sentence)
    return reply.result
