"""Lower the priority of a process."""

from __future__ import annotations

import os
import sys


def lower_priority(niceness: int) -> None:
    """Lower this process's priority by ``niceness``, 0 to 19; on Windows to below normal."""
    if sys.platform != "win32":
        os.nice(niceness)
    else:
        import psutil

        psutil.Process().nice(psutil.BELOW_NORMAL_PRIORITY_CLASS)
