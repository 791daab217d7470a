"""`rigapp engine`: host an engine until a viewer or a signal shuts it down."""

from __future__ import annotations

import os
import time
from pathlib import Path

from rigapp.config.loading import read_rig
from rigapp.process.ending import Background, shutdown_with_timeout, termination_signals
from rigapp.schema.details import indented
from rigapp.schema.messages import RunState
from rigapp.schema.notices import Finished
from rigapp.schema.states import ACTIVE
from rigapp.service.host import EngineHost
from rigapp.service.recorded import settle
from rigapp.service.registry import withdraw
from rigapp.service.requests import EXPECTED
from rigapp.service.security import parse_bind
from rigapp.service.simulated import parse_speed
from rigapp.texts import sentence_of_error

CONNECT_FOR_S, CONNECT_PERIOD_S = 300.0, 15.0
"""Time and period of attempts to connect after the computer's start, when devices may be late."""
IDLE_EXIT_S = 60.0  # a window may be closed and opened again meanwhile
CLOSE_S = 120.0
"""Time limit of closing: stopping a running test may take 60 s, a notifier 30 s."""


def serve(rig_path: Path, speed: str | None, bind: str | None = None, *, stay: bool = False) -> int:
    """Host an engine for windows until one of them, or a signal, shuts it down.

    bind: see ``security.parse_bind``. stay: run without viewers, for an engine started with the
    computer: it reports a test that was cut off, and tries for some minutes to connect its devices.
    Without ``stay``, it ends after ``IDLE_EXIT_S`` without test and viewer.
    """
    rig = read_rig(rig_path)
    host = EngineHost(rig, parse_speed(speed, rig), parse_bind(bind) if bind else None)
    with termination_signals() as signals:
        Background(lambda: _connect_quietly(host, CONNECT_FOR_S if stay else 0.0), "connect")
        if stay:
            host.warn_of_cut_off_test()
        unused_since = time.monotonic()
        while not host.ended.is_set() and not signals:
            notice = host.notices.get(0.2)
            if isinstance(notice, Finished):
                settle(notice)
            if stay or host.watched or host.occupied:
                unused_since = time.monotonic()
            elif time.monotonic() - unused_since > IDLE_EXIT_S:
                break
        close_host(host, signals)
    return 0


def close_host(host: EngineHost, signals: list[str]) -> None:
    """Close a host at the end of its process, which ends even if a thread hangs.

    signals: collected by ``termination_signals``.
    """
    shutdown_with_timeout(
        host.close,
        signals,
        turning=lambda: host.engine.state in ACTIVE,
        give_up=lambda: withdraw(os.getpid()),
        limit_s=CLOSE_S,
    )


def _connect_quietly(host: EngineHost, patience_s: float = 0.0) -> None:
    """Connect immediately, so that the window shows live values; the state shows a failure.

    patience_s: time of repeated attempts, until a viewer attaches or the state changes.
    """
    until = time.monotonic() + patience_s
    while True:
        try:
            host.connect()
        except EXPECTED as error:
            print(f"rigapp engine: {indented(sentence_of_error(error))}", flush=True)
        untouched = host.engine.state in (RunState.IDLE, RunState.FAULT) and not host.watched
        if not untouched or time.monotonic() > until or host.ended.wait(CONNECT_PERIOD_S):
            return
