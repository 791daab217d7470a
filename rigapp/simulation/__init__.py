"""The simulated rig: physics that the model lacks, wired to the simulated devices.

Others enter by ``process`` (start it), ``handle`` (control it), ``constants`` (its assumptions),
``disturbances`` and ``wire.link`` (its faults), ``wire.ports`` (a port for a device).
"""
