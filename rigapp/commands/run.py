"""`rigapp run` and `rigapp resume`: one test without a window."""

from __future__ import annotations

import os
import sys
import time
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Protocol

from rigapp.commands.engine import close_host
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.process.ending import Background, end_at_once, ending_as_interrupt, termination_signals
from rigapp.schema.details import indented
from rigapp.schema.messages import FinishReason
from rigapp.schema.notices import Committed, Finished, Notice, StateChanged
from rigapp.schema.states import ACTIVE, Ending, InFault, Refused
from rigapp.schema.wire import json_bytes
from rigapp.service.host import EngineHost
from rigapp.service.recorded import (
    end_whole_test,
    recorded_test,
    settle,
    with_revolutions,
)
from rigapp.service.registry import withdraw
from rigapp.service.resumption import Resumption, interval
from rigapp.service.security import parse_bind
from rigapp.service.simulated import parse_speed
from rigapp_drivers.api import DeviceError, DeviceFault

STATUS = {
    FinishReason.COMPLETE: 0,
    FinishReason.OPERATOR: 1,
    FinishReason.LIMIT: 1,
    FinishReason.STORAGE: 1,
    FinishReason.INTERNAL: 1,
    FinishReason.DEVICE: 3,
}
"""Outcome of a test -> exit status."""

HANGING_S = 10.0
"""Longest wait, after an interruption, for a device that is being opened."""

OFF_S = 3.0
"""Time for powering off before a further interruption ends the process."""


class Progress(Protocol):
    """Show the milestones of a test."""

    def notice(self, notice: Notice) -> None:
        """Show one milestone."""

    def close(self) -> None:
        """End the display."""


def run_test(
    test: Path,
    rig: Path,
    out: Path,
    revolutions: int | None,
    progress: str | None,
    speed: str | None,
    bind: str | None = None,
    record_wire: Path | None = None,
) -> int:
    """Run one test into a new file; return the exit status.

    record_wire: path for the recordings of the device lines.
    """
    document = with_revolutions(read_test(test), revolutions)
    return _conduct(
        document, rig, out, progress, speed, bind, resume=False, record_wire=record_wire
    )


def resume_test(
    file: Path,
    rig: Path,
    progress: str | None,
    speed: str | None,
    bind: str | None = None,
    *,
    reason: str = "",
) -> int:
    """Resume an interrupted test in its own file; return the exit status.

    reason: for resuming despite the findings of ``resumption``; logged.
    """
    ended = end_whole_test(file)
    if ended is not None:
        if progress == "json":
            _Json().notice(ended)
        return _report(ended)
    test = recorded_test(file)
    return _conduct(test, rig, file, progress, speed, bind, resume=True, reason=reason)


def examine_test(file: Path, rig: Path) -> int:
    """Show the findings for resuming a test; return 1 when it cannot be resumed."""
    document = read_rig(rig)
    with ending_as_interrupt():
        host = EngineHost(document, parse_speed(None, document))
        try:
            result = host.resumption(file)
        except Refused as error:
            raise UnusableInput(f"The rig cannot be looked at: {error}.") from error
        finally:
            host.close()
    show_resumption(result)
    return 1 if result.blocked or result.asks_reason else 0


def _conduct(
    test: Document[TestFile],
    rig: Path,
    out: Path,
    progress: str | None,
    speed: str | None,
    bind: str | None,
    *,
    resume: bool,
    reason: str = "",
    record_wire: Path | None = None,
) -> int:
    if progress not in (None, "json"):
        raise UnusableInput(f"--progress {progress}: only json is known; or leave it out.")
    rig_document = read_rig(rig)
    chosen = parse_speed(speed, rig_document)
    if not resume:
        _refuse_bad_target(out)
    if record_wire is not None and not record_wire.parent.is_dir():
        raise UnusableInput(
            f"{record_wire}: the folder {record_wire.parent} does not exist; create it first."
        )
    with termination_signals() as signals:
        host = EngineHost(
            rig_document, chosen, parse_bind(bind) if bind else None, record_wire=record_wire
        )
        shown: Progress = (
            _Json()
            if progress == "json"
            else _Bar(test.record)
            if sys.stderr.isatty()
            else _Quiet()
        )
        operator = test.record.metadata.operator
        try:
            starting = Background(
                lambda: host.start(
                    test, out, operator, resume=resume, reason=reason, examined=show_resumption
                ),
                "start",
            )
            return _follow(host, starting, shown, Interruption(host, signals), out)
        except DeviceError as error:
            end = Finished(FinishReason.DEVICE, str(error), "fault", 0, str(out))
            if progress == "json":
                shown.notice(host.engine.outcome or end)
            drive = rig_document.record.spindle.device
            if isinstance(error, DeviceFault) and error.device == drive:
                hint = f"{error.sentence} The reset is: rigapp reset {rig}"
                raise DeviceFault(error.device, error.port, hint) from error
            raise
        finally:
            shown.close()
            close_host(host, signals)
            if host.engine.outcome is not None:
                settle(host.engine.outcome)


def show_resumption(past: Resumption) -> None:
    """Print recorded state and differences to standard error, a line for each."""
    last = ""
    if past.last_at:
        at = datetime.fromtimestamp(past.last_at, UTC).isoformat(" ", "seconds")
        last = f", the last one at {at}, {interval(past.gap_s)} ago"
    lines = [
        f"{past.file}: {past.title or 'test'}, {past.status}. {past.reason}".rstrip(),
        f"{past.revolutions} revolutions are in it, up to number {past.last_revolution} of"
        f" {past.planned}{last}.",
    ]
    for finding in past.findings:
        same = finding.before == finding.now or not finding.before
        values = finding.now if same else f"{finding.before} -> {finding.now}"
        text = ": ".join(part for part in (finding.what, values) if part)
        lines.append(
            f"  {finding.fit.value:14} {text}{f' ({finding.sentence})' if finding.sentence else ''}"
        )
    print("\n".join(map(indented, lines)), file=sys.stderr)


def _refuse_bad_target(out: Path) -> None:
    """Refuse an unusable target before the start."""
    if out.exists() or out.is_symlink():
        raise UnusableInput(
            f"{out}: the file exists and is not overwritten; give another name, or use"
            " 'rigapp resume' to go on with it."
        )
    if not out.parent.is_dir():
        raise UnusableInput(f"{out}: the folder {out.parent} does not exist; create it first.")


def _report(end: Finished) -> int:
    status = STATUS[end.reason]
    sentence = f"{end.file}: {end.revolutions} revolutions, {end.status}. {end.sentence}"
    with suppress(OSError):  # of a terminal that was closed
        print(indented(sentence), file=sys.stderr)
    return status


class Interruption:
    """Handle Ctrl-C, kill and a closed terminal, even if a thread hangs.

    During a test the first signal stops it under control, the second powers off the drive, a third
    ends the process. Before a test, the first cancels the start, or ends the process.
    """

    def __init__(self, host: EngineHost, signals: list[str]) -> None:
        self._host = host
        self._signals = signals
        self._stop: Background[None] | None = None
        self._off: Background[None] | None = None
        self._since = 0.0

    @property
    def cause(self) -> str:
        """Return the first signal, empty without one."""
        return self._signals[0] if self._signals else ""

    def obey(self, starting: Background[None]) -> None:
        """Handle the signals received so far; to be called periodically, never blocks."""
        if not self._signals:
            return
        host, now = self._host, time.monotonic()
        self._since = self._since or now
        host.cancel(f"interrupted by {self.cause}")
        if host.engine.state in ACTIVE:
            self._end_test(now)
        elif not starting.done and (len(self._signals) > 1 or now - self._since > HANGING_S):
            withdraw(os.getpid())
            end_at_once(
                f"interrupted by {self.cause} while connecting; a device that did not answer was"
                " left open."
            )

    def _end_test(self, now: float) -> None:
        engine = self._host.engine
        if self._stop is None or (self._stop.done and isinstance(self._stop.error, Refused)):
            self._stop = Background(
                lambda: engine.stop("", f"interrupted by {self.cause}"), "interrupt"
            )
        if len(self._signals) > 1 and self._off is None:
            self._off = Background(lambda: engine.drive_off("", "interrupted twice"), "drive off")
            self._since = now
        if len(self._signals) > 2 and self._off is not None and now - self._since > OFF_S:
            withdraw(os.getpid())
            end_at_once("interrupted again: THE SPINDLE MAY STILL TURN; press the emergency stop.")


def _follow(
    host: EngineHost,
    starting: Background[None],
    shown: Progress,
    interruption: Interruption,
    out: Path,
) -> int:
    """Show milestones until the test ends or fails to start; return the exit status."""
    while True:
        interruption.obey(starting)
        notice = host.notices.get(0.1)
        if notice is not None:
            shown.notice(notice)
        if isinstance(notice, Finished):
            return _report(notice)
        if notice is None and starting.done and starting.error is not None:
            return _not_started(starting.error, shown, interruption, out)


def _not_started(
    error: BaseException, shown: Progress, interruption: Interruption, out: Path
) -> int:
    """Return the exit status of an interrupted start; raise any other error."""
    if not isinstance(error, Refused):
        raise error
    if interruption.cause:
        why, sentence = FinishReason.OPERATOR, f"interrupted by {interruption.cause}."
    elif isinstance(error, InFault):
        why, sentence = error.code, str(error)
    else:
        raise UnusableInput(f"The test cannot start: {error}.") from error
    end = Finished(
        why, f"The test did not start: {sentence}", Ending(why, sentence).status, 0, str(out)
    )
    shown.notice(end)
    with suppress(OSError):
        print(indented(end.sentence), file=sys.stderr)
    return STATUS[why]


class _Json:
    """Write one JSON object per line to standard output."""

    def notice(self, notice: Notice) -> None:
        try:
            print(json_bytes(notice).decode(), flush=True)
        except OSError:
            # A closed pipe must not end a test.
            sys.stdout = open(os.devnull, "w")  # noqa: SIM115 - open until the process ends

    def close(self) -> None:
        pass


class _Quiet:
    """Show nothing, for a pipe."""

    def notice(self, notice: Notice) -> None:
        pass

    def close(self) -> None:
        pass


class _Bar:
    """Show a progress bar on a terminal."""

    def __init__(self, test: TestFile) -> None:
        from rich.console import Console
        from rich.progress import (
            BarColumn,
            MofNCompleteColumn,
            Progress,
            TextColumn,
            TimeRemainingColumn,
        )

        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("revolutions"),
            TimeRemainingColumn(),
            console=Console(stderr=True),
        )
        self._task = self._progress.add_task("connecting", total=test.run.revolutions)
        self._progress.start()

    def notice(self, notice: Notice) -> None:
        if isinstance(notice, Committed):
            self._progress.update(self._task, completed=notice.revolutions)
        elif isinstance(notice, StateChanged):
            self._progress.update(self._task, description=notice.state.value)

    def close(self) -> None:
        with suppress(OSError):  # of a terminal that was closed
            self._progress.stop()
