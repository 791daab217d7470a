"""What the certificate of a run-out map says beside the identification."""

from __future__ import annotations

import csv
import io
from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from rigapp.calibrating.certificates.parts import Content, Parts, bands, surroundings
from rigapp.report.page.manuscript import Figure, Table


def run_out_parts(content: Content) -> Parts:
    """Return statements, tables and figures of a record."""
    files = content["taken"]["files"]
    speeds = " and ".join(f"{one['speed_rpm']:.2f}" for one in files)
    return Parts(
        _statements(content),
        [_rolls(content), *_tables(content)],
        _figures(content),
        "Map",
        calibrated=(
            f"the whole turn, orders 1 to {content['taken']['orders']}, rolled at {speeds} rpm; one"
            " pin in one place on the crank."
        ),
        conditions=surroundings(content["settings"]),
        uncertainty=[_expanded(content["result"])],
        readings=[_turns_table(content)],
    )


def _expanded(result: Content) -> Table:
    """Return U of the map of each probe."""
    rows = tuple(
        (f"Probe {number}", f"U = {one:.3f} µm, k = {result['coverage_factor']:.2f}")
        for number, one in enumerate(result["expanded_uncertainties_um"], 1)
    )
    return Table("Uncertainty of the map where it is largest", rows)


def _rolls(content: Content) -> Table:
    """Return the rolls: file, revolutions, speed, digest of the samples."""
    rows = tuple(
        (
            one["name"],
            f"{one['speed_rpm']:.2f} rpm",
            str(one["revolutions"]),
            one["sha256_of_samples"][:16],
        )
        for one in content["taken"]["files"]
    )
    return Table("Slow rolls", rows, ("file", "speed", "revolutions used", "samples' digest"))


def _statements(content: Content) -> list[str]:
    """Return method, uncertainty and what a slow roll cannot tell."""
    result = content["result"]
    orders = content["taken"]["orders"]
    one, two = result["expanded_uncertainties_um"]
    factor = result["coverage_factor"]
    texts = [
        f"Method: whole slow revolutions, each developed in Fourier orders 1 to {orders} of the"
        " crank angle by least squares, each probe for itself; the map is their mean.",
        f"The expanded uncertainty of the map is {one:.3f} µm (probe 1) and {two:.3f}"
        f" µm (probe 2) where it is largest, with a coverage factor k = {factor:.2f}"
        " (about 95 %), from the spread of the revolutions and of the rolls.",
        "The mean over the turn is where the pin rests in its seat, not run-out: the map has none.",
    ]
    if result["inertia_um"] is None:
        texts.append(
            "All rolls had one speed: a motion of the pin by inertia is contained in the map and"
            " not in its uncertainty."
        )
    else:
        moved = max(result["inertia_um"])
        texts.append(
            "The rolls were extrapolated to speed 0; the motion with the square of the speed, up to"
            f" {moved:.3f} µm in the slowest roll, was taken off, and 30 % of it (one"
            " standard deviation) counted as uncertainty."
        )
    if result.get("elastic_um"):
        texts.append(
            "Elasticity moves the pin into the bushing with the force: by the measured force and"
            " the model of the unworn bushing this motion, up to"
            f" {max(result['elastic_um']):.3f} µm about its mean, was taken off, and its"
            " size (20 %) and direction (0.1 rad, one standard deviation) counted as uncertainty."
        )
    if result["between_rolls_um"] is None:
        texts.append(
            "The direction of the load was the same in all rolls: a motion of the pin in the"
            " bushing that repeats each turn under this load is contained in the map."
        )
    return texts


def _tables(content: Content) -> list[Table]:
    """Return the orders with their uncertainty, and what the rolls showed."""
    result = content["result"]
    spread = [np.sqrt(np.diag(np.array(one))) for one in result["covariance_um2"]]
    rows = [
        (
            f"{probe + 1}",
            f"{order + 1}",
            f"{result['cos_um'][probe][order]:+.4f}",
            f"{spread[probe][2 * order]:.4f}",
            f"{result['sin_um'][probe][order]:+.4f}",
            f"{spread[probe][2 * order + 1]:.4f}",
        )
        for probe in range(2)
        for order in range(len(result["cos_um"][probe]))
    ]
    traits = (
        ("Lowest to highest", "peak_to_peak_um"),
        ("Motion with the speed, slowest roll", "inertia_um"),
        ("Elastic motion with the force", "elastic_um"),
        ("Rolls from the map, largest", "between_rolls_um"),
        ("First to last half, largest", "drift_um"),
        ("Not explained by the orders, standard deviation", "rest_um"),
    )
    return [
        Table(
            "Run-out = sum of cos and sin of the orders of the crank angle, µm",
            tuple(rows),
            ("probe", "order", "cos", "u", "sin", "u"),
        ),
        Table(
            "What the rolls showed",
            tuple((words, *_pair(result.get(key))) for words, key in traits),
            ("", "probe 1", "probe 2"),
        ),
    ]


def _pair(values: Sequence[float] | None) -> tuple[str, str]:
    if values is None:
        return "not known", "not known"
    return f"{values[0]:.3f} µm", f"{values[1]:.3f} µm"


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


def _figures(content: Content) -> list[Figure]:
    """Return the map with its uncertainty over the crank angle."""
    result = content["result"]
    curves = np.array(result["map_um"]).T
    half = result["coverage_factor"] * np.array(result["map_standard_uncertainty_um"]).T
    angle = result["map_step_deg"] * np.arange(len(curves))
    names = ("probe 1", "probe 2")
    label = "run-out (µm)"
    return [
        bands(
            "Run-out over the crank angle", "crank angle (deg)", angle, curves, half, label, names
        )
    ]
