"""The RoboClaw at the byte level: packets in, replies and the motor's command out.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from rigapp_drivers.roboclaw.simulator.device import RoboClawSimulator
from rigapp_drivers.roboclaw.simulator.registers import RoboClawFault

__all__ = ["RoboClawFault", "RoboClawSimulator"]
