"""Create the port of a simulated device."""

from __future__ import annotations

import contextlib
import sys
from pathlib import Path

from rigapp.simulation.wire.endpoints import Endpoint, SocketEndpoint


def port_at(link: Path) -> Endpoint:
    """Return a port with a permanent name; a TCP port if the system has no suitable pty."""
    if sys.platform != "win32":
        with contextlib.suppress(ImportError, OSError):
            from rigapp.simulation.wire.pty import PtyEndpoint

            return PtyEndpoint(link)
    return SocketEndpoint()
