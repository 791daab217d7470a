"""What a device and the program said on a line: recorded, read back, played as a device.

``trace`` is the file, ``recorder`` writes it, ``player`` answers from it, ``protocol_wire`` is the
player as pyserial opens it (``wire://FILE``), ``ports`` finds out what the port of a rig file is.
"""
