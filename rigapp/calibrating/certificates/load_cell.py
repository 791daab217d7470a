"""What the certificate of a load cell says beside the identification."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from calibration.load_cell.readings import parse_load_cell
from rigapp.calibrating.certificates.parts import Content, Parts, scatter
from rigapp.report.page.manuscript import Figure, Row, Table


def load_cell_parts(content: Content) -> Parts:
    """Return statements, tables and figures of a record."""
    tables = [_conditions(content), *_cell_tables(content), _readings_table(content)]
    return Parts(_statements(content["result"]), tables, _cell_figures(content))


def _level(shown: Sequence[float]) -> str:
    if len(shown) != 2:
        return ""
    one, two = (math.remainder(angle, 360.0) for angle in shown)
    return f"; level turned end for end at {one:.3f} and {two:.3f} deg"


def _conditions(content: Content) -> Table:
    settings = content["settings"]
    place = settings["place"]
    weights, angle = settings["weights"], settings["angle"]
    stated = place.get("gravity_m_s2")
    if stated is not None:
        gravity = f"{stated:.6g} m/s2 (stated)"
    else:
        gravity = f"from latitude {place['latitude_deg']:g} deg, height {place['height_m']:g} m"
    rows = [
        ("Local gravity", gravity),
        ("Air density", f"{place['air_density_kg_per_m3']:g} kg/m3"),
        *(
            (name, f"{place[key]:g} {unit}")
            for name, key, unit in (
                ("Temperature", "temperature_degC", "degC"),
                ("Humidity", "humidity_percent", "%"),
                ("Pressure", "pressure_hPa", "hPa"),
            )
            if place.get(key) is not None
        ),
        ("Weights", f"{weights['mass_kind']} mass, density {weights['density_kg_per_m3']:g} kg/m3,"
                    f" relative u = {weights['relative_standard_uncertainty']:g}"),
        ("Hanger", f"{weights['hanger_mass_kg']:g} kg"),
        ("Angle reference", f"offset {angle['offset_deg']:.6g} deg,"
                            f" u = {angle['standard_uncertainty_deg']:.3g} deg"
                            + _level(angle.get("level_readings_deg", ()))),
    ]  # fmt: skip
    return Table("Conditions", tuple(rows))


def _statements(result: Content) -> list[str]:
    factor = f"{result['coverage_factor']:.2f}"
    line = result["uncertainty_line_N"]
    return [
        "Method: dead weights at several angles of the pin. The procedure follows the ideas of ASTM"
        " E74 and ISO 376, which are for one axis and static forces; it does not comply with them.",
        result["classification"],
        f"The expanded uncertainty of one reading is U(F) = {line['constant_N']:.2f} N +"
        f" {line['per_N']:.5f} F with a coverage factor k = {factor} (about 95 %). It holds for the"
        " conditions and the time of the calibration. Creep was not measured.",
        "A common error of the pin angle leaves no residual; it is covered by the uncertainty of"
        " the angle reference only.",
    ]


def _cell_tables(content: Content) -> list[Table]:
    result, unit = content["result"], content["settings"]["cell"]["signal_unit"]
    matrix = result["matrix_N_per_unit"]
    spread = result["matrix_standard_uncertainty_N_per_unit"]
    rows: list[Row] = [
        (f"K{i + 1}{j + 1}", f"{matrix[i][j]:.5f}", f"{spread[i][j]:.5f}")
        for i in range(2)
        for j in range(2)
    ]
    fit = Table(
        f"Force on the pin = K (signal - zero); N per {unit}", tuple(rows), ("", "value", "u")
    )
    zero = Table(
        "Zero and residuals",
        (
            ("Zero", ", ".join(f"{value:.6f}" for value in result["zero"]) + f" {unit}"),
            ("Model", result["terms"]),
            ("Residual standard deviation", f"{result['residual_std_N']:.3f} N"),
        ),
    )
    covariance = Table(
        "Covariance of K11, K12, K21, K22",
        tuple(tuple(f"{value:.4e}" for value in row) for row in result["matrix_covariance"]),
        ("K11", "K12", "K21", "K22"),
    )
    names = {
        "reproducibility_b": "b, reproducibility",
        "repeatability_b_prime": "b', repeatability",
        "interpolation_fc": "fc, interpolation",
        "zero_return_f0": "f0, zero return",
        "reversibility_v": "v, reversibility",
        "creep_c": "c, creep",
    }
    traits = Table(
        "Characteristics, per cent",
        tuple(
            (words, "not measured" if value is None else f"{value:.3f}")
            for key, words in names.items()
            for value in (result["characteristics_percent"][key],)
        ),
    )
    budget = Table(
        f"Uncertainty at {result['full_scale_N']:g} N",
        (
            *((one["name"], f"{one['standard_uncertainty_N']:.3f} N") for one in result["budget"]),
            ("expanded", f"{result['expanded_uncertainty_N']:.3f} N"),
        ),
    )
    return [fit, *_quadratic(result, unit), zero, covariance, traits, budget]


def _quadratic(result: Content, unit: str) -> list[Table]:
    quadratic = result.get("quadratic_unit_per_N2")
    if quadratic is None:
        return []
    rows: list[Row] = [
        (f"signal {axis}", *(f"{value:.4e}" for value in row))
        for axis, row in enumerate(quadratic, 1)
    ]
    title = f"Quadratic terms: signal - zero = inverse(K) f + Q (f1^2, f1 f2, f2^2); {unit} per N^2"
    return [Table(title, tuple(rows), ("", "f1^2", "f1 f2", "f2^2"))]


def _readings_table(content: Content) -> Table:
    text, result = content["readings_csv"], content["result"]
    taken = parse_load_cell(text)
    cell_rows = [
        (name, str(step), f"{mass:g}", f"{math.degrees(angle):.3f}", f"{one:.6f}", f"{two:.6f}",
         f"{off[0]:.3f}", f"{off[1]:.3f}")
        for name, step, mass, angle, (one, two), off in zip(
            taken.series, taken.step, taken.mass, taken.angle, taken.signal, result["residual_N"],
            strict=True,
        )
    ]  # fmt: skip
    header = ("series", "step", "kg", "angle deg", "signal 1", "signal 2", "res. 1 N", "res. 2 N")
    return Table("Readings", tuple(cell_rows), header)


def _cell_figures(content: Content) -> list[Figure]:
    taken, result = parse_load_cell(content["readings_csv"]), content["result"]
    residual = np.array(result["residual_N"])
    load = np.hypot(*np.array(result["applied_N"]).T)
    angle = np.mod(np.degrees(taken.angle), 360.0)
    labels = ("residual (N)", ("signal 1", "signal 2"))
    return [
        scatter("Residual against force", "applied force (N)", load, residual, *labels),
        scatter("Residual against pin angle", "pin angle (deg)", angle, residual, *labels),
    ]
