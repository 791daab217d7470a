"""Bytes to meaning and back, one package a device; knows neither the application nor physics.

``api`` says what a driver offers and raises, ``registry`` finds drivers by name, ``edge`` is where
they are called, ``discovery`` asks who is on a port, ``transport`` opens ports. Each device's
package has ``driver`` (the entry point), ``probe``, and ``simulator``, a package of its own that
only the simulated rig and tests load; ``simulator_api`` is what the simulated rig sees of a
simulator, ``simulated`` what all simulators have. Others enter by ``api``, ``edge``, ``registry``,
``discovery``, ``simulator_api``, ``transport``, ``wire.trace``, ``wire.recorder`` (recorded lines),
``wire.ports`` (their names) and, for CAN buses, which are no serial ports, ``cia402.probe``.
Drivers of other packages import ``rigapp.drivers``.
"""
