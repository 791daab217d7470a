"""Run tests on a rig: the conductor, its connection to the devices, supervision."""
