"""The rig file: devices, the assignment of their inputs, and the linear calibration."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import msgspec

from rigapp.config.notify import NotifySection, PingSection
from rigapp.config.numbers import COUNT, FACTOR, FORCE_N, LATENCY_MS, TURN_DEG, within

Pair = tuple[float, float]
Triple = tuple[float, float, float]
Matrix = tuple[Pair, Pair]
Orders = tuple[float, ...]

SIMULATED = "simulated"
"""Port of a simulated device."""


class PlantSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[simulation.plant]: the differences of the simulated rig from the model.

    keys.toml explains each. Running-in and change depend on the depth, so that a resumed test
    continues alike. Keys after wear_change_depth_um are off by default; see examples/harsh.toml.
    bushing_creep_um_per_decade: after the first minute.
    """

    slider_mass_factor: Annotated[float, FACTOR] = 1.01
    spring_stiffness_factor: Annotated[float, FACTOR] = 0.985
    joint_friction_coefficient: Annotated[float, within(0.0, 2.0)] = 0.05
    wear_coefficient_factor: Annotated[float, within(0.0, 1e6)] = 1.1
    motor_torque_limit_Nm: Annotated[float, within(0.01, 10_000.0)] = 6.0
    speed_ripple_percent: Annotated[float, within(0.0, 50.0)] = 0.5
    cross_talk_percent: Annotated[float, within(0.0, 100.0)] = 1.5
    force_noise_N: Annotated[float, within(0.0, 1000.0)] = 0.7
    force_resolution_N: Annotated[float, within(0.0, 1000.0)] = 2.0
    force_drift_N_per_hour: Annotated[float, within(-10_000.0, 10_000.0)] = 0.2
    pin_run_out_um: Annotated[float, within(0.0, 1000.0)] = 3.0
    probe_noise_um: Annotated[float, within(0.0, 1000.0)] = 0.2
    filter_delay_ms: Annotated[float, within(0.0, 1000.0)] = 1.0
    outboard_mass_factor: Annotated[float, within(0.0, 100.0)] = 1.0
    probe_misalignment_deg: Annotated[Pair, TURN_DEG] = (0.0, 0.0)
    probe_sensitivity_error_percent: Annotated[Pair, within(-99.0, 1000.0)] = (0.0, 0.0)
    bushing_heating_K_per_W: Annotated[float, within(0.0, 10_000.0)] = 20.0
    bushing_time_constant_s: Annotated[float, within(1.0, 1e6)] = 300.0
    room_temperature_degC: Annotated[float, within(-40.0, 80.0)] = 21.0
    room_swing_K: Annotated[float, within(0.0, 50.0)] = 1.5
    humidity_percent: Annotated[float, within(0.0, 100.0)] = 45.0
    humidity_swing_percent: Annotated[float, within(0.0, 100.0)] = 8.0
    running_in_factor: Annotated[float, within(1.0, 1000.0)] = 1.0
    running_in_depth_um: Annotated[float, within(0.1, 10_000.0)] = 5.0
    wear_change_factor: Annotated[float, within(0.0, 1000.0)] = 1.0
    wear_change_depth_um: Annotated[float, within(0.0, 10_000.0)] = 20.0
    follower_mass_factor: Annotated[float, FACTOR] = 1.0
    clearance_error_um: Annotated[float, within(-1000.0, 1000.0)] = 0.0
    cell_gain_error_percent: Annotated[float, within(-50.0, 100.0)] = 0.0
    cell_creep_percent: Annotated[float, within(0.0, 10.0)] = 0.0
    cell_creep_time_s: Annotated[float, within(1.0, 1e6)] = 600.0
    pin_mass_kg: Annotated[float, within(0.0, 10.0)] = 0.0
    probe_wander_um: Annotated[float, within(0.0, 1000.0)] = 0.0
    probe_wander_revolutions: Annotated[float, within(1.0, 1e6)] = 200.0
    probe_temperature_um_per_K: Annotated[Pair, within(-100.0, 100.0)] = (0.0, 0.0)
    touched_probe_um: Annotated[float, within(-1000.0, 1000.0)] = 0.0
    touched_at_revolution: Annotated[float, within(0.0, 1e9)] = 100.0
    bushing_creep_um_per_decade: Annotated[float, within(0.0, 1000.0)] = 0.0
    room_swing_hours: Annotated[float, within(0.01, 10_000.0)] = 24.0
    restitution: Annotated[float | None, within(0.01, 1.0)] = None


class SimulationSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[simulation]: of the simulated devices; refused in a file without any."""

    seed: Annotated[int, within(0, 2**63 - 1)] = 1
    speed: Annotated[float, within(0.001, 10_000.0)] | Literal["max"] = 1.0
    plant: PlantSection = PlantSection()


class DeviceSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[devices.NAME]: driver, port and its settings.

    record: into a file in the folder ``wire`` beside the rig file.
    """

    driver: str
    port: str
    settings: dict[str, Any] = {}
    record: bool = False
    serial_number: str = ""

    @property
    def simulated(self) -> bool:
        """Return whether the device is simulated, which is determined by its port alone."""
        return self.port == SIMULATED


class SpindleSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[spindle]: the drive that turns the crank.

    Every speed in the program is the crank's.
    """

    device: str
    encoder_counts_per_revolution: Annotated[int, COUNT]
    maximum_speed_rpm: Annotated[float, within(0.1, 5000.0)]
    direction: Literal[1, -1] = 1
    watchdog_timeout_s: Annotated[float, within(0.05, 25.5)] = 0.5
    gear_ratio: Annotated[float, within(0.01, 1000.0)] = 1.0


class EncoderSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[encoder]: the crank encoder and the counter input that carries it."""

    device: str
    input: str
    counts_per_revolution: Annotated[int, COUNT] = 3600
    quadrature: Literal["after", "before"] = "after"
    direction: Literal[1, -1] = 1
    restarts_at_index: bool = True
    index_angle_deg: Annotated[float, TURN_DEG] = 0.0


class LoadCellSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[load_cell]: two bridges in the pin; force on the pin = matrix (signal - zero).

    quadratic_mV_per_V_per_N2: then signal - zero = inverse(matrix) f + quadratic (f1^2, f1 f2,
    f2^2), f the force on the pin. outboard_mass_kg: force_1 holds - mass radius speed^2 of it.
    """

    device: str
    input_1: str
    input_2: str
    matrix_N_per_mV_per_V: Annotated[Matrix, within(-1e6, 1e6)]
    zero_mV_per_V: Annotated[Pair, within(-1000.0, 1000.0)] = (0.0, 0.0)
    quadratic_mV_per_V_per_N2: Annotated[tuple[Triple, Triple] | None, within(-1.0, 1.0)] = None
    range_mV_per_V: Annotated[float, within(0.01, 1000.0)] = 3.5
    full_scale_N: Annotated[float, FORCE_N] = 400.0
    resolution_N: Annotated[float, within(1e-6, 1000.0)] = 2.0
    latency_ms: Annotated[Pair, LATENCY_MS] = (0.0, 0.0)
    uncertainty_N: Annotated[Pair | None, within(0.0, 10_000.0)] = None
    outboard_mass_kg: Annotated[float, within(0.0, 100.0)] = 0.0
    outboard_radius_mm: Annotated[float, within(0.1, 1000.0)] = 76.2
    pin_weight_N: Annotated[float, within(-10_000.0, 10_000.0)] = 0.0
    calibration: str = ""
    calibration_override: str = ""
    serial_number: str = ""


class ProbesSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[probes]: two capacitance probes; position = sensitivity (voltage - offset)."""

    device: str
    input_1: str
    input_2: str
    sensitivity_um_per_V: Annotated[Pair, within(1e-3, 1e5, size=True)]
    offset_V: Annotated[Pair, within(-1000.0, 1000.0)] = (0.0, 0.0)
    range_V: Annotated[float, within(0.001, 1000.0)] = 10.0
    latency_ms: Annotated[Pair, LATENCY_MS] = (0.0, 0.0)
    calibration: str | tuple[str, str] = ""
    calibration_override: str = ""
    uncertainty_um: Annotated[Pair | None, within(0.0, 10_000.0)] = None
    alignment: Annotated[Matrix, within(-100.0, 100.0)] = ((1.0, 0.0), (0.0, 1.0))
    run_out: str = ""
    run_out_override: str = ""
    run_out_cos_um: Annotated[tuple[Orders, Orders], within(-1000.0, 1000.0)] = ((), ())
    run_out_sin_um: Annotated[tuple[Orders, Orders], within(-1000.0, 1000.0)] = ((), ())

    @property
    def calibration_name(self) -> str:
        """Return the record's name, or both."""
        names = self.calibration
        return names if isinstance(names, str) else " + ".join(names)


class ChannelSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[channels.NAME]: a free scalar channel, from an input (V) or a source, not both.

    table: (voltage in V, value), linear between its points and beyond its ends. source: one value a
    revolution.
    """

    device: str = ""
    input: str = ""
    unit: str = ""
    scale: Annotated[float, within(1e-9, 1e9, size=True)] = 1.0
    offset_V: Annotated[float, within(-1000.0, 1000.0)] = 0.0
    table: Annotated[tuple[Pair, ...], within(-1e9, 1e9)] = ()
    range_V: Annotated[float, within(0.001, 1000.0)] = 10.0
    latency_ms: Annotated[float, LATENCY_MS] = 0.0
    source: str = ""
    uncertainty: Annotated[float | None, within(0.0, 1e9)] = None
    calibration: str = ""
    calibration_override: str = ""

    @property
    def slow_source(self) -> tuple[str, str]:
        """Return device and quantity of ``source``."""
        device, _, quantity = self.source.partition(".")
        return device, quantity


class RecordsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[records]: the laboratories whose calibration records are used.

    Files relative to the rig file. Empty: records need no signature.
    """

    trusted_keys: tuple[str, ...] = ()


class OperatorsSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[operators]: who may change limits.

    file: relative to the rig file.
    """

    file: str = ""


class OperatorsFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A file of operators. pins: a salted hash by name, as the window's settings write it."""

    schema: int
    pins: dict[str, str] = {}


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
    records: RecordsSection = RecordsSection()
    operators: OperatorsSection = OperatorsSection()
    simulation: SimulationSection | None = None
    notify: tuple[NotifySection, ...] = ()
    ping: PingSection | None = None

    @property
    def simulated_devices(self) -> tuple[str, ...]:
        """Return the names of the devices that are simulated."""
        return tuple(name for name, device in self.devices.items() if device.simulated)

    @property
    def simulated_samples(self) -> bool:
        """Return whether the samples are simulated: their time may differ from the clock's."""
        return self.devices[self.encoder.device].simulated

    @property
    def simulated(self) -> bool:
        """Return whether both drive and data acquisition are simulated."""
        return self.simulated_samples and self.devices[self.spindle.device].simulated
