"""The DATAQ DI-2108 and DI-4108 at the byte level: command lines and voltages in, words out.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from rigapp_drivers.dataq.simulator.device import COMMANDS, DataqFault, DataqSimulator

__all__ = ["COMMANDS", "DataqFault", "DataqSimulator"]
