"""What a device and the program said on a line: recorded, read back, played as a device.

``trace`` is the file, ``recorder`` writes it, ``protocol_wire`` answers from it as
pyserial opens it (``wire://FILE``), ``ports`` finds out what the port of a rig file is.
"""
