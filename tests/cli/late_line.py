"""Stand between a device and its user: a pseudo-terminal on which answers come later.

``python late_line.py PORT SECONDS`` prints the name of the new port. It knows nothing of rigapp.
"""

from __future__ import annotations

import os
import select
import sys
import time
import tty
from collections import deque


def main(port: str, late_s: float) -> None:
    """Carry bytes both ways until it is killed."""
    device = os.open(port, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(device)
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    print(os.ttyname(theirs), flush=True)
    waiting: deque[tuple[float, bytes]] = deque()
    while True:
        wait = max(0.0, waiting[0][0] - time.monotonic()) if waiting else 1.0
        for one in select.select([device, ours], [], [], wait)[0]:
            data = os.read(one, 65536)
            if one == ours:
                os.write(device, data)
            else:
                waiting.append((time.monotonic() + late_s, data))
        while waiting and waiting[0][0] <= time.monotonic():
            os.write(ours, waiting.popleft()[1])


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
