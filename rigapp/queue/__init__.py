"""Queue of tests of one rig: the list, its file, and the worker that runs it.

Others enter by ``items``, ``store``, ``worker``.
"""
