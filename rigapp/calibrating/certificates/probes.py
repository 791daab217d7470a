"""The parts of the certificates of a probe, of a pair of probes and of a run-out map."""

from __future__ import annotations

import csv
import io
from collections import defaultdict

import numpy as np

from rigapp.calibrating.certificates.formatting import (
    Content,
    Parts,
    budget_table,
    elements,
    plot,
    rows_of,
    say,
    table,
)
from rigapp.report.page.document import Figure, Row, Table
from rigapp.texts import capitalised
from rigapp_calibration.probes.calibrate import split_pair
from rigapp_calibration.probes.readings import ProbeReadings, parse_probe

LINE = {
    "Sensitivity": "{sensitivity_um_per_V:.5f} µm/V",
    "relative u": "{sensitivity_relative_standard_uncertainty:.2e}",
    "Offset": "{offset_V:.6f} V",
    "Linearity, best-fit line": "{linearity_percent:.3f} %",
    "Residual standard deviation": "{residual_std_um:.3f} µm",
    "Backlash": "{hysteresis_um:.3f} µm",
    "Cylinder gain": "{cylinder_gain:.5f}",
}
SETTINGS = {
    "Micrometer": "u = {micrometer_standard_uncertainty_um:g} µm",
    "Range": "{range_V:g} V",
}
GEOMETRY = {
    "target_radius_mm": {"Cylindrical target": "radius {target_radius_mm:g} mm"},
    "gap_at_zero_um": {
        "Sensing area, gap at position 0": "radius {sensor_radius_mm:g} mm, {gap_at_zero_um:g} µm"
    },
    "off_axis_um": {"Motion across the axis in use": "{off_axis_um:g} µm"},
}
"""Rows of the settings of a probe, as far as they are stated."""
ANGLES = (
    ("Probe 1 from the follower's axis", "angle", "[0]"),
    ("Probe 2 from across it", "angle", "[1]"),
    ("Angle between them less 90°", "orthogonality", ""),
)
"""Rows of the alignment: words, and keys of the result."""
METHOD = (
    "Method: micrometer steps up and down; voltage fitted as a straight line of position (least"
    " squares, best-fit line). Linearity is the largest residual over the range."
)
EXPANDED = (
    "The expanded uncertainty of one position is {least}{expanded_uncertainty_um:.2f} µm with a"
    " coverage factor k = {coverage_factor:.2f} (about 95 %)."
)
OF_MEAN = "{name}U of a mean of many readings is {expanded_uncertainty_of_mean_um:.2f} µm."
NOT_ACROSS = (
    "It does not contain what a motion of the pin across the probe's axis adds on a"
    " cylindrical target, y²/(2R): its size in use was not stated."
)
ALIGNMENT = (
    "Alignment: the target was moved along the follower's axis, then across it, and both"
    " probes were read. No reading shows an error of the direction in which the micrometer"
    " moves; u = {alignment_standard_uncertainty_deg:g}° was stated for it."
)


def probe_parts(content: Content) -> Parts:
    """Return the parts of the certificate of a probe, or of a pair."""
    each, alignment = _each(content), content["result"].get("alignment")
    return Parts(
        _statements(content),
        [
            *([] if alignment is None else [_alignment_table(alignment)]),
            *(
                Table(
                    f"{name}Position = sensitivity (voltage - offset)",
                    tuple(rows_of(LINE, result, "not measured")),
                )
                for name, result, _ in each
            ),
        ],
        [_residuals(*probe) for probe in each],
        calibrated=" ".join(_range(*probe) for probe in each),
        conditions=_conditions(content),
        uncertainty=[
            budget
            for name, result, _ in each
            for budget in budget_table(
                f"{name}Budget of one position".capitalize(), result, "um", "µm"
            )
        ],
        readings=[_readings_table(*probe) for probe in each],
    )


def _each(content: Content) -> list[tuple[str, Content, ProbeReadings]]:
    """Return name, result and readings of the one probe, or of both."""
    result, readings = content["result"], parse_probe(content["readings_csv"])
    if "probes" not in result:
        return [("", result, readings)]
    both = zip(result["probes"], split_pair(readings), strict=True)
    return [(f"Probe {number}: ", own, taken) for number, (own, taken) in enumerate(both, 1)]


def _range(name: str, result: Content, readings: ProbeReadings) -> str:
    low, high = 1e6 * readings.position.min(), 1e6 * readings.position.max()
    return (
        f"{name}{low:.1f} µm to {high:.1f} µm ({readings.signal.min():.3f} V to"
        f" {readings.signal.max():.3f} V), {len(set(readings.position))} positions. Beyond it the"
        " line and its uncertainty are extrapolated."
    )


def _conditions(content: Content) -> list[Row]:
    """Return micrometer, range and geometry."""
    probe, taken = content["settings"]["probe"], content.get("taken")
    rows = rows_of(SETTINGS, probe)
    for key, lines in GEOMETRY.items():
        if probe.get(key):
            rows += rows_of(lines, probe)
    if taken is not None:
        rows += rows_of({"Steps": "{positions} positions, {runs} runs up and down"}, taken)
    return rows


def _statements(content: Content) -> list[str]:
    """Return method, uncertainty and their limits."""
    probe, pair = content["settings"]["probe"], "probes" in content["result"]
    least = "the larger one of the two probes, " if pair else ""
    texts = [METHOD, say(EXPANDED, {**content["result"], "least": least})]
    texts += (
        say(OF_MEAN, {**result, "name": name})
        for name, result, _ in _each(content)
        if "expanded_uncertainty_of_mean_um" in result  # not in older records
    )
    if not probe.get("off_axis_um"):
        texts.append(NOT_ACROSS)
    if pair:
        texts.append(say(ALIGNMENT, probe))
    return texts


def _alignment_table(alignment: Content) -> Table:
    rows = [
        (
            words,
            say(f"{{{what}_deg{at}:+.3f}}°", alignment),
            say(f"{{{what}_standard_uncertainty_deg{at}:.3f}}°", alignment),
        )
        for words, what, at in ANGLES
    ]
    matrix = elements("m", alignment, {"matrix": "+.6f", "matrix_standard_uncertainty": ".6f"})
    title = "Alignment: position along and across the follower = matrix (probe 1, probe 2)"
    return Table(title, (*rows, *matrix), ("", "value", "u"))


def _readings_table(name: str, result: Content, readings: ProbeReadings) -> Table:
    rows = [
        (s, str(k), f"{1e6 * p:.3f}", f"{v:.6f}", f"{r:.3f}")
        for s, k, p, v, r in zip(
            readings.series, readings.step, readings.position, readings.signal,
            result["residual_um"], strict=True,
        )
    ]  # fmt: skip
    header = ("series", "step", "position µm", "V", "residual µm")
    return Table(f"{name}Readings", tuple(rows), header)


def _residuals(name: str, result: Content, readings: ProbeReadings) -> Figure:
    """Return the residuals over the position."""
    title = f"{name}residual against position"
    residual = np.array(result["residual_um"])[:, None]
    x = 1e6 * readings.position
    return plot(f"{capitalised(title)}", "position (µm)", x, residual, "residual (µm)")


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
"""Results of the rolls: words -> key of the result, a number of each probe."""
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
    speeds = " and ".join(f"{file['speed_rpm']:.2f}" for file in files)
    return Parts(
        _run_out_statements(result, content["taken"]["orders"]),
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
        (f"Probe {number}", f"U = {expanded:.3f} µm, k = {result['coverage_factor']:.2f}")
        for number, expanded in enumerate(result["expanded_uncertainties_um"], 1)
    )
    return Table("Uncertainty of the map where it is largest", rows)


def _run_out_statements(result: Content, orders: int) -> list[str]:
    """Return method, uncertainty and the limits of a slow roll."""
    inertia, elastic = result["inertia_um"], result.get("elastic_um")
    texts = [*STATEMENTS, ONE_SPEED if inertia is None else SPEEDS]
    if elastic:
        texts.append(ELASTIC)
    if result["between_rolls_um"] is None:
        texts.append(ONE_LOAD)
    values = {
        **result,
        "orders": orders,
        "moved": max(inertia or (0.0,)),
        "bent": max(elastic or (0.0,)),
    }
    return [text.format_map(values) for text in texts]


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
    rows = tuple((roll, number, turn["1"], turn["2"]) for (roll, number), turn in turns.items())
    header = ("roll", "revolution", "probe 1, µm", "probe 2, µm")
    return Table("First order of every revolution: size, angle of its maximum", rows, header)


def _map(result: Content) -> Figure:
    """Return the map with its uncertainty over the crank angle."""
    curves = np.array(result["map_um"]).T
    half = result["coverage_factor"] * np.array(result["map_standard_uncertainty_um"]).T
    angle = result["map_step_deg"] * np.arange(len(curves))
    title, names = "Run-out over the crank angle", ("probe 1", "probe 2")
    return plot(title, "crank angle (deg)", angle, curves, "run-out (µm)", names, half)
