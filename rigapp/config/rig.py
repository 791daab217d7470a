"""The rig file: devices, which of their inputs carries what, and the linear calibration.

What its numbers may be stands in ``rigapp.config.ranges``.
"""

from __future__ import annotations

from typing import Any, Literal

import msgspec

Pair = tuple[float, float]
Triple = tuple[float, float, float]
Matrix = tuple[Pair, Pair]


class PlantSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[simulation.plant]: how the simulated rig differs from the model, each by how much."""

    slider_mass_factor: float = 1.01
    spring_stiffness_factor: float = 0.985
    joint_friction_coefficient: float = 0.05
    wear_coefficient_factor: float = 1.1
    motor_torque_limit_Nm: float = 6.0
    speed_ripple_percent: float = 0.5
    cross_talk_percent: float = 1.5
    force_noise_N: float = 0.7
    force_resolution_N: float = 2.0
    force_drift_N_per_hour: float = 0.2
    pin_run_out_um: float = 3.0
    probe_noise_um: float = 0.2
    filter_delay_ms: float = 1.0
    outboard_mass_factor: float = 1.0
    probe_misalignment_deg: Pair = (0.0, 0.0)
    probe_sensitivity_error_percent: Pair = (0.0, 0.0)


class SimulationSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[simulation]: present only in a simulated rig."""

    seed: int = 1
    speed: float | Literal["max"] = 1.0
    plant: PlantSection = PlantSection()


class DeviceSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[devices.NAME]: driver, port ("simulated", a path or a pyserial URL) and its settings."""

    driver: str
    port: str
    settings: dict[str, Any] = {}


class SpindleSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[spindle]: the drive that turns the crank.

    encoder_counts_per_revolution: of the motor. gear_ratio: turns of the motor for one of the
    crank; every speed in the program is the crank's.
    """

    device: str
    encoder_counts_per_revolution: int
    maximum_speed_rpm: float
    direction: Literal[1, -1] = 1
    watchdog_timeout_s: float = 0.5
    gear_ratio: float = 1.0


class EncoderSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[encoder]: the crank encoder and the counter input that carries it."""

    device: str
    input: str
    counts_per_revolution: int = 3600
    quadrature: Literal["after", "before"] = "after"
    direction: Literal[1, -1] = 1
    restarts_at_index: bool = True
    index_angle_deg: float = 0.0


class LoadCellSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[load_cell]: two bridges in the pin; force on the pin = matrix (signal - zero).

    quadratic_mV_per_V_per_N2: only from a record whose readings justify it; then signal - zero =
    inverse(matrix) f + quadratic (f1^2, f1 f2, f2^2), f the force on the pin.
    uncertainty_N: expanded uncertainty U(F) = first + second F. calibration: a record that takes
    the place of matrix, zero, quadratic and uncertainty; calibration_override: why it is used
    though expired. outboard_mass_kg, outboard_radius_mm: the pin outboard of the gauges and the
    distance of its centre of mass from the crank's axis; force_1 holds - mass radius speed^2 of it.
    """

    device: str
    input_1: str
    input_2: str
    matrix_N_per_mV_per_V: Matrix
    zero_mV_per_V: Pair = (0.0, 0.0)
    quadratic_mV_per_V_per_N2: tuple[Triple, Triple] | None = None
    range_mV_per_V: float = 3.5
    full_scale_N: float = 400.0
    resolution_N: float = 2.0
    latency_ms: Pair = (0.0, 0.0)
    uncertainty_N: Pair | None = None
    outboard_mass_kg: float = 0.0
    outboard_radius_mm: float = 76.2
    calibration: str = ""
    calibration_override: str = ""


class ProbesSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[probes]: two capacitance probes; position = sensitivity (voltage - offset).

    calibration: a record for both probes, or one for each, in the place of these numbers. run_out:
    the record of the pin's run-out map, in the place of the map's numbers (Fourier orders 1 ... of
    the crank angle, for each probe). alignment: position along and across the follower = matrix
    (probe 1, probe 2). uncertainty_um: expanded uncertainty of a position, each probe.
    """

    device: str
    input_1: str
    input_2: str
    sensitivity_um_per_V: Pair
    offset_V: Pair = (0.0, 0.0)
    range_V: float = 10.0
    latency_ms: Pair = (0.0, 0.0)
    calibration: str | tuple[str, str] = ""
    calibration_override: str = ""
    uncertainty_um: Pair | None = None
    alignment: Matrix = ((1.0, 0.0), (0.0, 1.0))
    run_out: str = ""
    run_out_override: str = ""
    run_out_cos_um: tuple[tuple[float, ...], tuple[float, ...]] = ((), ())
    run_out_sin_um: tuple[tuple[float, ...], tuple[float, ...]] = ((), ())

    @property
    def calibration_name(self) -> str:
        """Return the record's name, or both."""
        names = self.calibration
        return names if isinstance(names, str) else " + ".join(names)


class ChannelSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[channels.NAME]: a free scalar channel, from an input (V) or a source, not both.

    An input is sampled with the encoder: value = scale (voltage - offset_V), scale in unit per V,
    or by ``table`` of (voltage in V, value), linear between its points and beyond its ends.
    source: "DEVICE.QUANTITY" of a device that tells it now and then, one value a revolution.
    """

    device: str = ""
    input: str = ""
    unit: str = ""
    scale: float = 1.0
    offset_V: float = 0.0
    table: tuple[Pair, ...] = ()
    range_V: float = 10.0
    latency_ms: float = 0.0
    source: str = ""

    @property
    def slow_source(self) -> tuple[str, str]:
        """Return device and quantity of ``source``."""
        device, _, quantity = self.source.partition(".")
        return device, quantity


class RigFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A rig file."""

    schema: int
    name: str
    devices: dict[str, DeviceSection]
    spindle: SpindleSection
    encoder: EncoderSection
    load_cell: LoadCellSection
    probes: ProbesSection
    channels: dict[str, ChannelSection] = {}
    simulation: SimulationSection | None = None
