"""Check the disk before a start: the size of a test's file, and the free space."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from rigapp.checks.start import DiskFacts
from rigapp.config.recipe import TestFile
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.texts import say


def disk_facts(
    test: TestFile, sample_rate_Hz: float, folder: Path, table: ChannelTable = BASE
) -> DiskFacts:
    """Return the disk space needed by a test of these channels and that free in a folder."""
    from rigapp.engine.recording.fileplan import file_plan
    from rigapp.storage import reserved_bytes, streams_of

    needed = reserved_bytes(streams_of(file_plan(test, sample_rate_Hz, table=table)).values())
    try:
        if not os.access(folder, os.W_OK | os.X_OK):
            return DiskFacts(
                folder, needed, 0, say("{} does not exist or cannot be written to", folder)
            )
        free = shutil.disk_usage(folder).free
    except OSError as error:
        return DiskFacts(
            folder,
            needed,
            0,
            say("{}: cannot be used ({}) ‹{}›", folder, error.strerror, error),
        )
    return DiskFacts(folder, needed, free)
