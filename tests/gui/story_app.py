"""The window on a scripted engine, as a program of its own; prints every request as JSON."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

# The source before the tests, whose folders bear the names of its packages.
sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[2]))

import snapshots

from rigapp.gui.window.app import main
from rigapp.schema.messages import Reply, RunState

STATES = {
    "start": RunState.RUNNING,
    "pause": RunState.PAUSED,
    "resume": RunState.RUNNING,
    "stop": RunState.STOPPED,
}


class TalkingClient:
    """Follow the commands and tell them on standard output."""

    def __init__(self) -> None:
        self._state = RunState.READY
        self._row = 1

    def poll(self) -> Any:
        """Return a snapshot of the present state."""
        running = self._state is RunState.RUNNING
        snapshot = snapshots.make_snapshot(
            first=self._row,
            count=2 if running else 0,
            curves=running,
            state=self._state,
            file="",
            alarms=(snapshots.ALARM,) if running else (),
        )
        self._row += 2 if running else 0
        return snapshot

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> Reply:
        """Tell the request and change the state."""
        print(json.dumps([verb, arguments or {}]), flush=True)
        self._state = STATES.get(verb, self._state)
        return Reply(ok=True)

    def close(self) -> None:
        """Let go."""


if __name__ == "__main__":
    examples = Path(__file__).parents[2] / "examples"
    sys.exit(
        main(
            TalkingClient,
            rig_path=examples / "simulated.toml",
            tests=[examples / "quick.toml"],
            results_folder=Path(sys.argv[1]),
        )
    )
