"""How often U of a position holds the truth of a probe that the evaluation was not written for.

Readings of ``independent_probe`` go the way of every user: a table and settings in, a result out.
One behaviour a row, then all together; a position in use lies within U in 93 to 99 of 100, one
reading of it as well as the mean of 25.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rigapp_calibration.probes.calibrate import calibrate_probe
from rigapp_calibration.probes.readings import ProbeReadings, ProbeSettings
from tests.calibration.independent_probe import Nature, Probe, Table, take, use

UM = 1e6
MEAN_OF = 25


@dataclass(frozen=True)
class Row:
    """One line of the table: the probe, and how its calibration is taken."""

    name: str
    nature: Nature
    positions: int = 11
    runs: int = 3


PLAIN = Nature()
ALL = Nature(bend=0.004, third=0.003, loop=0.001, drift=0.001)
ROWS = (
    Row("nothing beside noise", PLAIN),
    Row("a good micrometer", replace(PLAIN, screw=0.05)),
    Row("a noisy probe", replace(PLAIN, screw=0.1, noise=2.0)),
    Row("bend 0.4 %", replace(PLAIN, bend=0.004)),
    Row("third order 0.4 %", replace(PLAIN, third=0.004)),
    Row("bend and third order 1 %", replace(PLAIN, bend=0.01, third=0.01)),
    Row("hysteresis 0.2 %", replace(PLAIN, loop=0.002)),
    Row("drift 0.2 %", replace(PLAIN, drift=0.002)),
    Row("a coarse display", replace(PLAIN, display=0.02)),
    Row("all together", ALL),
    Row("all together, up and down once", ALL, runs=1),
    Row("all together, 21 positions", ALL, positions=21),
    Row("all together, 80 um", replace(ALL, reach=80.0, sensitivity=10.0, screw=0.1, noise=0.02)),
)


def settings_of(nature: Nature) -> ProbeSettings:
    """Return what a technician writes about a probe and the micrometer."""
    return ProbeSettings(
        "probe", 10.0, nature.screw / UM, resolution_volts=nature.display,
    )  # fmt: skip


def readings_of(table: Table) -> ProbeReadings:
    """Return a table as the program reads it."""
    series, step, position, signal = zip(*table, strict=True)
    return ProbeReadings(tuple(series), np.array(step), np.array(position) / UM, np.array(signal))


def held(row: Row, rng: np.random.Generator) -> dict[str, bool]:
    """Return what of one calibration and one position after it lay within U."""
    probe = Probe(row.nature, rng)
    found = calibrate_probe(
        readings_of(take(probe, row.positions, row.runs)), settings_of(row.nature)
    )
    result = {"refused": not found.accepted}
    if found.budget is None or found.sensitivity is None or found.offset is None:
        return result
    used = use(probe, MEAN_OF)
    for words, volts, count in (("one", used.one, 1), (f"mean of {MEAN_OF}", used.many, MEAN_OF)):
        error = found.sensitivity * (volts - found.offset) - used.position / UM
        result[words] = abs(error) <= found.budget.of_mean(count).expanded
    return result


def coverage(row: Row, sets: int, seed: int) -> dict[str, float]:
    """Return by name the part of the sets that lay within U, and the part that was refused."""
    total: dict[str, list[bool]] = {}
    for number in range(sets):
        for name, inside in held(row, np.random.default_rng((seed, number))).items():
            total.setdefault(name, []).append(inside)
    return {name: float(np.mean(one)) for name, one in total.items()}
