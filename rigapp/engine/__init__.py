"""Run tests on a rig: the conductor, its connection to the devices, supervision.

Other packages import ``engine`` (the conductor), ``devices`` (what a rig file names), and the rules
that hold without an engine too: ``judging.limits``, ``values.calibrate``, ``recording.fileplan``,
``recording.store``. This package imports none of them: planning a test needs no compiled loops.
"""
