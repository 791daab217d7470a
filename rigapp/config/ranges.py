"""The one table of what a number may be, for recipe, live change, window, check and settings.

A key is the dotted path of a number in its file; the unit is the one that the key names. Every
number must be finite; one that is nowhere in the table must be no more than that.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import msgspec

UNITS: Final = (
    ("_um_per_1000_revolutions", "um per 1000 revolutions"),
    ("_mV_per_V_per_N2", "mV/V per N^2"),
    ("_N_per_mV_per_V", "N per mV/V"),
    ("_mm3_per_Nm", "mm^3/(N m)"),
    ("_N_per_hour", "N/h"),
    ("_kg_per_m3", "kg/m^3"),
    ("_g_per_cm3", "g/cm^3"),
    ("_rpm_per_s", "rpm/s"),
    ("_um_per_V", "um/V"),
    ("_mV_per_V", "mV/V"),
    ("_N_per_m", "N/m"),
    ("_kg_m2", "kg m^2"),
    ("_m_s2", "m/s^2"),
    ("_percent", "%"),
    ("_revolutions", "revolutions"),
    ("_degC", "degC"),
    ("_days", "days"),
    ("_MPa", "MPa"),
    ("_hPa", "hPa"),
    ("_rpm", "rpm"),
    ("_deg", "deg"),
    ("_Nm", "N m"),
    ("_Hz", "Hz"),
    ("_kg", "kg"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_ms", "ms"),
    ("_h", "h"),
    ("_A", "A"),
    ("_C", "degC"),
    ("_N", "N"),
    ("_V", "V"),
    ("_m", "m"),
    ("_s", "s"),
)
"""Ending of a key -> its unit; the longer ending comes first."""

UNITS_OF: Final = {
    "run.revolutions": "revolutions",
    "cycles.before_alarm": "revolutions",
    "cycles.after_alarm": "revolutions",
}
"""Units of keys that do not name theirs."""

MISTAKEN: Final[Mapping[str, tuple[tuple[str, float, float], ...]]] = {
    "mm": (("m", 1e3, 0.0), ("um", 1e-3, 0.0)),
    "um": (("mm", 1e3, 0.0), ("m", 1e6, 0.0)),
    "m": (("km", 1e3, 0.0),),
    "kg": (("g", 1e-3, 0.0),),
    "kg m^2": (("kg mm^2", 1e-6, 0.0), ("g mm^2", 1e-9, 0.0)),
    "g/cm^3": (("kg/m^3", 1e-3, 0.0),),
    "kg/m^3": (("g/cm^3", 1e3, 0.0), ("g/m^3", 1e-3, 0.0)),
    "m/s^2": (("cm/s^2 (Gal)", 1e-2, 0.0), ("mm/s^2", 1e-3, 0.0)),
    "MPa": (("GPa", 1e3, 0.0), ("Pa", 1e-6, 0.0)),
    "mm^3/(N m)": (("m^2/N", 1e9, 0.0),),
    "hPa": (("kPa", 10.0, 0.0), ("Pa", 1e-2, 0.0)),
    "degC": (("K", 1.0, -273.15),),
    "N": (("kN", 1e3, 0.0), ("mN", 1e-3, 0.0)),
    "N/m": (("N/mm", 1e3, 0.0),),
    "s": (("ms", 1e-3, 0.0),),
    "ms": (("s", 1e3, 0.0), ("us", 1e-3, 0.0)),
    "rpm": (("revolutions/s", 60.0, 0.0), ("revolutions/h", 1.0 / 60.0, 0.0)),
    "mV/V": (("V/V", 1e3, 0.0), ("uV/V", 1e-3, 0.0)),
    "um/V": (("mm/V", 1e3, 0.0), ("m/V", 1e6, 0.0)),
    "%": (("a share of 1", 100.0, 0.0),),
}
"""Unit of a key -> units that are typed by mistake: name, factor and offset to the key's unit."""


@dataclass(frozen=True, slots=True)
class Range:
    """What a number may be, both ends included.

    size: its size is judged, the sign is free. whole: of things that are counted.
    """

    low: float
    high: float
    size: bool = False
    whole: bool = False

    def holds(self, value: float) -> bool:
        """Tell whether a finite number lies within."""
        return self.low <= (abs(value) if self.size else value) <= self.high

    def words(self, unit: str) -> str:
        """Return the range as a sentence says it."""
        sign = ", of either sign" if self.size else ""
        return f"{self.low:.9g} to {self.high:.9g} {unit}".rstrip() + sign


COUNT: Final = 100_000_000
ANY: Final = Range(-math.inf, math.inf)
FACTOR: Final = Range(0.01, 100.0)
TURN: Final = Range(-360.0, 360.0)
FORCE_N: Final = Range(1.0, 10_000.0)
DEPTH_UM: Final = Range(0.1, 20_000.0)
MASS_KG: Final = Range(0.0, 1000.0)
INERTIA_KG_M2: Final = Range(0.0, 10.0)
LATENCY_MS: Final = Range(0.0, 1000.0)
MODULUS_MPA: Final = Range(0.1, 2e6)
POISSON: Final = Range(0.0, 0.499)

TEST: Final = {
    "run.revolutions": Range(1, COUNT, whole=True),
    "run.speed_rpm": Range(0.1, 3000.0),
    "run.acceleration_rpm_per_s": Range(0.1, 10_000.0),
    "run.pause_angle_deg": Range(0.0, 359.999),
    "cycles.every_revolutions": Range(1, 1_000_000, whole=True),
    "cycles.per_decade": Range(1, 1000, whole=True),
    "cycles.before_alarm": Range(0, 1000, whole=True),
    "cycles.after_alarm": Range(0, 1000, whole=True),
    "limits.overload_N": FORCE_N,
    "limits.overspeed_rpm": Range(0.1, 5000.0),
    "limits.stale_data_s": Range(0.05, 60.0),
    "limits.rule.hysteresis": Range(0.0, 1e9),
    "limits.rule.delay_revolutions": Range(1, 1_000_000, whole=True),
    "limits.rule.warning_above": ANY,
    "limits.rule.critical_above": ANY,
    "limits.rule.warning_below": ANY,
    "limits.rule.critical_below": ANY,
    "stop.elapsed_time_h": Range(0.001, 100_000.0),
    "stop.running_time_h": Range(0.001, 100_000.0),
    "stop.wear_depth_um": DEPTH_UM,
    "stop.wear_depth_revolutions": Range(1, 1_000_000, whole=True),
    "stop.force_N": FORCE_N,
    "stop.force_revolutions": Range(1, 1_000_000, whole=True),
    "stop.wear_rate_um_per_1000_revolutions": Range(0.001, 10_000.0),
    "stop.wear_rate_window_revolutions": Range(20, 1_000_000, whole=True),
    "stop.deviation_N": Range(0.1, 10_000.0),
    "stop.deviation_percent": Range(0.1, 1000.0),
    "stop.deviation_revolutions": Range(1, 1_000_000, whole=True),
    "stop.hold_off_revolutions": Range(0, COUNT, whole=True),
}
"""A test file, less its [model]."""

MODEL: Final = {
    "mechanism.crank_radius_mm": Range(1.0, 1000.0),
    "mechanism.crank_mass_kg": MASS_KG,
    "mechanism.crank_inertia_kg_m2": INERTIA_KG_M2,
    "mechanism.follower_length_mm": Range(1.0, 5000.0),
    "mechanism.follower_mass_kg": MASS_KG,
    "mechanism.follower_inertia_kg_m2": INERTIA_KG_M2,
    "mechanism.slider_mass_kg": MASS_KG,
    "mechanism.added_mass_kg": MASS_KG,
    "mechanism.gravity_m_s2": Range(-20.0, 20.0),
    "spring.stiffness_N_per_m": Range(0.0, 1e6),
    "spring.free_position_mm": Range(-10_000.0, 10_000.0),
    "joint.pin_radius_mm": Range(0.5, 500.0),
    "joint.bushing_radius_mm": Range(0.5, 500.0),
    "joint.bushing_outer_radius_mm": Range(1.0, 1000.0),
    "joint.bushing_width_mm": Range(0.5, 1000.0),
    "joint.friction_coefficient": Range(0.0, 2.0),
    "bushing.youngs_modulus_MPa": MODULUS_MPA,
    "bushing.poissons_ratio": POISSON,
    "bushing.density_g_per_cm3": Range(0.01, 25.0),
    "bushing.wear_coefficient_mm3_per_Nm": Range(0.0, 1.0),
    "pin.youngs_modulus_MPa": MODULUS_MPA,
    "pin.poissons_ratio": POISSON,
}
"""A parameter file, and the [model] of a test."""

RIG: Final = {
    "simulation.seed": Range(0, 2**63 - 1, whole=True),
    "simulation.speed": Range(0.001, 10_000.0),
    "simulation.plant.slider_mass_factor": FACTOR,
    "simulation.plant.spring_stiffness_factor": FACTOR,
    "simulation.plant.joint_friction_coefficient": Range(0.0, 2.0),
    "simulation.plant.wear_coefficient_factor": Range(0.0, 1e6),
    "simulation.plant.motor_torque_limit_Nm": Range(0.01, 10_000.0),
    "simulation.plant.speed_ripple_percent": Range(0.0, 50.0),
    "simulation.plant.cross_talk_percent": Range(0.0, 100.0),
    "simulation.plant.force_noise_N": Range(0.0, 1000.0),
    "simulation.plant.force_resolution_N": Range(0.0, 1000.0),
    "simulation.plant.force_drift_N_per_hour": Range(-10_000.0, 10_000.0),
    "simulation.plant.pin_run_out_um": Range(0.0, 1000.0),
    "simulation.plant.probe_noise_um": Range(0.0, 1000.0),
    "simulation.plant.filter_delay_ms": LATENCY_MS,
    "simulation.plant.outboard_mass_factor": Range(0.0, 100.0),
    "simulation.plant.probe_misalignment_deg": TURN,
    "simulation.plant.probe_sensitivity_error_percent": Range(-99.0, 1000.0),
    "spindle.encoder_counts_per_revolution": Range(1, COUNT, whole=True),
    "spindle.maximum_speed_rpm": Range(0.1, 5000.0),
    "spindle.watchdog_timeout_s": Range(0.05, 25.5),
    "spindle.gear_ratio": Range(0.01, 1000.0),
    "encoder.counts_per_revolution": Range(1, COUNT, whole=True),
    "encoder.index_angle_deg": TURN,
    "load_cell.matrix_N_per_mV_per_V": Range(-1e6, 1e6),
    "load_cell.zero_mV_per_V": Range(-1000.0, 1000.0),
    "load_cell.quadratic_mV_per_V_per_N2": Range(-1.0, 1.0),
    "load_cell.range_mV_per_V": Range(0.01, 1000.0),
    "load_cell.full_scale_N": FORCE_N,
    "load_cell.resolution_N": Range(1e-6, 1000.0),
    "load_cell.latency_ms": LATENCY_MS,
    "load_cell.uncertainty_N": Range(0.0, 10_000.0),
    "load_cell.outboard_mass_kg": Range(0.0, 100.0),
    "load_cell.outboard_radius_mm": Range(0.1, 1000.0),
    "probes.sensitivity_um_per_V": Range(1e-3, 1e5, size=True),
    "probes.offset_V": Range(-1000.0, 1000.0),
    "probes.range_V": Range(0.001, 1000.0),
    "probes.latency_ms": LATENCY_MS,
    "probes.uncertainty_um": Range(0.0, 10_000.0),
    "probes.alignment": Range(-100.0, 100.0),
    "probes.run_out_cos_um": Range(-1000.0, 1000.0),
    "probes.run_out_sin_um": Range(-1000.0, 1000.0),
    "channels.*.scale": Range(1e-9, 1e9, size=True),
    "channels.*.offset_V": Range(-1000.0, 1000.0),
    "channels.*.table": Range(-1e9, 1e9),
    "channels.*.range_V": Range(0.001, 1000.0),
    "channels.*.latency_ms": LATENCY_MS,
}
"""A rig file, ``*`` for a name of its own; ``devices.NAME.settings`` are judged by the driver's own
table."""

CALIBRATION: Final = {
    "cell.full_scale_N": Range(1.0, 1e6),
    "cell.resolution_N": Range(1e-6, 1000.0),
    "weights.density_kg_per_m3": Range(1e-3, 1e6),
    "weights.density_standard_uncertainty_kg_per_m3": Range(0.0, 3000.0),
    "weights.relative_standard_uncertainty": Range(0.0, 0.01),
    "weights.hanger_mass_kg": Range(0.0, 100.0),
    "place.gravity_m_s2": Range(1e-3, 1e6),
    "place.gravity_relative_standard_uncertainty": Range(0.0, 0.01),
    "place.latitude_deg": Range(-90.0, 90.0),
    "place.height_m": Range(-500.0, 9000.0),
    "place.air_density_kg_per_m3": Range(0.0, 1e4),
    "place.air_density_standard_uncertainty_kg_per_m3": Range(0.0, 0.5),
    "place.temperature_degC": Range(-40.0, 60.0),
    "place.humidity_percent": Range(0.0, 100.0),
    "place.pressure_hPa": Range(400.0, 1100.0),
    "angle.offset_deg": TURN,
    "angle.standard_uncertainty_deg": Range(0.0, 10.0),
    "angle.setting_standard_uncertainty_deg": Range(0.0, 10.0),
    "angle.level_readings_deg": Range(-1e6, 1e6),
    "paperwork.valid_days": Range(1, 36_500, whole=True),
    "probe.range_V": Range(0.001, 1000.0),
    "probe.resolution_V": Range(0.0, 100.0),
    "probe.micrometer_standard_uncertainty_um": Range(0.0, 1000.0),
    "probe.target_radius_mm": Range(0.1, 10_000.0),
    "probe.sensor_radius_mm": Range(0.01, 1000.0),
    "probe.gap_at_zero_um": Range(0.1, 100_000.0),
    "probe.nominal_sensitivity_um_per_V": Range(0.0, 1e5, size=True),
    "probe.off_axis_um": Range(0.0, 100_000.0),
    "probe.alignment_standard_uncertainty_deg": Range(0.0, 45.0),
}
"""Settings files of calibrations; what is plausible for weights and air is judged with the readings
(``calibration.load_cell.plausible``)."""

RANGES: Final[Mapping[str, Range]] = {
    **TEST,
    **MODEL,
    **{f"model.{key}": one for key, one in MODEL.items()},
    **RIG,
    **CALIBRATION,
}

LEVELS: Final[Mapping[str, Range]] = {
    "N": Range(-10_000.0, 10_000.0),
    "um": Range(-20_000.0, 20_000.0),
    "mm": Range(-20.0, 20.0),
    "rpm": Range(0.0, 5000.0),
    "deg": Range(-360.0, 360.0),
}
"""Unit of a quantity -> what a level of a rule on it may be."""

OTHER_LEVEL: Final = Range(-1e9, 1e9)
"""What a level may be on a quantity of any other unit."""


def unit_of(key: str) -> str:
    """Return the unit that a key names, empty when none."""
    known = next((unit for ending, unit in UNITS if key.endswith(ending)), "")
    return UNITS_OF.get(key, known)


def refusal(key: str, value: Any, allowed: Range | None = None, unit: str | None = None) -> str:
    """Return what is wrong with the value of a key, without a full stop; empty when it is right.

    allowed, unit: in place of the table's. The unit that was likely meant is named.
    """
    allowed = RANGES.get(key, ANY) if allowed is None else allowed
    unit = unit_of(key) if unit is None else unit
    bounded = allowed is not ANY
    range_words = f"; allowed is {allowed.words(unit)}" if bounded else ""
    if isinstance(value, bool) or not isinstance(value, int | float):
        shown = str(value).lower() if isinstance(value, bool) else repr(value)
        return f"{key} = {shown} is not a number{range_words}"
    if isinstance(value, float) and not math.isfinite(value):
        return f"{key} = {value} is not a finite number{range_words}"
    if allowed.whole and not isinstance(value, int):
        return f"{key} = {value} is not a whole number{range_words}"
    if allowed.holds(value):
        return ""
    return f"{key} = {_shown(value)} is outside {allowed.words(unit)}{_meant(value, allowed, unit)}"


def refusals(record: msgspec.Struct, prefix: str = "") -> Iterator[str]:
    """Yield what is wrong with the numbers of a record, in the order of the file."""
    for name in record.__struct_fields__:
        yield from _of_value(f"{prefix}{name}", f"{prefix}{name}", getattr(record, name))


def _of_value(key: str, shown: str, value: Any) -> Iterator[str]:
    if isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from _of_value(f"{key}.{name}", f"{shown}.{name}", getattr(value, name))
    elif isinstance(value, dict):
        for name, one in value.items():
            if isinstance(one, msgspec.Struct):
                yield from _of_value(f"{key}.*", f"{shown}.{name}", one)
    elif isinstance(value, tuple):
        for place, one in enumerate(value, 1):
            yield from _of_value(key, f"{shown} {place}", one)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        found = refusal(key, value)
        if found:
            yield shown + found.removeprefix(key)


def _shown(value: float) -> str:
    try:
        return f"{value:.9g}"
    except OverflowError:
        return f"a number of {len(str(abs(value)))} digits"


def _meant(value: float, allowed: Range, unit: str) -> str:
    for other, factor, offset in MISTAKEN.get(unit, ()):
        try:
            meant = value * factor + offset
        except OverflowError:
            continue
        if meant and allowed.holds(meant):
            return f"; did you mean {other}? Then write {meant:.6g}"
    return ""
