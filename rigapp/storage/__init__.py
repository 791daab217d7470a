"""Test files: made whole before the test, written in place, readable at every instant.

``structure`` says what a file holds, ``filesystem`` how it stands on the disk; ``writing`` fills it
while the test runs, ``reading`` answers questions at any time, ``upkeep`` goes on with files that
are there already. Others enter by this door, which names what they may use; storage knows the
schema and the errors of the configuration, and nothing that measures or draws.
"""

from __future__ import annotations

from rigapp.storage.filesystem.errors import NoRoom, StorageFailed
from rigapp.storage.filesystem.folder import SPACE_MARGIN, hidden_name, move_into_place
from rigapp.storage.filesystem.system import hold_writer_lock
from rigapp.storage.reading.belief import believed_until
from rigapp.storage.reading.export import export_columns, export_test
from rigapp.storage.reading.reader import (
    Columns,
    StoredCycle,
    StoredVariable,
    TestReader,
    open_test,
)
from rigapp.storage.reading.resample import on_grid
from rigapp.storage.reading.trip import LargestForce, Trip, largest_force, trip_of
from rigapp.storage.structure.layout import (
    CALIBRATION,
    PROFILE_ANGLE,
    FilePlan,
    profile_rows,
    reserved_bytes,
    streams_of,
)
from rigapp.storage.structure.metadata import TestMetadata, name_and_unit
from rigapp.storage.upkeep.compact import compact_in_background, compact_test
from rigapp.storage.upkeep.resume import finish_whole_test, reopen_test
from rigapp.storage.writing.writer import TestWriter, create_test

__all__ = [
    "CALIBRATION",
    "PROFILE_ANGLE",
    "SPACE_MARGIN",
    "Columns",
    "FilePlan",
    "LargestForce",
    "NoRoom",
    "StorageFailed",
    "StoredCycle",
    "StoredVariable",
    "TestMetadata",
    "TestReader",
    "TestWriter",
    "Trip",
    "believed_until",
    "compact_in_background",
    "compact_test",
    "create_test",
    "export_columns",
    "export_test",
    "finish_whole_test",
    "hidden_name",
    "hold_writer_lock",
    "largest_force",
    "move_into_place",
    "name_and_unit",
    "on_grid",
    "open_test",
    "profile_rows",
    "reopen_test",
    "reserved_bytes",
    "streams_of",
    "trip_of",
]
