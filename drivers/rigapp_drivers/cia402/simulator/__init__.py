"""A CiA 402 drive behind an slcan adapter at the byte level: text lines in, text lines out.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from rigapp_drivers.cia402.simulator.device import Cia402Simulator
from rigapp_drivers.cia402.simulator.node import Cia402Fault

__all__ = ["Cia402Fault", "Cia402Simulator"]
