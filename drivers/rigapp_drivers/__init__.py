"""Device drivers, one package per device; independent of the application and of the physics.

``api`` defines the Protocols and errors, ``registry`` finds drivers by name, ``edge`` wraps every
call of a driver, ``discovery`` probes ports, ``transport`` opens them. Each device's package has
``driver`` (the entry point), ``probe``, and ``simulator``, a separate package that only the
simulated rig and tests load; ``simulator_api`` is the interface between the simulated rig and a
simulator, ``simulated`` the code common to all simulators. Other packages import only ``api``,
``edge``, ``registry``, ``discovery``, ``simulator_api``, ``transport``, ``wire.trace``,
``wire.recorder`` (recordings), ``wire.ports`` (port names) and ``cia402.probe`` (CAN buses).
Drivers of other packages import ``rigapp.drivers``.
"""
