"""The DATAQ DI-2108 and DI-4108: voltages, scans by clock or encoder. Import ``driver``."""
