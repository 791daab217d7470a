"""Thermometers, hygrometers and other slow transmitters over Modbus RTU. Import ``driver``."""
