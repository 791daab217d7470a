"""Thermometers, hygrometers and other slow transmitters over Modbus RTU. Enter by ``driver``."""
