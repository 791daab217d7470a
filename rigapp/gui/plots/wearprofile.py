"""The worn profile of the bushing, measured by the probes and by the model.

Files without recorded profiles show the circle of the pin sunk in by the depth at the contact
point, and say so.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotting import PlotPanel, QuietPlot, plot_heading, remark
from rigapp.gui.widgets.build import column
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.news import News, Takes
from rigapp.viewer.profiles import ANGLES_DEG as RECORDED_DEG
from rigapp.viewer.profiles import ShownProfile
from rigapp.viewer.quantities import UM_PER_MM
from rigapp.viewer.ranges import SteadyRange

Floats = NDArray[np.float64]

NO_DEPTH: Final[Text] = "No depth of wear known yet: the worn profile of the bushing is drawn here."
MEASURED = LinePen("first")
ANGLES_DEG = np.linspace(-180.0, 180.0, 721)


MEASURED_DEPTH: Final[tuple[Text, Text]] = ("measured {}", "measured: not known")
MODEL_DEPTH: Final[tuple[Text, Text]] = ("model {}", "model: not known")
"""A curve with its largest depth, and where there is none."""


@dataclass(frozen=True, slots=True)
class Entry:
    """What is said of a curve; not known: it has no depth to stand at."""

    text: str
    known: bool = True


def worn_profile(depth_mm: float, pin_radius_mm: float, bushing_radius_mm: float) -> Floats:
    """Return the depth of wear in mm at ANGLES_DEG from the contact point.

    The pin's circle has sunk into the bushing by ``depth_mm`` at the contact point; what lies
    beyond the bushing's first circle is worn. This holds where wear is much larger than elastic
    indentation and the force keeps its direction.
    """
    centre = bushing_radius_mm - pin_radius_mm + depth_mm
    angle = np.radians(ANGLES_DEG)
    root = np.maximum(pin_radius_mm**2 - (centre * np.sin(angle)) ** 2, 0.0)
    surface = centre * np.cos(angle) + np.sqrt(root)
    return np.maximum(surface - bushing_radius_mm, 0.0)


class WearProfilePanel(PlotPanel):
    """Draw the worn profile in the follower frame."""

    takes = Takes.HISTORY

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_profile_panel", "Worn profile of the bushing")
        self._drawn: tuple[object, ...] | None = None
        self.plot = QuietPlot(f"{prefix}_profile_plot", "Worn profile of the bushing", theme)
        self.plot.label("bottom", "Angle from the contact point, follower frame")
        self.plot.show_range("x", -180.0, 180.0)
        ticks = [(float(at), f"{at}°".replace("-", "−")) for at in range(-180, 181, 90)]
        self.plot.getAxis("bottom").setTicks([ticks])
        self._band = self.plot.shade(MEASURED)
        self._measured = self.plot.curve(MEASURED)
        self._model = self.plot.curve(MODEL)
        self.plot.steady = SteadyRange(2.0)
        self.title = remark(f"{prefix}_profile_title", "Depths, and what of the bushing was seen")
        column(plot_heading("Worn profile"), self.title, (self.plot, 1), on=self)
        self._start_afresh()

    def show_news(self, news: News) -> None:
        """Draw the newest recorded profile, or what follows from the newest depths."""
        data = news.data
        if self.take_data(data):
            self._start_afresh()
        joint = news.recipe.model.joint if news.recipe is not None else None
        if data.profile is not None:
            self._refresh_recorded(data.profile)
            return
        measured = data.predictions.last("measured_wear_depth")
        predicted = data.predictions.last("wear_depth")
        token = (repr(measured), repr(predicted), joint)
        if joint is None or token == self._drawn:
            return
        self._drawn = token
        deepest = np.nan
        self._draw_band(None)
        for curve, depth in ((self._measured, measured), (self._model, predicted)):
            if math.isfinite(depth):
                sunk = max(depth, 0.0)
                profile = worn_profile(sunk, joint.pin_radius_mm, joint.bushing_radius_mm)
                curve.setData(ANGLES_DEG, UM_PER_MM * profile)
                deepest = np.fmax(deepest, depth)
            else:
                clear(curve)
        if math.isnan(deepest):
            self.plot.empty(NO_DEPTH)
        self.plot.fit(0.0, UM_PER_MM * deepest)
        self._show_entries(
            _depth(MEASURED_DEPTH, measured),
            _depth(MODEL_DEPTH, predicted),
            tr("no profile is recorded: the pin's circle sunk in by the depth"),
        )

    def _start_afresh(self) -> None:
        """Draw nothing: the profile was of another test."""
        self._drawn = None
        clear(self._measured, self._model, self._band)
        self._show_entries(_depth(MEASURED_DEPTH, math.nan), _depth(MODEL_DEPTH, math.nan), "")
        self.plot.empty(NO_DEPTH)

    def _refresh_recorded(self, profile: ShownProfile) -> None:
        if self._drawn == (profile,):
            return
        self._drawn = (profile,)
        seen = np.isfinite(profile.measured)
        self._measured.setData(RECORDED_DEG, UM_PER_MM * profile.measured)
        self._model.setData(RECORDED_DEG, UM_PER_MM * profile.predicted)
        self._draw_band(profile)
        self.plot.fit(0.0, UM_PER_MM * profile.deepest)
        if seen.any():
            place = int(np.nanargmax(profile.measured))
            most = UM_PER_MM * profile.measured[place]
            depth = f"{most:.1f} ± {UM_PER_MM * profile.uncertainty[place]:.1f}"
            extent = RECORDED_DEG[seen]
            words = tr(
                "seen {:.0f}° to {:.0f}°, cycle {}", extent[0], extent[-1], profile.revolution
            )
            measured = Entry(tr("measured {}", depth))
        else:
            text = tr("measured: not known yet, cycle {}", profile.revolution)
            measured, words = Entry(text, known=False), ""
        deepest = float(np.nanmax(profile.predicted, initial=-1.0))
        model = _depth(MODEL_DEPTH, deepest if deepest >= 0.0 else math.nan)
        self._show_entries(measured, model, words)

    def _draw_band(self, profile: ShownProfile | None) -> None:
        if profile is None or not np.isfinite(profile.measured).any():
            clear(self._band)
            return
        seen = np.isfinite(profile.measured)
        angle, depth = RECORDED_DEG[seen], UM_PER_MM * profile.measured[seen]
        doubt = UM_PER_MM * profile.uncertainty[seen]
        self._band.setData(angle, np.maximum(depth - doubt, 0.0), depth + doubt)

    def _show_entries(self, measured: Entry, model: Entry, words: str) -> None:
        """Name both curves, where they are deepest, and say what was seen."""
        names = [
            CurveName(entry.text, pen, np.nanmax(curve.y, initial=0.0))
            for entry, pen, curve in (
                (measured, MEASURED, self._measured),
                (model, MODEL, self._model),
            )
            if entry.known
        ]
        self.plot.show_marks(names=tuple(names))
        unknown = [entry.text for entry in (measured, model) if not entry.known]
        self.title.setText(", ".join(("µm", *unknown, *filter(None, (words,)))))


def _depth(texts: tuple[Text, Text], depth: float) -> Entry:
    known = math.isfinite(depth)
    return Entry(tr(texts[0], f"{UM_PER_MM * depth:.1f}") if known else tr(texts[1]), known)
