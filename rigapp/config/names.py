"""Is this the name of a file that can be written, beside what is kept while it is written?"""

from __future__ import annotations

import os
from pathlib import Path

LONGEST_NAME_BYTES = 239
"""Most file systems keep names of 255 bytes; files under way have up to 16 more than their own."""


def name_refusal(path: Path) -> str:
    """Return why a file of that name cannot be made, without a full stop; empty when it can."""
    if path.name in ("", ".."):
        return f"{str(path)!r} names no file; give the name of a file"
    length = len(os.fsencode(path.name))
    if length > LONGEST_NAME_BYTES:
        start = path.name[:40]
        return (
            f"the file name {start}... has {length} bytes, {LONGEST_NAME_BYTES} at most; shorten it"
        )
    return ""
