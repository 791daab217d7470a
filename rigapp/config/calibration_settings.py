"""The settings file of a calibration: its text form, with units in the keys."""

from __future__ import annotations

import datetime
import math
from typing import Annotated, Literal

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.numbers import TURN_DEG, within
from rigapp_calibration.load_cell.settings import CellSettings, LoadCellSettings, Use
from rigapp_calibration.load_cell.weights import Place, WeightSet, normal_gravity
from rigapp_calibration.probes.readings import ProbeSettings

WEIGHTS_UNCERTAINTY = 5e-5
"""Relative standard uncertainty of weights without a stated one: class M1 (OIML R 111)."""
LATITUDE_GRAVITY_UNCERTAINTY = 5e-5
STATED_GRAVITY_UNCERTAINTY = 1e-5
"""Relative standard uncertainty of gravity by latitude and height, and of a stated one."""
WITH_THE_READINGS = within(-math.inf, math.inf)
"""Any number: ``rigapp_calibration.load_cell.settings`` checks it together with the readings."""


class CellSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[cell]: the load cell."""

    name: str
    full_scale_N: Annotated[float, within(1.0, 1e6)] = 400.0
    resolution_N: Annotated[float, within(1e-6, 1000.0)] = 2.0
    signal_unit: str = "mV/V"
    serial_number: str = ""
    rated_output_mV_per_V: Annotated[float | None, within(0.01, 100.0)] = None
    rated_output_tolerance_percent: Annotated[float, within(0.0, 50.0)] = 1.0
    decision_rule: Literal["guard band", "simple acceptance"] = "guard band"


class WeightPiece(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[weights.piece]]: one weight and its certificate; the uncertainty is expanded, k = 2."""

    name: str
    mass_kg: Annotated[float, within(1e-6, 2000.0)]
    certificate: str
    due: datetime.date
    expanded_uncertainty_g: Annotated[float, within(1e-6, 1000.0)]


class WeightsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[weights]: how their mass is stated, density, uncertainty, hanger, and every piece."""

    mass_kind: Literal["conventional", "true"] = "conventional"
    density_kg_per_m3: Annotated[float, WITH_THE_READINGS] = 8000.0
    density_standard_uncertainty_kg_per_m3: Annotated[float, within(0.0, 3000.0)] = 100.0
    relative_standard_uncertainty: Annotated[float | None, within(0.0, 0.01)] = None
    hanger_mass_kg: Annotated[float, within(0.0, 1000.0)] = 0.0
    hanger_at_zero_kg: Annotated[float, within(0.0, 100.0)] = 0.0
    piece: tuple[WeightPiece, ...] = ()

    @property
    def relative_uncertainty(self) -> float:
        """Return the relative standard uncertainty of any load.

        The errors of all pieces may be correlated (one laboratory compared them with one standard),
        so that the uncertainty of a load is that of its worst piece.
        """
        if self.relative_standard_uncertainty is not None:
            return self.relative_standard_uncertainty
        of_pieces = (piece.expanded_uncertainty_g / 2000.0 / piece.mass_kg for piece in self.piece)
        return max(of_pieces, default=WEIGHTS_UNCERTAINTY)


class SurroundingsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """[place] of a calibration without weights: the air, for the certificate; at_end: after it."""

    temperature_degC: Annotated[float | None, within(-40.0, 60.0)] = None
    humidity_percent: Annotated[float | None, within(0.0, 100.0)] = None
    pressure_hPa: Annotated[float | None, within(400.0, 1100.0)] = None
    temperature_at_end_degC: Annotated[float | None, within(-40.0, 60.0)] = None
    humidity_at_end_percent: Annotated[float | None, within(0.0, 100.0)] = None
    pressure_at_end_hPa: Annotated[float | None, within(400.0, 1100.0)] = None


class PlaceSection(SurroundingsSection, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """[place]: gravity, or latitude and height; the air."""

    gravity_m_s2: Annotated[float | None, WITH_THE_READINGS] = None
    latitude_deg: Annotated[float | None, within(-90.0, 90.0)] = None
    height_m: Annotated[float, within(-500.0, 9000.0)] = 0.0
    gravity_relative_standard_uncertainty: Annotated[float | None, within(0.0, 0.01)] = None
    air_density_kg_per_m3: Annotated[float, WITH_THE_READINGS] = 1.2
    air_density_standard_uncertainty_kg_per_m3: Annotated[float, within(0.0, 0.5)] = 0.05


class AngleSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[angle]: the result of the angle reference step."""

    offset_deg: Annotated[float | None, TURN_DEG] = None
    standard_uncertainty_deg: Annotated[float, within(0.0, 10.0)] = 0.05
    setting_standard_uncertainty_deg: Annotated[float, within(0.0, 10.0)] = 0.02
    level_readings_deg: Annotated[tuple[float, ...], within(-1e6, 1e6)] = ()


class UseSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[use]: changes from the calibration to a test, each at most so much; part of U.

    The defaults are those of a good strain-gauge cell in a room without air conditioning; 0 omits a
    part. cross_terms, bend, loop: effects that a calibration does not show.
    """

    temperature_difference_K: Annotated[float, within(0.0, 100.0)] = 5.0
    gain_percent_per_K: Annotated[float, within(0.0, 1.0)] = 0.01
    zero_percent_of_full_scale_per_K: Annotated[float, within(0.0, 1.0)] = 0.01
    creep_percent: Annotated[float, within(0.0, 5.0)] = 0.05
    gain_change_percent_per_year: Annotated[float, within(0.0, 10.0)] = 0.1
    load_introduction_percent: Annotated[float, within(0.0, 10.0)] = 0.0
    angle_deg: Annotated[float, within(0.0, 10.0)] = 0.0
    largest_force_N: Annotated[float | None, within(0.1, 1e6)] = None
    dead_zone_percent: Annotated[float, within(0.0, 5.0)] = 0.0
    zero_before_test: bool = False
    cross_terms_percent: Annotated[float, within(0.0, 10.0)] = 1.25
    bend_percent: Annotated[float, within(0.0, 10.0)] = 0.5
    loop_percent: Annotated[float, within(0.0, 10.0)] = 0.5


class PaperworkSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[paperwork]: the texts of the certificate beside the numbers.

    All optional. condition_as_received: ISO/IEC 17025, 7.8.2.1 g.
    """

    laboratory: str = ""
    address: str = ""
    place: str = ""
    customer: str = ""
    calibrated_on: datetime.date | None = None
    operator: str = ""
    reviewer: str = ""
    serial_number: str = ""
    condition_as_received: str = ""
    amplifier: str = ""
    cable: str = ""
    excitation: str = ""
    standards: str = ""
    notes: str = ""
    valid_days: Annotated[int, within(1, 36_500)] = 365


class Standard(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[standard]]: a standard beside the weights: a level, micrometer, thermometer."""

    name: str
    certificate: str
    due: datetime.date | None = None
    uncertainty: str = ""


class CalibrationFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The common part of every settings file of a calibration."""

    schema: int
    paperwork: PaperworkSection = PaperworkSection()
    standard: tuple[Standard, ...] = ()


class LoadCellFile(CalibrationFile, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A settings file for ``rigapp calibrate load-cell``."""

    cell: CellSection
    weights: WeightsSection = WeightsSection()
    place: PlaceSection = PlaceSection()
    angle: AngleSection = AngleSection()
    use: UseSection = UseSection()


class ProbeSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[probe]: the probe, its micrometer and, for a cylindrical target, the geometry."""

    name: str
    range_V: Annotated[float, within(0.001, 1000.0)] = 10.0
    resolution_V: Annotated[float, within(0.0, 100.0)] = 0.0
    micrometer_standard_uncertainty_um: Annotated[float, within(0.0, 1000.0)] = 0.5
    target_radius_mm: Annotated[float | None, within(0.1, 10_000.0)] = None
    sensor_radius_mm: Annotated[float | None, within(0.01, 1000.0)] = None
    gap_at_zero_um: Annotated[float | None, within(0.1, 100_000.0)] = None
    nominal_sensitivity_um_per_V: Annotated[float | None, within(0.0, 1e5, size=True)] = None
    off_axis_um: Annotated[float, within(0.0, 100_000.0)] = 0.0
    alignment_standard_uncertainty_deg: Annotated[float, within(0.0, 45.0)] = 0.2


class ProbeFile(CalibrationFile, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A settings file for ``rigapp calibrate probes``."""

    probe: ProbeSection = ProbeSection(name="probe")
    place: SurroundingsSection = SurroundingsSection()


class ScalarSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[channel]: a free channel, compared with a reference in the channel's unit."""

    name: str
    unit: str
    reference_standard_uncertainty: Annotated[float, within(0.0, 1e9)]
    method: Literal["line", "table"] = "line"
    resolution_V: Annotated[float, within(0.0, 100.0)] = 0.0


class ChannelFile(CalibrationFile, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A settings file for ``rigapp calibrate channel``."""

    channel: ScalarSection
    place: SurroundingsSection = SurroundingsSection()


class RunOutPinSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[pin]: whose run-out is mapped."""

    name: str = "pin"


class RunOutFile(CalibrationFile, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A settings file for ``rigapp calibrate run-out``."""

    pin: RunOutPinSection = RunOutPinSection()
    place: SurroundingsSection = SurroundingsSection()


def load_cell_meaning(file: LoadCellFile, where: str) -> LoadCellSettings:
    """Return the settings in SI units; raises UnusableInput naming their source ``where``."""
    place = file.place
    expected = None
    if place.latitude_deg is not None:
        expected = normal_gravity(math.radians(place.latitude_deg), place.height_m)
    gravity = place.gravity_m_s2 if place.gravity_m_s2 is not None else expected
    if gravity is None:
        raise UnusableInput(
            "{}: place.gravity_m_s2 is missing; write the local gravity, or"
            " latitude_deg and height_m.",
            where,
        )
    relative = place.gravity_relative_standard_uncertainty
    if relative is None:
        stated = place.gravity_m_s2 is not None
        relative = STATED_GRAVITY_UNCERTAINTY if stated else LATITUDE_GRAVITY_UNCERTAINTY
    weights = file.weights
    return LoadCellSettings(
        cell=CellSettings(
            file.cell.name,
            file.cell.full_scale_N,
            file.cell.resolution_N,
            file.cell.signal_unit,
            file.cell.rated_output_mV_per_V,
            0.01 * file.cell.rated_output_tolerance_percent,
            file.cell.decision_rule == "guard band",
        ),
        weights=WeightSet(
            weights.mass_kind,
            weights.density_kg_per_m3,
            weights.density_standard_uncertainty_kg_per_m3,
            weights.relative_uncertainty,
            weights.hanger_mass_kg,
            weights.hanger_at_zero_kg,
        ),
        place=Place(
            gravity,
            relative * gravity,
            place.air_density_kg_per_m3,
            place.air_density_standard_uncertainty_kg_per_m3,
        ),
        angle_offset=math.radians(file.angle.offset_deg or 0.0),
        angle_uncertainty=math.radians(file.angle.standard_uncertainty_deg),
        angle_stated=file.angle.offset_deg is not None,
        gravity_stated=place.gravity_m_s2 is not None,
        gravity_expected=expected,
        use=_use(file.use, file.paperwork.valid_days),
    )


def _use(use: UseSection, valid_days: int) -> Use:
    """Return the changes until the record expires, as fractions instead of per cent."""
    return Use(
        temperature=use.temperature_difference_K,
        gain_per_kelvin=0.01 * use.gain_percent_per_K,
        zero_per_kelvin=0.01 * use.zero_percent_of_full_scale_per_K,
        creep=0.01 * use.creep_percent,
        change=0.01 * use.gain_change_percent_per_year * valid_days / 365.0,
        introduction=0.01 * use.load_introduction_percent,
        angle=math.radians(use.angle_deg),
        largest=use.largest_force_N,
        dead_zone=0.01 * use.dead_zone_percent,
        zeroed=use.zero_before_test,
        cross_terms=0.01 * use.cross_terms_percent,
        nonlinearity=0.01 * use.bend_percent,
        loop=0.01 * use.loop_percent,
    )


def probe_meaning(file: ProbeFile) -> ProbeSettings:
    """Return the settings of a probe in SI units."""
    probe = file.probe
    return ProbeSettings(
        name=probe.name,
        range_volts=probe.range_V,
        micrometer_uncertainty=1e-6 * probe.micrometer_standard_uncertainty_um,
        resolution_volts=probe.resolution_V,
        target_radius=_scaled(probe.target_radius_mm, 1e-3),
        sensor_radius=_scaled(probe.sensor_radius_mm, 1e-3),
        gap_at_zero=_scaled(probe.gap_at_zero_um, 1e-6),
        nominal=_scaled(probe.nominal_sensitivity_um_per_V or None, 1e-6),
        off_axis=1e-6 * probe.off_axis_um,
        direction=math.radians(probe.alignment_standard_uncertainty_deg),
    )


def _scaled(value: float | None, unit: float) -> float | None:
    return None if value is None else unit * value
