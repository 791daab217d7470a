"""Calibration wizard: the user interface of ``rigapp.calibrating``, one page for each task."""
