"""Run tests on a rig: the engine, its connection to the devices, supervision.

Other packages import ``engine``, ``devices`` (those of a rig file), and the modules that need no
engine: ``judging.limits``, ``values.calibrate``, ``recording.fileplan``, ``recording.store``. This
package imports none of them: planning a test needs no compiled loops.
"""
