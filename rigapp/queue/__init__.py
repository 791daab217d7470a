"""Queue of tests of one rig: the list, its file, and the worker that runs it.

Other packages import ``items``, ``store``, ``worker``.
"""
