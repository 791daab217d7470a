"""Test files: made whole before the test, written in place, readable at every instant."""

from __future__ import annotations

from rigapp.storage.compact import compact_in_background, compact_test
from rigapp.storage.errors import NoRoom, StorageFailed
from rigapp.storage.export import export_test
from rigapp.storage.layout import FilePlan
from rigapp.storage.metadata import TestMetadata
from rigapp.storage.reader import StoredCycle, TestReader, open_test
from rigapp.storage.resample import on_grid
from rigapp.storage.resume import finish_whole_test, reopen_test
from rigapp.storage.writer import TestWriter, create_test

__all__ = [
    "FilePlan",
    "NoRoom",
    "StorageFailed",
    "StoredCycle",
    "TestMetadata",
    "TestReader",
    "TestWriter",
    "compact_in_background",
    "compact_test",
    "create_test",
    "export_test",
    "finish_whole_test",
    "on_grid",
    "open_test",
    "reopen_test",
]
