"""The simulated rig: physics that the model lacks, wired to the simulated devices.

Others enter by ``process`` (start it), ``handle`` (speak to it), ``constants`` (what it assumes),
``disturbances`` and ``wire.link`` (the faults that it knows),
``wire.ports`` (one for a device).
"""
