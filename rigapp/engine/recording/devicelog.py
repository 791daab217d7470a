"""Put what drivers warn of into the log of the test."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

AGAIN_AFTER_S = 60.0  # the same remark at most once a minute
KEPT = 64  # different remarks; more of them repeat


class DeviceLog(logging.Handler):
    """Pass warnings of the package ``drivers`` on, the same words once a minute at most.

    tell: takes the driver's name and the sentence.
    """

    def __init__(self, tell: Callable[[str, str], object]) -> None:
        super().__init__(logging.WARNING)
        self._tell = tell
        self._told: dict[str, float] = {}

    def attach(self) -> None:
        """Begin to listen."""
        logging.getLogger("rigapp_drivers").addHandler(self)

    def detach(self) -> None:
        """Listen no more."""
        logging.getLogger("rigapp_drivers").removeHandler(self)

    def emit(self, record: logging.LogRecord) -> None:
        """Pass a warning on."""
        try:
            text = record.getMessage()
            now = time.monotonic()
            if now - self._told.get(text, -AGAIN_AFTER_S) < AGAIN_AFTER_S:
                return
            if len(self._told) >= KEPT:
                self._told.clear()
            self._told[text] = now
            self._tell(record.name, text)
        except Exception:
            self.handleError(record)
