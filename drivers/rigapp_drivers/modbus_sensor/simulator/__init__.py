"""A Modbus RTU transmitter at the byte level: frames in, frames out, its own checksum.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from rigapp_drivers.modbus_sensor.simulator.device import (
    ModbusSensorFault,
    ModbusSensorSimulator,
    crc16,
)

__all__ = ["ModbusSensorFault", "ModbusSensorSimulator", "crc16"]
