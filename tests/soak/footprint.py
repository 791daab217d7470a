"""What a process holds: memory of its own, threads, file handles (Linux)."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

MEGABYTE = 2**20


@dataclass(frozen=True)
class Footprint:
    """Resident anonymous memory in bytes, number of threads and of open file handles."""

    memory: int
    threads: int
    handles: int


def footprint(pid: int) -> Footprint:
    """Look at a process."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    fields = dict(line.split(":", 1) for line in lines)
    return Footprint(
        memory=int(fields["RssAnon"].split()[0]) * 1024,
        threads=int(fields["Threads"]),
        handles=len(os.listdir(f"/proc/{pid}/fd")),
    )
