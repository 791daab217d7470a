"""Tests of one rig, one after another: the list, the disk that keeps it, who works it through.

Others enter by ``items``, ``store``, ``worker``.
"""
