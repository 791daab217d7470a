"""What the certificate of a free channel says beside the identification."""

from __future__ import annotations

import numpy as np

from rigapp.calibrating.certificates.formatting import Content, Parts, budget_table, plot
from rigapp.report.page.document import Table
from rigapp_calibration.channel import CHANNEL_COLUMNS, channel_table, rule_of
from rigapp_calibration.taking.readings import read_table


def channel_parts(content: Content) -> Parts:
    """Return what the certificate of a channel says."""
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
