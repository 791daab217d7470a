"""Make small recorded tests to publish, with something private in them where it is wanted."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from report.report_samples import CALIBRATION, STARTED, TEST_TEXT, append, row

from rigapp.schema.messages import Event
from rigapp.storage import FilePlan, TestMetadata, TestWriter, create_test

ADA = "Lovelace, Ada"
RIG_TEXT = 'schema = 1\nname = "Rig 2"\n\n[devices.daq]\ndriver = "gsv8"\nport = "/dev/ttyUSB0"\n'

__all__ = ["ADA", "RIG_TEXT", "event", "new_test", "recorded", "row"]


def event(kind: str, source: str, text: str) -> Event:
    """Return a line of the log."""
    return Event(STARTED, 1, kind, source, text)


def new_test(path: Path, rig: str = RIG_TEXT, operator: str = "Ada Lovelace") -> TestWriter:
    """Begin a test."""
    plan = FilePlan(8, cycles=1, samples_per_cycle=960, events=512)
    about = TestMetadata(
        title="PTFE, dry",
        rig_text=rig,
        test_text=TEST_TEXT,
        calibration=CALIBRATION,
        rig_name="Rig 2",
        operator=operator,
        specimen="PTFE 1",
        started=STARTED,
        identifier="11111111-2222-3333-4444-555555555555",
    )
    return create_test(path, plan, about)


def recorded(
    path: Path,
    rig: str = RIG_TEXT,
    operator: str = "Ada Lovelace",
    events: Sequence[Event] = (),
    closed: bool = True,
) -> Path:
    """Record a test; one that is not closed was interrupted."""
    writer = new_test(path, rig, operator)
    writer.append_event(event("state", "engine", f"started by {operator}"))
    for revolution in range(1, 9):
        append(writer, revolution, keep=revolution == 8)
    for one in events:
        writer.append_event(one)
    writer.commit()
    if closed:
        writer.finish("complete", "complete", "The planned 8 revolutions are made.")
    writer.close()
    return path
