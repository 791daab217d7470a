"""How often U holds the truth of a cell that the evaluation was not written for.

Readings of ``time_domain_cell`` go the way of every user: a table and settings in, a result out.
One behaviour of the cell a row, then all together; a force in use lies within U in 93 to 97 of 100.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from rigapp_calibration.load_cell.budget import uncertainty_at
from rigapp_calibration.load_cell.calibrate import LoadCellCalibration, calibrate_load_cell
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import CellSettings, LoadCellSettings, Use
from rigapp_calibration.load_cell.weights import Place, WeightSet
from tests.calibration.time_domain_cell import Course, G, Nature, Table, TimeCell, Used, take, use

FOUR = (0.0, 90.0, 180.0, 270.0)
WEIGHTS = 5e-5
ANGLE = math.radians(0.03)
COURSE, ZEROED = Course(), Use(zeroed=True)
TO_30 = Course(loads=(0.06, 0.12, 0.18, 0.24, 0.3))


@dataclass(frozen=True)
class Row:
    """One line of the table. reach: of full scale, the largest force in use."""

    name: str
    nature: Nature
    course: Course = COURSE
    use: Use = ZEROED
    reach: float = 0.99


PLAIN = Nature()
ALL = Nature(
    loop=0.003, creep=3e-4, warm_zero=1e-3, pin=2e-3, introduction=5e-4, product=2e-3, cubic=1e-3,
    setting_deg=0.05,
)  # fmt: skip
ROWS = (
    Row("nothing beside noise", PLAIN),
    Row("5 N", replace(PLAIN, full_scale=5.0, noise=4e-4)),
    Row("20 kN", replace(PLAIN, full_scale=20e3, noise=1e-4)),
    Row("coarse display", replace(PLAIN, noise=0.0018, display=0.005)),
    Row("pin 0.12 % of full scale", replace(PLAIN, pin=0.0012)),
    Row("pin 5 % of full scale", replace(PLAIN, pin=0.05)),
    Row("hysteresis 0.3 %", replace(PLAIN, loop=0.003)),
    Row("hysteresis, rising loads only", replace(PLAIN, loop=0.003), Course(falling=False)),
    Row("creep 0.1 %", replace(PLAIN, creep=1e-3), use=Use(creep=1e-3, zeroed=True)),
    Row("warm-up of the zero 0.5 %", replace(PLAIN, warm_zero=5e-3)),
    Row("load introduction 0.1 %", replace(PLAIN, introduction=1e-3),
        use=Use(introduction=1e-3, zeroed=True)),
    Row("f1 f2 0.4 %", replace(PLAIN, product=0.008)),
    Row("f1 f2 0.4 %, 4 angles", replace(PLAIN, product=0.008), Course(angles=FOUR)),
    Row("x y^2 0.4 %", replace(PLAIN, cubic=0.008)),
    Row("x^3 0.3 %", replace(PLAIN, bow=0.003)),
    Row("x^3 0.3 %, calibrated to 30 %", replace(PLAIN, bow=0.003), TO_30),
    Row("hysteresis 0.3 %, calibrated to 30 %", replace(PLAIN, loop=0.003), TO_30),
    Row("both, calibrated to 30 %", replace(PLAIN, bow=0.003, loop=0.003), TO_30),
    Row("the same, rising loads only", replace(PLAIN, bow=0.003, loop=0.003),
        replace(TO_30, falling=False)),
    Row("both, calibrated and used to 30 %", replace(PLAIN, bow=0.003, loop=0.003), TO_30,
        use=Use(zeroed=True, largest=120.0), reach=0.3),
    Row("angles set to 0.1 degrees", replace(PLAIN, setting_deg=0.1)),
    Row("dead zone 0.5 %", replace(PLAIN, dead_zone=0.005),
        use=Use(dead_zone=0.005, zeroed=True)),
    Row("all together", ALL, use=Use(creep=3e-4, introduction=5e-4, zeroed=True)),
    Row("all together, 5 N", replace(ALL, full_scale=5.0, noise=5e-4),
        use=Use(creep=3e-4, introduction=5e-4, zeroed=True)),
)  # fmt: skip


def settings_of(row: Row) -> LoadCellSettings:
    """Return what a technician writes about the cell of a row."""
    full = row.nature.full_scale
    return LoadCellSettings(
        cell=CellSettings("cell", full, row.nature.display * full, "mV/V"),
        weights=WeightSet(relative_uncertainty=WEIGHTS),
        place=Place(G, 1e-5 * G),
        angle_uncertainty=ANGLE,
        use=row.use,
    )


def readings_of(table: Table) -> LoadCellReadings:
    """Return a table as the program reads it."""
    series, step, mass, angle, one, two = zip(*table, strict=True)
    return LoadCellReadings(
        tuple(series), np.array(step), np.array(mass), np.radians(angle),
        np.column_stack((one, two)),
    )  # fmt: skip


def calibrated(
    row: Row, rng: np.random.Generator
) -> tuple[TimeCell, LoadCellSettings, LoadCellCalibration]:
    """Draw a cell and what its settings are wrong by, and calibrate it."""
    cell = TimeCell(
        row.nature, rng, scale=1.0 + rng.normal(0.0, WEIGHTS), turned=rng.normal(0.0, ANGLE)
    )
    settings = settings_of(row)
    found = calibrate_load_cell(readings_of(take(cell, row.course)), settings)
    cell.turned = 0.0  # in use the angle is as true as the force's direction
    return cell, settings, found


def errors(found: LoadCellCalibration, used: Used) -> dict[int, np.ndarray]:
    """Return by the number of readings what the force told is wrong by, N, pin frame.

    The pin's own weight is taken out of the zero at its angle and of the force at the other.
    """
    fit = found.fit
    assert fit is not None
    own = getattr(found, "pin_weight", None)
    weight = 0.0 if own is None else own.value

    def turned(angle: float) -> np.ndarray:
        return -weight * np.array([math.sin(angle), math.cos(angle)])

    rest = used.rest - fit.sensitivity @ turned(used.rest_angle)
    return {
        count: fit.force(signal - rest + fit.zero)[0] - turned(used.angle) - used.force
        for count, signal in ((1, used.signal), (25, used.signal_mean))
    }


def held(row: Row, rng: np.random.Generator) -> dict[str, bool]:
    """Return what of one calibration and one force after it lay within U."""
    cell, settings, found = calibrated(row, rng)
    result = {"refused": not found.accepted}
    if found.fit is None:
        return result
    full = row.nature.full_scale
    size = rng.uniform(0.05, row.reach) * full
    used = use(cell, size, row.reach * full)
    stated = uncertainty_at(found.parts, settings, size)
    cosine = abs(used.force[0]) / size
    for count, error in errors(found, used).items():
        words = "one" if count == 1 else f"mean of {count}"
        along, across = (one.of_mean(count).expanded for one in (stated.magnitude, stated.across))
        off = float(np.hypot(*(used.force + error)) - size)
        component = float(np.hypot(along * cosine, across * math.sqrt(1.0 - cosine**2)))
        result[f"|F|, {words}"] = abs(off) <= along
        result[f"component, {words}"] = abs(float(error[0])) <= component
    return result


def coverage(row: Row, sets: int, seed: int) -> dict[str, float]:
    """Return by name the part of the sets that lay within U, and the part that was refused."""
    total: dict[str, list[bool]] = {}
    for number in range(sets):
        for name, inside in held(row, np.random.default_rng((seed, number))).items():
            total.setdefault(name, []).append(inside)
    return {name: float(np.mean(one)) for name, one in total.items()}
