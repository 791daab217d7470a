"""`rigapp gui`, `rigapp replay` and `rigapp page`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rigapp.config.errors import UnusableInput, from_extra
from rigapp.config.loading import read_rig, read_test
from rigapp.config.names import login_name
from rigapp.prepare.shipped import RIG, examples_folder
from rigapp.process.ending import ending_as_interrupt
from rigapp.process.logs import in_file
from rigapp.process.memory import begin_to_load, end_of_loading
from rigapp.schema.details import indented

if TYPE_CHECKING:
    from rigapp.service.client import Client


def open_window(rig: Path | None, test: Path | None, *, start: bool, language: str = "") -> int:
    """Show the operator's window until it is closed; return the exit status.

    language: code of the language to store and use; empty: the stored one, or the system's.
    """
    begin_to_load()
    rig_path = (rig or examples_folder() / RIG).resolve()
    from rigapp.engine.devices import plan_devices

    plan_devices(read_rig(rig_path).record, str(rig_path))
    tests = _tests(rig_path, test)
    results = Path.cwd() / "results"
    results.mkdir(exist_ok=True)
    try:
        from rigapp.gui.window.app import main
    except ImportError as error:
        raise UnusableInput(
            f"The window's libraries are missing ‹{error}›; run 'rigapp doctor'."
        ) from error
    from rigapp.service.launch import attach

    def factory() -> Client:
        return attach(rig_path, login_name())

    with in_file(results / "window.log"):
        return main(
            factory,
            rig_path=rig_path,
            tests=tests,
            results_folder=results,
            start_test=tests[0] if start and tests else None,
            language=language,
        )


def _tests(rig: Path, test: Path | None) -> list[Path]:
    """Return the test files to list: the named one, then the rig folder's by revolutions."""
    result: list[Path] = []
    if test is not None:
        read_test(test)
        result.append(test.resolve())
    neighbours: list[tuple[int, Path]] = []
    for path in rig.parent.glob("*.toml"):
        try:
            revolutions = read_test(path).record.run.revolutions
        except UnusableInput:
            continue
        if path.resolve() not in result:
            neighbours.append((revolutions, path.resolve()))
    result += [path for _, path in sorted(neighbours)]
    return result


def replay_file(path: Path) -> int:
    """Replay a recorded test in the operator's window; return the exit status."""
    from rigapp.replay.client import ReplayClient, read_recording
    from rigapp.storage import blocks, open_test

    with open_test(path) as test:  # a damaged file is refused before the window opens
        read_recording(test)
        # Columns of the first page; others are read when they are shown.
        for _ in blocks(test, ("force_max", "force_min", "force_rms", "speed")):
            pass
    from rigapp.gui.window.app import main

    return main(
        lambda: ReplayClient(path), rig_path=path, tests=[], results_folder=path.resolve().parent
    )


def serve_page(
    rigs: Sequence[Path], bind: str, token: Path | None, certificate: Path | None, key: Path | None
) -> int:
    """Print the page's address and serve it until a termination signal; return the exit status."""
    with from_extra("page", "The page"):
        from rigapp.page.serving import page_server
    server = page_server(rigs, bind, token, certificate, key)
    end_of_loading()
    print(f"The page is at {server.address}", flush=True)
    try:
        with ending_as_interrupt():
            server.serve_until_ended()
    except KeyboardInterrupt:
        return 0
    if server.failure:
        print(f"rigapp: {indented(str(server.failure))}", file=sys.stderr)
        return 1
    return 0
