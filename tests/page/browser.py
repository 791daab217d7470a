"""Chromium without a window, steered through its own pipe: sizes, colours, pictures."""

from __future__ import annotations

import json
import os
import selectors
import subprocess
import time
from base64 import b64decode
from collections.abc import Callable
from pathlib import Path
from typing import Any

from patience import PATIENCE_S

NAVIGATED = -32000
"""Error of the DevTools protocol when the page that was asked has gone to make room for another."""


class PageNavigated(Exception):
    """Say that the page was loaded anew while it was asked."""


class Browser:
    """One page in a Chromium that has nothing kept from before."""

    def __init__(self, program: str, folder: Path) -> None:
        commands, self._commands = os.pipe()
        self._answers, answers = os.pipe()
        arguments = [
            program, "--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-background-networking", "--remote-debugging-pipe",
            f"--user-data-dir={folder}", "about:blank",
        ]  # fmt: skip
        self._process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{commands} 4>&{answers}', "bash", *arguments],
            pass_fds=(commands, answers),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": str(folder)},
        )
        os.close(commands)
        os.close(answers)
        self._number = 0
        self._rest = b""
        self._selector = selectors.DefaultSelector()
        self._selector.register(self._answers, selectors.EVENT_READ)
        self._session = ""
        self.events: list[dict[str, Any]] = []
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.ask("Target.attachToTarget", targetId=target, flatten=True)[
            "sessionId"
        ]
        for domain in ("Page", "Network", "Log", "Runtime"):
            self.ask(f"{domain}.enable")

    def ask(self, method: str, **parameters: Any) -> Any:
        """Ask the browser for something and return its answer."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        while True:
            told = self._read(method)
            if told.get("id") == self._number:
                if told.get("error", {}).get("code") == NAVIGATED:
                    raise PageNavigated(f"{method}: {told['error']}")
                assert "error" not in told, f"{method}: {told['error']}"
                return told["result"]
            self.events.append(told)

    def open(self, address: str, width: int, height: int, scheme: str) -> None:
        """Open an address at a size in CSS pixels, in a light or dark scheme.

        The page before is gone by then, and with it what it asked for: events are of this one.
        """
        self.ask("Page.navigate", url="about:blank")
        self.eventually("document.URL", lambda address: address == "about:blank")
        self.events.clear()
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=1, mobile=width < 600,
        )  # fmt: skip
        feature = {"name": "prefers-color-scheme", "value": scheme}
        self.ask("Emulation.setEmulatedMedia", features=[feature])
        self.ask("Page.navigate", url=address)

    def value(self, expression: str) -> Any:
        """Return what an expression is worth on the page."""
        found = self.ask("Runtime.evaluate", expression=expression, returnByValue=True)
        return found["result"].get("value")

    def eventually(self, expression: str, is_right: Callable[[Any], object]) -> None:
        """Wait until an expression has the right value, also over a page that is loaded anew."""
        deadline = time.monotonic() + PATIENCE_S
        while not is_right(value := self._value_if_loaded(expression)):
            assert time.monotonic() < deadline, f"{expression} is still {value!r}"
            time.sleep(0.1)

    def _value_if_loaded(self, expression: str) -> Any:
        try:
            return self.value(expression)
        except PageNavigated:
            return None

    def picture(self, path: Path) -> None:
        """Take a picture of the whole page."""
        found = self.ask("Page.captureScreenshot", captureBeyondViewport=True)
        path.write_bytes(b64decode(found["data"]))

    def close(self) -> None:
        """End the browser."""
        self._process.kill()
        self._process.wait()
        self._selector.close()
        os.close(self._commands)
        os.close(self._answers)

    def _read(self, method: str) -> dict[str, Any]:
        while b"\0" not in self._rest:
            ready = self._selector.select(PATIENCE_S)
            assert ready, f"the browser did not answer {method}"
            more = os.read(self._answers, 1 << 20)
            assert more, f"the browser ended at {method}"
            self._rest += more
        message, _, self._rest = self._rest.partition(b"\0")
        return json.loads(message)  # type: ignore[no-any-return]
