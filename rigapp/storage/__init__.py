"""Test files: complete before the test, written in place, readable at every instant.

``structure`` defines the contents, ``filesystem`` the file on the disk; ``writing`` fills it
while the test runs, ``reading`` reads it at any time, ``upkeep`` resumes, compresses and repairs
existing files. Other packages import this one, which depends only on the schema and the errors
of the configuration.
"""

from __future__ import annotations

from rigapp.storage.filesystem.calls import DiskFull, StorageFailed
from rigapp.storage.filesystem.folder import SPACE_MARGIN, hidden_name, move_into_place
from rigapp.storage.filesystem.system import hold_writer_lock
from rigapp.storage.reading.blocks import (
    StoredColumns,
    blocks,
    newest_known,
    row_numbers,
    rows_up_to,
)
from rigapp.storage.reading.export import DEFAULT_DIALECT, Dialect, export_columns, export_test
from rigapp.storage.reading.reader import StoredCycle, TestReader, open_test
from rigapp.storage.reading.resample import on_grid
from rigapp.storage.reading.seal import broken_seals, seal_description
from rigapp.storage.reading.streams import Columns, StoredVariable
from rigapp.storage.reading.trip import (
    LargestForce,
    Trip,
    TripCapture,
    TripPiece,
    largest_force,
    plausible_until,
    trip_capture,
    trip_of,
)
from rigapp.storage.reading.verify import NEWEST_BYTES, damage_of, find_damage
from rigapp.storage.structure.events import logged_sentence
from rigapp.storage.structure.hdf import open_for_reading
from rigapp.storage.structure.layout import (
    CALIBRATION,
    PROFILE_ANGLE,
    FilePlan,
    profile_rows,
    reserved_bytes,
    streams_of,
)
from rigapp.storage.structure.metadata import TestMetadata, name_and_unit
from rigapp.storage.upkeep.compact import (
    compact_test,
    seal_test,
    settle_in_background,
    trimmed_copy,
)
from rigapp.storage.upkeep.resume import close_test, finish_whole_test, reopen_test
from rigapp.storage.upkeep.salvage import Salvaged, salvage_test
from rigapp.storage.writing.writer import TestWriter, create_test

__all__ = [
    "CALIBRATION",
    "DEFAULT_DIALECT",
    "NEWEST_BYTES",
    "PROFILE_ANGLE",
    "SPACE_MARGIN",
    "Columns",
    "Dialect",
    "DiskFull",
    "FilePlan",
    "LargestForce",
    "Salvaged",
    "StorageFailed",
    "StoredColumns",
    "StoredCycle",
    "StoredVariable",
    "TestMetadata",
    "TestReader",
    "TestWriter",
    "Trip",
    "TripCapture",
    "TripPiece",
    "blocks",
    "broken_seals",
    "close_test",
    "compact_test",
    "create_test",
    "damage_of",
    "export_columns",
    "export_test",
    "find_damage",
    "finish_whole_test",
    "hidden_name",
    "hold_writer_lock",
    "largest_force",
    "logged_sentence",
    "move_into_place",
    "name_and_unit",
    "newest_known",
    "on_grid",
    "open_for_reading",
    "open_test",
    "plausible_until",
    "profile_rows",
    "reopen_test",
    "reserved_bytes",
    "row_numbers",
    "rows_up_to",
    "salvage_test",
    "seal_description",
    "seal_test",
    "settle_in_background",
    "streams_of",
    "trimmed_copy",
    "trip_capture",
    "trip_of",
]
