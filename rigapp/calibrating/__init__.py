"""Calibrations in the application: the parts that terminal and window share.

Sessions with live readings, their journal, the training mode, results, records and certificates,
the records that a rig file names. Independent of Qt, terminal and engine: it takes a window of
signals, and returns words and numbers.
"""
