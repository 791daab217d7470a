"""What the certificate of a run-out map says beside the identification."""

from __future__ import annotations

import csv
import io
from collections import defaultdict

import numpy as np

from rigapp.calibrating.certificates.formatting import Content, Parts, plot, say, table
from rigapp.report.page.document import Figure, Row, Table

ROLLS = {
    "file": "{name}",
    "speed": "{speed_rpm:.2f} rpm",
    "revolutions used": "{revolutions}",
    "samples' digest": "{sha256_of_samples:.16}",
}
TRAITS = {
    "Lowest to highest": "peak_to_peak_um",
    "Motion with the speed, slowest roll": "inertia_um",
    "Elastic motion with the force": "elastic_um",
    "Rolls from the map, largest": "between_rolls_um",
    "First to last half, largest": "drift_um",
    "Not explained by the orders, standard deviation": "rest_um",
}
"""What the rolls showed: words -> key of the result, a number of each probe."""
STATEMENTS = (
    "Method: whole slow revolutions, each developed in Fourier orders 1 to {orders} of the"
    " crank angle by least squares, each probe for itself; the map is their mean.",
    "The expanded uncertainty of the map is {expanded_uncertainties_um[0]:.3f} µm (probe 1) and"
    " {expanded_uncertainties_um[1]:.3f} µm (probe 2) where it is largest, with a coverage factor"
    " k = {coverage_factor:.2f} (about 95 %), from the spread of the revolutions and of the rolls.",
    "The mean over the turn is where the pin rests in its seat, not run-out: the map has none.",
)
ONE_SPEED = (
    "All rolls had one speed: a motion of the pin by inertia is contained in the map and"
    " not in its uncertainty."
)
SPEEDS = (
    "The rolls were extrapolated to speed 0; the motion with the square of the speed, up to"
    " {moved:.3f} µm in the slowest roll, was taken off, and 30 % of it (one"
    " standard deviation) counted as uncertainty."
)
ELASTIC = (
    "Elasticity moves the pin into the bushing with the force: by the measured force and"
    " the model of the unworn bushing this motion, up to {bent:.3f} µm about its mean, was taken"
    " off, and its size (20 %) and direction (0.1 rad, one standard deviation) counted as"
    " uncertainty."
)
ONE_LOAD = (
    "The direction of the load was the same in all rolls: a motion of the pin in the"
    " bushing that repeats each turn under this load is contained in the map."
)


def run_out_parts(content: Content) -> Parts:
    """Return statements, tables and figures of a record."""
    files, result = content["taken"]["files"], content["result"]
    speeds = " and ".join(f"{one['speed_rpm']:.2f}" for one in files)
    return Parts(
        _statements(result, content["taken"]["orders"]),
        [table("Slow rolls", ROLLS, files), _orders(result), _traits(result)],
        [_map(result)],
        "Map",
        calibrated=(
            f"the whole turn, orders 1 to {content['taken']['orders']}, rolled at {speeds} rpm; one"
            " pin in one place on the crank."
        ),
        uncertainty=[_expanded(result)],
        readings=[_turns_table(content)],
    )


def _expanded(result: Content) -> Table:
    """Return U of the map of each probe."""
    rows = tuple(
        (f"Probe {number}", f"U = {one:.3f} µm, k = {result['coverage_factor']:.2f}")
        for number, one in enumerate(result["expanded_uncertainties_um"], 1)
    )
    return Table("Uncertainty of the map where it is largest", rows)


def _statements(result: Content, orders: int) -> list[str]:
    """Return method, uncertainty and what a slow roll cannot tell."""
    inertia, elastic = result["inertia_um"], result.get("elastic_um")
    texts = [*STATEMENTS, ONE_SPEED if inertia is None else SPEEDS]
    if elastic:
        texts.append(ELASTIC)
    if result["between_rolls_um"] is None:
        texts.append(ONE_LOAD)
    told = {
        **result,
        "orders": orders,
        "moved": max(inertia or (0.0,)),
        "bent": max(elastic or (0.0,)),
    }
    return [text.format_map(told) for text in texts]


def _orders(result: Content) -> Table:
    """Return the orders of both probes with their uncertainty."""
    rows: list[Row] = []
    for probe, covariance in enumerate(result["covariance_um2"]):
        spread = np.sqrt(np.diag(np.array(covariance))).reshape(-1, 2)
        values = zip(result["cos_um"][probe], result["sin_um"][probe], spread, strict=True)
        rows += [
            (f"{probe + 1}", f"{order}", f"{a:+.4f}", f"{u:.4f}", f"{b:+.4f}", f"{v:.4f}")
            for order, (a, b, (u, v)) in enumerate(values, 1)
        ]
    title = "Run-out = sum of cos and sin of the orders of the crank angle, µm"
    return Table(title, tuple(rows), ("probe", "order", "cos", "u", "sin", "u"))


def _traits(result: Content) -> Table:
    rows = tuple(
        (words, *(say(f"{{{key}[{probe}]:.3f}} µm", result, "not known") for probe in range(2)))
        for words, key in TRAITS.items()
    )
    return Table("What the rolls showed", rows, ("", "probe 1", "probe 2"))


def _turns_table(content: Content) -> Table:
    """Return the first order of every revolution, from the readings kept in the record."""
    turns: dict[tuple[str, str], dict[str, str]] = defaultdict(dict)
    for row in csv.DictReader(io.StringIO(content["readings_csv"])):
        if row["order"] == "1":
            size = np.hypot(float(row["cos_um"]), float(row["sin_um"]))
            at = np.degrees(np.arctan2(float(row["sin_um"]), float(row["cos_um"]))) % 360.0
            turns[row["roll"], row["revolution"]][row["probe"]] = f"{size:.4f} at {at:.2f}°"
    rows = tuple((roll, number, one["1"], one["2"]) for (roll, number), one in turns.items())
    header = ("roll", "revolution", "probe 1, µm", "probe 2, µm")
    return Table("First order of every revolution: size, angle of its maximum", rows, header)


def _map(result: Content) -> Figure:
    """Return the map with its uncertainty over the crank angle."""
    curves = np.array(result["map_um"]).T
    half = result["coverage_factor"] * np.array(result["map_standard_uncertainty_um"]).T
    angle = result["map_step_deg"] * np.arange(len(curves))
    title, names = "Run-out over the crank angle", ("probe 1", "probe 2")
    return plot(title, "crank angle (deg)", angle, curves, "run-out (µm)", names, half)
