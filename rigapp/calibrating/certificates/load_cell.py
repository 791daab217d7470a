"""What the certificate of a load cell says beside the identification."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import msgspec
import numpy as np

from calibration.arrays import ACROSS
from calibration.load_cell.readings import parse_load_cell
from calibration.load_cell.two_axis import forces
from calibration.load_cell.weights import pin_force
from rigapp.calibrating.certificates.parts import (
    UNSTATED,
    Content,
    Parts,
    budget_table,
    scatter,
    surroundings,
)
from rigapp.config.calibration_settings import WeightsSection
from rigapp.report.page.manuscript import Figure, Row, Table

MARKED = "extrapolated"


def load_cell_parts(content: Content) -> Parts:
    """Return what the certificate of a load cell says."""
    result, loads = content["result"], loads_of(content)
    full = result["full_scale_N"]
    extrapolated = " EXTRAPOLATED beyond the calibrated range" * (full > loads[-1].applied)
    budgets = [
        budget_table(f"Budget of one reading of {what} at {full:g} N{extrapolated}", one, "N", "N")
        for what, one in (
            ("a component in its worst direction", result),
            ("|F|", result.get("magnitude", {})),
        )
    ]
    return Parts(
        _statements(content, loads, extrapolated),
        [_results(loads, result), *_cell_tables(content)],
        _cell_figures(content),
        calibrated=_range(loads),
        conditions=_conditions(content),
        uncertainty=[*_by_load(result, loads), *filter(None, budgets)],
        readings=[_readings_table(content)],
    )


@dataclass(frozen=True, slots=True)
class Load:
    """The readings at one load: applied and mean indicated force (N), error along and across, N.

    largest: the largest error of a reading. angles: pin angles, deg.
    """

    applied: float
    readings: int
    indicated: float
    error: float
    across: float
    largest: float
    angles: tuple[float, ...]


def loads_of(content: Content) -> tuple[Load, ...]:
    """Return what the cell indicates at each load with the calibration that is certified."""
    taken, result = parse_load_cell(content["readings_csv"]), content["result"]
    quadratic = result.get("quadratic_unit_per_N2")
    told = forces(
        taken.signal,
        np.array(result["matrix_N_per_unit"]),
        np.array(result["zero"]),
        None if quadratic is None else np.array(quadratic),
    )
    offset = math.radians(content["settings"]["angle"]["offset_deg"] or 0.0)
    along = pin_force(np.ones(len(taken)), taken.angle, offset)
    across = along @ ACROSS
    applied = np.sum(np.array(result["applied_N"]) * along, axis=1)
    indicated = np.sum(told * along, axis=1)
    aside = np.sum(told * across, axis=1)
    off = np.hypot(indicated - applied, aside)
    found = []
    for mass in np.unique(taken.mass):
        here = taken.mass == mass
        angles = np.unique(np.round(np.degrees(taken.angle[here]) % 360.0, 1))
        means = (float(one[here].mean()) for one in (applied, indicated, aside))
        load, shown, side = means
        largest = float(off[here].max())
        count = int(here.sum())
        found.append(Load(load, count, shown, shown - load, side, largest, tuple(angles)))
    return tuple(found)


def _range(loads: Sequence[Load]) -> str:
    angles = sorted({one for load in loads for one in load.angles})
    return (
        f"{loads[0].applied:.1f} N to {loads[-1].applied:.1f} N, {len(loads)} loads at"
        f" {len(angles)} pin angles ({', '.join(f'{one:.0f}' for one in angles)} deg)."
    )


def _results(loads: Sequence[Load], result: Content) -> Table:
    full = result["full_scale_N"]
    rows: list[Row] = [
        (
            f"{one.applied:.2f}",
            f"{one.readings}",
            f"{_plain(one.indicated):.2f}",
            f"{_plain(one.error):+.2f}",
            f"{_plain(one.across):+.2f}",
            f"{one.largest:.2f}",
            f"{_uncertainty(result, one.applied):.2f}",
            "",
        )
        for one in loads
    ]
    if full > loads[-1].applied:
        blank = ("–",) * 5
        rows.append((f"{full:.2f}", *blank, f"{result['expanded_uncertainty_N']:.2f}", MARKED))
    header = (
        "applied N",
        "readings",
        "indicated N",
        "error N",
        "across N",
        "largest error N",
        "U N",
        "",
    )
    title = (
        "Results by load: means over the pin angles. Error: indicated less applied; across: what is"
        " indicated square to the load; largest error: of a single reading; U: of a single reading"
    )
    return Table(title, tuple(rows), header)


def _plain(force: float) -> float:
    """Return a force (N) as two decimals tell it, without the sign of a zero."""
    return round(force, 2) + 0.0


def _uncertainty(result: Content, load: float) -> float:
    """Return U of one reading of a component at a load, N, between the loads it is stated for."""
    stated = result.get("uncertainty_by_load")
    if not stated:
        line = result["uncertainty_line_N"]
        return float(line["constant_N"] + line["per_N"] * load)
    told = [(one["load_N"], one["component_one_reading_N"]) for one in stated]
    return float(np.interp(load, *np.array(told).T))


def _by_load(result: Content, loads: Sequence[Load]) -> list[Table]:
    """Return U of a component, of |F| and of means at each load that the record states."""
    stated = result.get("uncertainty_by_load")
    if not stated:
        return []
    keys = [
        f"{what}_{count}_N"
        for what in ("component", "magnitude")
        for count in ("one_reading", "mean_of_many")
    ]
    rows = tuple(
        (
            f"{one['load_N']:g}",
            *(f"{one[key]:.2f}" for key in keys),
            f"{one['coverage_factor']:.2f}",
            MARKED if one["load_N"] > loads[-1].applied else "",
        )
        for one in stated
    )
    header = (
        "load N", "component, one reading", "component, mean of many", "|F|, one reading",
        "|F|, mean of many", "k", "",
    )  # fmt: skip
    return [Table("Expanded uncertainty by load, N, about 95 %", rows, header)]


def _level(shown: Sequence[float]) -> str:
    if len(shown) != 2:
        return ""
    one, two = (math.remainder(angle, 360.0) for angle in shown)
    return f"; level turned end for end at {one:.3f} and {two:.3f} deg"


def _conditions(content: Content) -> list[Row]:
    settings = content["settings"]
    place = settings["place"]
    weights, angle = settings["weights"], settings["angle"]
    used = msgspec.convert(weights, WeightsSection).relative_uncertainty
    stated = place.get("gravity_m_s2")
    if stated is not None:
        gravity = f"{stated:.6g} m/s2 (stated)"
    else:
        gravity = f"from latitude {place['latitude_deg']:g} deg, height {place['height_m']:g} m"
    return [
        *surroundings(settings),
        ("Local gravity", gravity),
        ("Air density", f"{place['air_density_kg_per_m3']:g} kg/m3"),
        ("Weights", f"{weights['mass_kind']} mass, density {weights['density_kg_per_m3']:g} kg/m3,"
                    f" relative u = {used:.2g}"),
        ("Hanger", f"{weights['hanger_mass_kg']:g} kg"),
        ("Angle reference", _offset(angle["offset_deg"]) +
                            f" u = {angle['standard_uncertainty_deg']:.3g} deg"
                            + _level(angle.get("level_readings_deg", ()))),
        *_in_use(settings.get("use")),
    ]  # fmt: skip


def _offset(offset: float | None) -> str:
    if offset is None:
        return "none was stated; offset taken as 0 deg,"
    return f"offset {round(offset, 6) + 0.0:g} deg,"


def _in_use(use: Content | None) -> list[Row]:
    """Return the changes from the calibration to a test that U contains, each at most so much."""
    if use is None:
        return []
    kelvin = use["temperature_difference_K"]
    words = (
        f"up to {kelvin:g} K from the calibration, gain {use['gain_percent_per_K']:g} %/K, zero"
        f" {use['zero_percent_of_full_scale_per_K']:g} % of full scale/K; creep"
        f" {use['creep_percent']:g} %; gain {use['gain_change_percent_per_year']:g} % a year"
    )
    return [("Changes in use, contained in U", words)]


def _statements(content: Content, loads: Sequence[Load], extrapolated: str) -> list[str]:
    result, in_use = content["result"], "use" in content["settings"]
    factor = f"{result['coverage_factor']:.2f}"
    line = result["uncertainty_line_N"]
    beyond = (
        f" Above {loads[-1].applied:.0f} N it is extrapolated: no load was there."
        if extrapolated
        else ""
    )
    holds = (
        "It holds in use, too, within the changes that the conditions name."
        if in_use
        else "It holds for the conditions and the time of the calibration."
    )
    return [
        "Method: dead weights at several angles of the pin. The procedure follows the ideas of ASTM"
        " E74 and ISO 376, which are for one axis and static forces; it does not comply with them.",
        result["classification"],
        f"The expanded uncertainty of one reading is U(F) = {line['constant_N']:.2f} N +"
        f" {line['per_N']:.5f} F with a coverage factor k = {factor} at full scale (about 95 %)."
        f" {holds}{beyond}",
        "A common error of the pin angle leaves no residual; it is covered by the uncertainty of"
        " the angle reference only.",
    ]


def _cell_tables(content: Content) -> list[Table]:
    result, unit = content["result"], content["settings"]["cell"]["signal_unit"]
    matrix = result["matrix_N_per_unit"]
    spread = result["matrix_standard_uncertainty_N_per_unit"]
    expanded = result.get("matrix_expanded_uncertainty_N_per_unit")
    rows: list[Row] = [
        (
            f"K{i + 1}{j + 1}",
            f"{matrix[i][j]:.5f}",
            f"{spread[i][j]:.5f}",
            UNSTATED if expanded is None else f"{expanded[i][j]:.5f}",
        )
        for i in range(2)
        for j in range(2)
    ]
    fit = Table(
        f"Force on the pin = K (signal - zero); N per {unit}", tuple(rows), ("", "value", "u", "U")
    )
    of_zero = result.get("zero_expanded_uncertainty")
    each = [f"U {UNSTATED}"] * 2 if of_zero is None else [f"U = {one:.6f}" for one in of_zero]
    in_newton = result.get("zero_expanded_uncertainty_N")
    zero = Table(
        "Zero and residuals",
        (
            *(
                (f"Zero of signal {axis}", f"{value:.6f} {unit}, {spread}")
                for axis, value, spread in zip((1, 2), result["zero"], each, strict=True)
            ),
            (
                "Uncertainty of the zero",
                UNSTATED if in_newton is None else f"U = {in_newton:.3f} N",
            ),
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
    return [fit, *_quadratic(result, unit), zero, covariance, traits]


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
    return Table("Readings as taken, residuals of the fit", tuple(cell_rows), header)


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
