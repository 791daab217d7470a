"""Watch every rig in one thread: content is made once for all open pages."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from rigapp.config.errors import UnusableInput
from rigapp.page import fragments
from rigapp.page.plots import Painter
from rigapp.page.rig import Find, WatchedRig
from rigapp.page.view import RigView, view_of
from rigapp.process.threads import Worker

log = logging.getLogger(__name__)

LOOK_S = 0.1  # the window polls as often outside of its fast pages
SHOW_S = 1.0  # faster changes cannot be read on a wall
TRENDS_S = 5.0  # a trend of thousands of revolutions moves by less than a pixel
RIGS_S = 2.0  # an engine that starts is on the page before its first revolution
MOST_RIGS = 16
"""More do not fit on a screen, and each has four threads."""
SILENCE_S = 10.0
"""Silence of the watching thread until ``/healthz`` reports it: a slow computer takes two."""

Rigs = Mapping[str, tuple[str, Find]]
"""By a key: the name of a rig, and the function that finds its engine."""
Publish = Callable[[Mapping[str, bytes]], None]


@dataclass(slots=True)
class _Shown:
    """A rig with its newest fragments."""

    rig: WatchedRig
    painter: Painter = field(default_factory=Painter)
    parts: dict[str, str] = field(default_factory=lambda: dict.fromkeys(fragments.PARTS, ""))
    trends_at: float = 0.0


class Watch:
    """The watched rigs; ``views`` and ``page`` may be read from any thread."""

    def __init__(self, rigs: Callable[[], Rigs], on_death: Callable[[str], None]) -> None:
        """Begin with none; rigs: called again and again; a rig once found stays shown."""
        self._find_rigs = rigs
        self._on_death = on_death
        self._publish: Publish = lambda frames: None
        self._shown: dict[str, _Shown] = {}
        self._rigs_at = self._show_at = 0.0
        self._boot = f"{time.time():.3f}"
        self._trouble: type[OSError] | None = None
        self._page = fragments.page({}, self._boot)
        self.views: tuple[RigView, ...] = ()
        self._worker = Worker("page", self._step, self._died, SILENCE_S)

    def start(self, publish: Publish) -> None:
        """Begin to watch; publish: receives frames for pages, by the names of their slots."""
        self._publish = publish
        self._worker.start()

    @property
    def well(self) -> bool:
        """Return whether the thread runs and watches."""
        return self._worker.well

    def page(self) -> str:
        """Return the page as it is now."""
        return self._page

    def close(self) -> None:
        """End the thread and detach from the engines."""
        self._worker.halt()
        self._worker.join(SILENCE_S)
        for shown in self._shown.values():
            shown.rig.close()

    def _step(self) -> None:
        try:
            self._look()
        except OSError as error:
            # Lack of descriptors, memory or network: a temporary failure does not end the page.
            if type(error) is not self._trouble:
                log.warning("The page could not look at the rigs: %s", error)
            self._trouble = type(error)
        else:
            self._trouble = None
        self._worker.pause(LOOK_S)

    def _look(self) -> None:
        now = time.monotonic()
        if now >= self._rigs_at:
            self._rigs_at = now + RIGS_S
            self._look_for_rigs()
        for shown in self._shown.values():
            if shown.rig.pump():
                shown.painter.forget()
                shown.trends_at = 0.0
        if now >= self._show_at:
            self._show_at = now + SHOW_S
            self._show(now)

    def _look_for_rigs(self) -> None:
        try:
            rigs = self._find_rigs()
        except UnusableInput as error:
            log.warning("%s", error)
            return
        for key, (name, find) in rigs.items():
            if key not in self._shown and len(self._shown) < MOST_RIGS:
                identity = f"rig{len(self._shown) + 1}"
                self._shown[key] = _Shown(WatchedRig(identity, name, find))

    def _show(self, now: float) -> None:
        self.views = tuple(self._set(shown, now) for shown in self._shown.values())
        rigs = {shown.rig.identity: shown.parts for shown in self._shown.values()}
        content = {"boot": self._boot, "rigs": list(rigs)}
        frames = {"rigs": fragments.frame("rigs", content)}
        for identity, parts in rigs.items():
            for part, html in parts.items():
                key = f"{identity}-{part}"
                frames[key] = fragments.frame("fragment", {"place": key, "html": html})
        frames["beat"] = fragments.frame("beat", time.time())
        self._page = fragments.page(rigs, self._boot)
        self._publish(frames)

    def _set(self, shown: _Shown, now: float) -> RigView:
        """Renew the fragments of a rig; return the view they are made of."""
        news = shown.rig.news()
        view = view_of(shown.rig, news)
        shown.parts["head"] = fragments.head(view, time.time())
        shown.parts["log"] = fragments.log(view)
        shown.parts["force"] = fragments.pictures([shown.painter.force(news)])
        if now >= shown.trends_at:
            shown.trends_at = now + TRENDS_S
            shown.parts["trends"] = fragments.pictures(shown.painter.trends(news))
        return view

    def _died(self, worker: Worker, error: BaseException) -> None:
        log.error("The page can show nothing any more: %s", error, exc_info=error)
        self._on_death(f"The part of the page that looks at the rigs has died ‹{error!r}›.")
