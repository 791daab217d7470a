"""The wire between a simulated device and the host: its ports, its queue, its own faults."""
