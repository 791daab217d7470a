"""Record the traffic on a line, read it, and play it back as a device.

``trace`` is the file format, ``recorder`` writes it, ``protocol_wire`` plays it back as a pyserial
port (``wire://FILE``), ``ports`` resolves the port of a rig file.
"""
