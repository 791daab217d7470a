"""The GSV-8 at the byte level: requests and electrical signals in, responses and frames out.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from rigapp_drivers.gsv8.simulator.device import Gsv8Simulator
from rigapp_drivers.gsv8.simulator.state import Gsv8Fault

__all__ = ["Gsv8Fault", "Gsv8Simulator"]
