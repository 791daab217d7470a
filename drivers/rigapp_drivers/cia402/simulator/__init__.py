"""A CiA 402 drive behind an slcan adapter at the byte level: text lines in, text lines out.

Loaded by the simulated rig and by tests; no driver at run time imports it.

Heartbeats, their supervision, SDO and PDO run on the time of the wire (``now_s``), the ramps on
the time of the plant (``elapsed_s``).
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Final

from rigapp_drivers.cia402.protocol import RPM, VENDOR_MAXON
from rigapp_drivers.cia402.simulator.node import Cia402Fault, Cia402Node, NodeOptions
from rigapp_drivers.cia402.slcan import SlcanAdapter, encode_frame
from rigapp_drivers.simulated import FaultPlan, Faults
from rigapp_drivers.simulator_api import DriveCommand, MotorState

_GARBLED: Final = b"t1x5zz\r"


class Cia402Simulator:
    """Respond as an EPOS4 or another CiA 402 drive does; see ``SimulatedDrive``.

    node_id and bit_rate: as set on the drive; it receives nothing at another bit rate of the
    adapter. counts_per_revolution: of the motor's encoder after quadrature, a multiple of 4 (object
    3010 holds a quarter of it). velocity_unit: object 60A9 at power-on. tpdo1_period_s: period of
    TPDO1 in addition to sending on change; None is the EPOS4's behaviour. vendor: a value other
    than maxon's makes a drive with the objects of CiA 301 and CiA 402 only. lacking: missing
    objects. faults: ``Fault`` records or tables of their fields.
    """

    kinds = Cia402Fault

    def __init__(
        self,
        *,
        node_id: int = 1,
        bit_rate: int = 500_000,
        counts_per_revolution: int = 3600,
        velocity_unit: int = RPM,
        vendor: int = VENDOR_MAXON,
        device_name: str = "Simulated CiA 402 drive",
        tpdo1_period_s: float | None = None,
        lacking: Collection[int] = (),
        faults: Faults = (),
    ) -> None:
        if counts_per_revolution < 4 or counts_per_revolution % 4:
            raise ValueError(
                f"{counts_per_revolution} counts per revolution are not four times a whole number"
            )
        self._plan = FaultPlan(Cia402Fault, faults)
        self.inject, self.clear = self._plan.add, self._plan.clear
        self._bit_rate = bit_rate
        self._adapter = SlcanAdapter()
        self.node = Cia402Node(
            NodeOptions(
                node_id=node_id,
                encoder_pulses=counts_per_revolution // 4,
                vendor=vendor,
                name=device_name,
                velocity_unit=velocity_unit,
                tpdo1_period_s=tpdo1_period_s,
                lacking=lacking,
            ),
            self._plan,
        )

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process lines from the host and return the replies."""
        time_s = self._plan.tick(now_s)
        frames, answers = self._adapter.receive(data)
        for frame in frames:
            if self._receives:
                self.node.take(frame, time_s)
        return answers + self._advance(time_s)

    def command(self, elapsed_s: float, now_s: float) -> DriveCommand:
        """Advance the ramps, check heartbeats and faults, return the motor command."""
        self.node.tick(self._plan.tick(now_s))
        return self.node.advance(elapsed_s)

    def observe(self, state: MotorState) -> None:
        """Set the motor's state for later replies."""
        self.node.observe(state)

    def emit(self, now_s: float) -> bytes:
        """Return the unsolicited lines of the drive: heartbeat, TPDO, emergency."""
        return self._advance(self._plan.tick(now_s))

    @property
    def watchdog_tripped(self) -> bool:
        """Return whether the supervision of the host has stopped the motor since power-on."""
        return self.node.watchdog_tripped

    @property
    def _receives(self) -> bool:
        return self._adapter.bit_rate in (None, self._bit_rate)

    def _advance(self, time_s: float) -> bytes:
        self.node.tick(time_s)
        lines = b"".join(encode_frame(frame) for frame in self.node.collect(time_s))
        if self._plan.link_fault(Cia402Fault.GARBLED_LINE, 0) is not None:
            lines = _GARBLED + lines
        return lines if self._adapter.is_open and self._receives else b""


__all__ = ["Cia402Fault", "Cia402Simulator"]
