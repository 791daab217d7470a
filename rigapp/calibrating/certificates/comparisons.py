"""Certificates of a comparison: a free channel with its reference, a turning pin.

The running check compares the pin's inertia force with the reading of the load cell.
"""

from __future__ import annotations

import numpy as np

from rigapp.calibrating.certificates.formatting import Content, Parts, budget_table, plot, table
from rigapp.report.page.document import Table
from rigapp_calibration.channel import CHANNEL_COLUMNS, channel_table, rule_of
from rigapp_calibration.taking.readings import read_table


def channel_parts(content: Content) -> Parts:
    """Return the parts of the certificate of a channel."""
    result = content["result"]
    readings = channel_table(read_table(content["readings_csv"], CHANNEL_COLUMNS))
    settings, unit = content["settings"], result["unit"]
    residual = np.array(result["residual_value"])
    rows = [("method", rule_of(result))]
    rows += [(f"{volts:.6f} V", f"{value:.6g} {unit}") for volts, value in result["table"] or ()]
    taken = [
        (series, str(step), f"{reference:g}", f"{signal:.6f}", f"{rest:.3g}")
        for series, step, reference, signal, rest in zip(
            readings.series,
            readings.step,
            readings.reference,
            readings.signal,
            residual,
            strict=True,
        )
    ]
    least, most = readings.reference.min(), readings.reference.max()
    way = "straight line" if result["table"] is None else "table of means, linear between them,"
    return Parts(
        [
            f"Method: voltages beside the values of a reference; {way} of both.",
            f"The expanded uncertainty of one value is {result['expanded_uncertainty_value']:.3g}"
            f" {unit} with a coverage factor k = {result['coverage_factor']:.2f} (about 95 %).",
        ],
        [Table("Value of a voltage", tuple(rows))],
        [
            plot(
                "Residual against reference",
                f"reference ({unit})",
                readings.reference,
                residual[:, None],
                f"residual ({unit})",
            )
        ],
        calibrated=f"{least:g} {unit} to {most:g} {unit} ({readings.signal.min():.3f} V to"
        f" {readings.signal.max():.3f} V). Beyond it value and uncertainty are extrapolated.",
        conditions=[
            ("Reference", f"u = {settings['channel']['reference_standard_uncertainty']:g} {unit}")
        ],
        uncertainty=budget_table("Budget of one value", result, "value", unit),
        readings=[
            Table(
                "Readings",
                tuple(taken),
                ("series", "step", f"reference {unit}", "V", f"residual {unit}"),
            )
        ],
    )


METHOD = (
    "Method: the pin turned without the follower at several speeds; the change of the mean"
    " force in the crank's frame against the known inertia of the pin outboard of the gauges,"
    " force_1 = - m r w^2, force_2 = 0. The slowest speed is the zero."
)
FACTOR = "The expanded uncertainties have the coverage factor k = 2 (about 95 %)."
SPEEDS = {
    "rpm": "{speed_rpm:.1f}",
    "known N": "{known_N[0]:+.3f}",
    "force_1 N": "{measured_N[0]:+.3f}",
    "force_2 N": "{measured_N[1]:+.3f}",
    "U N": "{expanded_uncertainty_N:.3f}",
    "verdict": "{verdict}",
}


def running_parts(content: Content) -> Parts:
    """Return statements, tables and figures of a record; every revolution's force over speed."""
    result, speeds = content["result"], content["result"]["speeds"]
    evaluated = (
        {**speed, "verdict": "agrees" if speed["agrees"] else "differs"} for speed in speeds
    )
    known, moment, expanded = (
        1e3 * result[f"{what}_kg_m"]
        for what in (
            "known_mass_times_radius",
            "measured_mass_times_radius",
            "measured_expanded_uncertainty",
        )
    )
    measured = f"{moment:.4f} kg mm, U = {expanded:.4f} kg mm"
    rows = (("known", f"{known:.4f} kg mm"), ("as the cell tells it", measured))
    text = content["readings_csv"].partition("\n")[2]
    taken = np.array([line.split(",")[1:] for line in text.splitlines()], np.float64)
    title, names = "Mean force of every revolution against speed", ("force_1", "force_2")
    return Parts(
        (METHOD, str(result["sentence"]), FACTOR),
        [
            table("Change of the mean force against the slowest speed", SPEEDS, evaluated),
            Table("Mass times radius outboard of the gauges", rows),
        ],
        [plot(title, "speed (rpm)", taken[:, 0], taken[:, 1:], "mean force (N)", names)],
        "Forces",
        calibrated=f"{speeds[0]['speed_rpm']:.1f} rpm to {speeds[-1]['speed_rpm']:.1f} rpm.",
    )
