"""The calibration wizard: a face of ``rigapp.calibrating.live_calibration``."""
