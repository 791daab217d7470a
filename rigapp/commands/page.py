"""`rigapp page`: the read-only page of the engines that run."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from rigapp.config.errors import from_extra
from rigapp.process.ending import ending_as_interrupt
from rigapp.process.memory import end_of_loading
from rigapp.schema.details import indented


def serve_page(
    rigs: Sequence[Path], bind: str, token: Path | None, certificate: Path | None, key: Path | None
) -> int:
    """Serve the page until somebody asks for the end; print its address first. Exit status."""
    with from_extra("page", "The page"):
        from rigapp.page.serving import page_server
    server = page_server(rigs, bind, token, certificate, key)
    end_of_loading()
    print(f"The page is at {server.address}", flush=True)
    try:
        with ending_as_interrupt():
            server.serve_until_asked()
    except KeyboardInterrupt:
        return 0
    if server.failure:
        print(f"rigapp: {indented(str(server.failure))}", file=sys.stderr)
        return 1
    return 0
