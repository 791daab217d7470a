"""The simulated rig: physics that the model lacks, wired to the simulated devices."""
