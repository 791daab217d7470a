"""CiA 402 drives, the maxon EPOS4 first, over CANopen. Enter by ``driver``."""
