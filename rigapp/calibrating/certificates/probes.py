"""What the certificate of a probe, of a pair of probes, says beside the identification."""

from __future__ import annotations

import numpy as np

from calibration.probes.alignment import split_pair
from calibration.probes.readings import ProbeReadings, parse_probe
from rigapp.calibrating.certificates.parts import (
    Content,
    Parts,
    budget_table,
    scatter,
    surroundings,
)
from rigapp.report.page.manuscript import Figure, Row, Table


def probe_parts(content: Content) -> Parts:
    """Return what the certificate of a probe, or of a pair, says."""
    each, alignment = _each(content), content["result"].get("alignment")
    tables = [] if alignment is None else [_alignment_table(alignment)]
    budgets = [
        budget_table(f"{name}Budget of one position".capitalize(), result, "um", "µm")
        for name, result, _ in each
    ]
    return Parts(
        _statements(content),
        [*tables, *(_line_table(result, name) for name, result, _ in each)],
        _figures(content),
        calibrated=" ".join(_range(*one) for one in each),
        conditions=_conditions(content),
        uncertainty=[one for one in budgets if one is not None],
        readings=[_readings_table(readings, result, name) for name, result, readings in each],
    )


def _range(name: str, result: Content, readings: ProbeReadings) -> str:
    low, high = 1e6 * readings.position.min(), 1e6 * readings.position.max()
    return (
        f"{name}{low:.1f} µm to {high:.1f} µm ({readings.signal.min():.3f} V to"
        f" {readings.signal.max():.3f} V), {len(set(readings.position))} positions. Beyond it the"
        " line and its uncertainty are extrapolated."
    )


def _conditions(content: Content) -> list[Row]:
    """Return surroundings, micrometer, range and geometry."""
    probe = content["settings"]["probe"]
    rows = [
        *surroundings(content["settings"]),
        ("Micrometer", f"u = {probe['micrometer_standard_uncertainty_um']:g} µm"),
        ("Range", f"{probe['range_V']:g} V"),
    ]
    if probe.get("target_radius_mm"):
        rows.append(("Cylindrical target", f"radius {probe['target_radius_mm']:g} mm"))
    if probe.get("sensor_radius_mm") and probe.get("gap_at_zero_um"):
        rows.append(
            (
                "Sensing area, gap at position 0",
                f"radius {probe['sensor_radius_mm']:g} mm, {probe['gap_at_zero_um']:g} µm",
            )
        )
    if probe.get("off_axis_um"):
        rows.append(("Motion across the axis in use", f"{probe['off_axis_um']:g} µm"))
    taken = content.get("taken")
    if taken is not None:
        rows.append(("Steps", f"{taken['positions']} positions, {taken['runs']} runs up and down"))
    return rows


def _statements(content: Content) -> list[str]:
    """Return method, uncertainty and what they do not cover."""
    result = content["result"]
    pair = "probes" in result
    least = "the larger one of the two probes, " if pair else ""
    texts = [
        "Method: micrometer steps up and down; voltage fitted as a straight line of position (least"
        " squares, best-fit line). Linearity is the largest residual over the range.",
        f"The expanded uncertainty of one position is {least}"
        f"{result['expanded_uncertainty_um']:.2f} µm with a coverage factor"
        f" k = {result['coverage_factor']:.2f} (about 95 %).",
    ]
    probe = content["settings"]["probe"]
    if not probe.get("off_axis_um"):
        texts.append(
            "It does not contain what a motion of the pin across the probe's axis adds on a"
            " cylindrical target, y²/(2R): its size in use was not stated."
        )
    if pair:
        texts.append(
            "Alignment: the target was moved along the follower's axis, then across it, and both"
            " probes were read. No reading shows an error of the direction in which the micrometer"
            f" moves; u = {probe['alignment_standard_uncertainty_deg']:g}° was stated for it."
        )
    return texts


def _each(content: Content) -> list[tuple[str, Content, ProbeReadings]]:
    """Return name, result and readings of the one probe, or of both."""
    result, readings = content["result"], parse_probe(content["readings_csv"])
    if "probes" not in result:
        return [("", result, readings)]
    both = zip(result["probes"], split_pair(readings), strict=True)
    return [(f"Probe {number}: ", one, taken) for number, (one, taken) in enumerate(both, 1)]


def _line_table(result: Content, name: str) -> Table:
    hysteresis = result["hysteresis_um"]
    return Table(
        f"{name}Position = sensitivity (voltage - offset)",
        (
            ("Sensitivity", f"{result['sensitivity_um_per_V']:.5f} µm/V"),
            ("relative u", f"{result['sensitivity_relative_standard_uncertainty']:.2e}"),
            ("Offset", f"{result['offset_V']:.6f} V"),
            ("Linearity, best-fit line", f"{result['linearity_percent']:.3f} %"),
            ("Residual standard deviation", f"{result['residual_std_um']:.3f} µm"),
            (
                "Backlash",
                "not measured" if hysteresis is None else f"{hysteresis:.3f} µm",
            ),
            ("Cylinder gain", f"{result['cylinder_gain']:.5f}"),
        ),
    )


def _alignment_table(found: Content) -> Table:
    angle, spread = found["angle_deg"], found["angle_standard_uncertainty_deg"]
    matrix = found["matrix"]
    return Table(
        "Alignment: position along and across the follower = matrix (probe 1, probe 2)",
        (
            ("Probe 1 from the follower's axis", f"{angle[0]:+.3f}°", f"{spread[0]:.3f}°"),
            ("Probe 2 from across it", f"{angle[1]:+.3f}°", f"{spread[1]:.3f}°"),
            (
                "Angle between them less 90°",
                f"{found['orthogonality_deg']:+.3f}°",
                f"{found['orthogonality_standard_uncertainty_deg']:.3f}°",
            ),
            *(
                (
                    f"m{i + 1}{j + 1}",
                    f"{matrix[i][j]:+.6f}",
                    f"{found['matrix_standard_uncertainty'][i][j]:.6f}",
                )
                for i in range(2)
                for j in range(2)
            ),
        ),
        ("", "value", "u"),
    )


def _readings_table(readings: ProbeReadings, result: Content, name: str) -> Table:
    rows = [
        (s, str(k), f"{1e6 * p:.3f}", f"{v:.6f}", f"{r:.3f}")
        for s, k, p, v, r in zip(
            readings.series, readings.step, readings.position, readings.signal,
            result["residual_um"], strict=True,
        )
    ]  # fmt: skip
    header = ("series", "step", "position µm", "V", "residual µm")
    return Table(f"{name}Readings", tuple(rows), header)


def _figures(content: Content) -> list[Figure]:
    """Return the residuals over the position."""
    figures = []
    for name, result, readings in _each(content):
        title = f"{name}residual against position"
        residual = np.array(result["residual_um"])[:, None]
        x = 1e6 * readings.position
        title = title[:1].upper() + title[1:]
        figures.append(scatter(title, "position (µm)", x, residual, "residual (µm)"))
    return figures
