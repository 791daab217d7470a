"""Single figures of a recorded test, as they stand in its report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

from rigapp.config.errors import UnusableInput
from rigapp.report.page.document import Figure
from rigapp.report.testreport import plots
from rigapp.report.testreport.cover import parameters_of, scheme
from rigapp.report.testreport.facts import (
    ChannelFacts,
    Rows,
    gaps_of,
    rows_of,
    stated_uncertainties,
)
from rigapp.report.testreport.model_facts import agreement_of, cycles_of, wear_of
from rigapp.report.testreport.worn import picture, worn_of
from rigapp.schema.channels import LOAD_CELL
from rigapp.storage import TestReader, open_test, trip_capture
from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty


def figure_of(path: Path, name: str = "") -> Figure:
    """Return a figure of a test by its name in FIGURES; without one, the first that there is.

    Raises UnusableInput for a file that is no test and for what the test has no data of.
    """
    with open_test(path) as reader:
        for one in (name,) if name else FIGURES:
            figure = FIGURES[one](reader)
            if figure is not None:
                return figure
    raise UnusableInput("{}: holds no data for the figure {}.", path, name or next(iter(FIGURES)))


def _wear(reader: TestReader) -> Figure | None:
    return plots.wear_trend(wear_of(reader), gaps_of(reader))


def _forces(reader: TestReader) -> Figure | None:
    rows, doubt = rows_of(reader), force_uncertainty(reader.calibration(), reader.configuration())
    channels = [one for one in rows.channels if one.channel.instrument == LOAD_CELL] if rows else []
    if rows is None or not channels:
        return None
    title = "Forces against revolution"
    return plots.trends(channels, agreement_of(reader), rows.gaps, title, doubt)


def _displacement(reader: TestReader) -> Figure | None:
    rows = rows_of(reader)
    channels = _of_probes(rows) if rows else []
    if rows is None or not channels:
        return None
    stated = stated_uncertainties(reader.calibration())
    title = "Displacement against revolution"
    return plots.trends(channels, None, rows.gaps, title, stated=stated)


def _of_probes(rows: Rows) -> list[ChannelFacts]:
    return [one for one in rows.channels if one.name.startswith("probe_")]


def _agreement(reader: TestReader) -> Figure | None:
    agreement = agreement_of(reader)
    return plots.residual_trend(agreement, gaps_of(reader)) if agreement else None


def _cycles(reader: TestReader) -> Figure | None:
    found = cycles_of(reader)
    doubt = force_uncertainty(reader.calibration(), reader.configuration())
    return plots.cycles(found, doubt) if found else None


def _profile(reader: TestReader) -> Figure | None:
    found = worn_of(reader)
    return picture(found) if found is not None else None


def _prediction(reader: TestReader) -> Figure | None:
    # Twin and compiler take 190 MB, which the other figures do without.
    from rigapp.report.testreport.identified import identified
    from rigapp.report.testreport.identifiedsections import depth_figure

    test = identified(reader, reader.path)
    return depth_figure(test, test.known) if test.known is not None else None


def _trip(reader: TestReader) -> Figure | None:
    found = trip_capture(reader)
    return plots.trip(found) if found is not None else None


def _mechanism(reader: TestReader) -> Figure | None:
    return scheme(parameters_of(reader))


FIGURES: Final[Mapping[str, Callable[[TestReader], Figure | None]]] = {
    "wear": _wear,
    "forces": _forces,
    "displacement": _displacement,
    "agreement": _agreement,
    "cycles": _cycles,
    "profile": _profile,
    "prediction": _prediction,
    "trip": _trip,
    "mechanism": _mechanism,
}
"""Name of a figure -> what draws it; None where the test has no data of it."""
