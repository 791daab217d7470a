"""What can go wrong with a file after its test has begun."""

from __future__ import annotations


class StorageFailed(Exception):
    """Say in one sentence which file can no longer be written, and why; the test must end."""


class NoRoom(StorageFailed):
    """Say in one sentence which part of the file is full."""
