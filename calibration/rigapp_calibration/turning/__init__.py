"""Calibrations with a turning spindle: run-out of the pin, load cell by a known inertia force."""
