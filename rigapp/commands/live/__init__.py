"""Calibrations at a terminal that take their readings at a rig, or turn its spindle."""
