"""Calibrations on a terminal with readings from a rig, or with its spindle turning."""
