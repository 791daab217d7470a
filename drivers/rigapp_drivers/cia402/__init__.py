"""CiA 402 drives over CANopen, primarily the maxon EPOS4. Import ``driver``."""
