"""The calibration wizard: the window's face of ``rigapp.calibrating``, one page a question."""
