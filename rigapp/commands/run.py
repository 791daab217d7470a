"""`rigapp run` and `rigapp resume`: one test without a window."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType
from typing import Protocol

import msgspec

from drivers.api import DeviceError
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.engine.messages import FinishReason
from rigapp.engine.publish import Committed, Finished, Notice, StateChanged
from rigapp.engine.run import Refused
from rigapp.service.host import (
    EngineHost,
    compress_complete,
    recorded_test,
    with_revolutions,
)
from rigapp.service.resumption import Resumption, interval
from rigapp.service.security import parse_bind
from rigapp.service.simulated import parse_speed

STATUS = {
    FinishReason.COMPLETE: 0,
    FinishReason.OPERATOR: 1,
    FinishReason.LIMIT: 1,
    FinishReason.STORAGE: 1,
    FinishReason.INTERNAL: 1,
    FinishReason.DEVICE: 3,
}
"""How a test ended -> exit status."""


class Progress(Protocol):
    """Show what happens to a test."""

    def notice(self, notice: Notice) -> None:
        """Show one milestone."""
        ...

    def close(self) -> None:
        """Show nothing more."""
        ...


def run_test(
    test: Path,
    rig: Path,
    out: Path,
    revolutions: int | None,
    progress: str | None,
    speed: str | None,
    bind: str | None = None,
) -> int:
    """Run one test into a new file; return the exit status."""
    document = with_revolutions(read_test(test), revolutions)
    return _conduct(document, rig, out, progress, speed, bind, resume=False)


def resume_test(
    file: Path,
    rig: Path,
    progress: str | None,
    speed: str | None,
    bind: str | None = None,
    *,
    reason: str = "",
) -> int:
    """Go on with an interrupted test in its own file; return the exit status.

    reason: why it may go on in spite of what ``resumption`` found; goes into the log.
    """
    test = recorded_test(file)
    return _conduct(test, rig, file, progress, speed, bind, resume=True, reason=reason)


def examine_test(file: Path, rig: Path) -> int:
    """Show what an interrupted test would meet if it went on; 1 when it could not as it is."""
    document = read_rig(rig)
    host = EngineHost(document, parse_speed(None, document))
    try:
        found = host.resumption(file)
    except Refused as error:
        raise UnusableInput(f"The rig cannot be looked at: {error}.") from error
    finally:
        host.close()
    show_resumption(found)
    return 1 if found.blocked or found.asks_reason else 0


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
) -> int:
    if progress not in (None, "json"):
        raise UnusableInput(f"--progress {progress}: only json is known; or leave it out.")
    rig_document = read_rig(rig)
    chosen = parse_speed(speed, rig_document)
    if not resume:
        _refuse_bad_target(out)
    host = EngineHost(rig_document, chosen, parse_bind(bind) if bind else None)
    shown: Progress = _Json() if progress == "json" else _bar(test.record)
    try:
        with _interrupts() as interrupts:
            try:
                host.start(
                    test,
                    out,
                    test.record.metadata.operator,
                    resume=resume,
                    reason=reason,
                    examined=show_resumption,
                )
            except Refused as error:
                raise UnusableInput(f"The test cannot start: {error}.") from error
            return _follow(host, shown, interrupts)
    except DeviceError as error:
        outcome = host.engine.outcome
        if progress == "json":
            sentence = str(error)
            shown.notice(outcome or Finished(FinishReason.DEVICE, sentence, "fault", 0, str(out)))
        raise
    finally:
        shown.close()
        host.close()
        if host.engine.outcome is not None:
            compress_complete(host.engine.outcome)


def show_resumption(found: Resumption) -> None:
    """Print what is there and what differs to standard error, one line each."""
    last = ""
    if found.last_at:
        at = datetime.fromtimestamp(found.last_at, UTC).isoformat(" ", "seconds")
        last = f", the last one at {at}, {interval(found.gap_s)} ago"
    lines = [
        f"{found.file}: {found.title or 'test'}, {found.status}. {found.reason}".rstrip(),
        f"{found.revolutions} revolutions are in it, up to number {found.last_revolution} of"
        f" {found.planned}{last}.",
    ]
    for one in found.findings:
        same = one.before == one.now or not one.before
        values = one.now if same else f"{one.before} -> {one.now}"
        text = ": ".join(part for part in (one.what, values) if part)
        lines.append(f"  {one.fit.value:14} {text}{f' ({one.sentence})' if one.sentence else ''}")
    print("\n".join(lines), file=sys.stderr)


def _refuse_bad_target(out: Path) -> None:
    """Refuse before anything is started what would be refused later anyway."""
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
    print(sentence, file=sys.stderr)
    return status


def _follow(host: EngineHost, shown: Progress, interrupts: list[str]) -> int:
    """Show milestones until the test has ended; the exit status.

    The first interrupt stops the test under control, the second takes the power off.
    """
    notices = host.notices
    obeyed = 0
    while True:
        if len(interrupts) > obeyed:
            obeyed = len(interrupts)
            with suppress(Refused):
                if obeyed == 1:
                    host.engine.stop("", f"interrupted by {interrupts[0]}")
                else:
                    host.engine.drive_off("", "interrupted twice")
        notice = notices.get(0.1)
        if notice is not None:
            shown.notice(notice)
        if isinstance(notice, Finished):
            return _report(notice)


@contextmanager
def _interrupts() -> Iterator[list[str]]:
    """Collect the names of the signals that ask for an end."""
    received: list[str] = []

    def interrupt(number: int, frame: FrameType | None) -> None:
        received.append(signal.Signals(number).name)

    numbers = (signal.SIGINT, signal.SIGTERM)
    before = {number: signal.signal(number, interrupt) for number in numbers}
    try:
        yield received
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


class _Json:
    """One JSON object a line on standard output."""

    def notice(self, notice: Notice) -> None:
        print(msgspec.json.encode(notice).decode(), flush=True)

    def close(self) -> None:
        pass


class _Quiet:
    """Nothing on a pipe."""

    def notice(self, notice: Notice) -> None:
        pass

    def close(self) -> None:
        pass


class _Bar:
    """A progress bar on a terminal."""

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
        self._progress.stop()


def _bar(test: TestFile) -> Progress:
    return _Bar(test) if sys.stderr.isatty() else _Quiet()
