"""What the certificate of a probe, of a pair of probes, says beside the identification."""

from __future__ import annotations

import numpy as np

from rigapp.calibrating.certificates.formatting import (
    Content,
    Parts,
    budget_table,
    elements,
    plot,
    rows_of,
    say,
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
"""Of the settings of a probe: a row for what is stated."""
ANGLES = (
    ("Probe 1 from the follower's axis", "angle", "[0]"),
    ("Probe 2 from across it", "angle", "[1]"),
    ("Angle between them less 90°", "orthogonality", ""),
)
"""Of the alignment: words, and where the result has it."""
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
    """Return what the certificate of a probe, or of a pair, says."""
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
        [_residuals(*one) for one in each],
        calibrated=" ".join(_range(*one) for one in each),
        conditions=_conditions(content),
        uncertainty=[
            budget
            for name, result, _ in each
            for budget in budget_table(
                f"{name}Budget of one position".capitalize(), result, "um", "µm"
            )
        ],
        readings=[_readings_table(*one) for one in each],
    )


def _each(content: Content) -> list[tuple[str, Content, ProbeReadings]]:
    """Return name, result and readings of the one probe, or of both."""
    result, readings = content["result"], parse_probe(content["readings_csv"])
    if "probes" not in result:
        return [("", result, readings)]
    both = zip(result["probes"], split_pair(readings), strict=True)
    return [(f"Probe {number}: ", one, taken) for number, (one, taken) in enumerate(both, 1)]


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
    """Return method, uncertainty and what they do not cover."""
    probe, pair = content["settings"]["probe"], "probes" in content["result"]
    least = "the larger one of the two probes, " if pair else ""
    texts = [METHOD, say(EXPANDED, {**content["result"], "least": least})]
    texts += (
        say(OF_MEAN, {**result, "name": name})
        for name, result, _ in _each(content)
        if "expanded_uncertainty_of_mean_um" in result  # not in records of before
    )
    if not probe.get("off_axis_um"):
        texts.append(NOT_ACROSS)
    if pair:
        texts.append(say(ALIGNMENT, probe))
    return texts


def _alignment_table(found: Content) -> Table:
    rows = [
        (
            words,
            say(f"{{{what}_deg{at}:+.3f}}°", found),
            say(f"{{{what}_standard_uncertainty_deg{at}:.3f}}°", found),
        )
        for words, what, at in ANGLES
    ]
    matrix = elements("m", found, {"matrix": "+.6f", "matrix_standard_uncertainty": ".6f"})
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
