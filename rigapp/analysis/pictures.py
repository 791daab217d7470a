"""Pictures of a recorded test, one call each; a notebook shows the returned figure."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.report.page.figures import MODEL_LINE, STYLE, revolution_axis
from rigapp.report.paper.pages import Chapter, size_in
from rigapp.report.paper.recorded import extrema, force_of_a_cycle, profile
from rigapp.report.testreport.envelope import envelope
from rigapp.report.testreport.identified import identified_test
from rigapp.report.testreport.identifiedsections import draw_depth
from rigapp.report.testreport.model_facts import cycles_at
from rigapp.report.testreport.plots import COLOURS, DEPTHS
from rigapp.storage import TestReader, open_test

BESIDE: Mapping[str, Any] = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}
"""Location of a legend: right of the axes."""


class Pictures:
    """Draw a test; each method returns a matplotlib figure.

    Each raises UnusableInput if the file lacks its data.
    """

    def __init__(self, path: Path) -> None:
        self._path = path

    def force(self) -> Any:
        """Draw both components and |F| of the last whole cycle, with the model (Fig. 20)."""
        return self._chapter(force_of_a_cycle, "a whole cycle with its predicted curve")

    def extrema(self) -> Any:
        """Draw maximum, RMS and minimum of |F| over the revolutions (Fig. 20, caption)."""
        return self._chapter(extrema, "a whole revolution")

    def profile(self) -> Any:
        """Draw the worn profile with its uncertainty, and the model's (Fig. 21)."""
        return self._chapter(profile, "a worn profile")

    def overlay(self, *revolutions: int, channel: str = "force") -> Any:
        """Draw whole cycles over the crank angle, measured and by the model.

        revolutions: first, middle and last of the saved ones when none is given. channel: with
        force, force_1 and force_2 the model is drawn too.
        """
        with open_test(self._path) as reader:
            saved = reader.cycle_revolutions()
            places = self._places(saved.tolist(), revolutions)
            units = reader.column_units("samples")
            if channel not in units:
                raise UnusableInput(f"{self._path}: {channel}: no such channel; {', '.join(units)}")
            cycles = cycles_at(reader, places)
        with _canvas(1) as (figure, (axes,)):
            shades = np.linspace(0.75, 0.0, len(cycles)) if len(cycles) > 1 else [0.0]
            for cycle, shade in zip(cycles, shades, strict=True):  # the newest on top, black
                grey = (shade, shade, shade)
                line = envelope(cycle.columns["angle"], cycle.columns[channel])
                axes.plot(*line, color=grey, label=f"{cycle.revolution:,} measured")
                if channel in cycle.model:
                    style = {**MODEL_LINE, "alpha": 1.0 - 0.8 * shade}
                    label = f"{cycle.model_revolution:,} model"
                    axes.plot(cycle.model["angle"], cycle.model[channel], **style, label=label)
            axes.set_xlabel("crank angle (°)")
            axes.set_ylabel(f"{channel} ({units[channel]})")
            axes.set_xlim(0.0, 360.0)
            axes.legend(title="revolution", **BESIDE)
        return figure

    def wear(self) -> Any:
        """Draw the wear depth: measured with its uncertainty, by the model, and as predicted.

        The predicted bands are drawn once the wear coefficient of the test is known.
        """
        known = identified_test(self._path)
        with open_test(self._path) as reader:
            table = reader.predictions()
        with _canvas(1) as (figure, (axes,)):
            drawn = [_depth(axes, table, name) for name in DEPTHS]
            if not any(drawn):
                raise UnusableInput(f"{self._path}: no wear depth is known of this test")
            if known.known is not None:
                draw_depth(axes, known, known.known)
            axes.set_ylabel("wear depth (µm)")
            axes.set_title(known.said, loc="left", wrap=True)
            axes.legend(**BESIDE)
            revolution_axis(axes)
        return figure

    def _places(self, saved: list[int], wanted: tuple[int, ...]) -> list[int]:
        if not saved:
            raise UnusableInput(f"{self._path}: no whole cycle is kept")
        if not wanted:
            return sorted({0, len(saved) // 2, len(saved) - 1})
        missing = sorted(set(wanted) - set(saved))
        if missing:
            raise UnusableInput(
                f"{self._path}: of revolution {missing[0]} no whole cycle is kept;"
                " test.cycles.revolution tells which are"
            )
        return sorted(len(saved) - 1 - saved[::-1].index(revolution) for revolution in set(wanted))

    def _chapter(self, made: Callable[[TestReader], Chapter | None], needs: str) -> Any:
        with open_test(self._path) as reader:
            chapter = made(reader)
        if chapter is None:
            raise UnusableInput(f"{self._path}: it does not hold {needs}")
        with _canvas(chapter.panels) as (figure, axes):
            chapter.draw(axes)
            figure.suptitle(chapter.title)
        return figure


def _depth(axes: Any, table: dict[str, Any], name: str) -> bool:
    """Draw a depth over the revolutions, with a band for its uncertainty; False without data."""
    values = table.get(name)
    if values is None or not np.isfinite(values).any():
        return False
    style, label, _ = DEPTHS[name]
    number = table["revolution"]
    axes.plot(*envelope(number, 1e3 * values), **style, label=label)
    doubt = table.get(f"{name}_uncertainty")
    if doubt is not None:
        low, high = (envelope(number, 1e3 * (values + sign * doubt)) for sign in (-1.0, 1.0))
        axes.fill_between(
            low[0], low[1], np.interp(low[0], *high), color=COLOURS["value"], alpha=0.2, lw=0
        )
    return True


@contextmanager
def _canvas(panels: int) -> Iterator[tuple[Any, list[Any]]]:
    """Yield a figure of pyplot, which notebooks show, and its panels in the report's style."""
    import matplotlib
    from matplotlib import pyplot

    with matplotlib.rc_context(STYLE):
        figure, axes = pyplot.subplots(
            panels, 1, squeeze=False, figsize=size_in(panels), layout="constrained"
        )
        try:
            yield figure, list(axes[:, 0])
        except BaseException:
            pyplot.close(figure)
            raise
