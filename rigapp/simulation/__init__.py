"""The simulated rig: physics beyond the model, connected to the simulated devices.

Other packages import only ``process`` (start it), ``handle`` (control it), ``constants`` (its
assumptions), ``disturbances`` and ``wire.link`` (its faults), ``wire.ports`` (a port for a device).
"""
