"""The calibration wizard: a face of ``rigapp.commands.live_calibration``."""
