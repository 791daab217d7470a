"""The simulated rig: physics that the model lacks, wired to the simulated devices.

Others enter by ``process`` (start it), ``handle`` (speak to it), ``constants`` (what it assumes),
``disturbances`` and ``link`` (the faults that it knows),
``endpoints`` (the ports of its devices).
"""
