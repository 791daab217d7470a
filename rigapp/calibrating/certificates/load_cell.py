"""The parts of a load cell's certificate beside the identification."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from decimal import Decimal
from typing import Any

import msgspec
import numpy as np

from rigapp.calibrating.certificates.formatting import (
    UNSTATED,
    Content,
    Parts,
    budget_table,
    plot,
    rows_of,
    say,
    table,
)
from rigapp.config.calibration_settings import WeightsSection
from rigapp.report.page.document import Figure, Row, Table
from rigapp_calibration.arrays import ACROSS
from rigapp_calibration.coverage import by_uncertainty
from rigapp_calibration.load_cell.characteristics import Creep, creep_words
from rigapp_calibration.load_cell.readings import LoadCellReadings, parse_load_cell
from rigapp_calibration.load_cell.two_axis import forces
from rigapp_calibration.load_cell.weights import pin_force

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
"""Digits of an exponent."""

EXTRAPOLATED = "extrapolated"
MARKED = "extrapolated, U in use"
RESULTS = {
    "applied N": "{applied}",
    "readings": "{readings}",
    "indicated N": "{indicated}",
    "error N": "{error}",
    "across N": "{across}",
    "largest error N": "{largest}",
    "U N": "{expanded}",
    "": "{mark}",
}
BY_LOAD = {
    "load N": "{load}",
    "component, one reading": "{component_one_reading_N}",
    "component, mean of many": "{component_mean_of_many_N}",
    "|F|, one reading": "{magnitude_one_reading_N}",
    "|F|, mean of many": "{magnitude_mean_of_many_N}",
    "k": "{coverage_factor:.2f}",
    "": "{mark}",
}
TRAITS = {
    "b, reproducibility": "{reproducibility_b:.3f}",
    "b', repeatability": "{repeatability_b_prime:.3f}",
    "fc, interpolation": "{interpolation_fc:.3f}",
    "f0, zero return": "{zero_return_f0:.3f}",
    "v, reversibility (hysteresis)": "{reversibility_v:.3f}",
    "c, creep": "{creep_c:.3f}",
}
HUNG = {
    "kg": "{mass:g}",
    "s after loading": "{time:.1f}",
    "angle °": "{angle:.3f}",
    "signal 1": "{signals[0]:.6f}",
    "signal 2": "{signals[1]:.6f}",
}
STATED_GRAVITY = "{place[gravity_m_s2]:.6g} m/s² (stated)"
FROM_LATITUDE = "from latitude {place[latitude_deg]:g}°, height {place[height_m]:g} m"
CONDITIONS = {
    "Air density": "{place[air_density_kg_per_m3]:g} kg/m³",
    "Resolution": "{resolution} N, of the cell with its amplifier",
    "Weights": "{weights[mass_kind]} mass, density {weights[density_kg_per_m3]:g} kg/m³,"
    " relative u = {used:.2g} %",
    "Hanger": "{weights[hanger_mass_kg]:g} kg",
    "Angle reference": "{offset}, u = {angle[standard_uncertainty_deg]:.3g}°{level}",
}
IN_USE = {
    "Changes that U in use holds": "up to {temperature_difference_K:g} K from the calibration,"
    " gain {gain_percent_per_K:g} %/K, zero {zero_percent_of_full_scale_per_K:g} % of full"
    " scale/K; creep {crept}; gain {gain_change_percent_per_year:g} % a year{more}"
}
SELDOM = {
    "load_introduction_percent": "; load introduction {load_introduction_percent:g} %",
    "angle_deg": "; pin angle {angle_deg:g}°",
    "dead_zone_percent": "; held back {dead_zone_percent:g} % of full scale",
    "largest_force_N": "; forces up to {largest_force_N:g} N",
}
"""The contributions to U after the calibration, each with its limit."""
OF_CALIBRATION = (
    "The expanded uncertainty of the calibration, of one reading at the time and in the conditions"
    " named, is U(F) = {line} with a coverage factor k = {factor} at {load} N (about 95 %)."
)
IN_USE_TOO = (
    "The expanded uncertainty in use is U(F) = {line} with k = {factor} at full scale. It holds"
    " what may change after the calibration, too, within what the conditions name.{beyond}"
)
HOLDS_IN_USE = "It holds in use, too, within the changes that the conditions name."
HOLDS_THEN = "It holds for the conditions and the time of the calibration."


def load_cell_parts(content: Content) -> Parts:
    """Return the parts of the certificate of a load cell."""
    result, taken = content["result"], parse_load_cell(content["readings_csv"])
    loads = _loads(content, taken)
    least, most, full = loads[0]["load"], loads[-1]["load"], result["full_scale_N"]
    extrapolated = " EXTRAPOLATED beyond the calibrated range" * (full > most)
    own = result.get("of_calibration")
    budgets = [
        budget_table(
            f"{title}Budget of one reading of {what} at {_short(at, full)} N{mark}", sums, "N", "N"
        )
        for title, of, at, mark in (
            ("Calibration: ", own and _used(own), _largest(own), ""),
            ("In use: " if own else "", result, full, extrapolated),
        )
        if of
        for what, sums in (
            ("a component in its worst direction", of),
            ("|F|", of.get("magnitude", {})),
        )
    ]
    angles = np.unique(np.round(np.degrees(taken.angle) % 360.0, 1))
    return Parts(
        _statements(content, most),
        [_results(loads, result), *_cell_tables(content)],
        _cell_figures(taken, result),
        calibrated=f"{_load(least, full)} N to {_load(most, full)} N, {len(loads)} loads at"
        f" {len(angles)} pin angles ({', '.join(f'{angle:.0f}' for angle in angles)}°).",
        conditions=_conditions(content["settings"], result.get("creep")),
        uncertainty=[
            *_by_load(own or {}, most, full, "of the calibration"),
            *_by_load(result, most, full, "in use" if own else ""),
            *(table for budget in budgets for table in budget),
        ],
        readings=[_readings_table(taken, result), *_hung_table(taken)],
    )


def _loads(content: Content, taken: LoadCellReadings) -> list[Content]:
    """Return the indication at each load with the certified calibration, N.

    Means over the pin angles, along the load and across it; largest: error of a single reading.
    """
    result = content["result"]
    quadratic = result.get("quadratic_unit_per_N2")
    force = forces(
        taken.signal,
        np.array(result["matrix_N_per_unit"]),
        np.array(result["zero"]),
        None if quadratic is None else np.array(quadratic),
    )
    offset = math.radians(content["settings"]["angle"]["offset_deg"] or 0.0)
    along = pin_force(np.ones(len(taken)), taken.angle, offset)
    # The weight of the pin acts with every load; it is removed in use as well.
    force = force - (result.get("pin_weight_N") or 0.0) * along
    applied = np.sum(np.array(result["applied_N"]) * along, axis=1)
    indicated = np.sum(force * along, axis=1)
    aside = np.sum(force * (along @ ACROSS), axis=1)
    off = np.hypot(indicated - applied, aside)
    items: list[Content] = []
    for mass in np.unique(taken.mass):
        rows = taken.mass == mass
        load, shown, side = (float(values[rows].mean()) for values in (applied, indicated, aside))
        expanded = _uncertainty(result, load)
        items.append(
            {
                "load": load,
                "applied": by_uncertainty(load, expanded, 1),
                "readings": int(rows.sum()),
                "indicated": by_uncertainty(shown, expanded),
                "error": by_uncertainty(shown - load, expanded),
                "across": by_uncertainty(side, expanded),
                "largest": by_uncertainty(float(off[rows].max()), expanded),
                "expanded": by_uncertainty(expanded, expanded),
                "mark": "",
            }
        )
    return items


def _results(loads: Sequence[Content], result: Content) -> Table:
    items, full = [*loads], result["full_scale_N"]
    if full > loads[-1]["load"]:
        expanded = result["expanded_uncertainty_N"]
        shown = by_uncertainty(full, expanded, 1), by_uncertainty(expanded, expanded)
        items.append({"applied": shown[0], "expanded": shown[1], "mark": MARKED})
    title = (
        "Results by load: means over the pin angles. Error: indicated less applied; across: what is"
        " indicated square to the load; largest error: of a single reading; U: of a single reading"
    )
    return table(title, RESULTS, items, "–")


def _uncertainty(result: Content, load: float) -> float:
    """Return U of one reading of a component at a load, N, between the loads it is stated for.

    That of the calibration itself, where the record has it.
    """
    result = result.get("of_calibration", result)
    stated = result.get("uncertainty_by_load")
    if not stated:
        line = result["uncertainty_line_N"]
        return float(line["constant_N"] + line["per_N"] * load)
    points = [(point["load_N"], point["component_one_reading_N"]) for point in stated]
    return float(np.interp(load, *np.array(points).T))


def _by_load(result: Content, most: float, full: float, what: str) -> list[Table]:
    """Return U of a component, of |F| and of means at each stated load; what: for the titles."""
    items = [
        {
            **{
                key: by_uncertainty(value, value)
                if key.endswith(("_reading_N", "_many_N"))
                else value
                for key, value in row.items()
            },
            "load": _short(row["load_N"], full),
            "mark": EXTRAPOLATED if row["load_N"] > most + 1e-6 else "",
        }
        for row in result.get("uncertainty_by_load", ())
    ]
    title = f"Expanded uncertainty {what} by load, N, about 95 %".replace("  ", " ")
    return [table(title, BY_LOAD, items)] if items else []


def _conditions(settings: Content, creep: Content | None) -> list[Row]:
    angle = settings["angle"]
    offset, level = angle["offset_deg"], angle.get("level_readings_deg", ())
    values = {
        **settings,
        "used": 100.0 * msgspec.convert(settings["weights"], WeightsSection).relative_uncertainty,
        "resolution": f"{Decimal(str(settings['cell']['resolution_N'])).normalize():f}",
        "offset": "none was stated; offset taken as 0 degrees",
        "level": "",
    }
    if offset is not None:
        values["offset"] = f"offset {round(offset, 6) + 0.0:g}°"
    if len(level) == 2:
        first, second = (math.remainder(shown, 360.0) for shown in level)
        values["level"] = f"; level turned end for end at {first:.3f}° and {second:.3f}°"
    gravity = say(STATED_GRAVITY, settings, say(FROM_LATITUDE, settings))
    use = settings.get("use")
    return [
        ("Local gravity", gravity),
        *rows_of(CONDITIONS, values),
        *([] if use is None else rows_of(IN_USE, _in_use(use, creep))),
    ]


def _in_use(use: Content, creep: Content | None) -> dict[str, Any]:
    """Return the contributions in use for IN_USE; optional ones only if stated."""
    more = "".join(say(words, use) for key, words in SELDOM.items() if use.get(key))
    return {**use, "crept": _crept(use, creep), "more": more}


def _crept(use: Content, creep: Content | None) -> str:
    if creep is None:
        return f"{use['creep_percent']:g} % as stated"
    return f"{creep['half_width_percent']:.3f} % as measured"


def _statements(content: Content, most: float) -> list[str]:
    result, in_use = content["result"], "use" in content["settings"]
    beyond = ""
    if result["full_scale_N"] > most:
        above = _load(most, result["full_scale_N"], -1)
        beyond = f" Above {above} N it is extrapolated: no load was there."
    return [
        "Method: dead weights at several angles of the pin. The procedure follows the ideas of ASTM"
        " E74 and ISO 376, which are for one axis and static forces; it does not comply with them.",
        result["classification"],
        *_uncertainties(result, HOLDS_IN_USE if in_use else HOLDS_THEN, beyond),
        _common_angle(content["settings"]["angle"]),
        "No statement of conformity is made: no decision rule applies.",
        *_creep(content),
    ]


def _uncertainties(result: Content, holds: str, beyond: str) -> list[str]:
    """Return both statements of U; of older records the only one, and when it ``holds``."""
    own, line = result.get("of_calibration"), _line_words(result)
    factor = f"{result['coverage_factor']:.2f}"
    if own is None:
        return [
            f"The expanded uncertainty of one reading is U(F) = {line} with a coverage factor"
            f" k = {factor} at full scale (about 95 %). {holds}{beyond}"
        ]
    values = {"line": _line_words(own), "factor": f"{own['coverage_factor']:.2f}"}
    return [
        OF_CALIBRATION.format(**values, load=_load(own["load_N"], result["full_scale_N"])),
        IN_USE_TOO.format(line=line, factor=factor, beyond=beyond),
    ]


def _line_words(result: Content) -> str:
    line = result["uncertainty_line_N"]
    constant, share = (by_uncertainty(line[key], line[key]) for key in ("constant_N", "per_N"))
    return f"{constant} N + {share} F"


def _used(own: Content) -> Content:
    """Return U of the calibration without the budget lines that belong to use."""

    def shown(budget: Sequence[Content]) -> list[Content]:
        return [line for line in budget if line["standard_uncertainty_N"] > 0.0]

    magnitude = {**own["magnitude"], "budget": shown(own["magnitude"]["budget"])}
    return {**own, "budget": shown(own["budget"]), "magnitude": magnitude}


def _largest(own: Content | None) -> float:
    return float(own["load_N"]) if own else 0.0


def _load(load: float, full_scale: float, more: int = 0) -> str:
    """Return a load in words: as exact as a thousandth of full scale."""
    return by_uncertainty(load, 0.01 * full_scale, more)


def _short(load: float, full_scale: float) -> str:
    """Return a load as ``_load`` does, without zeros at its end."""
    return f"{float(_load(load, full_scale)):g}"


def _common_angle(angle: Content) -> str:
    words = "A common error of the pin angle leaves no residual"
    if angle["offset_deg"] is None:
        return f"{words}, and no angle reference was taken: U does not hold it."
    return f"{words}; U holds it by the uncertainty of the angle reference."


def _creep(content: Content) -> list[str]:
    """Return how the creep was measured, or what U contains instead; nothing for old records."""
    use, creep = content["settings"].get("use"), content["result"].get("creep")
    if use is None:
        return []
    if creep is None:
        return [creep_words(None, 0.01 * use["creep_percent"])]
    early, late = creep["hung_s"]
    half_width = 0.01 * creep["half_width_percent"]
    words = creep_words(Creep(creep["load_N"], (early, late), creep["change_N"], half_width), 0.0)
    return [f"{words} It was measured at one load that stayed on, after it was hung from none."]


def _cell_tables(content: Content) -> list[Table]:
    result, unit = content["result"], content["settings"]["cell"]["signal_unit"]
    title, header = f"Force on the pin = K (signal - zero); N per {unit}", ("", "value", "u", "U")
    fit = Table(title, tuple(_elements(result)), header)
    names = tuple(name for name, *_ in fit.rows)
    spread = np.sqrt(np.diag(np.array(result["matrix_covariance"])))
    alike = np.array(result["matrix_covariance"]) / np.outer(spread, spread)
    correlation = tuple(tuple(f"{value:.3f}" for value in row) for row in alike)
    return [
        fit,
        *_quadratic(result, unit),
        _zero(result, unit),
        Table(
            f"Correlation of {', '.join(names)}: covariance is correlation times u times u",
            correlation,
            names,
        ),
        Table(
            "Characteristics, per cent",
            tuple(rows_of(TRAITS, result["characteristics_percent"], "not measured")),
        ),
    ]


def _elements(result: Content) -> Iterator[Row]:
    """Yield the elements of the matrix with u and U, rounded by U."""
    keys = ("", "_standard_uncertainty", "_expanded_uncertainty")
    matrices = [result.get(f"matrix{key}_N_per_unit") for key in keys]
    for row, column in np.ndindex(2, 2):
        values = [None if value is None else value[row][column] for value in matrices]
        of_all = values[2] or 0.0
        shown = (
            UNSTATED if value is None else by_uncertainty(value, of_all, index == 1)
            for index, value in enumerate(values)
        )
        yield (f"K{row + 1}{column + 1}", *shown)


def _zero(result: Content, unit: str) -> Table:
    stated = result.get("zero_expanded_uncertainty") or (0.0, 0.0)
    zeros = (
        (
            f"Zero of signal {axis}",
            f"{by_uncertainty(value, spread)} {unit}, U ="
            f" {by_uncertainty(spread, spread) if spread else UNSTATED}",
        )
        for axis, value, spread in zip((1, 2), result["zero"], stated, strict=True)
    )
    of_zero, weight = result.get("zero_expanded_uncertainty_N"), result.get("pin_weight_N")
    rows = (
        *zeros,
        (
            "Uncertainty of the zero",
            f"U = {by_uncertainty(of_zero, of_zero)} N" if of_zero else UNSTATED,
        ),
        *([] if weight is None else [_pin_weight(result)]),
        ("Model", result["terms"]),
        ("Residual standard deviation", f"{result['residual_std_N']:.2g} N"),
    )
    return Table("Zero and residuals", rows)


def _pin_weight(result: Content) -> Row:
    expanded = result["pin_weight_expanded_uncertainty_N"]
    value = by_uncertainty(result["pin_weight_N"], expanded)
    name = "Weight that turns with the pin, taken out of the indications"
    return name, f"{value} N, U = {by_uncertainty(expanded, expanded)} N"


def _quadratic(result: Content, unit: str) -> list[Table]:
    quadratic = result.get("quadratic_unit_per_N2")
    if quadratic is None:
        return []
    # One power of ten for all: different exponents are hard to compare by eye.
    largest = max(abs(value) for row in quadratic for value in row)
    power = math.floor(math.log10(largest)) if largest > 0.0 else 0
    rows: list[Row] = [
        (f"signal {axis}", *(f"{value / 10.0**power:.4f}" for value in row))
        for axis, row in enumerate(quadratic, 1)
    ]
    shown = f"10{str(power).translate(RAISED)} {unit} per N²"
    title = f"Quadratic terms: signal - zero = inverse(K) f + Q (f1², f1 f2, f2²); {shown}"
    return [Table(title, tuple(rows), ("", "f1²", "f1 f2", "f2²"))]


def _readings_table(taken: LoadCellReadings, result: Content) -> Table:
    expanded = result["expanded_uncertainty_N"]
    cell_rows = [
        (name, str(step), f"{mass:g}", f"{math.degrees(angle):.3f}", f"{s_1:.6f}", f"{s_2:.6f}",
         *(by_uncertainty(residual, expanded, 1) for residual in off))
        for name, step, mass, angle, (s_1, s_2), off in zip(
            taken.series, taken.step, taken.mass, taken.angle, taken.signal, result["residual_N"],
            strict=True,
        )
    ]  # fmt: skip
    header = ("series", "step", "kg", "angle °", "signal 1", "signal 2", "res. 1 N", "res. 2 N")
    return Table("Readings as taken, residuals of the fit", tuple(cell_rows), header)


def _hung_table(taken: LoadCellReadings) -> list[Table]:
    hung = taken.hung
    if hung is None:
        return []
    items = (
        {"mass": mass, "time": time, "angle": math.degrees(angle), "signals": signals}
        for mass, time, angle, signals in zip(
            hung.mass, hung.time, hung.angle, hung.signal, strict=True
        )
    )
    return [table("Readings of the creep, which are not in the fit", HUNG, items)]


def _cell_figures(taken: LoadCellReadings, result: Content) -> list[Figure]:
    residual = np.array(result["residual_N"])
    load = np.hypot(*np.array(result["applied_N"]).T)
    angle = np.mod(np.degrees(taken.angle), 360.0)
    labels = ("residual (N)", ("signal 1", "signal 2"))
    return [
        plot("Residual against force", "applied force (N)", load, residual, *labels),
        plot("Residual against pin angle", "pin angle (°)", angle, residual, *labels),
    ]
