"""The wire between a simulated device and the host: its ports, queue and faults."""
