"""Run tests on a rig: the conductor, its connection to the devices, supervision.

Others enter by ``engine`` (the conductor), ``devices`` (what a rig file names), and by the rules
that hold without an engine too: ``judging.limits``, ``values.calibrate``, ``recording.fileplan``,
``recording.store``. No door imports them all: who plans a test need not load compiled loops.
"""
