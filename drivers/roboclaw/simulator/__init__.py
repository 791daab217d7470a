"""The RoboClaw at the byte level: packets in, replies and the motor's command out.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from drivers.roboclaw.simulator.device import RoboClawSimulator
from drivers.roboclaw.simulator.registers import RoboClawFault

__all__ = ["RoboClawFault", "RoboClawSimulator"]
