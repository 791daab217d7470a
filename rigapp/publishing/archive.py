"""Write files into one ZIP file that has the same bytes each time."""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.publishing.packed import PackedFile, Progress

EPOCH = (1980, 1, 1, 0, 0, 0)
"""The first moment that a ZIP file can tell: when it was packed is no property of the data."""
READABLE = 0o100644 << 16
UNIX = 3


def write_archive(
    target: Path, files: Sequence[PackedFile], digests: Mapping[str, str], progress: Progress
) -> None:
    """Write the files in the order of their places; what is compressed is only stored.

    digests: SHA-256 by place, as it was before. Raises UnusableInput for a file that has changed.
    """
    with zipfile.ZipFile(target, "x") as archive:
        for one in sorted(files, key=lambda one: one.place):
            about = zipfile.ZipInfo(one.place, EPOCH)
            about.create_system, about.external_attr = UNIX, READABLE
            about.compress_type = zipfile.ZIP_STORED if one.packed else zipfile.ZIP_DEFLATED
            about.file_size = one.size  # tells whether the entry needs 64 bits
            found = hashlib.sha256()
            with archive.open(about, "w") as entry:
                for part in one.parts():
                    entry.write(part)
                    found.update(part)
                    progress(len(part))
            if found.hexdigest() != digests[one.place]:
                raise UnusableInput(f"{one.source}: was changed while it was packed.")
